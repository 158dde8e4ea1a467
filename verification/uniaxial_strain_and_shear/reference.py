"""Uniaxial strain and pure shear of a metal with a bilinear curve, H = E Et/(E - Et), K bulk and G shear modulus.

Uniaxial strain e: the deviator is (2/3, -1/3, -1/3) 2 G e, so the von Mises stress is 2 G e and flow begins at e = sy/(2 G). Beyond
it the plastic strain p along the axis obeys  sy + H p = 2 G (e - 3/2 p):  p = (2 G e - sy)/(3 G + H). The stress along the axis is
K e + 2/3 q with q = sy + H p, of slope K + (4 G/3) H/(H + 3 G); that across is K e - 1/3 q.

Pure shear by g (engineering strain): stress G g up to ty = sy/sqrt(3); then of slope 1/(1/G + 3/H).

Both directions of the stress deviator are constant, so no law of this kind has an error of its increments here. Strains are
logarithmic where they are finite and the axes do not turn.
"""
from math import sqrt

LEAD = {"young": 19.5, "poisson": 0.42, "yield": 3.02, "tangent": 1.85}     # [kgf/mm2]
STEEL = {"young": 1.96e4, "poisson": 0.33, "yield": 31.6, "tangent": 195.0}


def moduli(metal):
    """(K, G, H).

    >>> [f"{x:.5f}" for x in moduli(LEAD)]
    ['40.62500', '6.86620', '2.04391']
    """
    E, nu = metal["young"], metal["poisson"]
    return E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu)), E * metal["tangent"] / (E - metal["tangent"])


def uniaxial_strain(metal, e):
    """(stress along, stress across, plastic strain) at a strain that has only grown.

    >>> K, G, H = moduli(LEAD)
    >>> a, b = uniaxial_strain(LEAD, 0.4), uniaxial_strain(LEAD, 0.5)
    >>> abs((b[0] - a[0]) / 0.1 - plastic_modulus_in_uniaxial_strain(LEAD)) < 1e-12
    True
    >>> abs(a[0] - a[1] - LEAD["yield"] - H * a[2]) < 1e-12, abs(a[0] + 2 * a[1] - 3 * K * 0.4) < 1e-12
    (True, True)
    """
    K, G, H = moduli(metal)
    p = max((2 * G * e - metal["yield"]) / (3 * G + H), 0.0)
    q = 2 * G * e - 3 * G * p
    return K * e + 2 * q / 3, K * e - q / 3, p


def plastic_modulus_in_uniaxial_strain(metal):
    """
    >>> f"{plastic_modulus_in_uniaxial_strain(LEAD):.5f}"
    '41.45140'
    """
    K, G, H = moduli(metal)
    return K + 4 * G / 3 * H / (H + 3 * G)


def yield_stress_in_shear(metal):
    """
    >>> f"{yield_stress_in_shear(LEAD):.5f} {yield_stress_in_shear(STEEL):.5f}"
    '1.74360 18.24427'
    """
    return metal["yield"] / sqrt(3)


def tangent_in_shear(metal):
    """
    >>> f"{tangent_in_shear(LEAD):.5f} {tangent_in_shear(STEEL):.5f}"
    '0.61980 65.07337'
    """
    _, G, H = moduli(metal)
    return 1 / (1 / G + 3 / H)


def pure_shear(metal, g):
    """Shear stress at an engineering shear that has only grown.

    >>> abs(pure_shear(LEAD, 0.5) - yield_stress_in_shear(LEAD) - tangent_in_shear(LEAD) * (0.5 - 1.74360 / 6.86620)) < 1e-5
    True
    """
    _, G, _ = moduli(metal)
    first = yield_stress_in_shear(metal) / G
    return G * g if g < first else yield_stress_in_shear(metal) + tangent_in_shear(metal) * (g - first)
