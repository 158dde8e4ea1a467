"""How much of a result's spread each uncertain input makes on its own: first-order indices from a few runs, with their sampling error.

Inputs are independent and uniform; u in [-1, 1] goes from the low end to the high one. The result is taken apart as
f(u) = f0 + sum_i g_i(u_i) + rest, where g_i is the mean of f over all other inputs, less f0. So S_i = var g_i / var f is Sobol's
first-order index, and the share of the rest is what inputs do together, and what the fit misses.

g_i is a sum of Legendre polynomials p_k(u) = sqrt(2k + 1) P_k(u), orthonormal for a uniform input, fitted by least squares to all runs
(Sudret, Reliab. Eng. Syst. Saf. 93 (2008) 964-979, without products of inputs: those have no part in S_i). Each input has a degree of its
own, at least 1, chosen by the error of runs that are left out one at a time, which the fit gives in closed form. Then

    var g_i = sum_k (c_ik^2 - var c_ik),   var rest = sum_j e_j^2 / (N - terms),   var f = sum_i var g_i + var rest

with N runs, residuals e_j, and the variance of a coefficient taken off because its square is on average too large by it. All sampling
errors are those of the jackknife: the fit without each run in turn, for the degrees chosen; an index has 2 sum_k (var c_ik)^2 / (var f)^2
more, the variance of c^2 where c is nothing. The jackknife takes runs as independent, which is too careful for Sobol's points and Latin
hypercubes. It does not see what all runs miss: few runs fit planes, and a curved effect is then in the rest.
"""
import dataclasses

import numpy as np

MOST_DEGREE = 8       # of a polynomial
RUNS_PER_TERM = 3     # [-] at least, where degrees above 1 are tried
LEAST_PER_TERM = 1.5  # [-] runs for each term of a plane, below which there is no estimate
GAIN = 8.0            # [-] N times the share of the error of runs left out that a change of degree must take off: by chance few do
ROUND_OFF = 1e-20     # [-] of the variance: a fit that leaves less is exact
TWICE = 2.0           # standard errors that are given, about 95 of 100


@dataclasses.dataclass
class Number:
    """An estimate and twice its standard error, of the sampling alone."""
    value: float
    error: float


@dataclasses.dataclass
class Sensitivity:
    """What runs say of one result.

    mean, deviation  of the result over all inputs
    share            S_i [-] of each input
    change           [unit of the result] from the low end to the high one along the straight line closest to g_i
    rest             [-] share of what no single input makes
    predicted        [-] share of the variance that the single inputs predict in runs that were left out of the fit
    degrees          of the polynomials
    """
    mean: Number
    deviation: Number
    share: list
    change: list
    rest: Number
    predicted: float
    degrees: list


class TooFew(Exception):
    """There are not enough runs for this many inputs."""


def least_runs(inputs):
    """Runs below which a plane has no estimate of its own error."""
    return int(np.ceil(LEAST_PER_TERM * (1 + inputs)))


def polynomials(u, degree):
    """p_1 ... p_degree at u: an array of len(u) x degree."""
    return np.polynomial.legendre.legvander(u, degree)[:, 1:] * np.sqrt(2 * np.arange(1, degree + 1) + 1)


def left_out(design, values):
    """Sum of the squared errors of runs, each predicted by the fit to the others."""
    fit = np.linalg.qr(design)[0]
    leverage = np.sum(fit * fit, axis=1)
    if np.any(leverage > 1 - 1e-9):
        return np.inf
    return float(np.sum(((values - fit @ (fit.T @ values)) / (1 - leverage))**2))


