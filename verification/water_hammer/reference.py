"""Water hammer: the speed of a pressure wave in water within an elastic tube, and how far the tube swells behind it.

*Speed.* A tube that is free along its axis has no axial stress. Under the pressure p inside, its inner radius Ri grows (Lame) by the part

    p/E [(Ro^2 + Ri^2)/(Ro^2 - Ri^2) + nu],

and its section by twice that. With the compression p/K of the water, the section holds more water by p/K (1 + psi), so the wave has the
speed c/sqrt(1 + psi) (Korteweg 1878; for thick walls Tijsseling, Computers and Structures 85 (2007) 844-851). A piston of the velocity v
makes the pressure rho c v with that speed.

The inertia of the wall along its axis is left out. A wave of the speed c is slow beside the 5000 m/s of a bar of steel. The wall then has
an axial stress of -nu c^2/(5000^2 - c^2) of the hoop stress, which changes the speed of the thin tube by 0.1 %.

*Dynamic peak.* Skalak (An extension to the theory of water hammer, Trans. ASME 78 (1956) 105-116) adds the inertia of the wall and of the
water across the tube. Far from a piston that starts at once, the front is then the integral of Airy's function, whose largest value depends
on nothing.

*Measurement.* Inaba and Shepherd (Flexural waves in fluid-filled tubes subject to axial impact, J. Pressure Vessel Technol. 132 (2010))
shot a projectile at a buffer on the water in tubes of mild steel, 38 to 40 mm inside. In the tube of 0.8 mm they saw 1100 m/s, as their
abstract says; from 6.4 mm on the speed of sound in water.
"""
from math import gamma, sqrt

WATER, SOUND, STEEL, POISSON, INNER = 998.0, 1482.0, 200e9, 0.3, 19e-3
THICK, THIN = 12.7e-3, 0.8e-3
MEASURED = 1100.0  # [m/s] in the thin tube


def wave_speed(wall, young=STEEL):
    """Speed of the wave in a tube with this wall. [m/s]

    >>> round(wave_speed(THIN)), round(wave_speed(THICK))    # the numbers of the catalogue
    (1195, 1444)
    >>> round(wave_speed(THICK, young=1e20))                 # a rigid tube
    1482
    """
    outer = INNER + wall
    psi = 2 * WATER * SOUND**2 / young * ((outer**2 + INNER**2) / (outer**2 - INNER**2) + POISSON)
    return SOUND / sqrt(1 + psi)


def pressure(wall, velocity=1.0):
    """Behind the wave that a piston makes. [Pa]"""
    return WATER * wave_speed(wall) * velocity


def hoop_strain(wall, radius, velocity=1.0):
    """Static hoop strain at a radius of the wall, under the pressure behind the wave (Lame, no axial stress). [-]

    >>> thin = hoop_strain(THIN, INNER + THIN / 2) * STEEL / pressure(THIN)    # of a membrane: radius over wall
    >>> abs(thin * THIN / (INNER + THIN / 2) - 1) < 0.02
    True
    """
    outer = INNER + wall
    return pressure(wall, velocity) * INNER**2 / (STEEL * (outer**2 - INNER**2)) * ((1 - POISSON) + (1 + POISSON) * outer**2 / radius**2)


def peak_of_front():
    """The largest value of the integral of Airy's function from infinity, over what it tends to: at the first zero, by its power series.

    >>> round(peak_of_front(), 4)
    1.2744
    """
    zero = -2.338107410459767
    f, g = zero, zero**2 / 2
    first, second = zero, zero**2 / 2
    for k in range(1, 40):
        first *= zero**3 / ((3 * k) * (3 * k - 1)) * (3 * k - 2) / (3 * k + 1)
        second *= zero**3 / ((3 * k + 1) * (3 * k)) * (3 * k - 1) / (3 * k + 2)
        f, g = f + first, g + second
    to_zero = f / (3**(2 / 3) * gamma(2 / 3)) - g / (3**(1 / 3) * gamma(1 / 3))  # from 0 to the zero, which is left of it
    return 1 / 3 - to_zero


