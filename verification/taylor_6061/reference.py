"""Taylor bars of 6061-T6: constants of the metal, and what is known of the measurements.

*Constants.* Lesuer, Kay & LeBlanc, Modeling large-strain, high-rate deformation in metals, Lawrence Livermore UCRL-JC-134118 (2001),
table 1: A 324 MPa, B 114 MPa, n 0.42, C 0.002, m 1.34, at rates over 1/s. The report was not read; a reader of it prints the same. It
fits stress and strain of tests at many rates; none of them is a Taylor bar, as far as secondary sources say. Melting at 925 K (Banerjee &
Bhawalkar 2008 have 933.6 K, which moves nothing here), specific heat 890 J/(kg K), Young's modulus 70 GPa: handbook values.

*Temper.* By the measured flow stress the bars of House, Gust and Wilkins & Guinan are one batch, T6: medians of 508, 529 and 533 MPa.

*Measurements.* No source gives an uncertainty. House's 23 shots scatter about ln(L/L0) = a V^2 + b, fitted for each length, by 1.0 % in
length and 2.7 % at the foot (9 degrees of freedom). The drawn profiles of Wilkins & Guinan, digitised by the Uintah project, are off in
volume by 4 and 12 %, and the length of that of 373 m/s is 0.758 of the first one where the table has 0.703: its foot and belly are
doubtful. The source table has shots to 603 m/s, which the shorter table of fast_bar has not: 603 m/s (0.370), 580 (0.404) and 591
(0.412).
"""

# standard uncertainties of the inputs over their values: no source gives one. 5 % on the yield stress is the spread of T6 from batch to
# batch; the others are how far constants of one metal lie apart between authors
SPREAD = {"yield": 0.05, "hardening_coefficient": 0.2, "rate_coefficient": 0.5, "thermal_exponent": 0.1, "taylor_quinney": 0.05,
          "young": 0.03}

SPEED = 0.005   # [-] of the measured speed: no source gives one; printed to 1 m/s, which is 0.2 % at 150 m/s
FRICTION = 0.1  # [-] between anvil and bar, somewhere between none and this: no source gives one
U_MEASURED = {"length": 0.01, "foot": 0.027, "belly": 0.027}  # [-] scatter of House's shots about a smooth curve: see above


def left(temperature):
    """What is left of the flow stress at a temperature [K], over that at room temperature, by the law.

    >>> round(left(294), 2), round(left(655), 2)
    (1.0, 0.53)
    """
    return 1 - ((temperature - 294) / (925 - 294))**1.34
