"""A bilinear elastic-plastic bar strikes a rigid wall: von Karman's and Taylor's two fronts.

The wall stops the struck end. An elastic front takes the bar to the yield stress at c = sqrt(E/rho); it slows the material by
V_y = sigma_y/(rho c). The rest of the speed is taken by a plastic front at c_p = sqrt(E_t/rho). Momentum across each front gives
sigma = sigma_y + rho c_p (V - V_y), and the strain behind the plastic front is sigma_y/E + (V - V_y)/c_p.
Source: von Karman & Duwez, J. Appl. Phys. 21 (1950) 987; G. I. Taylor (1942). The limit of small strains: all stresses and
velocities are in proportion, so a hundredth of yield and speed gives a hundredth of the stress.

`large_strains`: what a bar that is free at its sides does when 4 % of strain count. The law speaks of Cauchy stress over
logarithmic strain, s = sigma_y + E_t (l - sigma_y/E), and flow keeps the volume, so the section grows by exp(l - s/E) (Poisson's
ratio zero). The force per initial area P = s exp(l - s/E) over e = 1 - exp(-l) is what carries waves. It stiffens with e, because the
section grows, so the front is a jump: rho (V - V_y)^2 = (P - P_y)(e - e_y) (momentum and continuity across it).
"""
from math import exp, log, sqrt

STEEL = {"density": 7850, "young": 200e9, "tangent": 2e9, "yield_stress": 400e6}  # SI
SPEED = 30.0  # [m/s]


def small_strains(density, young, tangent, yield_stress, speed):
    """Exact values in SI units.

    >>> bar = small_strains(**STEEL, speed=SPEED)
    >>> round(bar["yield_speed"], 4), round(bar["stress"] / 1e6, 3), round(bar["strain"], 5)
    (10.0951, 478.87, 0.04143)
    >>> small = small_strains(**{**STEEL, "yield_stress": 4e6}, speed=0.3)
    >>> round(100 * small["stress"] / bar["stress"], 12), round(100 * small["strain"] / bar["strain"], 12)
    (1.0, 1.0)
    """
    c, slow = sqrt(young / density), sqrt(tangent / density)
    yield_speed = yield_stress / (density * c)
    return {"wave_speed": c, "plastic_speed": slow, "yield_speed": yield_speed,
            "stress": yield_stress + density * slow * (speed - yield_speed),
            "strain": yield_stress / young + (speed - yield_speed) / slow}


def large_strains(density, young, tangent, yield_stress, speed):
    """Force per initial area `stress` [Pa] and shortening per length `strain` [-] behind the plastic front.

    In the limit of small strains it is the bar above, at full speed 2 % more force.

    >>> tiny = {**STEEL, "yield_stress": 400.0}
    >>> abs(large_strains(**tiny, speed=SPEED * 1e-6)["stress"] / small_strains(**tiny, speed=SPEED * 1e-6)["stress"] - 1) < 1e-6
    True
    >>> bar = large_strains(**STEEL, speed=SPEED)
    >>> round(bar["stress"] / small_strains(**STEEL, speed=SPEED)["stress"] - 1, 4), round(bar["strain"], 5)
    (0.0204, 0.0371)
    """
    def force(e):
        strain = -log(1 - e)
        stress = yield_stress + tangent * (strain - yield_stress / young)
        return stress * exp(strain - stress / young)

    e_y = 1 - exp(-yield_stress / young)
    yield_speed = sqrt(yield_stress * e_y / density)
    low, high = e_y, 0.5
    for _ in range(200):
        e = (low + high) / 2
        low, high = (e, high) if (force(e) - yield_stress) * (e - e_y) < density * (speed - yield_speed)**2 else (low, e)
    return {"stress": force(e), "strain": e, "plastic_speed": (speed - yield_speed) / (e - e_y)}


def profile(density, young, tangent, yield_stress, speed, length, t):
    """Corners of the strain over the reference position at the time t [(m, -)]; before the elastic front has reached the free end.

    >>> [(round(x, 4), round(100 * e, 3)) for x, e in profile(**STEEL, speed=SPEED, length=1.0, t=0.1e-3)]
    [(0.0, 4.143), (0.0505, 4.143), (0.0505, 0.2), (0.5048, 0.2), (0.5048, 0.0), (1.0, 0.0)]
    """
    bar = small_strains(density, young, tangent, yield_stress, speed)
    slow, fast, first = bar["plastic_speed"] * t, bar["wave_speed"] * t, yield_stress / young
    return [(0.0, bar["strain"]), (slow, bar["strain"]), (slow, first), (fast, first), (fast, 0.0), (length, 0.0)]
