"""A fluid at rest below a level surface.

The pressure at the depth d is p0 + density g d. An element with one pressure has the mean of it over its volume, which is that at its
centroid. The floor carries the weight and what presses on the top.
"""
GRAVITY = 9.81                                # [m/s2]
LENGTH, WIDTH, HEIGHT = 0.5, 0.3, 0.4         # [m]
WATER, AIR = 1000.0, 1.2                      # [kg/m3]
SOUND_OF_WATER, ATMOSPHERE, GAMMA = 1482.0, 1e5, 1.4  # [m/s] [Pa] [-]
SOUND_OF_AIR = (GAMMA * ATMOSPHERE / AIR)**0.5        # [m/s]

POINTS = [(a / 3**0.5, b / 3**0.5, c / 3**0.5) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
CORNERS = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))


def pressure(height, density, above=0.0):
    """At a height over the floor [m], below a surface at HEIGHT where the pressure is `above`. [Pa]

    >>> round(pressure(0, 1000), 3), round(pressure(HEIGHT, 1.2, 1e5), 3)
    (3924.0, 100000.0)
    """
    return above + density * GRAVITY * (HEIGHT - height)


def floor_force(density, above=0.0):
    """[N]

    >>> round(floor_force(1000), 6)
    588.6
    """
    return (density * GRAVITY * HEIGHT + above) * LENGTH * WIDTH


def height_of_centroid(corners):
    """Of a hexahedron whose faces are bent as its shape functions bend them: two Gauss points each way are exact. [m]

    >>> cube = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    >>> round(height_of_centroid(cube), 12)
    0.5

    A wedge, whose top is an edge, has its centroid at a third of its height and the mean of its corners at half of it:

    >>> round(height_of_centroid(cube[:4] + [(0, 0, 1), (0, 0, 1), (0, 1, 1), (0, 1, 1)]), 12)
    0.333333333333
    """
    moment = volume = 0.0
    for point in POINTS:
        at, slopes = [0.0] * 3, [[0.0] * 3 for _ in range(3)]
        for sign, corner in zip(CORNERS, corners):
            part = [(1 + p * s) / 2 for p, s in zip(point, sign)]
            for axis in range(3):
                at[axis] += part[0] * part[1] * part[2] * corner[axis]
                for by in range(3):
                    others = [part[other] for other in range(3) if other != by]
                    slopes[by][axis] += sign[by] / 2 * others[0] * others[1] * corner[axis]
        (a, b, c), (d, e, f), (g, h, i) = slopes
        jacobian = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
        volume, moment = volume + jacobian, moment + jacobian * at[2]
    return moment / volume
