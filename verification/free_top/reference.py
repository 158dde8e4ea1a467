"""A free asymmetric top: Euler's equations J w' = (J w) x w, by the classical method of Runge and Kutta with small steps.

Energy and the size of the angular momentum are its two integrals (Landau & Lifshitz, Mechanics, par. 37); a spin about the middle axis is
not stable and turns over again and again. The orientation is not needed: the spin in the axes of the body tells when.
"""


def brick(mass, a, b, c):
    """Moments of inertia of a brick with the edges a, b, c about its centre.

    >>> [round(J, 6) for J in brick(12, 1, 2, 3)]
    [13.0, 10.0, 5.0]
    """
    return [mass / 12 * (b * b + c * c), mass / 12 * (c * c + a * a), mass / 12 * (a * a + b * b)]


def turnings(J, spin, end, step=1e-4):
    """Times at which the spin about the first axis of the body changes its sign up to `end` [s].

    The top below turns over; one about its axis of least inertia does not.

    >>> times = turnings([2, 1, 3], [1, 0.01, 0.01], 60, 1e-2)
    >>> len(times) > 2
    True
    >>> turnings([1, 2, 3], [1, 0.01, 0.01], 60, 1e-2)
    []
    """
    def rate(w):
        return [(J[1] - J[2]) / J[0] * w[1] * w[2], (J[2] - J[0]) / J[1] * w[2] * w[0], (J[0] - J[1]) / J[2] * w[0] * w[1]]

    def ahead(w, k, h):
        return [x + h * y for x, y in zip(w, k)]

    times, w, t = [], list(spin), 0.0
    for _ in range(round(end / step)):
        k1 = rate(w)
        k2 = rate(ahead(w, k1, step / 2))
        k3 = rate(ahead(w, k2, step / 2))
        k4 = rate(ahead(w, k3, step))
        after = [x + step / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(w, k1, k2, k3, k4)]
        if w[0] * after[0] < 0:
            times.append(t + step * w[0] / (w[0] - after[0]))
        w, t = after, t + step
    return times
