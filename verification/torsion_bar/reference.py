"""Dynamic torsion of a free square bar: what four other codes found, and what torsional waves say.

The bar turns at the rate a z about its axis, so the twist per length grows as a t everywhere until waves that relieve it arrive from the
free ends. Sections that stay plane have the shear G a t r. All natural modes of a free bar that are odd in z have frequencies n pi c_t/L
with odd n, so they pass their largest twist together, at L/(2 c_t) with c_t = sqrt(G J/(rho I)): then nothing moves and all energy is
strain.

Two elements across: their nodes stand where the warping of a square, x y (x^2 - y^2), is zero, so the mesh cannot warp and J = I_p = s^4/6.
Masses lumped at the nodes have more rotary inertia than the bar: (1 + 2/n^2) I_p with n elements across, half as much again for n = 2.

Source: Norma.jl, docs/notes/torsion-verification: E = 1 GPa, nu = 0.25, 1000 kg/m3, 0.05 m x 0.05 m x 1 m, a = 8000 1/(m s), 2 x 2 x 40
hexahedra of 2 x 2 x 2 points, neo-Hookean. Largest nodal von Mises stress, projected to the nodes, at 0.79 ms: Norma and Carina 150.0, LCM
150.1 MPa with consistent masses, Sierra/Adagio 155.1 MPa with lumped ones. Read in the source, not recomputed.
"""
from math import sqrt

BAR = {"young": 1e9, "poisson": 0.25, "density": 1000.0, "side": 0.05, "length": 1.0, "rate": 8000.0}  # SI
TIME, LUMPED, CONSISTENT = 0.79e-3, 155.1e6, 150.0e6  # [s] [Pa] [Pa]


def shear_modulus(young, poisson):
    return young / (2 * (1 + poisson))


def von_mises_at_corner(t, young, poisson, density, side, length, rate):
    """In the middle of the bar, before relief arrives, of a section that stays plane [Pa].

    What the code with lumped masses found is this to 0.2 %: no relief has arrived there.

    >>> round(von_mises_at_corner(TIME, **BAR) / 1e6, 1)
    154.8
    """
    return sqrt(3) * shear_modulus(young, poisson) * rate * t * side / sqrt(2)


def largest_twist_at(young, poisson, density, side, length, rate, across=None):
    """Time at which all energy is strain [s]; masses lumped at n x n elements across, or spread evenly.

    The first is that at which the codes with consistent masses found it.

    >>> round(1e3 * largest_twist_at(**BAR), 2), round(1e3 * largest_twist_at(**BAR, across=2), 3)
    (0.79, 0.968)
    """
    heavier = 1 if across is None else 1 + 2 / across**2
    return length / 2 / sqrt(shear_modulus(young, poisson) / density / heavier)


def kinetic_energy(young, poisson, density, side, length, rate, across, along):
    """At the start, of masses lumped at the nodes [J].

    >>> round(kinetic_energy(**BAR, across=2, along=40), 3)
    4171.875
    """
    lumped = lambda cells, width: sum((0.5 if i in (0, cells) else 1) / cells * (width * (i / cells - 0.5))**2 for i in range(cells + 1))
    mass = density * side**2 * length
    return 0.5 * mass * rate**2 * 2 * lumped(across, side) * lumped(along, length)
