"""An elastic sphere strikes a rigid plane: Hertz's quasi-static law, and how far a finite sphere is from it.

Hertz (1882), in Johnson, Contact Mechanics, chapters 4 and 11: the force over the approach is (4/3) E* sqrt(R) d^1.5, with
E* = E/(1 - nu^2) against a rigid plane. Energy then gives the largest approach, and the duration 2.94328 d/v.

His bodies are half-spaces. FINITE_SPHERE holds what a full sphere does instead, at Poisson's ratio 0.3 and without friction, as
factors on Hertz's force and duration over a/R: from an axisymmetric finite-element model of the catalogue's authors
(status N there: computed and confirmed, not published).
"""
from math import pi, sqrt

# a/R: (largest force over Hertz's, contact time over Hertz's)
FINITE_SPHERE = {0.05: (1.016, 0.986), 0.1: (1.039, 0.973), 0.2: (1.083, 0.947)}
LEAST_REBOUND = 0.998  # [-] over the speed of impact, in all of them


def mass_of(radius, density):
    """[kg]"""
    return 4 / 3 * pi * radius**3 * density


def hertz(radius, density, young, poisson, speed, mass=None):
    """Hertz's values in SI units; of a ball that lacks some of its mass, with this mass [kg].

    >>> steel = hertz(0.01, 7850, 210e9, 0.3, 1)
    >>> round(steel["approach"] * 1e6, 3), round(steel["force"], 1), round(steel["duration"] * 1e6, 3)
    (17.795, 2309.8, 52.376)
    >>> round(steel["contact_radius"] * 1e3, 4), round(steel["pressure"] / 1e9, 3)
    (0.4218, 6.197)
    """
    modulus = young / (1 - poisson**2)
    mass = mass or mass_of(radius, density)
    approach = (15 * mass * speed**2 / (16 * modulus * sqrt(radius)))**0.4
    force = 4 / 3 * modulus * sqrt(radius) * approach**1.5
    contact_radius = sqrt(radius * approach)
    return {"approach": approach, "force": force, "duration": 2.94328 * approach / speed, "contact_radius": contact_radius,
            "pressure": 1.5 * force / (pi * contact_radius**2), "impulse": 2 * mass * speed}


def speed_for(ratio, radius, density, young, poisson):
    """The speed [m/s] at which Hertz's contact grows to a/R = ratio.

    >>> speed = speed_for(0.1, 0.01, 7850, 210e9, 0.3)
    >>> round(speed, 4), round(hertz(0.01, 7850, 210e9, 0.3, speed)["contact_radius"] * 1e3, 6)
    (8.6522, 1.0)
    """
    approach = ratio**2 * radius
    return sqrt(16 * young / (1 - poisson**2) * sqrt(radius) * approach**2.5 / (15 * mass_of(radius, density)))


def finite_sphere(ratio):
    """Factors on Hertz's force and time at a/R = ratio, between the computed ones by a straight line.

    >>> finite_sphere(0.1)
    (1.039, 0.973)
    """
    known = sorted(FINITE_SPHERE)
    for low, high in zip(known, known[1:]):
        if low <= ratio <= high:
            part = (ratio - low) / (high - low)
            return tuple(round(a + part * (b - a), 4) for a, b in zip(FINITE_SPHERE[low], FINITE_SPHERE[high]))
    raise ValueError(f"a/R = {ratio} is outside {known[0]} to {known[-1]}")
