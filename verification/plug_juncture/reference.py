"""What is known of the head before any program runs: a plug that moves as one, masses of turned polygons, and impulses."""
import math

DENSITY, HEIGHT, HOLE, SHOULDER, SIDE = 7850.0, 0.56, 0.2, 0.95, 0.85   # [kg/m3] [m], of the small plug
HALF = HEIGHT / 2                                                       # [m] of what is below and above the shoulder
RADII, WIDTH, PLAY = (0.9, 1.9, 2.9), 0.1, 0.01                         # [m] of the ledges
HELD = 1e15                                                             # [kg] of what does not move
GAP, PEAK, PULSE = 5e-3, 10e6, 4e-3                                     # [m] [Pa] [s]


def part_of_circle(cells):
    """Of the area of a circle, what a polygon of so many corners has."""
    angle = 2 * math.pi / cells
    return math.sin(angle) / angle


def mass(cells):
    """Of the small plug. [kg]

    >>> round(mass(10**6) / 1e3, 1)
    10.7
    """
    lower, upper = SHOULDER**2 - HOLE**2, SIDE**2 - HOLE**2
    return DENSITY * math.pi * (lower + upper) * HALF * part_of_circle(cells)


def masses(cells):
    """Of the three plugs: below half the height without a ledge in the bore, above it without a shoulder outside. [kg]

    >>> abs(masses(48)[0] / mass(48) - 1) < 1e-12
    True
    """
    found, bore = [], HOLE
    for plug, radius in enumerate(RADII):
        above = bore - WIDTH if plug > 0 else bore
        areas = (radius + WIDTH / 2)**2 - bore**2, (radius - WIDTH / 2)**2 - above**2
        found.append(DENSITY * math.pi * sum(areas) * HALF * part_of_circle(cells))
        bore = radius + WIDTH / 2 + PLAY
    return found


def force(cells):
    """Of the pressure at its peak. [N]"""
    return PEAK * math.pi * (SHOULDER**2 - HOLE**2) * part_of_circle(cells)


def impulse(cells):
    """Of the whole pulse, a triangle. [N s]"""
    return force(cells) * PULSE / 2


def closing_time(acceleration):
    """When what moves as one has gone through the gap:  x = a (t^2/2 - t^3/(6 T)),  a [m/s2] under the peak of the pressure. [s]

    >>> t = closing_time(force(48) / mass(48))
    >>> way = force(48) / mass(48) * (t**2 / 2 - t**3 / (6 * PULSE))
    >>> round(way / GAP, 12)
    1.0
    """
    low, high = 0.0, PULSE
    for _ in range(100):
        t = (low + high) / 2
        way = acceleration * (t**2 / 2 - t**3 / (6 * PULSE))
        low, high = (t, high) if way < GAP else (low, t)
    return low


# Shield plates below the small plug

RIM, LOWEST = 0.9, 0.05   # [m] radius of the plates, thickness of the lowest


def acceleration_of_lowest():
    """Of the plate that the pressure strikes. [m/s2]"""
    return PEAK / (DENSITY * LOWEST)


def impulse_on_plate(cells):
    """Of the pressure on the lowest plate. [N s]"""
    return PEAK * math.pi * (RIM**2 - HOLE**2) * part_of_circle(cells) * PULSE / 2
