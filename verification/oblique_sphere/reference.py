"""Spheres of alumina that strike glass at an angle: what was measured, how well, and what rigid kinematics make of it.

*Constants.* Alumina 4000 kg/m^3, 380 GPa, 0.23; soda-lime glass 70 GPa, 0.25, friction 0.092, restitution 0.98: as MFIX (test DEM05),
Lethe and Chung & Ooi (Granular Matter 13 (2011) 643) quote Kharaz, Gorham & Salman. Density of glass 2500 kg/m^3: handbook; it acts
through waves alone. The elastic constants are of the materials and independent of the rebounds. *The friction is not*: it is that of the
same spheres on the same glass, by the impulse of spheres that slid throughout. So points where a sphere slides throughout test nothing of
friction, and are a group of their own, `sliding`; those below that angle, where stick and microslip decide, are `microslip`.

*Speed.* 3.9 m/s in MFIX and Lethe, 3.85 m/s in two other quotations: uniform between both.

*Measurements.* The three figures are of one motion, so two of them give the third. With restitution e along the normal, and e_t along the
face,

    e_t = e tan(rebound) / tan(impact),    spin = 5/2 v sin(impact) (1 - e_t) / R,

what the figures have differs by 4 % in e_t and by 8 % in spin (root mean square), most near the ends, where 1 - e_t is small. That is
taken as their uncertainty, shared out: 3 % of the tangent of the rebound, 5 % of the spin. The third figure, e_t, is reported only: it is
no independent point.
"""
from math import atan, cos, degrees, radians, sin, tan

FRICTION, RESTITUTION, RADIUS = 0.092, 0.98, 2.5e-3
SPEED = 3.9  # [m/s]
U_MEASURED = {"rebound": 0.03, "spin": 0.05}
SPREAD = {"contacts[0].friction": ("0.089", "0.095"), "bodies[0].material.young": ("361 GPa", "399 GPa"),
          "bodies[1].material.young": ("68.6 GPa", "71.4 GPa"), "bodies[1].material.poisson": ("0.23", "0.27")}
U_SPEED = 0.05 / 3.9 / 12**0.5  # [-] uniform over 0.05 m/s


def slides_beyond():
    """Impact angle [degrees] beyond which a rigid sphere slides throughout.

    >>> round(slides_beyond(), 1)
    32.5
    """
    return degrees(atan(3.5 * FRICTION * (1 + RESTITUTION)))


def spin_of_sliding(angle):
    """Of a rigid sphere that slides throughout. [rad/s]

    >>> round(spin_of_sliding(50.2214))   # measured: 453
    455
    """
    return 2.5 * FRICTION * (1 + RESTITUTION) * SPEED * cos(radians(angle)) / RADIUS


def restitution_of(rebound, impact):
    """e_t from the two angles.

    >>> round(restitution_of(6.6917, 9.9429), 3)   # the figure has 0.67
    0.656
    """
    return RESTITUTION * tan(radians(rebound)) / tan(radians(impact))


def spin_of(restitution, impact):
    """Spin from e_t. [rad/s]

    >>> round(spin_of(0.594, 21.1931))   # the figure has 577
    572
    """
    return 2.5 * SPEED * sin(radians(impact)) * (1 - restitution) / RADIUS
