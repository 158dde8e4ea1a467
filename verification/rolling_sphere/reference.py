"""A sphere that slides with friction begins to roll, on a rigid plane into which it cannot sink: it flattens.

Friction mu m g slows the sphere down and turns it. Friction acts in the plane, so the angular momentum about a line in the plane is kept:
with the height h of the centre and the inertia k m R^2 (k = 2/5 for a solid sphere),

    v h + k R^2 w = v0 h,   v = v0 - mu g t

The sphere rolls once v = w r with the rolling radius r:

    v = v0/(1 + k R^2/(h r)),   t = (v0 - v)/(mu g),   d = (v0^2 - v^2)/(2 mu g)

whatever the mass is. Friction then has nothing to do. Of a rigid sphere h = r = R: 5/7 of the speed.

An elastic sphere is lower by Hertz's approach, h = R - delta. Its surface is compressed where it touches. Hertz's pressure moves the rim of
the contact inwards by u (Johnson, Contact Mechanics, Eq. 3.42a),

    u/a = (1 - 2 nu)(1 + nu) p0/(3 E)

which is the mean strain over the contact, along the line of rolling and over the area. As much less surface rolls off in a turn:
r = R (1 - u/a). Both are of the first order in (a/R)^2 and in a/R, and what they leave out is of the next.
"""
from math import pi, sqrt


def hertz(weight, radius, young, poisson):
    """(approach delta [m], mean strain of the surface u/a [-]) of a sphere under its weight.

    >>> approach, strain = hertz(41092, 1.0, 20e6, 0.3)
    >>> round(approach, 5), round(strain, 5)
    (0.01253, 0.01357)
    >>> hertz(41092, 1.0, 20e6, 0.5)[1]   # nothing in an incompressible one
    0.0
    """
    modulus = young / (1 - poisson**2)
    approach = (0.75 * weight / (modulus * sqrt(radius)))**(2 / 3)
    return approach, (1 - 2 * poisson) * (1 + poisson) / (3 * young) * 2 * modulus / pi * sqrt(approach / radius)


def rolling(speed, friction, gravity, k=0.4, height=1.0, radius=1.0):
    """(time [s], speed [m/s], way [m]) at which it begins to roll; height and rolling radius over that of the sphere.

    >>> [round(x, 5) for x in rolling(3, 0.2, 9.81)]
    [0.43687, 2.14286, 1.12339]
    >>> [round(x, 4) for x in rolling(3, 0.2, 9.81, height=0.98747, radius=0.98643)]
    [0.4451, 2.1267, 1.141]
    """
    later = speed / (1 + k / (height * radius))
    return (speed - later) / (friction * gravity), later, (speed**2 - later**2) / (2 * friction * gravity)


def speed_at(t, speed, friction, gravity, begins, later):
    """[m/s]

    >>> speed_at(0.1, 3, 0.2, 10, 0.45, 2.1), speed_at(5, 3, 0.2, 10, 0.45, 2.1)
    (2.8, 2.1)
    """
    return speed - friction * gravity * t if t < begins else later
