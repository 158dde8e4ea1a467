"""Flow stresses that are curves over the plastic strain, and uniaxial stress on them.

    Voce (J. Inst. Metals 74 (1948) 537)     A + Q (1 - exp(-b p))
    Ludwik (Elemente der technologischen Mechanik, 1909)     A + K p^n
    Swift (J. Mech. Phys. Solids 1 (1952) 1)     K (e + p)^n
    Cowper and Symonds (Brown University, 1957)     times 1 + (rate / D)^(1/q)

In uniaxial stress s the logarithmic strain is p + s/E.
"""
from math import exp, log

SLOW = ((0.0, 250e6), (0.01, 320e6), (0.05, 400e6), (0.1, 480e6), (0.2, 600e6))
FAST = ((0.0, 330e6), (0.02, 400e6), (0.1, 540e6), (0.2, 650e6))
YOUNG = 200e9


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
