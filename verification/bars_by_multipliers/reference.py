"""Two elastic bars that collide, by d'Alembert's solution, and how many steps the elements alone need.

With poisson = 0 a bar is exactly one-dimensional, and the stable step of an element that is `size` long is size / c.

At finite strain the law of the program, a rate of Cauchy stress that is E times the rate of deformation, gives in one dimension the stress
E ln(lambda) of the stretch lambda, whatever the path, and with poisson = 0 the section stays as it is. So rho x_tt = (E ln lambda)_X, with
the wave speed c / sqrt(lambda) per unit of the length at rest: compression steepens to a shock, release spreads to a fan. A bar that meets
its mirror image has a rigid wall at its end:

    shock   momentum over it: rho U^2 (1 - lambda) = -E ln(lambda) at the velocity V/2 = U (1 - lambda)
    fan     it comes back from the free end, centred where the shock arrived there; left- and right-going characteristics carry
            u + w and u - w with w = 2 c sqrt(lambda), and at the wall u = 0
    end     the bars part when the stress at the wall is zero, w = 2 c

The fan and what the wall reflects of it cross; their crossings are found one after another, each from its two neighbours, by the mean of
slopes. The error falls with the square of their number: 200 leave 1e-8 of the times and velocities below.
"""
from math import log, sqrt


def reference(density, young, length, gap, closing_speed):
    """Exact values in SI units.

    >>> steel = reference(7850, 210e9, 0.1, 1e-5, 10)
    >>> round(steel["stress"] / 1e6, 1), round(steel["first"] * 1e6, 2), round(steel["time"] * 1e6, 2)
    (203.0, 1.0, 38.67)
    """
    c = sqrt(young / density)
    return {"stress": density * c * closing_speed / 2, "first": gap / closing_speed, "time": 2 * length / c, "speed": closing_speed / 2,
            "c": c}


def shock(speed):
    """(stretch behind it, its speed) at a particle velocity of `speed`, both speeds over c.

    >>> stretch, fast = shock(0.1)
    >>> round(stretch, 6), round(fast, 6), abs(fast**2 * (1 - stretch) + log(stretch)) < 1e-12
    (0.90251, 1.025751, True)
    """
    low, high = 0.0, 0.9
    for _ in range(100):
        strain = (low + high) / 2
        low, high = (strain, high) if -strain * log(1 - strain) < speed**2 else (low, strain)
    return 1 - low, speed / low


def wall(speed, parts=200):
    """[(time, pressure), ...] at the wall from the arrival of the fan until the bar leaves, in units of L/c and E.

    >>> coarse, fine = (wall(0.1, parts) for parts in (100, 200))
    >>> abs(coarse[-1][0] / fine[-1][0] - 1) < 1e-9, fine[-1][1] < 1e-12
    (True, True)
    """
    stretch, fast = shock(speed)
    start, first = 1 / fast, 2 * sqrt(stretch)
    right = [first - 2 * (first + (1 - first / 2) * i / parts) for i in range(parts + 1)]   # u - w of each characteristic of the fan

    def c(i, left):
        """Wave speed where the characteristic i meets one that carries u + w = left."""
        return 4 / (left - right[i])

    left, row = first, [(1.0, start + sqrt(stretch))]
    for i in range(1, parts + 1):   # the first that the wall sends back, across the straight lines of the fan
        x, t = row[-1]
        back, own = (c(i - 1, left) + c(i, left)) / 2, c(i, left)
        dt = (x - own * (t - start)) / (back + own)
        row.append((x - back * dt, t + dt))
    found = [(row[0][1], -log(stretch))]
    for j in range(1, parts + 1):
        before, left, (x, t) = left, -right[j], row[1]
        new = [(1.0, t + 2 * (1 - x) / (c(j, before) + c(j, left)))]
        found.append((new[0][1], -2 * log(left / 2)))
        for i in range(j + 1, parts + 1):
            (x, t), (other, late) = row[i - j + 1], new[-1]
            on, back = (c(i, before) + c(i, left)) / 2, (c(i - 1, left) + c(i, left)) / 2
            meet = (other - x + on * t + back * late) / (on + back)
            new.append((x + on * (meet - t), meet))
        row = new
    return found


def at_finite_strain(density, young, length, closing_speed):
    """Stress between the bars [Pa]; since first touch, times [s] when the fan arrives, when the stress is half of it and when they part;
    mean velocity of a bar after over before.

    >>> slow, fast = (at_finite_strain(7850, 210e9, 0.1, part * sqrt(210e9 / 7850)) for part in (1e-6, 0.2))
    >>> round(slow["stress"] / reference(7850, 210e9, 0.1, 1e-5, 1e-6 * sqrt(210e9 / 7850))["stress"], 5)
    1.0
    >>> round(slow["half"] / (2 * 0.1 / sqrt(210e9 / 7850)), 5), round(slow["rebound"], 5)
    (1.0, 1.0)
    >>> round(fast["stress"] / 210e9, 7), round(1e6 * fast["half"], 4), round(fast["rebound"], 6)
    (0.1025751, 37.4557, 0.987234)
    """
    c = sqrt(young / density)
    speed = closing_speed / 2 / c
    rows = wall(speed)
    plateau = rows[0][1]
    impulse = plateau * rows[0][0] + sum((later - t) * (p + q) / 2 for (t, p), (later, q) in zip(rows, rows[1:]))
    half = next(t + (p - plateau / 2) / (p - q) * (later - t) for (t, p), (later, q) in zip(rows, rows[1:]) if q <= plateau / 2)
    return {"stress": plateau * young, "until": rows[0][0] * length / c, "half": half * length / c, "parts": rows[-1][0] * length / c,
            "rebound": impulse / speed - 1}
