"""A wave that stands in a tank: linear theory, of water that keeps its volume and of water that does not.

In a tank of the depth H the wave number k is a whole multiple of pi over the length. Water that keeps its volume has

    omega^2 = g k tanh(k H).

Water with the speed of sound c and one density at all depths moves by  u = X(z) sin kx,  w = Z(z) cos kx  with the growth of volume
D = k X + Z'. Momentum and the weight of the water that moves give

    omega^2 X = c^2 k D - g k Z,     omega^2 Z = g Z' - c^2 D' - g D.

Both Z and D then are sums of exp(+-q z), and with Z = 0 at the floor and D = 0 at the surface, where the pressure is that of the air,

    omega^2 = g k^2 tanh(q H)/q,     q^2 = k^2 - omega^2/c^2 + (g k/(omega c))^2.
"""
from math import pi, sqrt, tanh

GRAVITY, LENGTH = 9.81, 1.0  # [m/s2] [m]
NUMBER = pi / LENGTH         # [1/m] of the longest wave


def frequency(depth, k=NUMBER):
    """Of water that keeps its volume. [rad/s]

    In deep water it does not depend on the depth, in shallow water the wave goes with sqrt(g H):

    >>> round(frequency(100) / sqrt(9.81 * pi), 9)
    1.0
    >>> round(frequency(1e-3) / (pi * sqrt(9.81 * 1e-3)), 5)
    1.0
    """
    return sqrt(GRAVITY * k * tanh(k * depth))


def period(depth):
    """[s]

    >>> round(period(0.5), 4), round(period(0.2), 4)
    (1.1818, 1.5166)
    """
    return 2 * pi / frequency(depth)


def compressible_frequency(depth, sound, k=NUMBER):
    """Of water with a speed of sound [m/s]. [rad/s]

    >>> f"{compressible_frequency(0.5, 60) / frequency(0.5) - 1:.1e}", f"{compressible_frequency(0.2, 60) / frequency(0.2) - 1:.1e}"
    ('-2.7e-05', '-6.0e-05')
    >>> f"{compressible_frequency(0.2, 1482) / frequency(0.2) - 1:.1e}"
    '-9.8e-08'

    What it returns solves both equations: by small steps from the floor, where Z = 0 and D = 1, D is zero at the surface.

    >>> w, c, n = compressible_frequency(0.2, 20), 20, 2000
    >>> def slopes(Z, D):
    ...     X = (c * c * NUMBER * D - GRAVITY * NUMBER * Z) / w**2
    ...     by_z = D - NUMBER * X
    ...     return by_z, (GRAVITY * by_z - GRAVITY * D - w**2 * Z) / c**2
    >>> Z, D, step = 0.0, 1.0, 0.2 / n
    >>> for _ in range(n):
    ...     half = [a + step / 2 * b for a, b in zip((Z, D), slopes(Z, D))]
    ...     Z, D = [a + step * b for a, b in zip((Z, D), slopes(*half))]
    >>> abs(D) < 1e-6
    True
    """
    omega = frequency(depth, k)
    for _ in range(100):
        q = sqrt(k * k - (omega / sound)**2 + (GRAVITY * k / (omega * sound))**2)
        omega = sqrt(GRAVITY * k * k * tanh(q * depth) / q)
    return omega
