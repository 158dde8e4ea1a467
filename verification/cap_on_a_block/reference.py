"""The cap of a ball on a block of few contact radii, without friction: what CalculiX computes, and Hertz's contact radius.

CalculiX CrunchiX 2.20 (Debian 2.20-1), axisymmetric elements CAX8R with large displacements; `deck.py` beside this writes the decks. The
node on the axis below the cap does not settle when its cells are halved, and is not compared.
"""

# {times of 20 x 16 and 24 x 16 cells: force on 5 degrees [N], displacements of the face upwards [m]}
MESHES = {1: {"force": 139.2633, "off_1": -8.113764e-06, "off_2": -2.597295e-06, "off_3": -7.492639e-07},
          2: {"force": 139.4143, "off_1": -8.170949e-06, "off_2": -2.600929e-06, "off_3": -7.500476e-07}}
FINEST = 2

# (distance from the axis [m], displacement upwards [m]) of the face of the block, finest mesh
FACE = [
    (0, -1.87234e-05), (0.0001506076, -1.935568e-05), (0.0003048611, -1.901841e-05), (0.0004664062, -1.840032e-05),
    (0.0006388889, -1.74545e-05), (0.0008259549, -1.609476e-05), (0.00103125, -1.420205e-05), (0.00125842, -1.16179e-05),
    (0.001511111, -8.170949e-06), (0.001792969, -5.942934e-06), (0.002107639, -4.49122e-06), (0.002458767, -3.422012e-06),
    (0.00285, -2.600929e-06), (0.003284983, -1.958651e-06), (0.003767361, -1.453333e-06), (0.004300781, -1.057142e-06),
    (0.004888889, -7.500476e-07), (0.00553533, -5.164839e-07), (0.00624375, -3.433518e-07), (0.007017795, -2.187415e-07),
    (0.007861111, -1.310668e-07), (0.008777344, -6.842007e-08), (0.009770139, -1.804345e-08), (0.01084314, 3.373428e-08),
    (0.012, 9.731723e-08)]


def contact_radius(force, radius, young, poisson):
    """Hertz's, of a ball on a half-space of the same material [m]; force on all 360 degrees.

    >>> a = contact_radius(72 * MESHES[FINEST]["force"], 0.05, 210e9, 0.3)
    >>> round(1e3 * a, 2), round(6e-3 / a, 1)   # the block is so many of them deep
    (1.48, 4.0)
    """
    return (3 * force * radius * (1 - poisson**2) / (2 * young))**(1 / 3)
