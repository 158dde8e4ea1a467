"""Flow stresses that are curves over the plastic strain, and uniaxial stress on them.

    Voce (J. Inst. Metals 74 (1948) 537)     A + Q (1 - exp(-b p))
    Ludwik (Elemente der technologischen Mechanik, 1909)     A + K p^n
    Swift (J. Mech. Phys. Solids 1 (1952) 1)     K (e + p)^n
    Cowper and Symonds (Brown University, 1957)     times 1 + (rate / D)^(1/q)

In uniaxial stress s the logarithmic strain is p + s/E. A metal of Johnson and Cook (Proc. 7th Int. Symp. Ballistics, 1983, 541) has the
flow stress (A + B p^n) (1 + C ln (rate / rate_0)) (1 - T*^m); a share of its work per first volume becomes heat, and none leaves.
"""
from functools import lru_cache
from math import exp, log

SLOW = ((0.0, 250e6), (0.01, 320e6), (0.05, 400e6), (0.1, 480e6), (0.2, 600e6))
FAST = ((0.0, 330e6), (0.02, 400e6), (0.1, 540e6), (0.2, 650e6))
YOUNG = 200e9
STEEL_4340 = dict(density=7830, young=200e9, poisson=0.29, A=792e6, B=510e6, n=0.26, C=0.014, rate_0=1.0, m=1.03, cold=293.0, melt=1793.0,
                  heat=477.0, share=0.9)


def measured(table, p):
    """Linear between points, and constant beyond the last one [Pa].

    >>> [measured(SLOW, p) / 1e6 for p in (0, 0.01, 0.15, 0.5)]
    [250.0, 320.0, 540.0, 600.0]
    """
    for (a, low), (b, high) in zip(table, table[1:]):
        if p <= b:
            return low + (high - low) * (p - a) / (b - a)
    return table[-1][1]


def between(p, rate, slow=1.0, fast=100.0):
    """Between curves at two rates linear in the logarithm of the rate, beyond them the nearest one [Pa].

    >>> round(between(0, 10) / 1e6, 9), between(0, 1e6) / 1e6, between(0, 1e-6) / 1e6
    (290.0, 330.0, 250.0)
    """
    part = min(max(log(rate / slow) / log(fast / slow), 0.0), 1.0) if rate > 0 else 0.0
    return (1 - part) * measured(SLOW, p) + part * measured(FAST, p)


def voce(p, yields=250e6, growth=300e6, exponent=10):
    """
    >>> voce(0) / 1e6, round(voce(100) / 1e6, 9)
    (250.0, 550.0)
    """
    return yields + growth * (1 - exp(-exponent * p))


def ludwik(p, yields=250e6, growth=300e6, exponent=0.5):
    """
    >>> ludwik(0) / 1e6, ludwik(0.25) / 1e6
    (250.0, 400.0)
    """
    return yields + growth * p**exponent


def swift(p, growth=700e6, exponent=0.2, offset=0.02):
    """
    >>> round(swift(0.98) / 1e6, 9)
    700.0
    """
    return growth * (offset + p)**exponent


def cowper_symonds(rate, reference=40.4, exponent=5):
    """The factor of the rate.

    >>> cowper_symonds(40.4), cowper_symonds(0)
    (2.0, 1.0)
    """
    return 1 + (rate / reference)**(1 / exponent)


def area_under(table, p):
    """Work of a unit of volume [J/m3].

    >>> round(area_under(SLOW, 0.01) / 1e6, 9), round(area_under(SLOW, 0.05) / 1e6, 9)
    (2.85, 17.25)
    """
    knots = [a for a, _ in table if a < p] + [p]
    return sum((measured(table, a) + measured(table, b)) / 2 * (b - a) for a, b in zip(knots, knots[1:]))


def area_between(first, last, rate):
    """Work of a unit of volume from one plastic strain to another at a rate that stays [J/m3]: of curves, each linear in parts.

    >>> round(area_between(0.0, 0.01, 1.0) / 1e6, 9), round(area_between(0.0, 0.02, 100.0) / 1e6, 9)
    (2.85, 7.3)
    """
    knots = [first, *sorted({p for table in (SLOW, FAST) for p, _ in table if first < p < last}), last]
    return sum((between(a, rate) + between(b, rate)) / 2 * (b - a) for a, b in zip(knots, knots[1:]))


