"""A plate on a column of water that cavitates: Taylor's formula, the balance of momentum, and a one-dimensional solution.

The problem is that of Bleich and Sandler (Interaction between structures and bilinear fluids, Int. J. Solids Structures 6 (1970) 617-639)
as the catalogue defines it by its numbers (F-8). A plate of the mass m per area floats on water of the depth H. The air above has a
pressure. Below the base the same water goes on, so waves leave there. A plane wave of the pressure p0 exp(-t/theta) comes from below; here
t = 0 is when it reaches the plate. The water has p = K mu where it is whole, with mu the compression, and no pressure below zero.

*Taylor (1941).* Before the water cavitates, m dv/dt = 2 p0 exp(-t/theta) - rho c v: the pressure at a wall at rest, less what the moving
plate radiates. The static pressure and the weight balance. The plate has its largest velocity where dv/dt is zero; its pressure is then the
static one, so no bubble has opened yet.

*Momentum.* At the end all is at rest again, and the static forces balance. The base has given the impulse 2 p0 theta of the wave, and its
motion has taken rho c times its displacement. So all water and the plate have come up by 2 p0 theta/(rho c), whatever bubbles did.

*The one-dimensional solution* is Godunov's scheme in the coordinate of the material, with the exact solution of Riemann's problem of this
fluid at each face. In whole water both sides of a face send sound waves. A side with bubbles is closed by a shock: with the open part e and
the pressure p, the shock takes the water from one velocity to the other by the difference sqrt(p (e + p/K)/rho). It dissipates the energy
of the closing bubbles. Without that, bubbles open and close in single cells without end, and the plate is thrown too high by 3 %. The step
is the time in which sound crosses a cell, so waves in whole water are exact.
"""
from functools import cache
from math import exp, log, sqrt

DEPTH, DENSITY, SOUND, PLATE, PEAK, THETA, AIR, GRAVITY = 3.81, 989.0, 1451.0, 144.7, 0.71e6, 0.9958e-3, 0.101e6, 9.81
IMPEDANCE, BULK = DENSITY * SOUND, DENSITY * SOUND**2
ARRIVAL = DEPTH / SOUND  # [s] from the base to the plate

# The catalogue's own one-dimensional code with 2000 cells, the finest of three meshes. [m/s] [m/s] [m]
CATALOGUE = {"peak": 0.7612, "velocity at 2 ms": 0.367, "largest displacement": 1.696e-3}
# column() with 2000 cells, as `python3 reference.py` prints it. [m] [s] [-]
FINEST = {"largest displacement": 1.7056e-3, "closed": 10.241e-3, "largest void": 0.00140}


def taylor_peak():
    """The largest velocity of the plate and the time at which it has that. [m/s] [s]

    >>> "%.4f" % taylor_peak()[0]    # the catalogue's limit
    '0.7645'
    """
    beta = IMPEDANCE * THETA / PLATE
    t = THETA * log(beta) / (beta - 1)
    return 2 * PEAK * THETA / PLATE / (beta - 1) * (exp(-t / THETA) - exp(-beta * t / THETA)), t


def last_displacement():
    """How far the plate has come up when all is at rest again. [m]"""
    return 2 * PEAK * THETA / IMPEDANCE


def root_of(falling, high):
    """Where a falling function is zero between 0 and `high`; 0 where it is not positive there. [Pa]"""
    low = 0.0
    if falling(low) <= 0:
        return low
    while high - low > 1e-3:
        middle = (low + high) / 2
        low, high = (middle, high) if falling(middle) > 0 else (low, middle)
    return low


def behind(pressure, p, void, sign):
    """By how much a side of a face changes its velocity when its pressure becomes p: by a sound wave, or by a shock that closes bubbles.

    Pressures are absolute; `void` is the open part. The sign is that of the side: what is below slows down. [m/s]
    """
    return sign * (sqrt(p * (void + p / BULK) / DENSITY) if void > 0 else (p - pressure) / IMPEDANCE)


