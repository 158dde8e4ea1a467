"""A ring that starts outwards everywhere at once: how far and how long it breathes in, elastic and plastic.

A thin ring of radius R is in uniaxial stress along its hoop. Its radius r moves by  r'' = -sigma A / (rho A0 R), with A its section now. If
it keeps its volume, A r = A0 R, and with the logarithmic strain e = ln(r/R)

    rho r r'' = -sigma(e),     1/2 rho (V^2 - r'^2) = integral of sigma over e,

so that the largest strain follows from energy alone, at strains of any size. `small` has closed forms where r stays close to R, as the
catalogue gives them; `history` integrates the equation. A plate that keeps its thickness has a section, and with it a force, that is larger
by the factor exp(e/2): `thickening`.
"""
from math import acos, asin, exp, log, sqrt

STEEL = {"density": 7850, "young": 200e9, "yield_stress": 300e6}
PERFECT, HARDENING = 0.0, 2e9  # [Pa] tangent moduli


def largest_strain(speed, density, young, yield_stress, tangent):
    """Of energy: 1/2 rho V^2 = sigma_y e - sigma_y e_y/2 + E_t (e - e_y)^2/2, e_y = sigma_y/E.

    >>> round(largest_strain(50, tangent=PERFECT, **STEEL), 6), round(largest_strain(50, tangent=HARDENING, **STEEL), 6)
    (0.033458, 0.03063)
    """
    first = yield_stress / young
    left = density * speed**2 / 2 - yield_stress * first / 2
    if tangent == 0:
        return first + left / yield_stress
    return first + (sqrt(yield_stress**2 + 2 * tangent * left) - yield_stress) / tangent


def small(speed, density, young, yield_stress, tangent, radius=1.0):
    """(largest strain, its time [s], strain that stays) for r close to R: an arc of a sine up to yield, then a parabola or another.

    >>> [round(v, 7) for v in small(50, tangent=PERFECT, **STEEL)]
    [0.0334583, 0.0013234, 0.0319583]
    >>> [round(v, 7) for v in small(50, tangent=HARDENING, **STEEL)]
    [0.0306298, 0.0011759, 0.0288385]
    """
    first = yield_stress / young
    omega = sqrt(young / density) / radius
    start = asin(first * radius * omega / speed) / omega
    rate = sqrt(speed**2 - (first * radius * omega)**2)  # [m/s] at yield
    largest = largest_strain(speed, density, young, yield_stress, tangent)
    if tangent == 0:
        end = start + rate * density * radius / yield_stress
    else:
        slow = sqrt(tangent / density) / radius  # the arc about the strain at which the hardening line meets zero
        past = first - yield_stress / tangent
        end = start + acos((first - past) / (largest - past)) / slow
    stress = yield_stress + tangent * (largest - first)
    return largest, end, largest - stress / young


def history(speed, density, young, yield_stress, tangent, radius=1.0, thickening=0.0, end=2e-3, steps=4000):
    """[(t, e, stress)] by Runge and Kutta's method at finite strain; `thickening` is 1 for a plate that keeps its thickness, else 0.

    >>> path = history(50, tangent=PERFECT, **STEEL)
    >>> abs(max(e for _, e, _ in path) / largest_strain(50, tangent=PERFECT, **STEEL) - 1) < 1e-5
    True
    >>> slow = top(history(10, tangent=HARDENING, end=6e-4, **STEEL))
    >>> [abs(a / b - 1) < 2e-3 for a, b in zip(slow, reversed(small(10, tangent=HARDENING, **STEEL)[:2]))]
    [True, True]
    """
    hardening = young * tangent / (young - tangent)
    plastic, flowed = 0.0, 0.0  # signed, accumulated

    def stress_at(e):
        trial = young * (e - plastic)
        over = abs(trial) - (yield_stress + hardening * flowed)
        return trial if over <= 0 else trial - young * over / (young + hardening) * (1 if trial > 0 else -1)

    def pull(r):
        e = log(r / radius)
        return -stress_at(e) * exp(0.5 * thickening * e) / (density * r)

    r, v, h, path = radius, speed, end / steps, []
    for i in range(steps + 1):
        e = log(r / radius)
        stress = stress_at(e)
        step = (e - stress / young) - plastic
        plastic, flowed = plastic + step, flowed + abs(step)
        path.append((i * h, e, stress))
        k1, l1 = v, pull(r)
        k2, l2 = v + h / 2 * l1, pull(r + h / 2 * k1)
        k3, l3 = v + h / 2 * l2, pull(r + h / 2 * k2)
        k4, l4 = v + h * l3, pull(r + h * k3)
        r, v = r + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
    return path


def top(path):
    """(time, strain) of the largest strain, by a parabola through three points."""
    i = max(range(len(path)), key=lambda k: path[k][1])
    (t0, a, _), (t1, b, _), (_, c, _) = path[i - 1:i + 2]
    shift = (a - c) / (2 * (a - 2 * b + c))
    return t1 + shift * (t1 - t0), b - (a - c) * shift / 4
