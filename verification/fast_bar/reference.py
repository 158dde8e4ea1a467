"""Metals of the shots, and meshes for them."""

# constants of Johnson and Cook: copper and 4340 of Johnson & Cook (1983), 6061-T6 of Lesuer, Kay & LeBlanc (2001); Pa, K, J/(kg K)
COPPER = {"young": "124 GPa", "poisson": 0.34, "yield": "90 MPa", "hardening_coefficient": "292 MPa", "hardening_exponent": 0.31,
          "rate_coefficient": 0.025, "thermal_exponent": 1.09, "melting_temperature": "1356 K", "specific_heat": "383 J/(kg*K)"}
ALUMINIUM = {"young": "70 GPa", "poisson": 0.33, "yield": "324 MPa", "hardening_coefficient": "114 MPa", "hardening_exponent": 0.42,
             "rate_coefficient": 0.002, "thermal_exponent": 1.34, "melting_temperature": "925 K", "specific_heat": "890 J/(kg*K)"}
STEEL = {"young": "200 GPa", "poisson": 0.29, "yield": "792 MPa", "hardening_coefficient": "510 MPa", "hardening_exponent": 0.26,
         "rate_coefficient": 0.014, "thermal_exponent": 1.03, "melting_temperature": "1793 K", "specific_heat": "477 J/(kg*K)"}
METALS = {"Cu": COPPER, "OFHC Cu": COPPER, "6061-T6": ALUMINIUM, "4340": STEEL, "4340 Rc58": STEEL}


def cells_along(length, radius, level):
    """Two to four times as many cells as radii along a bar: those of every bar are as high as wide, and alike.

    >>> [cells_along(32.4, 3.2, level) for level in (0, 1, 2)]
    [20, 30, 40]
    """
    return round((2 + level) * length / radius)