def meet(below, above):
    """Absolute pressure at a face, and its velocity; where bubbles open at the face, the mean of both sides. [Pa] [m/s]

    below, above  (velocity, pressure, open part)

    >>> p, v = meet((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0))    # two columns collide
    >>> abs(p - IMPEDANCE) < 1e-2, abs(v) < 1e-6
    (True, True)
    >>> meet((-1.0, 1e5, 0.0), (1.0, 1e5, 0.0))[0]        # they part
    0.0
    >>> p, _ = meet((1.0, 0.0, 0.01), (1.0, 0.0, 0.0))    # nothing happens
    >>> p
    0.0
    """
    (v0, p0, void0), (v1, p1, void1) = below, above
    p = root_of(lambda p: v0 - behind(p0, p, void0, 1) - v1 - behind(p1, p, void1, 1), max(p0, p1) + IMPEDANCE * abs(v0 - v1) + 1.0)
    return p, (v0 - behind(p0, p, void0, 1) + v1 + behind(p1, p, void1, 1)) / 2


def at_plate(below, velocity, step):
    """The same under the plate, with the plate's mean velocity in the step. [Pa] [m/s]"""
    v0, p0, void0 = below
    rate = step / (2 * PLATE)

    def mean(p):
        return velocity + rate * (p - AIR - PLATE * GRAVITY)
    p = root_of(lambda p: v0 - behind(p0, p, void0, 1) - mean(p), p0 + IMPEDANCE * abs(v0 - velocity) + 1.0)
    return p, mean(p)


@cache
def column(cells, end):
    """[(time after the arrival, velocity of the plate, its displacement, largest open part)], to `end` after the wave has entered below.

    >>> history = column(125, 10e-3)
    >>> abs(max(v for _, v, _, _ in history) / taylor_peak()[0] - 1) < 2e-3
    True
    """
    h = DEPTH / cells
    step = h / SOUND
    at_rest = [AIR + PLATE * GRAVITY + DENSITY * GRAVITY * (DEPTH - (i + 0.5) * h) for i in range(cells)]
    base = at_rest[0] + DENSITY * GRAVITY * h / 2
    v, q = [0.0] * cells, list(at_rest)  # q: K mu, below zero where bubbles are open
    plate = moved = 0.0
    history = []
    for number in range(round(end / step)):
        incident = PEAK * exp(-(number + 0.5) * step / THETA)
        sides = [(velocity, max(q_, 0.0), max(-q_, 0.0) / BULK) for velocity, q_ in zip(v, q)]
        excess = (2 * incident + sides[0][1] - base - IMPEDANCE * v[0]) / 2
        faces = [(base + excess, (2 * incident - excess) / IMPEDANCE)]
        for below, above in zip(sides, sides[1:]):
            # The static pressure differs by rho g h between the centres: at the face each side has its own, shifted by half of that.
            p0, p1 = below[1] - DENSITY * GRAVITY * h / 2, above[1] + DENSITY * GRAVITY * h / 2
            p = (p0 + p1 + IMPEDANCE * (below[0] - above[0])) / 2
            if below[2] == above[2] == 0 and p >= 0:
                faces.append((p, (below[0] + above[0] + (p0 - p1) / IMPEDANCE) / 2))
            elif below[2] > 0 and above[2] > 0 and below[0] <= above[0]:
                faces.append((0.0, (below[0] + above[0]) / 2))
            else:
                faces.append(meet((below[0], p0 if below[2] == 0 else 0.0, below[2]), (above[0], p1 if above[2] == 0 else 0.0, above[2])))
        top = sides[-1]
        faces.append(at_plate((top[0], top[1] - DENSITY * GRAVITY * h / 2 if top[2] == 0 else 0.0, top[2]), plate, step))
        moved += step * faces[-1][1]
        plate += step / PLATE * (faces[-1][0] - AIR - PLATE * GRAVITY)
        v = [v_ + step * ((low - high) / (DENSITY * h) - GRAVITY) for v_, (low, _), (high, _) in zip(v, faces, faces[1:])]
        q = [q_ + BULK * step / h * (low - high) for q_, (_, low), (_, high) in zip(q, faces, faces[1:])]
        history.append(((number + 1) * step - ARRIVAL, plate, moved, max(0.0, -min(q)) / BULK))
    return history


def closed(history):
    """When the last bubble closes, after the arrival. [s]"""
    return max(t for t, _, _, void in history if void > 0)


if __name__ == "__main__":
    for number in (250, 500, 1000, 2000):
        found = column(number, 20e-3)
        print(f"{number} cells: peak {max(v for _, v, _, _ in found):.4f} m/s, displacement {1e3 * max(u for _, _, u, _ in found):.4f} mm, "
              f"closed at {1e3 * closed(found):.3f} ms, largest void {max(void for *_, void in found):.5f}, "
              f"at the end {1e3 * found[-1][2]:.5f} mm of {1e3 * last_displacement():.5f}")
