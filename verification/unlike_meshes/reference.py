"""The stress in blocks under a uniform pressure, whatever the meshes: minus that pressure along the load."""


def reference(pressure):
    """[Pa] of the stress along the load; positive pressure presses."""
    return -pressure
