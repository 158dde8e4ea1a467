"""Uniaxial stress of a metal with a bilinear curve.

Up to the yield strain sy/E the stress is E e, beyond it sy + Et (e - sy/E). The strain is the sum of an elastic part s/E and a
plastic part p, and s = sy + H p, so 1/Et = 1/E + 1/H: H = E Et / (E - Et). As hardening is not given back, the work of the
plastic strain, sy p + H p^2/2, is dissipated and s^2/(2 E) is stored.

Strain and stress: the law adds increments of strain over increments of the *present* length, so its strain is the logarithm of
the stretch; its stress is Cauchy's, force over present area. For small strains all strains agree.

Numbers of Table II of Kulak & Fiala, in kgf/mm^2.
"""
LEAD = {"young": 19.5, "yield": 3.02, "tangent": 1.85}
STEEL = {"young": 1.96e4, "yield": 31.6, "tangent": 195.0}


def plastic_modulus(metal):
    """H, the slope of stress over plastic strain.

    >>> f"{plastic_modulus(LEAD):.5f} {plastic_modulus(STEEL):.3f}"
    '2.04391 196.960'
    """
    return metal["young"] * metal["tangent"] / (metal["young"] - metal["tangent"])


def yield_strain(metal):
    """
    >>> f"{yield_strain(LEAD):.4f} {yield_strain(STEEL):.6f}"
    '0.1549 0.001612'
    """
    return metal["yield"] / metal["young"]


def stress(metal, strain):
    """At a strain that has only grown.

    >>> round(stress(LEAD, 0.1), 12)
    1.95
    >>> round(stress(LEAD, 3 * yield_strain(LEAD)), 6), round(stress(STEEL, 3 * yield_strain(STEEL)), 6)
    (3.593026, 32.228776)
    """
    first = yield_strain(metal)
    return metal["young"] * strain if strain < first else metal["yield"] + metal["tangent"] * (strain - first)


def plastic_strain(metal, strain):
    """Total less elastic strain.

    >>> abs(plastic_modulus(LEAD) * plastic_strain(LEAD, 0.4) - (stress(LEAD, 0.4) - LEAD["yield"])) < 1e-15
    True
    """
    return strain - stress(metal, strain) / metal["young"]


def dissipated(metal, strain):
    """Per volume; with what is stored it is the area below the curve.

    >>> e = 0.4
    >>> area = 0.5 * LEAD["yield"] * yield_strain(LEAD) + 0.5 * (LEAD["yield"] + stress(LEAD, e)) * (e - yield_strain(LEAD))
    >>> abs(dissipated(LEAD, e) + stored(LEAD, e) - area) < 1e-15
    True
    """
    p = plastic_strain(metal, strain)
    return metal["yield"] * p + plastic_modulus(metal) * p * p / 2


def stored(metal, strain):
    return stress(metal, strain)**2 / (2 * metal["young"])
