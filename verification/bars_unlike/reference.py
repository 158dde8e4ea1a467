"""Two elastic bars of any lengths and impedances that collide end on end, by characteristics.

In a bar p + Z v is constant along dx = +c dt and p - Z v along dx = -c dt, with the pressure p, the velocity v of the material and the
impedance Z = rho c. What leaves the ends in contact comes back from the free end, where p = 0, after T = 2 L/c with the other sign. So
only the ends in contact need be known, and there all is constant between arrivals: nothing is discretised. Ends push and do not pull. They
part where p would be negative and meet again where the gap closes.
Source: d'Alembert; Graff, Wave Motion in Elastic Solids, chapter 2 (impact of rods).
"""
from dataclasses import dataclass
from math import sqrt


@dataclass
class Bar:
    """SI units."""
    density: float
    young: float
    length: float
    velocity: float

    def impedance(self):
        return sqrt(self.density * self.young)

    def transit(self):
        """There and back."""
        return 2 * self.length * sqrt(self.density / self.young)


def history(left, right, gap, end):
    """[(from when, pressure between the ends)] until `end`; the left bar moves to +x relative to the right one.

    Equal bars: rho c V/2 for 2 L/c.
    >>> steel = dict(density=7850, young=210e9, length=0.1)
    >>> [(round(1e6 * t, 2), round(p / 1e6, 3)) for t, p in history(Bar(**steel, velocity=2.5), Bar(**steel, velocity=-2.5), 5e-6, 1e-4)]
    [(0.0, 0.0), (1.0, 101.504), (39.67, 0.0)]

    A bar of three times the impedance of a very long one: each step is (3 - 1)/(3 + 1) of the one before.
    >>> heavy, light = Bar(9, 1, 1, 1), Bar(1, 1, 100, 0)
    >>> [(t, p) for t, p in history(heavy, light, 0, 20)]
    [(0.0, 0.75), (6.0, 0.375), (12.0, 0.1875), (18.0, 0.09375)]
    """
    za, zb, ta, tb = left.impedance(), right.impedance(), left.transit(), right.transit()
    tiny = 1e-9 * min(ta, tb)
    sent_a, sent_b = [(-ta, -za * left.velocity)], [(-tb, zb * right.velocity)]  # [(from when, p - Z v)] of the left, p + Z v of the right
    steps, arrivals, t = [], [ta, tb], 0.0
    while t < end:
        comes_a, comes_b = -value_at(sent_a, t - ta + tiny), -value_at(sent_b, t - tb + tiny)
        p = (zb * comes_a + za * comes_b) / (za + zb) if gap <= 0 else 0.0
        p = p if p > 1e-9 * (abs(comes_a) + abs(comes_b)) else 0.0
        va, vb = (comes_a - p) / za, (p - comes_b) / zb
        steps.append((t, p))
        sent_a.append((t, p - za * va))
        sent_b.append((t, p + zb * vb))
        arrivals += [t + ta, t + tb]
        until = min(a for a in arrivals if a > t + tiny)
        opening = vb - va
        if gap > 0 and opening < 0 and t - gap / opening < until - tiny:
            until, gap = t - gap / opening, 0.0
        else:
            gap = 0.0 if p > 0 else max(0.0, gap + opening * (until - t))
        t = until
    return [one for i, one in enumerate(steps) if i == 0 or abs(one[1] - steps[i - 1][1]) > 1e-9 * max(p for _, p in steps)]


def value_at(changes, t):
    """What the last change before t set."""
    return next(value for when, value in reversed(changes) if when <= t)


def velocities(left, right, gap, end):
    """Mean velocities of both bars at `end`, from the impulse of all steps.

    Equal transit times: all ends as for rigid bodies, without any loss.
    >>> [round(v, 12) for v in velocities(Bar(9, 1, 1, 1), Bar(1, 1, 3, 0), 0, 100)]
    [0.5, 1.5]

    A bar that strikes one twice as long stops.
    >>> [round(v, 12) for v in velocities(Bar(1, 1, 1, 1), Bar(1, 1, 2, -1), 0, 100)]
    [-1.0, 0.0]
    """
    impulse = impulse_at(history(left, right, gap, end), end)
    return left.velocity - impulse / (left.density * left.length), right.velocity + impulse / (right.density * right.length)


def impulse_at(steps, t):
    """Impulse per area until t."""
    ends = [when for when, _ in steps[1:]] + [max(t, steps[-1][0])]
    return sum(p * max(0.0, min(end, t) - when) for (when, p), end in zip(steps, ends))


# Two equal bars in plane strain with Poisson's ratio 0.3, 100 mm long and 10 mm wide, as one on a smooth rigid wall. The mean force in each
# half microsecond after first touch over rho c_p V A, with V of one bar, from finite differences on a staggered grid (plane_strain.py).
# Uncertainty, as root mean squares over the time of contact: 0.08 % from another grid, 0.02 % until 33 us. Single bins at release: 0.5 %.
BIN = 0.5e-6  # [s]
FORCE = (
    0.9734, 0.9203, 0.8672, 0.8240, 0.8428, 0.8963, 0.9626, 0.9890, 0.9599, 0.8954,
    0.8291, 0.8166, 0.8560, 0.9344, 0.9867, 0.9879, 0.9287, 0.8539, 0.8133, 0.8335,
    0.9051, 0.9703, 0.9924, 0.9470, 0.8769, 0.8236, 0.8310, 0.8879, 0.9544, 0.9832,
    0.9519, 0.8900, 0.8370, 0.8375, 0.8820, 0.9429, 0.9707, 0.9500, 0.8964, 0.8496,
    0.8456, 0.8812, 0.9338, 0.9592, 0.9462, 0.9009, 0.8614, 0.8530, 0.8811, 0.9245,
    0.9492, 0.9424, 0.9062, 0.8727, 0.8598, 0.8803, 0.9143, 0.9400, 0.9390, 0.9131,
    0.8831, 0.8666, 0.8783, 0.9043, 0.9311, 0.9361, 0.9142, 0.8696, 0.8213, 0.7790,
    0.7414, 0.6627, 0.5240, 0.2956, 0.0600)
LAST_PUSH = 37.4e-6  # [s] after first touch; 0.1 us is uncertain


def wave_speeds(density, young, poisson):
    """In uniaxial strain, which no lateral surface relieves yet, and along a thin bar in plane strain."""
    return sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density), sqrt(young / (1 - poisson**2) / density)


def rebound(density, young, poisson, length):
    """Speed after the impact over that before, from the impulse of the table.

    >>> round(rebound(7850, 210e9, 0.3, 0.1), 4)
    0.96

    The force begins with that of uniaxial strain and loses nearly the same in each of the first bins, as fronts come in from both sides;
    then it swings about that of a bar.
    >>> round(FORCE[0] + (FORCE[0] - FORCE[1]) / 2, 3)
    1.0
    >>> fast, slow = wave_speeds(7850, 210e9, 0.3)
    >>> round(sum(FORCE[20:60]) / 40 / (slow / fast), 2)
    1.0
    """
    return sum(FORCE) * BIN * wave_speeds(density, young, poisson)[0] / length - 1