def pulled(strains, steps, flow):
    """[(stress [Pa], plastic strain, its rate)] at logarithmic strains that grow in increments, from the strains alone.

    Each increment takes the flow stress at its end, with the rate of the plastic strain in it: p + flow(p, rate) / E is the strain.

    steps  [s] of the increments
    flow   flow stress of the plastic strain and its rate

    >>> found = pulled([0, 0.001, 0.01 + 320e6 / YOUNG], [1, 1], lambda p, rate: measured(SLOW, p))
    >>> [(round(s / 1e6, 6), round(p, 9)) for s, p, _ in found]
    [(0.0, 0.0), (200.0, 0.0), (320.0, 0.01)]
    """
    found, p = [(0.0, 0.0, 0.0)], 0.0
    for strain, step in zip(strains[1:], steps):
        low, high = p, strain
        if YOUNG * (strain - p) <= flow(p, 0.0):
            found.append((YOUNG * (strain - p), p, 0.0))
            continue
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if middle + flow(middle, (middle - p) / step) / YOUNG < strain else (low, middle)
        found.append((YOUNG * (strain - low), low, (low - p) / step))
        p = low
    return found


def uniaxial(strain):
    """Stress [Pa] and plastic strain of the slow curve at a logarithmic strain.

    >>> s, p = uniaxial(0.01 + 320e6 / YOUNG)
    >>> round(s / 1e6, 6), round(p, 9)
    (320.0, 0.01)
    """
    if YOUNG * strain <= SLOW[0][1]:
        return YOUNG * strain, 0.0
    low, high = 0.0, strain
    for _ in range(100):
        p = (low + high) / 2
        low, high = (p, high) if p + measured(SLOW, p) / YOUNG < strain else (low, p)
    return measured(SLOW, low), low


def johnson_cook(p, rate, temperature, metal=STEEL_4340):
    """
    >>> round(johnson_cook(0, 1, 293) / 1e6, 9), johnson_cook(1, 1, 1793)
    (792.0, 0.0)
    """
    hot = min(max((temperature - metal["cold"]) / (metal["melt"] - metal["cold"]), 0.0), 1.0)
    return (metal["A"] + metal["B"] * p**metal["n"]) * (1 + metal["C"] * log(max(rate / metal["rate_0"], 1.0))) * (1 - hot**metal["m"])


@lru_cache
def heated(strain, time, steps=8000):
    """Stress [Pa], plastic strain and temperature [K] of Johnson and Cook's steel in uniaxial stress at a logarithmic strain that has grown
    at a constant rate: small steps with the rate of each step, and the heat by the trapezoid.

    >>> stress, p, _ = heated(1e-3, 1.0, 10)    # elastic
    >>> round(stress / 1e6, 9), p
    (200.0, 0.0)
    >>> stress, p, temperature = heated(0.05, 0.05, 500)
    >>> round(stress / johnson_cook(p, 1.0, temperature), 6), round(0.9 * 1e9 * p / (7830 * 477) / (temperature - 293), 1)
    (1.0, 1.0)
    """
    metal, step = STEEL_4340, time / steps
    p, stress, temperature = 0.0, 0.0, metal["cold"]

    def state(e, q):
        """At a strain and a plastic strain."""
        now = metal["young"] * (e - q)
        volume = exp((1 - 2 * metal["poisson"]) * (stress + now) / 2 / metal["young"])
        return now, q, temperature + metal["share"] * volume * (stress + now) / 2 * (q - p) / (metal["density"] * metal["heat"])

    for i in range(1, steps + 1):
        e = strain * i / steps
        low, high = p, e
        if metal["young"] * (e - p) <= johnson_cook(p, 0.0, temperature):
            high = p
        for _ in range(60 if high > low else 0):
            middle = (low + high) / 2
            now, _, warm = state(e, middle)
            low, high = (middle, high) if now > johnson_cook(middle, (middle - p) / step, warm) else (low, middle)
        stress, p, temperature = state(e, low)
    return stress, p, temperature
