"""Forces between bodies that stand on each other, and of a block that slides: weights, Newton's third law and Coulomb's friction."""

GRAVITY = 9.81  # [m/s2]


def weight(density, *sides):
    """Of a block [N].

    >>> round(weight(1000, 0.1, 0.1, 0.1), 12)
    9.81
    """
    volume = 1.0
    for side in sides:
        volume *= side
    return density * GRAVITY * volume


def slowed(momentum, friction, force, t):
    """Momentum of a block that is pressed on its floor by a force and slides for the time t, and has not stopped yet [N s].

    >>> slowed(10, 0.5, 4, 2)
    6.0
    """
    return momentum - friction * force * t
