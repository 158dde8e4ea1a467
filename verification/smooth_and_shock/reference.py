"""Waves and fronts whose exact form is known: what a viscosity of shocks must leave alone, and what it must keep clean.

Elastic motion keeps its energy, so the exact loss of every smooth motion here is zero. d'Alembert's front of a pressure p is a jump to the
stress p; a body that hits a plane with the speed V has a jump to rho c V. Sources: Timoshenko & Goodier, Theory of Elasticity, waves in
bars and the impact of bars (Saint-Venant, Boussinesq); Love, Theory of Elasticity, radial vibrations of cylinders and spherical shells;
Wood, J. Appl. Mech. 19 (1952) 521, plane plastic waves of finite thickness.
"""
from math import cos, exp, pi, sqrt

STEEL = {"density": 7850, "young": 200e9, "poisson": 0.3, "yield_stress": 4e6, "tangent": 2e9}   # SI, of the plastic front
SHELL = {"density": 7850, "young": 210e9, "poisson": 0.3, "radius": 0.1, "thickness": 2e-3}      # SI
PULSE = ((0.0, 0.0), (4e-6, 26e6), (30e-6, 13e6), (60e-6, 0.0))                                  # [s] [Pa] inside the shell


def speed_in_strain(density, young, poisson):
    """Of plane waves of pressure in a body [m/s].

    >>> round(speed_in_strain(1000, 742857142.857143, 0.3), 6), round(speed_in_strain(1000, 1e9, 0), 6)
    (1000.0, 1000.0)
    """
    return sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density)


def speed_in_sheet(density, young, poisson):
    """Of plane waves in a sheet whose sides are held [m/s].

    >>> round(speed_in_sheet(1000, 910e6, 0.3), 9)
    1000.0
    """
    return sqrt(young / (1 - poisson**2) / density)


def transmitted(stress, before, behind):
    """Stress on both sides of the seam of two impedances rho c when a front comes to it [Pa].

    >>> transmitted(1.0, 1.0, 4.0), transmitted(1.0, 2.0, 2.0)
    (1.6, 1.0)
    """
    return stress * 2 * behind / (before + behind)


def standing(t, period):
    """Velocity at a free end of a standing wave over that at the start [-].

    >>> standing(0.5, 1.0)
    -1.0
    """
    return cos(2 * pi * t / period)


def peaks(ratio):
    """Largest stress at the clamp and, from the first reflection on, at the struck end, over rho c V [-].

    A ram strikes a clamped bar of `ratio` times its mass. Up to 2T, T = L/c, the stress at the struck end is f = exp(-ratio t/T). The
    wave that comes back is f of 2T before; the ram then moves by v' = -ratio (v + 2 f)/T, and v + 2 f is the stress. So the struck end
    jumps to 2 + exp(-2 ratio) at 2T, what goes out from there is 1 + exp(-2 ratio), and the clamp doubles it at 3T. All of them decay
    behind the jump, and no later one counts if the ram is not heavier than twice the bar.

    >>> [round(one, 4) for one in peaks(0.5)]
    [2.7358, 2.3679]
    """
    left = exp(-2 * ratio)
    return 2 * (1 + left), 2 + left


def plastic_front(density, young, poisson, yield_stress, tangent, speed):
    """Stresses [Pa] and speeds [m/s] of both fronts in a body of uniaxial strain that is stopped from `speed`; strains are small.

    The elastic front reaches s_y = Y (1 - nu)/(1 - 2 nu). Behind it the modulus is K + 4/3 G H/(H + 3 G), H = E E_t/(E - E_t).

    >>> front = plastic_front(**STEEL, speed=0.6)
    >>> round(front["yield_stress"] / 1e6, 9), round(front["stress"] / 1e6, 3), round(front["slow"] / front["fast"], 4)
    (7.0, 23.238, 0.7889)
    >>> elastic = plastic_front(**{**STEEL, "tangent": 200e9 * (1 - 1e-12)}, speed=0.6)
    >>> round(elastic["slow"] / elastic["fast"], 6)
    1.0
    """
    shear, bulk = young / (2 * (1 + poisson)), young / (3 * (1 - 2 * poisson))
    hardening = young * tangent / (young - tangent)
    fast = sqrt((bulk + 4 / 3 * shear) / density)
    slow = sqrt((bulk + 4 / 3 * shear * hardening / (hardening + 3 * shear)) / density)
    first = yield_stress * (1 - poisson) / (1 - 2 * poisson)
    return {"yield_stress": first, "stress": first + density * slow * (speed - first / (density * fast)), "slow": slow, "fast": fast}


