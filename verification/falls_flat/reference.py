"""Bars and cubes that fall flat."""
SPEED, SIDE, GAP, WAVE = 0.7, 0.01, 1e-3, (1e6 / 1e3) ** 0.5  # [m/s] [m] [m] [m/s] along a thin bar


def end(layers, periods=12):
    """Until waves have gone along the bar so often after it has touched. [s]

    >>> round(1e3 * end(1), 4), round(1e3 * end(8), 4)
    (5.2233, 31.7864)
    """
    return GAP / SPEED + periods * layers * SIDE / WAVE
