"""Taylor bars of copper: constants of the metal, and what is known of the measurements.

*Constants.* Johnson & Cook, A constitutive model and data for metals subjected to large strains, high strain rates and high temperatures,
Proc. 7th Int. Symp. on Ballistics, The Hague 1983, 541-547, OFHC copper: A 90 MPa, B 292 MPa, n 0.31, C 0.025, m 1.09, melting at 1356 K.
The paper was not read. Two readers of it or of copies print the same: Banerjee (arXiv cond-mat/0512466, table 4: annealed OFHC copper, T0
= 294 K) and the Los Alamos report LA-UR-22-29965, as quoted elsewhere. The constants come from torsion, tension and Hopkinson bars; the
cylinders of the same paper (JC below) were a check and no part of the fit, as far as secondary sources say. Young's modulus, Poisson's
ratio and the specific heat are handbook values.

*Temper.* The constants are of annealed copper. By the measured flow stress the bars of Johnson & Cook and of Gust (OFHC and ETP) are of
one kind; those of Wilkins & Guinan are a quarter harder, and those of House half as hard again. The source table gives no temper. So the
batch `soft` is compared; `Wilkins` and `House` are run and printed, with the same constants, as batches of another temper. Jones's eight
shots are left out: their flow stresses go from 189 to 842 MPa without order, so the table mixes tempers that it does not name.

*Measurements.* No source gives an uncertainty. House's 26 shots scatter about ln(L/L0) = a V^2 + b, fitted for each length, by 1.0 % in
length and 2.5 % at the foot (12 degrees of freedom); two equal shots differ by 0.7 and 2.3 %. The larger numbers are taken, for all
sources. Shots that are out of order, as Gust's at 148 and 311 m/s by 8 and 12 %, stay.
"""
from math import log, pi

# standard uncertainties of the inputs over their values: no source gives one. 10 % on the yield stress and 5 % on the hardening are the
# spread of one temper from batch to batch; the others are how far constants of one metal lie apart between authors
SPREAD = {"yield": 0.1, "hardening_coefficient": 0.05, "rate_coefficient": 0.2, "thermal_exponent": 0.1, "taylor_quinney": 0.05,
          "young": 0.03}

SPEED = 0.005   # [-] of the measured speed: no source gives one; printed to 1 m/s, which is 0.2 % at 150 m/s
FRICTION = 0.1  # [-] between anvil and bar, somewhere between none and this: no source gives one
U_MEASURED = {"length": 0.01, "foot": 0.025, "belly": 0.025}  # [-] scatter of House's shots about a smooth curve: see above


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

    >>> [round(flow_stress(8920, 190, 0.638) / 1e6), round(flow_stress(8910, 180, 0.667) / 1e6)]   # Johnson & Cook, Gust
    [358, 356]
    >>> [round(flow_stress(8900, 183, 0.716) / 1e6), round(flow_stress(8960, 175, 23.6 / 30.38) / 1e6)]   # Wilkins & Guinan, House
    [446, 543]
    """
    return density * speed**2 / (2 * log(1 / ratio))
