"""The stress in blocks under a uniform pressure, whatever the meshes: minus that pressure along the load."""


def reference(pressure):
    """[Pa] of the stress along the load; a positive pressure presses.

    >>> reference(21e6)
    -21000000.0
    """
    return -pressure
