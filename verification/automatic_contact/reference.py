"""Blows between rigid bodies that move along one line and keep all energy."""


def blow(m, u, M, U):
    """Speeds of two bodies after they have met.

    >>> blow(1.0, 2.0, 1.0, 0.0)
    (0.0, 2.0)
    >>> blow(1.0, 3.0, 2.0, 0.0)
    (-1.0, 2.0)
    """
    common = (m * u + M * U) / (m + M)
    return 2 * common - u, 2 * common - U


def struck_twice(plate, above, below, speed):
    """Speeds of plate and both blocks along z: the upper one strikes first, then the lower one meets the plate.

    >>> [round(v, 12) for v in struck_twice(1.0, 1.0, 1.0, 1.0)]
    [1.0, 0.0, -1.0]
    """
    of_above, of_plate = blow(above, -speed, plate, 0.0)
    of_below, of_plate = blow(below, speed, plate, of_plate)
    return of_plate, of_above, of_below
