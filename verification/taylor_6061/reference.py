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
from math import log, pi

# standard uncertainties of the inputs over their values: no source gives one. 5 % on the yield stress is the spread of T6 from batch to
# batch; the others are how far constants of one metal lie apart between authors
SPREAD = {"yield": 0.05, "hardening_coefficient": 0.2, "rate_coefficient": 0.5, "thermal_exponent": 0.1, "taylor_quinney": 0.05,
          "young": 0.03}

SPEED = 0.005   # [-] of the measured speed: no source gives one; printed to 1 m/s, which is 0.2 % at 150 m/s
FRICTION = 0.1  # [-] between anvil and bar, somewhere between none and this: no source gives one
U_MEASURED = {"length": 0.01, "foot": 0.027, "belly": 0.027}  # [-] scatter of House's shots about a smooth curve: see above


def digitised(shot):
    """Standard uncertainty of a diameter that was read from a drawn profile. Flow keeps the volume, so what the drawn one is off the first
    volume, V/V0 - 1, is half of it the error of diameters. [-] Zero where there is no profile.

    >>> round(digitised({"diameter": 7.62, "length": 46.94, "volume": 1883.36}), 3)
    0.06
    >>> digitised({"diameter": 7.62, "length": 46.94, "volume": None})
    0.0
    """
    if shot["volume"] is None:
        return 0.0
    return abs(shot["volume"] / (pi / 4 * shot["diameter"]**2 * shot["length"]) - 1) / 2


def flow_stress(density, speed, ratio):
    """Mean flow stress that takes a bar's energy in an even field: density speed^2 / (2 ln(L0/L)). [Pa] It orders batches by temper, by
    measurements alone: of bars of one form and speed the one with the higher stress is harder.

    >>> [round(flow_stress(2700, 262, 0.844) / 1e6), round(flow_stress(2685, 252, 0.848) / 1e6)]   # Wilkins & Guinan, Gust
    [546, 517]
    >>> round(flow_stress(2700, 248, 19.4 / 22.785) / 1e6)   # House
    516
    """
    return density * speed**2 / (2 * log(1 / ratio))
