"""Adiabatic shear of Johnson and Cook's metal as a differential equation, integrated by Runge and Kutta.

Turned round, the flow stress of Johnson & Cook (Proc. 7th Int. Symp. Ballistics, 1983, 541) says how fast a metal flows under a
stress q that is above the static flow stress S(p, T) = (A + B p^n) (1 - T*^m):

    dp/dt = rate_0 exp((q / S - 1) / C)

Below S nothing flows. In simple shear q = sqrt(3) tau, and of the rate of the angle, g, the shear modulus G gets what the flow leaves:

    dtau/dt = G (g - sqrt(3) dp/dt),     dT/dt = share q dp/dt / (density heat)

There is no return to a surface and no increment of a law in it.
"""
from math import exp, sqrt

STEEL = dict(density=7830, young=200e9, poisson=0.29, A=792e6, B=510e6, n=0.26, C=0.014, rate_0=1.0, m=1.03, cold=293.0, melt=1793.0,
             heat=477.0, share=0.9)


def static(metal, p, T):
    """Flow stress without rate [Pa].

    >>> round(static(STEEL, 0, 293) / 1e6, 9)
    792.0
    >>> static(STEEL, 1, 1793)
    0.0
    """
    hot = min(max((T - metal["cold"]) / (metal["melt"] - metal["cold"]), 0.0), 1.0)
    return (metal["A"] + metal["B"] * p ** metal["n"]) * (1 - hot ** metal["m"])


def sheared(metal, angle, time, steps=40000, rows=200):
    """Simple shear at a constant rate: rows of angle, shear stress [Pa], plastic strain, temperature [K].

    >>> slow = dict(STEEL, C=1e-3, share=0.0)          # hardly any effect of the rate, no heat: the static curve
    >>> g, tau, p, T = sheared(slow, 0.1, 1e-2)[-1]
    >>> abs(sqrt(3) * tau / static(slow, p, T) - 1) < 0.003
    True
    """
    G, rate = metal["young"] / (2 * (1 + metal["poisson"])), angle / time

    def slope(tau, p, T):
        q, S = sqrt(3) * tau, static(metal, p, T)
        flow = metal["rate_0"] * exp(min((q / S - 1) / metal["C"], 60.0)) if q > S else 0.0
        return G * (rate - sqrt(3) * flow), flow, metal["share"] * q * flow / (metal["density"] * metal["heat"])

    tau, p, T, dt = 0.0, 0.0, metal["cold"], time / steps
    table = [(0.0, tau, p, T)]
    for step in range(1, steps + 1):
        a = slope(tau, p, T)
        b = slope(*(v + dt / 2 * d for v, d in zip((tau, p, T), a)))
        c = slope(*(v + dt / 2 * d for v, d in zip((tau, p, T), b)))
        d = slope(*(v + dt * e for v, e in zip((tau, p, T), c)))
        tau, p, T = (v + dt / 6 * (i + 2 * j + 2 * k + l) for v, i, j, k, l in zip((tau, p, T), a, b, c, d))
        if step % (steps // rows) == 0:
            table.append((rate * dt * step, tau, p, T))
    return table
