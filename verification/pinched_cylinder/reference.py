"""A cylinder with end diaphragms, pinched by two opposite forces in the middle of its length.

Radius 300, length 600, thickness 3, E = 3e6, nu = 0.3, force 1: the deflection under the force is 1.8248e-5 (MacNeal & Harder, *Finite
Elem. Anal. Des.* 1 (1985) 3; Belytschko, Stolarski, Liu, Carpenter & Ong, *Comput. Meth. Appl. Mech. Engng* 51 (1985) 221), from Fluegge's
series for thin shells. Without diaphragms the cylinder would bend as a ring, without stretching, and give way much more.
"""
from math import pi

PUBLISHED = 1.8248e-5  # [m] at a force of 1 N
YOUNG, POISSON, RADIUS, LENGTH, THICKNESS = 3e6, 0.3, 300.0, 600.0, 3.0  # [Pa] [-] [m] [m] [m]


def ring():
    """Two forces P on a ring as long as the cylinder move by (pi/8 - 1/pi) P R^3 / (E'I) each, E' = E / (1 - nu^2). [m]

    >>> 20 < ring() / PUBLISHED < 30
    True
    """
    stiffness = YOUNG / (1 - POISSON**2) * LENGTH * THICKNESS**3 / 12
    return (pi / 8 - 1 / pi) * RADIUS**3 / stiffness
