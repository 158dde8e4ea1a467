"""A rigid bar that falls on another one, ridge on ridge: one impulse along the normal of both, and all energy is kept.

With r the distance of the point of contact from the centre of each bar, along it, and I its moment of inertia about the axis across it
and the normal, the impulse that turns the relative speed V round is

    J = 2 V / (1/m_1 + 1/m_2 + r_1^2/I_1 + r_2^2/I_2)
"""

BAR = {"length": 0.1, "width": 0.01, "density": 7850.0}  # SI


def inertia(length, width, density):
    """Mass and moment of inertia of a square bar about an axis across it through its centre.

    >>> inertia(**BAR)
    (0.0785, 6.607083333333334e-05)
    """
    mass = round(density * length * width**2, 12)
    return mass, mass * (length**2 + width**2) / 12


def speeds_after(speed, first, second):
    """Speeds of two bars along the normal after the first has struck the second with `speed`, struck at r from their centres.

    >>> speeds_after(1.0, 0.0, 0.0)
    (0.0, 1.0)
    >>> a, b = speeds_after(1.0, 0.02, 0.0); round(a, 12), round(b, 12)
    (0.192, 0.808)
    """
    mass, turn = inertia(**BAR)
    impulse = 2 * speed / (2 / mass + (first**2 + second**2) / turn)
    return speed - impulse / mass, impulse / mass
