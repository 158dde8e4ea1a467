"""A block slides on a level plane until Coulomb's friction has stopped it.

Deceleration mu g: distance v0^2/(2 mu g), time v0/(mu g), heat equal to the kinetic energy it began with.
"""


def reference(speed, friction, gravity):
    """Exact values in SI units.

    >>> stop = reference(5, 0.3, 9.81)
    >>> round(stop["distance"], 5), round(stop["time"], 5)
    (4.24737, 1.69895)
    """
    return {"distance": speed**2 / (2 * friction * gravity), "time": speed / (friction * gravity)}
