"""A lead cylinder in a steel skin drops on a rigid floor: what other codes found, and what it starts with.

Kulak & Fiala, Development of an Impact Capability for NEPTUNE, chapter 5; the round robin is Yagawa et al., Nucl. Eng. Des. 78 (1984) 377,
as they report it with their Fig. 5: three of four codes. All of them are results of programs; nobody measured. Units are kgf, mm and s.
"""
from math import pi, sin

NEPTUNE = {"settlement": 65e-3, "time": 5.5e-3}  # [m] [s]
ROUND_ROBIN = {"settlement": (58e-3, 72.5e-3), "time": (4.3e-3, 6.25e-3)}
KGF = 9.80665  # [N]
LEAD = {"radius": 152.5, "length": 914, "density": 1.13e-9}
SKIN = {"radius": 155.675, "length": 914, "thickness": 6.35, "density": 8.0e-10}  # of the mid-surface
SPEED = 13330  # [mm/s]


def kinetic_energy(speed=SPEED):
    """Of the round cask at the start [kgf mm].

    >>> round(kinetic_energy() / 1e6, 3)
    7.108
    """
    lead = LEAD["density"] * pi * LEAD["radius"]**2 * LEAD["length"]
    skin = SKIN["density"] * 2 * pi * SKIN["radius"] * SKIN["thickness"] * SKIN["length"]
    return (lead + skin) * speed**2 / 2


def kinetic_energy_of_sector(sides):
    """Of one of `sides` sectors whose round faces are chords [J].

    >>> abs(kinetic_energy_of_sector(100000) * 100000 / (kinetic_energy() * KGF * 1e-3) - 1) < 1e-8
    True
    """
    angle = 2 * pi / sides
    lead = LEAD["density"] * LEAD["radius"]**2 / 2 * sin(angle) * LEAD["length"]
    skin = SKIN["density"] * 2 * SKIN["radius"] * sin(angle / 2) * SKIN["thickness"] * SKIN["length"]
    return (lead + skin) * SPEED**2 / 2 * KGF * 1e-3


def place(value, low, high):
    """Middle and half the width of a range, so that |value - middle| / half is 1 on its ends.

    >>> place(58, 58, 72.5)
    (65.25, 7.25, -1.0)
    """
    middle, half = (low + high) / 2, (high - low) / 2
    return middle, half, (value - middle) / half
