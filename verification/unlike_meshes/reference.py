"""Two strips on each other, clamped, pressed together and bent; and the stress in blocks under a uniform pressure.

**Strips.** Both have the length L, the width b and the thickness h, no friction between them, and Poisson's ratio zero. A load q per area
bends them, and a pressure p on both outer faces presses them together; both act on the deformed faces. Without the pressure each bends
alone: w = q b L^4/(8 E I) with E I = 2 E b h^3/12 of both. The pressure adds two effects of the same order, p L^2/(E h^2):

- An even pressure on all faces of a body does nothing. Here it is missing on the ends, as if a tension p per area pulled there along the
  axis, T = 2 p h b. In the terms of forces: of two curved faces the outer one is longer. Strips become softer by that.
- Strips slide on each other by h w' where they slope by w'. At the tip the face of one sticks out, without pressure from the other strip,
  by h w'(L): a force p b h w'(L) = T/2 w'(L) acts against the deflection. This is the larger effect.

Equilibrium of what is between x and the tip, deflection and load downwards:

    E I w''' = -q b (L - x) + T w' - (T/2) w'(L),   w(0) = w'(0) = 0,   w''(L) = 0

With k^2 = T/(E I) = 12 p/(E h^2) and r = q b/T = q/(2 p h),

    w' = A cosh kx + B sinh kx + r (L - x) + w'(L)/2,   A = -r L - w'(L)/2,   B = (r/k - A sinh kL)/cosh kL,
    w'(L) = 2 r (tanh(kL)/k - L/cosh kL)/(1 + 1/cosh kL)

Shear adds the integral of the shear force q b (L - x) - T w' + (T/2) w'(L) over 5/6 G 2 h b.

**Blocks.** The stress along a uniform pressure is minus that pressure, whatever the meshes.
"""
from math import cosh, sinh, sqrt, tanh


def deflection(load, pressure, young, length, thickness):
    """Of the tip by the load [m], of two strips of this thickness each.

    >>> strips = dict(young=70e9, length=0.1, thickness=0.01)
    >>> bending, shear = 12 * 280e3 * 0.1**4 / (16 * 70e9 * 0.01**3), 280e3 * 0.1**2 / (4 * 5 / 6 * 35e9 * 0.01)
    >>> round(deflection(280e3, 1e3, **strips) / (bending + shear), 4)   # each alone
    1.0
    >>> [round(1e3 * deflection(280e3, p, **strips), 4) for p in (14e6, 70e6, 280e6)]
    [0.2907, 0.251, 0.1613]
    """
    k = sqrt(12 * pressure / (young * thickness**2))
    c, s, r = cosh(k * length), sinh(k * length), load / (2 * pressure * thickness)
    slope = 2 * r * (tanh(k * length) / k - length / c) / (1 + 1 / c)
    a = -r * length - slope / 2
    b = (r / k - a * s) / c
    bent = a * s / k + b * (c - 1) / k + r * length**2 / 2 + slope * length / 2
    tension = 2 * pressure * thickness
    shear_force = load * length**2 / 2 - tension * bent + tension / 2 * slope * length  # the integral of it, over b
    return bent + shear_force / (5 / 6 * young / 2 * 2 * thickness)


def reference(pressure):
    """[Pa] of the stress along the load; a positive pressure presses.

    >>> reference(21e6)
    -21000000.0
    """
    return -pressure