def chosen_degrees(columns, values):
    """The degree of each input, by steps of one input at a time as long as runs left out are predicted better.

    columns  [input] polynomials of all degrees at the runs
    """
    inputs, runs = len(columns), len(values)
    degrees = [1] * inputs
    most_terms = max(runs // RUNS_PER_TERM, 1 + inputs)

    def error(tried):
        return left_out(design_of(columns, tried), values)

    now = error(degrees)
    exact = ROUND_OFF * float(np.sum((values - values.mean())**2))
    while now > exact:
        others = [degrees[:i] + [k] + degrees[i + 1:] for i in range(inputs) for k in range(1, MOST_DEGREE + 1)
                  if k != degrees[i] and 1 + sum(degrees) - degrees[i] + k <= most_terms]
        tried = [(error(one), one) for one in others]
        best, which = min(tried, default=(np.inf, None), key=lambda one: one[0])
        if not best < (1 - GAIN / runs) * now:
            break
        now, degrees = best, which
    return degrees


def design_of(columns, degrees):
    return np.column_stack([np.ones(len(columns[0])), *(one[:, :k] for one, k in zip(columns, degrees))])


def estimate(u, values):
    """The Sensitivity of the values of runs at u [run][input]; TooFew where the runs cannot tell."""
    u, values = np.asarray(u, dtype=float), np.asarray(values, dtype=float)
    runs, inputs = u.shape
    if runs < least_runs(inputs):
        raise TooFew(f"{runs} runs with a result are too few for {inputs} inputs: {least_runs(inputs)} or more are needed")
    scale = float(np.max(np.abs(values - values[0])))
    if scale == 0:  # no input has any effect
        none = [Number(0.0, 0.0) for _ in range(inputs)]
        return Sensitivity(Number(float(values[0]), 0.0), Number(0.0, 0.0), none, none, Number(0.0, 0.0), 1.0, [1] * inputs)
    shifted = (values - values[0]) / scale
    columns = [polynomials(u[:, i], MOST_DEGREE) for i in range(inputs)]
    degrees = chosen_degrees(columns, shifted)
    design = design_of(columns, degrees)
    press = left_out(design, shifted)
    if not np.isfinite(press):
        raise TooFew("a run is the only one that tells a term of the fit: more runs are needed")
    ends = np.cumsum([1, *degrees])
    parts = [slice(a, b) for a, b in zip(ends, ends[1:])]

    def numbers(coefficients, squares, of_runs):
        """[f0, sd, S_1 ..., rest, change_1 ...] of one fit."""
        own = [np.sum(coefficients[part]**2 - noise[part]) for part in parts]
        rest = squares / (of_runs - len(coefficients))
        total = max(sum(own), 0.0) + rest
        return np.array([coefficients[0], np.sqrt(total), *(one / total for one in own), rest / total,
                         *(2 * np.sqrt(3) * coefficients[part.start] for part in parts)])

    inverse = np.linalg.inv(design.T @ design)
    pulls = inverse @ design.T  # [term][run]
    fit = pulls @ shifted
    residuals = shifted - design @ fit
    spare = 1 - np.sum(design * pulls.T, axis=1)
    without = fit[:, None] - pulls * (residuals / spare)  # [term][run left out]
    noise = variance_of(without)
    squares = float(np.sum(residuals**2))
    whole = numbers(fit, squares, runs)
    replicas = np.array([numbers(without[:, j], squares - residuals[j]**2 / spare[j], runs - 1) for j in range(runs)])
    variances = variance_of(replicas.T)
    total = whole[1]**2
    for i, part in enumerate(parts):  # of c^2 beyond 4 c^2 var c, which is nothing where c is
        variances[2 + i] += 2 * np.sum(noise[part]**2) / total**2
        whole[2 + i] = max(whole[2 + i], 0.0)
    errors = TWICE * np.sqrt(variances)

    def number(at, unit=1.0):
        return Number(float(whole[at]) * unit, float(errors[at]) * unit)

    mean = number(0, scale)
    mean.value += float(values[0])
    return Sensitivity(mean, number(1, scale), [number(2 + i) for i in range(inputs)],
                       [number(3 + inputs + i, scale) for i in range(inputs)], number(2 + inputs),
                       1 - press / float(np.sum((shifted - shifted.mean())**2)), degrees)


def variance_of(replicas):
    """The jackknife's variance of numbers, from those without each run in turn: [number][run left out]."""
    runs = replicas.shape[1]
    return (runs - 1) / runs * np.sum((replicas - replicas.mean(axis=1, keepdims=True))**2, axis=1)