def shock(pressure, young, density):
    """Stretch behind a shock that a pressure [Pa] sends into a bar of Poisson's ratio zero, the shock's speed, that of the end [m/s].

    The stress is E ln(stretch), of a section that keeps its area; momentum and mass are conserved (Rankine & Hugoniot):
        p = rho U v,     v = U (1 - stretch)

    >>> [round(value, 4) for value in shock(3e8, 1e9, 1000)]
    [0.7408, 1075.8665, 278.845]
    >>> weak = shock(1e3, 1e9, 1000)
    >>> round(weak[1], 2), round(weak[2], 6)
    (1000.0, 0.001)
    """
    stretch = exp(-pressure / young)
    speed = sqrt(pressure / (density * (1 - stretch)))
    return stretch, speed, speed * (1 - stretch)


def breathing(poisson):
    """k a of the first radial mode of a long cylinder, k a J0(k a) = (1 - 2 nu)/(1 - nu) J1(k a); its circular frequency is k c.

    >>> round(breathing(0.3), 4)
    2.1257
    """
    def bessel(n, x):
        term, total = (x / 2)**n, 0.0  # n is 0 or 1: n! is 1
        for m in range(40):
            total += term
            term *= -(x / 2)**2 / ((m + 1) * (m + 1 + n))
        return total

    low, high = 1.0, 3.0
    for _ in range(80):
        middle = (low + high) / 2
        above = middle * bessel(0, middle) > (1 - 2 * poisson) / (1 - poisson) * bessel(1, middle)
        low, high = (middle, high) if above else (low, middle)
    return low


def expansion(end, density, young, poisson, radius, thickness, pulse=PULSE, step=2e-8):
    """[(t, u)] of a thin spherical shell under a pressure inside: u'' + w^2 u = p/(rho h), w^2 = 2 E/(rho R^2 (1 - nu)).

    By the exact step of an oscillator under a load that is linear in time.

    >>> still = expansion(2e-4, **SHELL, pulse=((0.0, 1e6), (1.0, 1e6)))
    >>> static = 1e6 * 0.1**2 * 0.7 / (2 * 210e9 * 2e-3)
    >>> round(max(u for _, u in still) / static, 4), round(min(u for _, u in still) / static, 4)
    (2.0, 0.0)
    """
    omega = sqrt(2 * young / (density * radius**2 * (1 - poisson)))

    def load(t):
        for (a, first), (b, last) in zip(pulse, pulse[1:]):
            if a <= t <= b:
                return (first + (last - first) * (t - a) / (b - a)) / (density * thickness)
        return 0.0

    turn = complex(cos(omega * step), sqrt(1 - cos(omega * step)**2))
    path, motion, before = [(0.0, 0.0)], complex(-load(0.0) / omega**2, 0.0), load(0.0)  # about the rest under the load; v/omega
    for i in range(1, round(end / step) + 1):
        now = load(i * step)
        slope = (now - before) / (step * omega**3)
        motion = complex(motion.real, motion.imag - slope) * turn.conjugate()  # cosines: u + i v/omega turns by -omega step
        motion = complex(motion.real, motion.imag + slope)
        path.append((i * step, motion.real + now / omega**2))
        before = now
    return path


def energy(largest, density, young, poisson, radius, thickness):
    """Of an eighth of the shell that swings between -largest and largest [J].

    >>> round(energy(max(u for t, u in expansion(2.6e-4, **SHELL) if t > 2e-4), **SHELL), 1)
    64.3
    """
    mass = density * 4 * pi * radius**2 * thickness / 8
    return mass / 2 * 2 * young / (density * radius**2 * (1 - poisson)) * largest**2
