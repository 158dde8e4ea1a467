"""A block pressed on a wider one and pushed aside: what CalculiX computes.

CalculiX CrunchiX 2.20 (Debian 2.20-1), hexahedra with incompatible modes (C3D8I), penalties of 1e13 and 1e12 Pa/m; `deck.py` beside this
writes the decks.
"""

PUSH = 1e-4  # [m] of the top aside

# {times of 20 x 10 and 7 x 7 cells: forces on the top [N] after the press and after the push}
MESHES = {1: {"press": 33690.66, "aside": 1469.88},
          2: {"press": 33466.29, "aside": 1452.452},
          4: {"press": 33385.94, "aside": 1444.278}}


def extrapolated(coarse, middle, fine):
    """Of three meshes, each with half the cells of the one before (Richardson).

    >>> extrapolated(1 + 4, 1 + 1, 1 + 0.25)
    1.0
    """
    return fine - (middle - fine)**2 / ((coarse - middle) - (middle - fine))


EXTRAPOLATED = {name: extrapolated(*(MESHES[n][name] for n in (1, 2, 4))) for name in ("press", "aside")}

# {cells: [(place along the foot [m], displacement aside after the press [m], after the push [m])]}
FOOT = {
    1: [(0.5, -2.839994e-05, 1.628946e-06), (0.6428571, -2.130582e-05, 9.905659e-06), (0.7857143, -1.4655e-05, 1.758307e-05),
        (0.9285714, -4.992577e-06, 2.761355e-05), (1.071429, 4.992577e-06, 3.761919e-05), (1.214286, 1.4655e-05, 4.698247e-05),
        (1.357143, 2.130582e-05, 5.251791e-05), (1.5, 2.839994e-05, 6.10949e-05)],
    2: [(0.5, -2.859539e-05, 8.046643e-07), (0.5714286, -2.32764e-05, 6.999168e-06), (0.6428571, -2.189658e-05, 9.146044e-06),
        (0.7142857, -1.828494e-05, 1.324811e-05), (0.7857143, -1.418479e-05, 1.773492e-05), (0.8571429, -9.677434e-06, 2.252683e-05),
        (0.9285714, -4.895714e-06, 2.748061e-05), (1, -1.172761e-15, 3.245092e-05), (1.071429, 4.895714e-06, 3.727575e-05),
        (1.142857, 9.677434e-06, 4.189111e-05), (1.214286, 1.418479e-05, 4.612319e-05), (1.285714, 1.828494e-05, 4.985331e-05),
        (1.357143, 2.189658e-05, 5.302175e-05), (1.428571, 2.32764e-05, 5.361854e-05), (1.5, 2.859539e-05, 5.983474e-05)]}
