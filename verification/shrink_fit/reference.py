"""A ring shrunk onto a longer hollow shaft: what CalculiX computes, and Lame's number for a shaft that is no longer than the ring.

CalculiX CrunchiX 2.20 (Debian 2.20-1), axisymmetric elements CAX8R, small displacements; `deck.py` beside this writes the decks.
"""

# {times of 6 x 20 and 10 x 8 cells: radial displacements [m] and the resultant of the pressure on 5 degrees [N]}
MESHES = {1: {"outer_middle": 4.532221e-06, "outer_end": 4.700231e-06, "bore_middle": -3.113495e-06, "bore_20": -1.825359e-06,
              "shaft_30": -4.364251e-07, "push": 1266.294},
          2: {"outer_middle": 4.531826e-06, "outer_end": 4.69905e-06, "bore_middle": -3.113756e-06, "bore_20": -1.824898e-06,
              "shaft_30": -4.356178e-07, "push": 1266.097},
          4: {"outer_middle": 4.531686e-06, "outer_end": 4.698649e-06, "bore_middle": -3.113861e-06, "bore_20": -1.82472e-06,
              "shaft_30": -4.353805e-07, "push": 1266.028}}
FINEST = 4

STEP = 2.5e-3  # [m] between the places of LINES, from the middle along the axis

# radial displacements of the finest mesh [m]
LINES = {
    "bore": [-3.113861e-06, -3.101025e-06, -3.060514e-06, -2.986411e-06, -2.86943e-06, -2.698643e-06, -2.465383e-06, -2.169426e-06,
             -1.82472e-06, -1.459248e-06, -1.106377e-06, -7.930328e-07, -5.329839e-07, -3.274871e-07, -1.696761e-07, -4.887764e-08,
             4.660848e-08, 1.281288e-07, 2.060743e-07, 2.89142e-07, 3.807204e-07],
    "shaft": [-3.47274e-06, -3.464013e-06, -3.437056e-06, -3.38943e-06, -3.316629e-06, -3.210899e-06, -3.057749e-06, -2.822721e-06,
              -2.27664e-06, -1.411062e-06, -9.722129e-07, -6.635016e-07, -4.353805e-07, -2.644992e-07, -1.357173e-07, -3.717964e-08,
              4.136289e-08, 1.091136e-07, 1.742812e-07, 2.434997e-07, 3.189902e-07],
    "ring": [4.531686e-06, 4.536262e-06, 4.549554e-06, 4.57026e-06, 4.59625e-06, 4.624708e-06, 4.652528e-06, 4.677192e-06,
             4.698649e-06]}


def of_equal_length(a, b, c, interference, young, poisson):
    """(pressure [Pa], displacement of the outside [m]) of two thick tubes of equal length under no axial stress (Lame).

    The longer shaft holds the ring's bore, so that it is pressed in less and the ring widens more:

    >>> pressure, outside = of_equal_length(0.010, 0.025, 0.050, 1e-5, 210e9, 0.3)
    >>> round(1e-6 * pressure, 1), round(1e6 * outside, 2), 1e6 * MESHES[4]["outer_middle"] > 1e6 * outside
    (27.6, 4.38, True)
    """
    ring = b / young * ((c * c + b * b) / (c * c - b * b) + poisson)
    shaft = b / young * ((b * b + a * a) / (b * b - a * a) - poisson)
    pressure = interference / (ring + shaft)
    return pressure, pressure / young * 2 * b * b * c / (c * c - b * b)
