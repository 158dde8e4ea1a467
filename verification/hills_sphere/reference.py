"""Hill's thick sphere under pressure inside, elastic and perfectly plastic, quasi-static; exact for von Mises and any Poisson's ratio.

Hill, The Mathematical Theory of Plasticity (1950), chapter V. With the wall plastic from the inner radius a to c and elastic to the outer
radius b

    p = 2 sigma_y ln(c/a) + 2/3 sigma_y (1 - c^3/b^3),     u(b) = sigma_y c^3 (1 - nu)/(E b^2).

By symmetry the stress is one of pure shear and pressure, so Tresca's and von Mises's laws agree. The volume changes elastically
everywhere, which gives the displacement inside; `profile` has the stresses, `inner` the motion of the bore.
"""
from math import log


def pressure(c, inner=1.0, outer=2.0):
    """Over the yield stress, with the wall plastic up to c.

    >>> [round(pressure(c), 6) for c in (1.0, 1.2, 1.4, 2.0)]
    [0.583333, 0.88731, 1.110944, 1.386294]
    """
    return 2 * log(c / inner) + 2 / 3 * (1 - c**3 / outer**3)


def outer_motion(c, poisson, outer=2.0):
    """u(b) E / sigma_y [m].

    >>> round(outer_motion(1.2, 0.3), 6), round(outer_motion(1.4, 0.49), 6)
    (0.3024, 0.34986)
    """
    return c**3 * (1 - poisson) / outer**2


def radial_stress(r, c, inner=1.0, outer=2.0):
    """Over the yield stress; minus the pressure inside, nothing outside.

    >>> [round(radial_stress(r, 1.2), 6) + 0.0 for r in (1, 2)]
    [-0.88731, 0.0]
    """
    if r < c:
        return 2 * log(r / c) - 2 / 3 * (1 - c**3 / outer**3)
    return 2 / 3 * (c**3 / outer**3 - c**3 / r**3)


def hoop_stress(r, c, outer=2.0):
    """Over the yield stress; one more than the radial one where the wall flows.

    >>> round(hoop_stress(1.1, 1.2) - radial_stress(1.1, 1.2), 6)
    1.0
    """
    if r < c:
        return radial_stress(r, c, outer=outer) + 1
    return 2 / 3 * (c**3 / outer**3 + c**3 / (2 * r**3))


def motion(r, c, poisson, outer=2.0):
    """u(r) E / sigma_y [m].

    The change of volume is elastic everywhere, u' + 2 u/r = 3 (1 - 2 nu) mean stress / E. From equilibrium the mean stress times 3 r^2 is
    the rate of r^3 sigma_r, so that u r^2 = (1 - 2 nu) r^3 sigma_r / E + constant, and the elastic wall has constant = c^3 (1 - nu) sigma_y
    / E.

    >>> abs(motion(2.0, 1.2, 0.3) - outer_motion(1.2, 0.3)) < 1e-12
    True
    """
    return ((1 - 2 * poisson) * r**3 * radial_stress(r, c, outer=outer) + (1 - poisson) * c**3) / r**2
