"""Two boxes whose faces overlap by a known depth.

Every apex has the gap -depth and the pressure penalty x depth, whatever the meshes; apart by the same distance every gap is
+distance and nothing is pushed or pulled. The resultant is the pressure on the area of the apexes.
"""


def reference(gap, penalty, area):
    """(pressure [Pa] of every apex, resultant [N]) at a gap, open for positive.

    >>> reference(-0.1, 1e6, 1.0), reference(0.1, 1e6, 1.0)
    ((100000.0, 100000.0), (0.0, 0.0))
    """
    pressure = penalty * max(0.0, -gap)
    return pressure, pressure * area
