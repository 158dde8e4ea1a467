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

# standard uncertainties of the inputs over their values: no source gives one. 10 % on the yield stress and 5 % on the hardening are the
# spread of one temper from batch to batch; the others are how far constants of one metal lie apart between authors
SPREAD = {"yield": 0.1, "hardening_coefficient": 0.05, "rate_coefficient": 0.2, "thermal_exponent": 0.1, "taylor_quinney": 0.05,
          "young": 0.03}

SPEED = 0.005   # [-] of the measured speed: no source gives one; printed to 1 m/s, which is 0.2 % at 150 m/s
FRICTION = 0.1  # [-] between anvil and bar, somewhere between none and this: no source gives one
U_MEASURED = {"length": 0.01, "foot": 0.025, "belly": 0.025}  # [-] scatter of House's shots about a smooth curve: see above


def left(temperature):
    """What is left of the flow stress at a temperature [K], over that at room temperature, by the law.

    >>> round(left(294), 2), round(left(720), 2), round(left(1235), 2)
    (1.0, 0.63, 0.12)
    """
    return 1 - ((temperature - 294) / (1356 - 294))**1.09
