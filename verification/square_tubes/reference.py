"""Mean force of a square tube that is crushed along its axis: theory, and theory with the effective crush length, near which tests lie.

Abramowicz & Jones, Dynamic axial crushing of square tubes, Int. J. Impact Engng 2 (1984) 179-208; side c, wall h, flow stress s, M0 = s
h^2/4:

    Pm/M0 = 38.27 (c/h)^(1/3)                   one fold pressed flat, rigid and perfectly plastic
    Pm/M0 = 52.22 (c/h)^(1/3)                   with the effective crush length, 0.73 of that
    H/h   = 0.983 (c/h)^(2/3)                   half of the length of a fold

The paper was not read. 38.27 and H = 0.99 c^(2/3) h^(1/3) stand in a second text that quotes it; 52.22 stands in none that could be read,
but in notes of this project, and 38.27/52.22 = 0.733 is the effective crush length that the summary speaks of. The summary, which was
read: 84 dynamic tests of steel tubes with c/h = 30.25 and 32.18. Forces of single tests could not be had, so these are relations and no
measurements.
"""
TUBES = {"c/h = 32.18": (37.07e-3, 1.152e-3), "c/h = 30.25": (49.31e-3, 1.63e-3)}  # [m] side, wall: remembered, but for their ratios
THEORY, EFFECTIVE = 38.27, 52.22
U_TESTS = 0.1  # [-] of tests about the relation: remembered, not read


def moment(flow, wall):
    """M0 [N]: per length of a hinge."""
    return flow * wall**2 / 4


def mean_force(coefficient, side, wall, flow):
    """[N]

    >>> round(mean_force(38.27, 37.07e-3, 1.152e-3, 300e6) / moment(300e6, 1.152e-3), 2)
    121.73
    >>> round(THEORY / EFFECTIVE, 3)
    0.733
    """
    return coefficient * (side / wall)**(1 / 3) * moment(flow, wall)


def fold(side, wall):
    """2H: length of the wall of one fold [m].

    >>> round(1e3 * fold(37.07e-3, 1.152e-3), 1)
    22.9
    """
    return 2 * 0.983 * wall * (side / wall)**(2 / 3)


def ratios():
    """c/h of the tubes, as the summary has them.

    >>> ratios()
    [32.18, 30.25]
    """
    return [round(side / wall, 2) for side, wall in TUBES.values()]
