"""Balls in a row that meet pole on pole: blows of two masses, one after the other.

Where masses m and M meet with the speed of approach w, the impulse is (1 + e) w m M/(m + M).
Source: W. Goldsmith, Impact (1960), chapter 1.
"""
GAP = 1e-4                               # [m] between two balls
PAIR = {"masses": [1, 1], "speeds": [1.0, 0.5], "end": 0.5e-3}
ROW = {"masses": [4, 8, 2, 10], "speeds": [1.0, 0.0, 0.0, 0.0], "end": 2e-3}


def speeds_after(masses, speeds, end, restitution=1.0):
    """Velocities at the end.

    Equal masses exchange their velocities; a larger one strikes a smaller one.

    >>> speeds_after([1, 1], [1.0, 0.5], 1)
    [0.5, 1.0]
    >>> [round(v, 12) for v in speeds_after([2, 1], [3.0, 0.0], 1)]
    [1.0, 4.0]
    >>> speeds_after([1, 1], [1.0, 0.0], 1, restitution=0.5)
    [0.25, 0.75]
    """
    speeds, gaps, t = list(speeds), [GAP] * (len(masses) - 1), 0.0
    while True:
        rates = [b - a for a, b in zip(speeds, speeds[1:])]
        closures = [(gap / -rate, i) for i, (gap, rate) in enumerate(zip(gaps, rates)) if rate < 0]
        step, i = min(closures, default=(end, 0))
        if t + step >= end:
            return speeds
        gaps = [gap + rate * step for gap, rate in zip(gaps, rates)]
        t, gaps[i], m, M = t + step, 0.0, masses[i], masses[i + 1]
        impulse = (1 + restitution) * -rates[i] * m * M / (m + M)
        speeds[i], speeds[i + 1] = speeds[i] - impulse / m, speeds[i + 1] + impulse / M
