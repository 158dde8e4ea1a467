"""What must stay when apexes and bases change places, and what need not.

One pass asks the nodes of one surface to stay above the facets of the other. The other way round other points are asked, so
that pressures differ from element to element; what both bodies exchange in all follows from waves in the bodies, and from
how stiff contact is altogether, and is nearly the same. Two passes ask both, with half the penalty each: they are the
same two passes whichever comes first. Either way force and counterforce have one line of action.
"""


def exchanged(of_two):
    """The two accounts of a contact in two passes, for the sides changed.

    >>> exchanged({"energy_touch_penalty": 1.0, "energy_touch_back_penalty": 2.0, "speed": 3.0})
    {'energy_touch_back_penalty': 1.0, 'energy_touch_penalty': 2.0, 'speed': 3.0}
    """
    def other(name):
        if "touch_back" in name:
            return name.replace("touch_back", "touch")
        return name.replace("touch", "touch_back")
    return {other(name): value for name, value in of_two.items()}
