"""Taylor bars of 4340 steel: constants of the metal, and what is known of the measurements.

*Constants.* Johnson & Cook, Proc. 7th Int. Symp. on Ballistics, The Hague 1983, 541-547, 4340 of Rockwell C 30: A 792 MPa, B 510 MPa, n
0.26, C 0.014, m 1.03, melting at 1793 K, specific heat 477 J/(kg K). The paper was not read; programs that quote it print the same (in
shear, 457.3 and 294.4 MPa). From torsion, tension and Hopkinson bars; the cylinders of the same paper (JC below) were a check and no part
of the fit, as far as secondary sources say. Young's modulus and Poisson's ratio are handbook values.

*Temper.* The constants are of the batch `JC`. The table calls House's bars "Rc = 58" and Gust's "Rc = 40". Steel of Rockwell C 58 has a
static strength of some 2 GPa, and House's bars shortened as those of Johnson & Cook did: the flow stresses at 208 to 215 m/s are 1386 and
1491 MPa. So "Rc = 58" cannot be what it looks like, and House's temper is not known. `House`, `Gust` and `Jones` are run and printed with
the same constants, as batches of another temper.

*Measurements.* No source gives an uncertainty. House's 14 shots scatter about ln(L/L0) = a V^2 + b, fitted for each length, by 0.6 % in
length and 1.6 % at the foot (4 degrees of freedom, so little is known); those of copper and 6061-T6 do by 1.0 and 2.6 %, which is taken.
"""
from math import log, pi

# standard uncertainties of the inputs over their values: no source gives one. 5 % on the yield stress is the spread of one temper from
# batch to batch; the others are how far constants of one metal lie apart between authors
SPREAD = {"yield": 0.05, "hardening_coefficient": 0.05, "rate_coefficient": 0.2, "thermal_exponent": 0.1, "taylor_quinney": 0.05,
          "young": 0.03}

SPEED = 0.005   # [-] of the measured speed: no source gives one; printed to 1 m/s, which is 0.2 % at 150 m/s
FRICTION = 0.1  # [-] between anvil and bar, somewhere between none and this: no source gives one
U_MEASURED = {"length": 0.01, "foot": 0.026, "belly": 0.026}  # [-] scatter of House's shots about a smooth curve: see above


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

    >>> [round(flow_stress(7830, 208, 0.885) / 1e6), round(flow_stress(7830, 215, 22.4 / 25.29135) / 1e6)]   # Johnson & Cook, House
    [1386, 1491]
    """
    return density * speed**2 / (2 * log(1 / ratio))
