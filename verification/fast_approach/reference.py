"""What a fast approach, an overlap and coincident nodes must not do: go wrong in silence.

A wave crosses an element of depth h in h/c, and the stable step of the elements is about that. A node that comes with half of c or more can
cross half an element in a step, and then strains beyond 1/2 make every small-strain law meaningless. Such a run must stop, or be refused,
or be warned of.
"""
from math import sqrt


def sound(young, density):
    """Speed of waves in a body without lateral strain [m/s].

    >>> round(sound(1e6, 1000), 4)
    31.6228
    """
    return sqrt(young / density)


def crossed(speed, step, depth):
    """Part of an element that a node crosses in a step. [-]

    >>> crossed(100.0, 1e-3, 0.2)
    0.5
    """
    return speed * step / depth


def silent(ended_well, warned, created, deepest, depth, allowed=0.05):
    """Whether a run ended as if all were well and was not: energy from nowhere, or an apex deeper than half an element.

    >>> silent(True, False, 1e-4, 0.01, 0.25), silent(True, False, 0.5, 0.01, 0.25), silent(True, False, 1e-4, 0.2, 0.25)
    (False, True, True)
    >>> silent(True, True, 1e-4, 0.2, 0.25), silent(False, False, 0.5, 0.2, 0.25)
    (False, False)
    """
    wrong = not created <= allowed or not deepest <= 0.5 * depth
    return wrong and ended_well and not warned
