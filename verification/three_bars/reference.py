"""Three equal bars in a row with gaps, the first moving: waves along characteristics.

The compressive force of a bar is f + g, its impedance times velocity f - g; f runs to the right and g to the left, unchanged, with the
speed c. An end without contact has no force, so a wave comes back with the other sign. Ends that touch and are pressed, f + g > 0, move
together; the bars are equal, so waves pass. Steps are a part of L/c, so waves move by whole steps and all is exact as long as gaps close
at whole steps.

Two equal bars have rho c V/2 between them for 2L/c, and exchange their velocities (St. Venant, 1867). Here that comes out twice.
"""
from collections import deque
from math import sqrt

BARS = {"density": 1000, "young": 1e9, "length": 1.0, "area": 1e-4, "gap": 0.05, "speed": 10.0}  # SI
NARROW = {**BARS, "gap": 0.005}  # the second gap closes while the first two bars are still in contact


def characteristics(density, young, length, area, gap, speed, end=16e-3, parts=100):
    """Closures, separations [s], largest force [N] and impulse [N s] of both junctures; momenta [N s] of the bars over time, gaps [m].

    With the wide gaps one impact follows the other.

    >>> wide = characteristics(**BARS)
    >>> [round(1e3 * t, 9) for t in wide["closures"]], [round(1e3 * t, 9) for t in wide["separations"]]
    ([5.0, 11.0], [7.0, 13.0])
    >>> [round(f, 9) for f in wide["forces"]], [round(p, 9) for p in wide["impulses"]]
    ([500.0, 500.0], [1.0, 1.0])
    >>> [round(abs(p), 9) for p in wide["momenta"][-1]], round(wide["gaps"][0], 9)
    ([0.0, 0.0, 1.0], 0.05)

    With the narrow ones both junctures are closed for L/2c, with the same forces, impulses and velocities.

    >>> narrow = characteristics(**NARROW)
    >>> [round(1e3 * t, 9) for t in narrow["closures"]], [round(1e3 * t, 9) for t in narrow["separations"]]
    ([0.5, 2.0], [2.5, 4.0])
    >>> [round(f, 9) for f in narrow["forces"]], [round(abs(p), 9) for p in narrow["momenta"][-1]]
    ([500.0, 500.0], [0.0, 0.0, 1.0])
    """
    c = sqrt(young / density)
    z, step, small = density * c * area, length / c / parts, 1e-9
    right = [deque([z * v / 2] * parts) for v in (speed, 0.0, 0.0)]   # f of each bar, first end first
    left = [deque([-z * v / 2] * parts) for v in (speed, 0.0, 0.0)]   # g
    gaps, closed = [gap, gap], [False, False]
    closures, separations, forces, impulses = [None, None], [None, None], [0.0, 0.0], [0.0, 0.0]
    momenta, times = [[density * area * length * v for v in (speed, 0.0, 0.0)]], [0.0]
    for number in range(round(end / step)):
        f, g = [wave.pop() for wave in right], [wave.popleft() for wave in left]  # that arrive at the last and first ends
        right[0].appendleft(-g[0])
        left[2].append(-f[2])
        now = list(momenta[-1])
        for j in (0, 1):
            touch = gaps[j] <= small * length and f[j] + g[j + 1] > small * z * speed
            force = f[j] + g[j + 1] if touch else 0.0
            if touch and closures[j] is None:
                closures[j] = number * step
            if closed[j] and not touch:
                separations[j] = number * step
            if not touch:
                gaps[j] += (-2 * g[j + 1] - 2 * f[j]) / z * step
            closed[j] = touch
            left[j].append(force - f[j])
            right[j + 1].appendleft(force - g[j + 1])
            forces[j], impulses[j] = max(forces[j], force), impulses[j] + force * step
            now[j], now[j + 1] = now[j] - force * step, now[j + 1] + force * step
        momenta.append(now)
        times.append((number + 1) * step)
    return {"closures": closures, "separations": separations, "forces": forces, "impulses": impulses, "gaps": gaps,
            "times": times, "momenta": momenta, "momentum": density * area * length * speed}
