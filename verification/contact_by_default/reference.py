"""What contact must not cost: steps beyond those of the elements. Elements alone take the time over their longest step.

A rigid or unilateral contact does no work, so what it creates and loses is held against zero. The settlement of the cask under a
penalty of 2000 times the stiffness of the softer side was taken on the mesh of level 2, a quarter.
"""
HARD_PENALTY = 0.05813  # [m]


def steps_of_elements(end, longest):
    """Steps of a run that elements alone limit, all as long as the longest [s].

    >>> steps_of_elements(50e-6, 0.2e-6)
    250.0
    """
    return round(end / longest, 9)
