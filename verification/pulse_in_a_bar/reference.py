"""A Gaussian displacement at rest in a bar parts into two pulses: d'Alembert's solution, u = (a/2)(g(z - ct) + g(z + ct)).

Clamped ends reflect a pulse with the other sign. While the pulses are away from them the bar is as good as infinite; at the time L/c
each pulse has been at one end and both meet in the middle again, so u = -a g(z), at rest.

Source of the inputs: Norma.jl, test single-explicit-dynamic-solid-clamped and its example clamped.yaml: E = 1 GPa, 1000 kg/m3, no
Poisson effect, a = 0.01 m, s = 0.02 m, t = 1e-5 s. Its gates are relative, to the extremes over the bar of this solution: u 8e-5, v 6e-4
(the smallest 5e-4), a 6e-4. These extremes are those at its nodes, 1 mm apart; between them
the velocity reaches 98.7857. It has a linear material; ours sees strains of 30 % there, so the case has a millionth of the height.
"""
from math import exp, sqrt

INPUTS = {"young": 1e9, "density": 1000.0, "height": 0.01, "width": 0.02}  # SI
TIME, NODES = 1e-5, 1e-3  # [s] [m]
PART = 1e-6               # [-] of the height, as it is run


def pulse(z, t, young, density, height, width):
    """Displacement, velocity and acceleration [m, m/s, m/s2] far from the ends.

    >>> [f"{x:.6g}" for x in pulse(0.0, TIME, **INPUTS)]
    ['0.00882497', '-220.624', '-1.65468e+07']
    """
    c = sqrt(young / density)
    u = v = a = 0.0
    for sign in (-1, 1):
        x = (z + sign * c * t) / width
        g = height / 2 * exp(-x * x / 2)
        u += g
        v += -sign * c / width * x * g
        a += (c / width)**2 * (x * x - 1) * g
    return u, v, a


def extremes(t, **inputs):
    """Largest and smallest value of displacement, velocity, acceleration at places NODES apart, as the source has its nodes.

    >>> found = extremes(TIME, **INPUTS)
    >>> [f"{value:.6g}" for pair in found for value in pair]
    ['0.00882497', '0', '98.7781', '-220.624', '7.95606e+06', '-1.65468e+07']
    """
    samples = [pulse(i * NODES, t, **inputs) for i in range(500)]  # even in z
    result = []
    for which in range(3):
        values = [sample[which] for sample in samples]
        low = min(values)
        result.append((max(values), 0.0 if abs(low) < 1e-12 * max(values) else low))
    return result


def reflected(z, young, density, height, width):
    """Displacement at L/c [m]: the pulse upside down.

    >>> reflected(0.0, **INPUTS)
    -0.01
    """
    return -height * exp(-(z / width)**2 / 2)
