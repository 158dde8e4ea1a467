"""One-point hexahedra in their hourglass modes: what springs and dashpots do to a cube.

A field 4 y z, 4 z x, 4 x y or 8 x y z over a unit cube about the origin has the value +1 or -1 at the corners and no mean gradient. The
one stress of the element does not see it, so its elastic energy is zero to first order: twelve such modes, four along each axis.
With the mass m/8 at each corner an amplitude a has the kinetic energy m a'^2/2 and, against a spring of stiffness k on the sum 8 a
(Flanagan & Belytschko 1981), the energy 32 k a^2: the frequency is w^2 = 64 k/m. The element's k = kappa mu h/24 makes a cube exact in
pure bending without Poisson effect at kappa = 1 (docs/theory/hexahedron.md).

Dashpots: c = eps m w_0/32 with w_0 = 2 c_p/h gives 8 (m/8) a'' = -64 c a' and so a' ~ exp(-2 eps w_0 t).
"""
from math import exp, sqrt

STEEL = {"density": 7850.0, "young": 210e9, "poisson": 0.3}
AMPLITUDE, SIDE = 1e-3, 1.0     # [m/s] [m]
SPRINGS, DASHPOTS = 0.1, 0.05   # [-] the usual coefficients
SHAPES, AXES = ("yz", "zx", "xy", "xyz"), ("x", "y", "z")
MODES = [f"{shape}_along_{axis}" for shape in SHAPES for axis in AXES]


def signs(shape):
    """At the eight corners.

    >>> [sum(signs(shape)) for shape in SHAPES]
    [0, 0, 0, 0]
    >>> corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    >>> all(sum(s * c[axis] for s, c in zip(signs(shape), corners)) == 0 for shape in SHAPES for axis in range(3))
    True
    >>> all(sum(a * b for a, b in zip(signs(s), signs(t))) == 0 for s in SHAPES for t in SHAPES if s != t)
    True
    """
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    value = {"yz": lambda x, y, z: y * z, "zx": lambda x, y, z: z * x, "xy": lambda x, y, z: x * y, "xyz": lambda x, y, z: x * y * z}[shape]
    return [value(*corner) for corner in corners]


def kinetic():
    """Of one cube at the start [J]."""
    return STEEL["density"] * SIDE**3 * AMPLITUDE**2 / 2


def spring_frequency(coefficient=SPRINGS):
    """[rad/s]

    >>> mass, mu = 7850.0, 210e9 / 2.6
    >>> abs(spring_frequency(0.1)**2 / (64 * 0.1 * mu / 24 / mass) - 1) < 1e-14
    True
    """
    shear = STEEL["young"] / (2 * (1 + STEEL["poisson"]))
    return sqrt(64 * coefficient * shear * SIDE / 24 / (STEEL["density"] * SIDE**3))


def dashpot_rate(coefficient=DASHPOTS):
    """At which the velocity falls [1/s]: 2 eps w_0.

    >>> round(dashpot_rate() / (0.2 * 6001.0), 3)  # w_0 = 2 c_p/h, and c_p = 6001 m/s
    1.0
    """
    young, nu = STEEL["young"], STEEL["poisson"]
    p_wave = sqrt(young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / STEEL["density"])
    return 2 * coefficient * 2 * p_wave / SIDE


def damped(t, coefficient=DASHPOTS):
    """Kinetic energy at the time t over that at the start.

    >>> round(damped(0.0), 3), round(damped(1 / (2 * dashpot_rate())) * exp(1), 12)
    (1.0, 1.0)
    """
    return exp(-2 * dashpot_rate(coefficient) * t)
