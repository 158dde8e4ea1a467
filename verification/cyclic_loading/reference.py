"""Uniaxial stress of a bilinear metal that is pulled, pushed back and pulled again.

A share b of the plastic modulus H = E Et/(E - Et) makes the elastic range grow, the rest moves it: with the plastic strain p of a
segment, its half width grows by b H p and its centre moves by (1 - b) H p. From a turning point at stress s the metal is elastic until
the other end of the range; beyond it the slope is Et again, whatever b is. So after a pull to s_max reverse flow begins at

    -s_max  for isotropic hardening (b = 1),     s_max - 2 sy  for kinematic (b = 0),     s_max - 2 (sy + b H p)  between.

Strains are logarithmic, stresses Cauchy's, in kgf/mm2. Lead and steel of Table II of Kulak & Fiala, who do not say which.
"""
LEAD = {"young": 19.5, "yield": 3.02, "tangent": 1.85}
STEEL = {"young": 1.96e4, "yield": 31.6, "tangent": 195.0}
SHARES = {"isotropic": 1.0, "kinematic": 0.0, "mixed": 0.5}


def plastic_modulus(metal):
    return metal["young"] * metal["tangent"] / (metal["young"] - metal["tangent"])


class Segment:
    """From one turning point to the next."""

    def __init__(self, metal, share, start, end, stress, centre, half):
        self.metal, self.start, self.end, self.stress = metal, start, end, stress
        self.sign = 1.0 if end > start else -1.0
        self.yield_stress = centre + self.sign * half
        self.yield_strain = start + (self.yield_stress - stress) / metal["young"]
        flow = max(self.sign * (end - self.yield_strain), 0.0) * (1 - metal["tangent"] / metal["young"])
        hardening = plastic_modulus(metal) * flow
        self.centre, self.half = centre + self.sign * (1 - share) * hardening, half + share * hardening
        self.flow = flow

    def at(self, strain):
        if self.sign * (strain - self.yield_strain) <= 0:
            return self.stress + self.metal["young"] * (strain - self.start)
        return self.yield_stress + self.metal["tangent"] * (strain - self.yield_strain)


def segments(metal, share, turns):
    """The segments through the turning strains, from rest.

    >>> e = 3 * LEAD["yield"] / LEAD["young"]
    >>> for kind, share in SHARES.items():
    ...     pull, push, again = segments(LEAD, share, [e, -e, e])
    ...     top, p = pull.at(e), pull.flow
    ...     mixed = top - 2 * (LEAD["yield"] + 0.5 * plastic_modulus(LEAD) * p)
    ...     wanted = {"isotropic": -top, "kinematic": top - 2 * LEAD["yield"]}.get(kind, mixed)
    ...     print(kind, round(push.yield_stress, 6), abs(push.yield_stress - wanted) < 1e-12)
    isotropic -3.593026 True
    kinematic -2.446974 True
    mixed -3.02 True
    """
    found, start, stress, centre, half = [], 0.0, 0.0, 0.0, metal["yield"]
    for end in turns:
        one = Segment(metal, share, start, end, stress, centre, half)
        found.append(one)
        start, stress, centre, half = end, one.at(end), one.centre, one.half
    return found


def accumulated(metal, share, turns):
    """All plastic strain, counted forwards and backwards alike.

    >>> e = 3 * STEEL["yield"] / STEEL["young"]
    >>> accumulated(STEEL, 0.0, [e, -e, e]) > accumulated(STEEL, 1.0, [e, -e, e])
    True
    """
    return sum(one.flow for one in segments(metal, share, turns))


def dissipated(metal, share, turns):
    """Per volume: the stress less the centre times the flow; what moves the centre is stored.

    >>> e = 3 * LEAD["yield"] / LEAD["young"]
    >>> flow = segments(LEAD, 0.0, [e, -e])
    >>> abs(dissipated(LEAD, 0.0, [e, -e]) - LEAD["yield"] * (flow[0].flow + flow[1].flow)) < 1e-12
    True
    """
    work, half = 0.0, metal["yield"]
    for one in segments(metal, share, turns):
        work += 0.5 * (half + one.half) * one.flow
        half = one.half
    return work
