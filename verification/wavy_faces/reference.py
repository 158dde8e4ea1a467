"""Two elastic layers whose faces differ by a cosine, in plane strain, pressed until they touch everywhere.

A layer of the thickness H without shear on its faces, under normal pressures that are cosines of the wave number k on both (plane strain,
E and nu): if both have the amplitude q, each face moves in by S q; if one has q and the other -q, both move by A q in the direction of the
push,

    S = 2 (1 - nu^2)/(E k) (cosh kH - 1)/(sinh kH + kH),   A = 2 (1 - nu^2)/(E k) (cosh kH + 1)/(sinh kH - kH)

which is Filon's solution (Timoshenko and Goodier, Theory of Elasticity, section 24); both are 2 (1 - nu^2)/(E k) for a half-space. So a
layer with a free rear face gives way by (S + A)/2 for each q, one on a smooth rigid plane by 2 S A/(S + A).

Faces with the gap g (1 - cos kx) before touch everywhere under a mean pressure that is larger than q = g/(sum of both), and the pressure
is then the mean plus q cos kx: the case of Westergaard (1939) for layers (Johnson, Contact Mechanics, section 13.2).
"""
from math import cos, cosh, pi, sin, sinh


def compliances(k, thickness, young, poisson):
    """(S, A) [m/Pa].

    >>> half_space = 2 * (1 - 0.3**2) / (200e9 * 50)
    >>> S, A = compliances(50, 1.0, 200e9, 0.3)
    >>> abs(S / half_space - 1) < 1e-12 and abs(A / half_space - 1) < 1e-12
    True
    >>> S, _ = compliances(1e-2, 1.0, 200e9, 0.3)             # a thin layer under an even pressure, plane strain with free sides
    >>> round(S / (0.5 * 1.0 * (1 - 0.3**2) / 200e9), 4)
    1.0
    >>> _, A = compliances(1e-2, 1.0, 200e9, 0.3)              # and a beam: 2 q = E/(1 - nu^2) H^3/12 k^4 w
    >>> round(A / (2 * 12 * (1 - 0.3**2) / (200e9 * 1e-2**4)), 4)
    1.0
    """
    kh, half_space = k * thickness, 2 * (1 - poisson**2) / (young * k)
    return half_space * (cosh(kh) - 1) / (sinh(kh) + kh), half_space * (cosh(kh) + 1) / (sinh(kh) - kh)


def free_behind(S, A):
    """[m/Pa] where the rear face is free.

    >>> free_behind(2.0, 4.0)
    3.0
    """
    return 0.5 * (S + A)


def smooth_plane_behind(S, A):
    """[m/Pa] where the rear face stays flat on a smooth plane.

    >>> S, A = compliances(3.0, 1.0, 200e9, 0.3)
    >>> whole, _ = compliances(3.0, 2.0, 200e9, 0.3)           # half of a layer that is pressed from both sides
    >>> round(smooth_plane_behind(S, A) / whole, 12)
    1.0
    """
    return 2 * S * A / (S + A)


def amplitude(gap, *compliance):
    """[Pa] of the pressure that closes a gap g (1 - cos kx).

    >>> amplitude(6.0, 1.0, 2.0)
    2.0
    """
    return gap / sum(compliance)


def weighted_mean(k, x, left, right):
    """The mean of cos kx with the shape function of the node x as weight: 1 at x, 0 at both neighbours; a node at an end is its
    own neighbour.

    >>> round(weighted_mean(pi, 0.0, 0.0, 1e-3), 6), round(weighted_mean(pi, 0.5, 0.49, 0.51), 12)
    (0.999999, 0.0)
    >>> round(weighted_mean(2.0, 0.3, 0.2, 0.5), 9)            # by the midpoint rule with a million points
    0.77985459
    """
    total = 0.0
    for end in (left, right):
        h = abs(end - x)
        if h > 0:  # integral of (1 - s/h) cos(k (x + way s))
            way = 1 if end > x else -1
            total += cos(k * x) * (1 - cos(k * h)) / (k * k * h) - way * sin(k * x) * (k * h - sin(k * h)) / (k * k * h)
    return total / (0.5 * (right - left))


def squeeze_modulus(young, poisson):
    """[Pa] of an even pressure where all sides are held.

    >>> squeeze_modulus(1.0, 0.0)
    1.0
    """
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
