"""Rigid plates in a row with gaps, of which the first is struck: a chain of blows, each with its restitution.

Plates move without a force between blows, the first under the force F (1 - t/T) of a pulse that falls to nothing. Where two of the masses
m and M meet, with the speed of approach w, the impulse is (1 + e) w m M/(m + M). By e = 0 they stay together and are one plate from
then on; the pulse never pulls, so it parts none. Blows come one at a time; two at the same moment are refused, since their order counts.

Gaps are cubic in time beside the plate that is pushed and linear elsewhere. Blows are roots of cubics, found between their turning points.
Source: S. D. Poisson's and I. Newton's impact, in W. Goldsmith, Impact (1960), chapter 1.
"""
from math import sqrt

DENSITY, AREA = 7850, 1.0                            # [kg/m3], [m2]
THICK = (0.05, 0.05, 0.075, 0.05, 0.05, 0.1)         # [m]
PLATES = {"masses": [DENSITY * AREA * h for h in THICK], "gaps": [0.005] * 5, "end": 0.01}  # SI
STRUCK = {"speed": 10.0}                             # [m/s] of the first
PUSHED = {"force": 10e6 * AREA, "pulse": 1e-3}       # [N], [s]


def chain(masses, gaps, end, speed=0.0, force=0.0, pulse=1.0, restitution=1.0):
    """Blows (time, juncture, impulse), velocities at the end, and what goes through each juncture to all plates behind it.

    Three equal plates hand the speed on; without restitution all go on together, and 2/3 of the energy is lost.

    >>> equal = chain([1, 1, 1], [0.1, 0.2], 1, speed=10)
    >>> [(round(t, 12), juncture, impulse) for t, juncture, impulse in equal["blows"]], equal["speeds"], equal["energies"]
    ([(0.01, 1, 10.0), (0.03, 2, 10.0)], [0.0, 0.0, 10.0], [50.0, 50.0])
    >>> one = chain([1, 1, 1], [0.1, 0.2], 1, speed=9, restitution=0)
    >>> [round(v, 12) for v in one["speeds"]], round(one["lost"], 12)
    ([3.0, 3.0, 3.0], 27.0)

    A larger mass strikes two smaller ones: v = 2 m/(m + M) V, twice.

    >>> falling = chain([4, 2, 1], [0.1, 0.1], 0.06, speed=3)
    >>> [round(v, 12) for v in falling["speeds"]]
    [1.0, 1.333333333333, 5.333333333333]

    A force that stands, as a long pulse nearly is, closes the gap g after sqrt(2 g m/F).

    >>> round(chain([2, 3], [0.04], 1, force=100, pulse=1e9)["blows"][0][0], 6), round(sqrt(2 * 0.04 * 2 / 100), 6)
    (0.04, 0.04)

    Momentum is the impulse of the pulse, energy its work less what blows take.

    >>> pushed = chain([2, 3, 1], [0.04, 0.01], 1, force=200, pulse=0.2)
    >>> abs(sum(m * v for m, v in zip((2, 3, 1), pushed["speeds"])) - 20) < 1e-12
    True
    >>> abs(sum(m * v * v / 2 for m, v in zip((2, 3, 1), pushed["speeds"])) - pushed["work"] + pushed["lost"]) < 1e-9
    True
    """
    groups = [[i] for i in range(len(masses))]
    speeds, gaps = [speed, *[0.0] * (len(masses) - 1)], list(gaps)
    t, blows, lost, work, history = 0.0, [], 0.0, 0.0, [(0.0, tuple(speeds))]

    def mass(group):
        return sum(masses[i] for i in group)

    while t < end:
        until = pulse if force and t < pulse < end else end
        push, drop = (force * (1 - t / pulse), force / pulse) if t < pulse else (0.0, 0.0)  # F = push - drop s
        first = mass(groups[0])
        step, where = until - t, None
        for k, (left, right) in enumerate(zip(groups, groups[1:])):
            i = left[-1]
            root = closing(gaps[i], speeds[i + 1] - speeds[i], *((push / first, drop / first) if k == 0 else (0.0, 0.0)), step)
            if root is not None:
                step, where = root, k
        gained = (push * step - drop * step**2 / 2) / first
        way = speeds[0] * step + (push * step**2 / 2 - drop * step**3 / 6) / first
        work += first * gained * (speeds[0] + gained / 2)
        ways = [way if i in groups[0] else v * step for i, v in enumerate(speeds)]
        speeds = [v + gained if i in groups[0] else v for i, v in enumerate(speeds)]
        gaps = [gap + ways[i + 1] - ways[i] for i, gap in enumerate(gaps)]
        t = until if where is None else t + step
        history.append((t, tuple(speeds)))
        if where is None:
            continue
        if blows and not t > blows[-1][0] * (1 + 1e-9):
            raise ValueError("two blows at once")
        left, right = groups[where:where + 2]
        gaps[left[-1]], one, other = 0.0, mass(left), mass(right)
        approach = speeds[left[-1]] - speeds[right[0]]
        impulse = (1 + restitution) * approach * one * other / (one + other)
        lost += (1 - restitution**2) * approach**2 / 2 * one * other / (one + other)
        speeds = [v - impulse / one if i in left else v + impulse / other if i in right else v for i, v in enumerate(speeds)]
        blows.append((t, right[0], impulse))
        history.append((t, tuple(speeds)))
        if restitution == 0:
            groups[where:where + 2] = [left + right]
    behind = range(1, len(masses))
    return {
        "blows": blows, "speeds": speeds, "lost": lost, "work": work,  # [s], [-], [N s]; [m/s]; [J]; [J]
        "history": history,                                            # [s], [m/s] corners; straight between but for the pulse
        "impulses": [sum(m * v for m, v in zip(masses[i:], speeds[i:])) for i in behind],         # [N s]
        "energies": [sum(m * v * v / 2 for m, v in zip(masses[i:], speeds[i:])) for i in behind],  # [J]
    }


def closing(gap, rate, push, drop, span):
    """The first s within the span at which gap + rate s - push s^2/2 + drop s^3/6 becomes negative, or None.

    >>> closing(1.0, -2.0, 0.0, 0.0, 9.0), closing(1.0, 2.0, 0.0, 0.0, 9.0)
    (0.5, None)
    >>> round(closing(1.0, 0.0, 2.0, 0.0, 9.0), 12)
    1.0
    """
    def value(s):
        return gap + s * (rate - s * (push / 2 - s * drop / 6))

    turns = []
    if drop and push * push > 2 * drop * rate:
        root = sqrt(push * push - 2 * drop * rate)
        turns = [(push - root) / drop, (push + root) / drop]
    elif push and not drop:
        turns = [rate / push]
    corners = [0.0, *sorted(s for s in turns if 0 < s < span), span]
    if gap == 0 and (rate < 0 or (rate == 0 and push > 0)):
        return 0.0
    for low, high in zip(corners, corners[1:]):
        if value(high) < 0 <= value(low):
            if not push and not drop:
                return -gap / rate
            while (middle := (low + high) / 2) not in (low, high):
                low, high = (low, middle) if value(middle) < 0 else (middle, high)
            return high
    return None
