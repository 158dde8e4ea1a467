"""How close is close enough, why, and what must break."""
from reference import deflection, first_frequency, layers_factor
from verify import Breaks, Check, Figure, Pair, Report, Table, crossings

CATALOGUE = ("E-3",)
CLAIM = "n layers of one-point elements with hourglass dashpots have 1 - 1/n^2 of the bending stiffness, in statics and in vibration."
EVIDENCE = "exact"
DRIVER = "scene"

BEAM = {"young": 210e9, "poisson": 0, "length": 1, "width": 0.1, "height": 0.1}
LOAD, DENSITY = 1000, 7850  # [N] [kg/m3]
FREE = "verification/cantilever/free.yaml"
MODES = "verification/cantilever/modes.yaml"
SPRINGS = {"bodies[0].element.hourglass_kind": "stiffness", "bodies[0].element.hourglass": 0.01}  # those of modes.yaml


def cells(layers):
    return {"bodies[0].mesh.cells": f"[{10 * layers}, 1, {layers}]"}


def stiff(layers, coefficient=0.1):
    return {**cells(layers), "bodies[0].element.hourglass_kind": "stiffness", "bodies[0].element.hourglass": coefficient}


def assumed(layers):
    """The hourglass control of the program's defaults."""
    return {**cells(layers), "bodies[0].element.hourglass_kind": "assumed_strain", "bodies[0].element.hourglass": 1}


def full(layers):
    return {**cells(layers), "bodies[0].element.kind": "full"}


def tip(run):
    return -run.column("tip")[-1]


def frequency(run):
    """From the first and the last time the tip passes its rest downwards. [Hz]"""
    times = crossings(run.column("time"), run.column("tip"), rising=False)
    return (len(times) - 1) / (times[-1] - times[0]) if len(times) > 1 else float("nan")


def against_layers(layers):
    return lambda run: Pair(tip(run.again(cells(layers))), deflection(load=LOAD, bending=layers_factor(layers), **BEAM), "m")


def against_beam(run):
    return Pair(tip(run.again(cells(8))), deflection(load=LOAD, **BEAM), "m")


def swing(layers):
    exact = first_frequency(density=DENSITY, bending=layers_factor(layers), **BEAM)
    return lambda run: Pair(frequency(run.other("scene", FREE, {**cells(layers), **slower(run)})), exact, "Hz")


def lowest(run, layers):
    """The first frequency by stiffness and mass. [Hz]"""
    return run.other("modes", MODES, {**cells(layers), **slower(run)}).result("frequency_1")


def by_modes(layers):
    exact = first_frequency(density=DENSITY, bending=layers_factor(layers), **BEAM)
    return lambda run: Pair(lowest(run, layers), exact, "Hz")


def two_ways(run):
    """The beam of four layers with weak springs: swinging, beside its own stiffness and mass."""
    return Pair(frequency(run.other("scene", FREE, {**cells(4), **slower(run), **SPRINGS})), lowest(run, 4), "Hz")


def slower(run):
    """Changes of a break that hold for the free beam as well."""
    return {key: value for key, value in run.overrides.items() if key.startswith("bodies") and "cells" not in key}


def formulations(run):
    beam = deflection(load=LOAD, **BEAM)
    rows = []
    kinds = [("one point, dashpots", cells), ("one point, springs 0.01", lambda n: stiff(n, 0.01)), ("one point, springs 0.1", stiff),
             ("one point, springs 1", lambda n: stiff(n, 1)), ("one point, assumed strains", assumed), ("eight points", full)]
    for name, change in kinds:
        row = [name]
        for layers in (1, 2, 4, 8):
            row.append("a mechanism" if name.endswith("dashpots") and layers == 1 else f"{tip(run.again(change(layers))) / beam:.4f}")
        rows.append(row)
    rows.append(["1/(1 - 1/n^2), with shear", "infinite", *(f"{deflection(load=LOAD, bending=layers_factor(n), **BEAM) / beam:.4f}"
                                                            for n in (2, 4, 8))])
    return rows


