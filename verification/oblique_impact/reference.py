"""What an impact of two free bodies cannot change: momentum, angular momentum, and the sum of all energies.

Newton's third law: contact forces come in pairs without net force and, where each pair acts along one line, without
net moment. The frictional force of a pair with fixed weights on the base does not: its moment is the force times the offset
of the apex from the centroid of the facet.
"""


def of_a_box(mass, size, centre, velocity):
    """(momentum, angular momentum about the origin) of a box that does not turn; both vectors.

    >>> of_a_box(2.0, (1, 1, 1), (0, 1, 0), (3, 0, 0))
    ((6.0, 0.0, 0.0), (0.0, 0.0, -6.0))
    """
    p = tuple(mass * v for v in velocity)
    x, y, z = centre
    return p, (y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0])
