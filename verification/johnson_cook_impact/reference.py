"""A plate of Johnson and Cook's metal strikes a rigid wall: one-dimensional waves, by finite differences on a grid of its own.

Density, momentum and heat are conserved along lines of matter, with velocities at the points of a grid and stresses between them
(von Neumann & Richtmyer, J. Appl. Phys. 21 (1950) 232). In uniaxial strain, with the logarithmic strain e and the plastic strain p,

    mean stress    K e                                         (Hooke's law in rates)
    deviator       s = 2 G (2/3 e - flow along x)
    flow           3/2 |s| = (A + B p^n) (1 + C ln(rate / rate_0)) (1 - T*^m)      (Johnson & Cook 1983)
    heat           density heat dT = share 3/2 |s| dp per reference volume

The flow of a step is found by regula falsi. Positive stress is tension; the wall stands at x = 0.
"""
from math import log, sqrt

STEEL = dict(density=7830, young=200e9, poisson=0.29, A=792e6, B=510e6, n=0.26, C=0.014, rate_0=1.0, m=1.03, cold=293.0, melt=1793.0,
             heat=477.0, share=0.9)


def moduli(metal):
    """Bulk and shear modulus [Pa].

    >>> [round(m / 1e9, 3) for m in moduli(STEEL)]
    [158.73, 77.519]
    """
    return metal["young"] / (3 * (1 - 2 * metal["poisson"])), metal["young"] / (2 * (1 + metal["poisson"]))


def flow_stress(metal, p, rate, T):
    """Johnson & Cook's flow stress [Pa]; below rate_0 the rate does nothing.

    >>> round(flow_stress(STEEL, 0, 0, 293) / 1e6, 9), round(flow_stress(STEEL, 1, 1, 293) / 1e6, 9)
    (792.0, 1302.0)
    """
    hot = min(max((T - metal["cold"]) / (metal["melt"] - metal["cold"]), 0.0), 1.0)
    quick = 1 + metal["C"] * log(rate / metal["rate_0"]) if rate > metal["rate_0"] else 1.0
    return (metal["A"] + metal["B"] * p ** metal["n"]) * quick * (1 - hot ** metal["m"])


def elastic_limit(metal):
    """Stress of uniaxial strain at which flow begins, without any effect of the rate [Pa].

    >>> round(elastic_limit(STEEL) / 1e9, 4)
    1.3389
    """
    K, G = moduli(metal)
    return (K + 4 / 3 * G) / (2 * G) * metal["A"]


def root(miss, high, low=0.0):
    """Where a falling function is zero, by regula falsi (Illinois), to a part of 1e-9 of the interval.

    >>> round(root(lambda x: 2 - x * x, 2.0), 8)
    1.41421356
    """
    at_low, at_high, enough = miss(low), miss(high), 1e-9 * high
    for _ in range(60):
        x = (low * at_high - high * at_low) / (at_high - at_low)
        here = miss(x)
        if here > 0:
            moved, low, at_low, at_high = x - low, x, here, at_high / 2
        else:
            moved, high, at_high, at_low = high - x, x, here, at_low / 2
        if moved < enough or high - low < enough:
            break
    return x


def impact(metal, thickness, speed, until, cells=200, rows=260):
    """Rows of time [s], velocity of the back [m/s], means of plastic strain and temperature [K] over the mass.

    >>> light = dict(STEEL, A=1e15)                        # elastic: the back turns round after thickness / c
    >>> K, G = moduli(light)
    >>> times = [row[0] for row in impact(light, 0.01, 1.0, 3e-6, cells=60, rows=100) if row[1] > 0]
    >>> abs(times[0] / (0.01 / sqrt((K + 4 / 3 * G) / 7830)) - 1) < 0.03
    True
    """
    K, G = moduli(metal)
    c, h, rho = sqrt((K + 4 / 3 * G) / metal["density"]), thickness / cells, metal["density"]
    dt = 0.4 * h / c
    steps = int(until / dt) + 1
    dt = until / steps
    x = [h * i for i in range(cells + 1)]
    v = [0.0] + [-speed] * cells
    length, mean, s, p, T, q = [h] * cells, [0.0] * cells, [0.0] * cells, [0.0] * cells, [metal["cold"]] * cells, [0.0] * cells
    table = [(0.0, -speed, 0.0, metal["cold"])]
    every = max(steps // rows, 1)
    for step in range(1, steps + 1):
        stress = [mean[i] + s[i] - q[i] for i in range(cells)]
        for i in range(1, cells):
            v[i] += dt / (rho * h) * (stress[i] - stress[i - 1])
        v[cells] -= 2 * dt / (rho * h) * stress[-1]
        for i in range(1, cells + 1):
            x[i] += dt * v[i]
        for i in range(cells):
            new = x[i + 1] - x[i]
            e = log(new / length[i])
            length[i] = new
            closing = v[i] - v[i + 1]
            q[i] = rho * h / new * (1.0 * closing * closing + 0.1 * c * closing) if closing > 0 else 0.0
            if e == 0.0:
                continue
            mean[i] += K * e
            trial = s[i] + 4 / 3 * G * e
            size = 1.5 * abs(trial)
            if size <= flow_stress(metal, p[i], 0.0, T[i]):
                s[i] = trial
                continue
            heat = metal["share"] * new / (h * rho * metal["heat"])

            def miss(flow):
                now = size - 3 * G * flow
                return now - flow_stress(metal, p[i] + flow, flow / dt, T[i] + heat * now * flow)

            flow = root(miss, size / (3 * G))
            now = size - 3 * G * flow
            p[i] += flow
            T[i] += heat * now * flow
            s[i] = 2 / 3 * now if trial > 0 else -2 / 3 * now
        if step % every == 0 or step == steps:
            table.append((step * dt, v[cells], sum(p) / cells, sum(T) / cells))
    return table
