"""A rigid block held at a constant depth and dragged over a flat plane that is meshed irregularly.

The plane is flat, so normal force and friction are constant: N = penalty x depth x area of the apexes, T = mu N once it slides.
With the area of the facet under each apex in place of the apex's own, N follows the facets.
"""


def reference(penalty, depth, area, friction):
    """(N, T) [N].

    >>> reference(1e9, 1e-3, 0.04, 0.25)
    (40000.0, 10000.0)
    """
    normal = penalty * depth * area
    return normal, friction * normal
