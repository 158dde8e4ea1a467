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
from math import log

# standard uncertainties of the inputs over their values: no source gives one. 5 % on the yield stress is the spread of one temper from
# batch to batch; the others are how far constants of one metal lie apart between authors
SPREAD = {"yield": 0.05, "hardening_coefficient": 0.05, "rate_coefficient": 0.2, "thermal_exponent": 0.1, "taylor_quinney": 0.05,
          "young": 0.03}

SPEED = 0.005   # [-] of the measured speed: no source gives one; printed to 1 m/s, which is 0.2 % at 150 m/s
FRICTION = 0.1  # [-] between anvil and bar, somewhere between none and this: no source gives one
U_MEASURED = {"length": 0.01, "foot": 0.026, "belly": 0.026}  # [-] scatter of House's shots about a smooth curve: see above


def flow(strain, rate):
    """Flow stress of the constants without heat [MPa] at a rate in 1/s.

    >>> round(flow(0.2, 1e4))   # measured, for an even field, batch `JC` at 208 m/s: 1386 MPa
    1273
    """
    return (792 + 510 * strain**0.26) * (1 + 0.014 * log(rate))