DEPARTURES = {
    "hourglass_kind, hourglass": "the claim is of elements whose hourglass control has dashpots; modes need weak springs instead"}

CHECKS = [
    Check("deflection, 2 layers", against_layers(2), 0.02, "the catalogue's bound for 1 - 1/n^2"),
    Check("deflection, 4 layers", against_layers(4), 0.02, "the catalogue's bound for 1 - 1/n^2"),
    Check("deflection, 8 layers", against_layers(8), 0.02, "the catalogue's bound for 1 - 1/n^2"),
    Check("deflection, 8 layers against the beam", against_beam, 0.02, "the catalogue's bound: 1/64 of it is the layers' own bending"),
    Check("first frequency, 4 layers", swing(4), 0.02, "Timoshenko's, with 1 - 1/n^2 of the stiffness"),
    Check("first frequency, 8 layers", swing(8), 5e-5,
          "Timoshenko's, with 1 - 1/n^2 of the stiffness; a row every 0.02 ms and straight lines between tell three periods to 3e-5"),
    Check("first frequency by modes, 4 layers", by_modes(4), 8e-5,
          "the same beam, from its stiffness and mass; cells of 1/40 of its length leave the fourth power of pi/40, 4e-5: twice that"),
    Check("first frequency by modes, 8 layers", by_modes(8), 5e-6, "the same; cells of 1/80 leave a sixteenth of it"),
    Check("swinging beside modes, 4 layers", two_ways, 1e-3,
          "the same model twice: a run sampled every 0.02 ms tells three periods to 5e-4", evidence="invariant"),
    Check("by default, 4 layers against the beam", lambda run: Pair(tip(run.again(assumed(4))), deflection(load=LOAD, **BEAM), "m"), 2e-3,
          "assumed strains bend as the beam, as in one_layer_bends; cells of 1/40 of its length leave 1/1600"),
]

STUDIES = [Table("Deflection over the beam's, n layers.", ["element", "n = 1", "n = 2", "n = 4", "n = 8"], formulations, full=True)]

BREAKS = [
    Breaks("deflection, 2 layers", "the layers' own bending counted: eight points in each element", {"bodies[0].element.kind": "full"}),
    Breaks("deflection, 4 layers", "a plate's stiffness E/(1 - nu^2) in a beam", {"bodies[0].material.young": "230.77 GPa"}),
    Breaks("deflection, 4 layers", "hourglass springs in place of dashpots", {"bodies[0].element.hourglass_kind": "stiffness",
        "bodies[0].element.hourglass": 1}),
    Breaks("first frequency, 4 layers", "half the density", {"bodies[0].material.density": "3925 kg/m^3"}),
    Breaks("first frequency by modes, 4 layers", "half the density", {"bodies[0].material.density": "3925 kg/m^3"}),
    *(Breaks(what, "a plate's stiffness E/(1 - nu^2) in a beam", {"bodies[0].material.young": "230.77 GPa"}, full=True)
      for what in ("deflection, 8 layers", "deflection, 8 layers against the beam", "by default, 4 layers against the beam")),
    *(Breaks(f"first frequency{way}, 8 layers", "half the density", {"bodies[0].material.density": "3925 kg/m^3"}, full=True)
      for way in ("", " by modes")),
    Breaks("swinging beside modes, 4 layers", "springs a hundred times as stiff in the modes alone", {"bodies[0].element.hourglass": 1},
           full=True),
]


def deflection_over_layers(run):
    beam = deflection(load=LOAD, **BEAM)
    return [("Nereid", [2, 4, 8], [tip(run.again(cells(n))) / beam for n in (2, 4, 8)])]


def exact_deflection(_):
    beam, layers = deflection(load=LOAD, **BEAM), [1.8 + 0.1 * i for i in range(70)]
    return [("1 - 1/n^2 of the stiffness", layers, [deflection(load=LOAD, bending=layers_factor(n), **BEAM) / beam for n in layers])]


FIGURES = [Figure("layers", "layers of elements", "deflection over the beam's", deflection_over_layers, exact=exact_deflection,
                  caption="Deflection of a cantilever of n layers of one-point elements over Timoshenko's.")]
