"""Two blocks pressed together by a uniform pressure: the contact patch test of Taylor and Papadopoulos.

R. L. Taylor and P. Papadopoulos, On a patch test for contact problems in two dimensions, in Computational Methods in Nonlinear
Mechanics (Springer 1991) 690. The stress is -p everywhere, the contact pressure p at every apex, and a penalty (Pa/m) lets the
blocks overlap by p/penalty, which the top settles more than the column alone.
"""


def reference(pressure, young, height, penalty):
    """Exact values in SI units; both blocks of this height, Poisson's ratio free at the sides.

    >>> exact = reference(1.0, 1e6, 0.5, 2e7)
    >>> exact["overlap"], exact["settlement"]
    (5e-08, 1.05e-06)
    """
    overlap = pressure / penalty
    return {"stress": -pressure, "contact_pressure": pressure, "overlap": overlap,
            "settlement": 2 * height * pressure / young + overlap}
