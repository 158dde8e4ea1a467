"""Shots of Taylor bars beside what was measured: for the folders verification/taylor_*, whose case.yaml is one shot.

A shot is a row of shots.csv. `shoot` runs it on a mesh, `measured` and `computed` give the quantities

    length   final length over the first one
    foot     largest diameter over the first one
    belly    diameter at 0.2 of the first length over the first diameter
    rear     length of the rear part that has kept its diameter within 1 %, over the first length: reported, no verdict

after the bar has left the wall: as means over one period of its length wave, or of the last frame.
"""
import csv
import math

from validation import Point, u_of_inputs, u_of_meshes

LEVELS = [(2, 2, 2), (3, 2, 3), (4, 3, 4)]  # cells of core, ring, and along for each radius
SIZES = [2, 3, 4]
QUANTITIES = ("length", "foot", "belly")
TEXTS = ("source", "label", "batch", "seen")
UNITS = {"young": "Pa", "yield": "Pa", "hardening_coefficient": "Pa", "specific_heat": "J/(kg*K)", "melting_temperature": "K"}
BEYOND = 0.01  # [-] of the radius: the rear part ends where the bar is thicker


def read_shots(folder):
    """Rows of shots.csv; numbers are floats, what is not given is None."""
    text = (folder / "shots.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return [{key: value if key in TEXTS else float(value) if value else None for key, value in row.items()} for row in rows]


def label(shot):
    return f"{shot['source']} {shot['speed']:g} m/s, {shot['length']:g} mm, {shot['temperature']:g} K"


def keys(shot, young, level, change=None):
    """What of case.yaml this shot sets. The run ends one period of the length wave after the push of the wall has ceased."""
    core, ring, along = LEVELS[level]
    radius, speed = shot["diameter"] / 2, shot["speed"]
    period = 2 * shot["length"] * 1e-3 / math.sqrt(young / shot["density"])
    momentum = shot["density"] * math.pi * radius**2 * shot["length"] * 1e-9 * speed / 4
    return {"bodies[0].material.density": f"{shot['density']:g} kg/m^3", "bodies[0].material.temperature": f"{shot['temperature']:g} K",
            "bodies[0].mesh.radius": f"{radius:g} mm", "bodies[0].mesh.length": f"{shot['length']:g} mm",
            "bodies[0].mesh.cells_core": core, "bodies[0].mesh.cells_ring": ring,
            "bodies[0].mesh.cells_along": round(along * shot["length"] / radius),
            "initial[0].velocity": f'["0", "0", "-{speed:g}"]', "stop[0].steady.window": f"{period:.4g} s",
            "stop[0].steady.within": f"{1e-3 * momentum:.4g} N*s", "output.history_every": f"{period / 20:.4g} s", **(change or {})}


def shoot(run, shot, level, change=None):
    return run.again(keys(shot, run.case("bodies[0].material.young"), level, change))


def ended(one):
    """Whether the bar came to its end and left the wall."""
    return one.summary["ending"]["word"] == "stopped_by_condition"


def measured(shot):
    """{quantity: number} of what is given."""
    given = {"length": shot["length_ratio"] if shot["length_ratio"] is not None else
             shot["final_length"] and shot["final_length"] / shot["length"],
             "foot": shot["df"] and shot["df"] / shot["diameter"], "belly": shot["w"] and shot["w"] / shot["diameter"],
             "rear": shot["xf"] and shot["xf"] / shot["length"]}
    return {name: value for name, value in given.items() if value}


def computed(one, shot):
    """{quantity: number}; not a number where the run did not end."""
    if not ended(one):
        return dict.fromkeys((*QUANTITIES, "rear"), math.nan)
    length, radius = shot["length"] * 1e-3, shot["diameter"] * 0.5e-3
    times = one.column("time")
    start = times[-1] - one.case("stop[0].steady.window")
    mean = {name: one.mean(name, start, times[-1]) for name in ("length", "foot_radius")}
    profile = outline(one, radius)
    return {"length": mean["length"] / length, "foot": mean["foot_radius"] / radius,
            "belly": width(profile, 0.2 * length) / radius, "rear": rear(profile, radius) / length}


def outline(one, radius):
    """[(height over the foot, radius)] of the nodes of the side, from the foot up, of the last frame. [m]"""
    fields = one.frame("body")[1]
    found = {}
    for (x, y, z), (u, v, w) in zip(fields["points"], fields["displacement"]):
        if math.hypot(x, y) > radius * (1 - 1e-6):
            found.setdefault(round(z, 9), []).append((z + w, math.hypot(x + u, y + v)))
    lowest = min(height for ring in found.values() for height, _ in ring)
    return [(sum(h for h, _ in ring) / len(ring) - lowest, sum(r for _, r in ring) / len(ring)) for _, ring in sorted(found.items())]


def width(profile, height):
    """Radius at a height over the foot; where the side has folded, the outermost.

    >>> width([(0, 3.0), (1, 2.0), (2, 1.0)], 1.5)
    1.5
    """
    found = [low[1] + (high[1] - low[1]) * (height - low[0]) / (high[0] - low[0])
             for low, high in zip(profile, profile[1:]) if min(low[0], high[0]) <= height <= max(low[0], high[0]) and high[0] != low[0]]
    return max(found, default=math.nan)


def rear(profile, radius):
    """Length from the free end to where the bar is thicker than it was.

    >>> rear([(0, 3.0), (1, 1.02), (2, 1.0), (3, 1.0)], 1.0)
    1.5
    """
    top = profile[-1][0]
    for high, low in zip(profile[::-1], profile[-2::-1]):
        if low[1] > radius * (1 + BEYOND):
            part = (radius * (1 + BEYOND) - high[1]) / (low[1] - high[1])
            return top - (high[0] + part * (low[0] - high[0]))
    return top


def inputs(value_of, spread):
    """[(key, value below, value above)] of the uncertain inputs, one standard uncertainty to each side.

    >>> inputs({"bodies[0].material.yield": 90e6}.get, {"yield": 0.1})
    [('bodies[0].material.yield', '8.1e+07 Pa', '9.9e+07 Pa')]
    """
    found = []
    for name, part in spread.items():
        key = f"bodies[0].material.{name}"
        found.append((key, *(f"{value_of(key) * (1 + sign * part):.6g} {UNITS.get(name, '')}".strip() for sign in (-1, 1))))
    return found


def u_inputs(run, shot, spread, speed, friction):
    """{quantity: standard uncertainty} of a shot on the coarse mesh.

    speed     [-] of the measured speed
    friction  at the wall, which is somewhere between none and this; taken as uniform there
    """
    nominal = computed(shoot(run, shot, 0), shot)
    pairs = [tuple(computed(shoot(run, shot, 0, {key: value}), shot) for value in (low, high))
             for key, low, high in inputs(run.case, spread)]
    pairs.append(tuple(computed(shoot(run, {**shot, "speed": shot["speed"] * (1 + sign * speed)}, 0), shot) for sign in (-1, 1)))
    pairs.append((nominal, computed(shoot(run, shot, 0, {"planes[2].friction": friction / math.sqrt(3)}), shot)))
    return {name: u_of_inputs(nominal[name], [(low[name], high[name]) for low, high in pairs]) for name in QUANTITIES}


def nearest(shot, representatives):
    """Label of the representative shot with the closest temperature, length and speed."""
    def distance(one):
        return sum(abs(math.log(one[key] / shot[key])) for key in ("temperature", "length", "speed"))
    return label(min(representatives, key=distance))


def points(run, family, shots, group_of, of_inputs, u_measured, seen, levels_of):
    """Points of all quantities of these shots.

    group_of    function of a shot: its batch
    of_inputs   {label: {quantity: u}} of the representative shots
    u_measured  function of shot and quantity: relative standard uncertainty
    seen        function of shot and quantity: whether its run was seen before
    levels_of   function of a shot: its meshes, coarse to fine
    """
    found = []
    representatives = [shot for shot in shots if label(shot) in of_inputs]
    for shot in shots:
        levels = levels_of(shot)
        runs = [shoot(run, shot, level) for level in levels]
        values = [computed(one, shot) for one in runs]
        uncertainty = of_inputs[nearest(shot, representatives)]
        for name, what in measured(shot).items():
            if name not in QUANTITIES:
                continue
            series = [value[name] for value in values]
            good = all(map(math.isfinite, series))
            found.append(Point(family, name, group_of(shot), label(shot), shot["speed"], what, series[-1],
                               u_of_meshes([SIZES[level] for level in levels], series) if good else math.nan, uncertainty[name],
                               u_measured(shot, name), not seen(shot, name), runs[-1].summary["ending"]["word"]))
    return found


def digitised(shot):
    """Standard uncertainty of a diameter that was read from a drawn profile. Flow keeps the volume, so what the drawn one is off the first
    volume, V/V0 - 1, is half of it the error of diameters. [-] Zero where there is no profile.

    >>> round(digitised({"diameter": 7.62, "length": 46.94, "volume": 1883.36}), 3)
    0.06
    >>> digitised({"diameter": 7.62, "length": 46.94, "volume": None})
    0.0
    """
    if shot["volume"] is None:
        return 0.0
    return abs(shot["volume"] / (math.pi / 4 * shot["diameter"]**2 * shot["length"]) - 1) / 2


def flow_stress(density, speed, ratio):
    """Mean flow stress that takes a bar's energy in an even field: density speed^2 / (2 ln(L0/L)). [Pa] It orders batches by temper, by
    measurements alone: of bars of one form and speed the one with the higher stress is harder.

    >>> [round(flow_stress(8920, 190, 0.638) / 1e6), round(flow_stress(8960, 175, 23.6 / 30.38) / 1e6)]   # copper: Johnson & Cook, House
    [358, 543]
    >>> [round(flow_stress(2700, 262, 0.844) / 1e6), round(flow_stress(2685, 252, 0.848) / 1e6)]   # 6061-T6: Wilkins & Guinan, Gust
    [546, 517]
    >>> [round(flow_stress(7830, 208, 0.885) / 1e6), round(flow_stress(7830, 215, 22.4 / 25.29135) / 1e6)]   # 4340: Johnson & Cook, House
    [1386, 1491]
    """
    return density * speed**2 / (2 * math.log(1 / ratio))
