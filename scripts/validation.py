"""Comparison with experiments: error, uncertainties and verdict of a point, bias and scatter of many.

ASME V&V 20 (2009): of a result S of the program and a measurement D

    E = S - D,   u_val^2 = u_num^2 + u_input^2 + u_D^2,   and the model error lies in E +- k u_val.

All u are standard uncertainties, k = 2. Where |E| is at most k u_val, the error of the model cannot be told from what is not known: a hit.
Otherwise E is the model error, with k u_val as its uncertainty: a miss, which is printed as any other point.

Of many points, McGrattan & Toman, Metrologia 48 (2011) 173-180, as the validation guide of FDS uses them: with M computed, E measured,
sE the relative standard uncertainty of the measurement,

    sM^2 = var ln(M/E) - sE^2,   bias = exp(mean ln(M/E) + sM^2/2 - sE^2/2),

so computed values are measured ones times bias, with the relative scatter sM. A point drawn at M lies with 95 % probability between
bias (1 - 2 sM) and bias (1 + 2 sM) times its truth. The variance has n - 1.
"""
import dataclasses
import math

from convergence import NO_ORDER_FACTOR, tendency

COVERAGE = 2.0  # k: about 95 of 100
COLUMNS = ("family", "quantity", "group", "label", "at", "measured", "computed", "u_num", "u_input", "u_measured", "error", "u_val",
           "verdict", "blind", "ending")


@dataclasses.dataclass
class Point:
    """A measured number beside the computed one, in one unit; u_... are standard uncertainties relative to `measured`.

    group  what the family is divided into, as a batch of metal: bias and scatter are given for each
    at     what the points of a family are ordered by, as a speed
    blind  no run of this point was seen before the criteria were written
    """
    family: str
    quantity: str
    group: str
    label: str
    at: float
    measured: float
    computed: float
    u_num: float
    u_input: float
    u_measured: float
    blind: bool = True
    ending: str = "end"

    def error(self):
        """E over D. [-]"""
        return self.computed / self.measured - 1

    def u_val(self):
        return math.sqrt(self.u_num**2 + self.u_input**2 + self.u_measured**2)

    def verdict(self):
        """
        >>> Point("", "", "", "", 0, 1.0, 1.05, 0.003, 0.02, 0.02).verdict()
        'hit'
        >>> Point("", "", "", "", 0, 1.0, 1.07, 0.003, 0.02, 0.02).verdict()
        'miss'
        >>> Point("", "", "", "", 0, 1.0, math.nan, 0.003, 0.02, 0.02).verdict()
        'no result'
        """
        if not math.isfinite(self.computed):
            return "no result"
        return "hit" if abs(self.error()) <= COVERAGE * self.u_val() else "miss"

    def row(self):
        """Texts of COLUMNS."""
        numbers = (self.measured, self.computed, self.u_num, self.u_input, self.u_measured, self.error(), self.u_val())
        return [self.family, self.quantity, self.group, self.label, f"{self.at:g}", *(f"{x:.5g}" for x in numbers), self.verdict(),
                "yes" if self.blind else "no", self.ending]


def u_of_meshes(levels, values):
    """Standard uncertainty of the finest value over it: Roache's index, taken as an interval of k = 2. Levels grow with the mesh. Of two
    meshes it is as much as without an order: three times their spread.

    >>> round(u_of_meshes([2, 3, 4], [1 + 2**-2, 1 + 3**-2, 1 + 4**-2]), 4)
    0.0368
    >>> round(u_of_meshes([2, 3], [1.02, 1.0]), 4)
    0.03
    """
    spread = NO_ORDER_FACTOR * (max(values) - min(values))
    uncertainty = spread if len(levels) == 2 else tendency(levels, values)[2]
    finest = max(zip(levels, values))[1]
    return math.nan if uncertainty is None else abs(uncertainty / finest) / COVERAGE


def u_of_inputs(nominal, changed):
    """Standard uncertainty over the nominal result, by the law of propagation for inputs that do not depend on each other.

    changed  [(value with the input one standard uncertainty below, above), ...]

    >>> round(u_of_inputs(10, [(9.9, 10.1), (10.2, 9.8)]), 6)
    0.022361
    """
    return math.sqrt(sum((0.5 * (high - low))**2 for low, high in changed)) / abs(nominal)


def bias_and_scatter(pairs, u_measured):
    """(bias, scatter of the model, number) of (measured, computed); u_measured is relative.

    A scatter smaller than that of the measurements is zero, and then the bias is the mean of the ratios' logarithms.

    >>> [round(x, 4) for x in bias_and_scatter([(1, 1.05), (2, 2.1), (3, 3.15)], 0.0)]
    [1.05, 0.0, 3]
    >>> bias, scatter, _ = bias_and_scatter([(1, 1.0), (1, 1.1), (1, 1.2)], 0.02)
    >>> round(bias, 4), round(scatter, 4)
    (1.1011, 0.089)
    """
    logs = [math.log(computed / measured) for measured, computed in pairs]
    mean = sum(logs) / len(logs)
    variance = sum((x - mean)**2 for x in logs) / (len(logs) - 1) if len(logs) > 1 else 0.0
    of_model = variance - u_measured**2
    if of_model <= 0:
        return math.exp(mean), 0.0, len(logs)
    return math.exp(mean + of_model / 2 - u_measured**2 / 2), math.sqrt(of_model), len(logs)


def summary(points):
    """Rows of a table: family, quantity and group, points, hits, blind ones, bias, scatter, largest error."""
    rows = []
    for key in dict.fromkeys((p.family, p.quantity, p.group) for p in points):
        some = [p for p in points if (p.family, p.quantity, p.group) == key and math.isfinite(p.computed)]
        lost = sum((p.family, p.quantity, p.group) == key for p in points) - len(some)
        if not some:
            rows.append([*key, f"0 of {lost}", "", "", "", "", ""])
            continue
        u = math.sqrt(sum(p.u_measured**2 for p in some) / len(some))
        bias, scatter, n = bias_and_scatter([(p.measured, p.computed) for p in some], u)
        worst = max(some, key=lambda p: abs(p.error()))
        rows.append([*key, f"{n} of {n + lost}", f"{sum(p.verdict() == 'hit' for p in some)}", f"{sum(p.blind for p in some)}",
                     f"{bias:.3f}", f"{scatter:.3f}", f"{worst.error():+.1%} ({worst.label})"])
    return rows


SUMMARY_COLUMNS = ["family", "quantity", "group", "points", "hits", "blind", "bias", "scatter", "largest error"]
