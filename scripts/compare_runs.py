"""Two runs of one scene compared: histories, last frames, ledgers, and the bytes of what they wrote.

This is a module of checks and no command: `scripts/report A B --text` prints what differs between two runs.

The results of the twin are carried back by the transformation that made it (Carry), so that vectors and tensors are compared, too.
"""
import csv
import math

import runs
import twins


class Carry:
    """What becomes of a result: lengths, masses and times scaled, vectors turned, nodes and cells renumbered."""

    def __init__(self, matrix=twins.IDENTITY, scale=(1, 1, 1), nodes=None, cells=None):
        self.matrix, self.scale, self.nodes, self.cells = matrix, scale, nodes, cells

    def factor(self, unit):
        _, *powers = twins.measure(unit)
        return math.prod(one ** power for one, power in zip(self.scale, powers))

    def vector(self, v):
        return v if self.matrix is twins.IDENTITY else twins.product(self.matrix, v)

    def tensor(self, s):
        """Six components xx, yy, zz, xy, yz, xz."""
        return s if self.matrix is twins.IDENTITY else twins.tensor(self.matrix, s)


# ------------------------------------------------------------------------------------------------
# Numbers

def apart(ours, theirs):
    """The largest difference of two lists; no number beside no number differs by nothing."""
    worst = 0.0
    for a, b in zip(ours, theirs):
        if not (math.isnan(a) and math.isnan(b)):
            d = abs(a - b)
            worst = d if not d <= worst else worst
    return worst


def relative(difference, scale):
    """A difference over the largest of all values on both sides, of which all may be zero."""
    return difference / scale if scale > 0 else difference


def size(values):
    return max((abs(v) for v in values if not math.isnan(v)), default=0.0)


def largest(found):
    """The largest difference, and infinity where one is no number."""
    return max(math.inf if math.isnan(v) else v for v in found.values())


# ------------------------------------------------------------------------------------------------
# Results

def history(run):
    """Columns of history.csv: {name: (unit, numbers)}; of frequencies the squares: a solver finds these, and roots of zero are not."""
    with (run.folder / "history.csv").open(newline="", encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    found = {name.split(" [")[0]: (name.split(" [")[1].split("]")[0], [float(row[i]) for row in rows]) for i, name in enumerate(head)}
    return {name: ("Hz^2", [x * x for x in column]) if unit == "Hz" else (unit, column) for name, (unit, column) in found.items()}


def histories(base, twin, carry=Carry(), only=None):
    """The largest difference of each column over its largest value; energies over the largest energy. 1 where rows are missing."""
    ours, theirs = history(base), history(twin)
    back = {name: [v / carry.factor(unit) for v in theirs[name][1]] for name, (unit, _) in ours.items()}
    most = {name: max(size(column), size(back[name])) for name, (_, column) in ours.items()}
    most_energy = max(v for name, v in most.items() if name.startswith("energy_"))
    found = {"rows": float(len(ours["time"][1]) != len(theirs["time"][1]))}
    for name, (_, column) in ours.items():
        if only is None or name in only:
            scale = most_energy if name.startswith("energy_") else most[name]
            found[name] = relative(apart(column, back[name]), scale)
    return found


OF_ELEMENTS = {"stress": "Pa", "von_mises": "Pa", "pressure": "Pa", "plastic_strain": "1", "strain": "1"}
PLACES = ("top", "middle", "bottom", "membrane")  # of plates
UNITS = {"displacement": "m", "velocity": "m/s", "contact_force": "N", **OF_ELEMENTS,
         **{f"{name}_{place}": unit for name, unit in OF_ELEMENTS.items() for place in PLACES}}
NODAL = ("displacement", "velocity", "contact_force")


def fields(base, twin, carry=Carry(), change=lambda name, value: value):
    """The largest difference of each field of the last frames over its largest component.

    change(name, value)  what is done to a value of the twin before, with its units carried back
    """
    (_, ours), (_, theirs) = base.frame("body"), twin.frame("body")
    found = {}
    for name, unit in UNITS.items():
        if name not in ours:
            continue
        factor = carry.factor(unit)
        where = carry.nodes if name in NODAL else carry.cells
        turned = carry.vector if name in NODAL else carry.tensor
        worst, scale = 0.0, 0.0
        for i, one in enumerate(ours[name]):
            other = theirs[name][i if where is None else where[i]]
            one, other = (turned(one), other) if isinstance(one, tuple) else ((one,), (other,))
            other = change(name, [v / factor for v in other])
            d = apart(one, other)
            worst = d if not d <= worst else worst
            scale = max(scale, size(one), size(other))
        found[name] = relative(worst, scale)
    return found


def ledgers(base, twin, carry=Carry()):
    """Momentum of the whole scene and impulses of all sources, over the largest of them."""
    factor = carry.factor("kg*m/s")
    pairs = [(base.ledger("momentum"), twin.ledger("momentum"))]
    for name, account in base.summary["ledger"]["accounts"].items():
        pairs.append((account["impulse"]["value"], twin.account(name)["impulse"]["value"]))
    pairs = [(carry.vector(ours), [v / factor for v in theirs]) for ours, theirs in pairs]
    scale = max(size(v) for pair in pairs for v in pair)
    return {"impulses": relative(max(apart(*pair) for pair in pairs), scale)}


def differences(base, twin, carry=Carry()):
    """All that is compared: {name: largest relative difference}."""
    return {**histories(base, twin, carry), **fields(base, twin, carry), **ledgers(base, twin, carry)}


# ------------------------------------------------------------------------------------------------
# Bits

def written(folder):
    """{file: its bytes} of histories and frames of a run."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.suffix in (".csv", ".pvd", ".vtu", ".vtp")}


def files_that_differ(one, other):
    """Names of the files that are not the same, or missing on one side; and of how many."""
    ours, theirs = written(one), written(other)
    return [name for name in sorted({*ours, *theirs}) if ours.get(name) != theirs.get(name)], len(ours)


# ------------------------------------------------------------------------------------------------
# Differences over time

# Ends of names of results that are times of events, and counts: round-off moves them by one.
NO_NUMBERS = ("_at", "_first_touch", "_last_touch", "_reconnections", "_lost", "_recovered")
# Parts of names of columns that a moving observer has otherwise.
OF_ROUND_OFF = ("_asymmetry", "_residual", "_booked_amiss")  # ends of names of results that measure round-off itself
OF_THE_FRAME = ("energy_kinetic", "external", "potential", "residual", "integration")
SAME_TIME = 1e-9  # [-] of the end: rows of both runs at one time
NOTHING = 1e-9    # [-] of the largest value of its unit: less is round-off, and is compared with that
SMALL = 1e-3      # [-] of the largest column of its unit: where modelling is compared, less counts as no result of its own


def scales(run):
    """({column or field: its largest value}, {the same, and each unit: the largest value of the unit}) of a run; energies count as the
    largest of them.

    A scene at rest has nothing but round-off in its velocities and energies. So the velocity that its gravity would make in the time of the
    run counts too, and weight times size; of spins, velocities over the size; of lengths, a thousandth of the size, since positions are
    rounded.
    """
    units, own = {}, {}
    for name, (unit, column) in history(run).items():
        units[name], own[name] = "energy" if name.startswith("energy_") else unit, size(column)
    if has_bodies(run):
        last_time, last = run.frame("body")
        for name, unit in UNITS.items():
            if name in last:
                units[f"field {name}"] = unit
                own[f"field {name}"] = max((size(v if isinstance(v, tuple) else (v,)) for v in last[name]), default=0.0)
        extent = max(max(p[i] for p in last["points"]) - min(p[i] for p in last["points"]) for i in range(3))
        pull = size(gravity_of(run))
        weight = math.hypot(*run.summary["ledger"]["accounts"].get("gravity", {}).get("impulse", {}).get("value", [0])) / last_time
        units["of gravity"], own["of gravity"] = "m/s", pull * last_time
        fastest = max(own[name] for name, unit in units.items() if unit == "m/s")
        units["of spins"], own["of spins"] = "rad/s", fastest / extent
        units["of places"], own["of places"] = "m", SMALL * extent
        units["of weight"], own["of weight"] = "energy", weight * extent
    family = {}
    for name, unit in units.items():
        family[unit] = max(family.get(unit, 0.0), own[name])
    return {name: family[unit] if unit == "energy" else own[name] for name, unit in units.items()}, \
        {**family, **{name: family[unit] for name, unit in units.items()}}


def gravity_of(run):
    """Its components, or the one number that a program asks for; none where there is no gravity. [m/s2]"""
    found = run.summary["provenance"]["resolved"].get("gravity", {}).get("value", [])
    return found if isinstance(found, list) else [found]


def has_bodies(run):
    """Whether a run has frames of bodies over time; other programs write shapes, of any sign."""
    return "time" in run.columns and (run.folder / "body.pvd").is_file()


def curves(twin, interpolated=False):
    """{column: [(time, relative difference)]} of a twin, over the largest value of the column; energies over the largest energy.

    Rows of the same time are compared; with `interpolated`, those of the base with what the twin has then.
    """
    ours, theirs = history(twin.base), history(twin.run)
    first, *names = ours
    times, other_times = ours[first][1], theirs[first][1]
    end = max(size(times), size(other_times))
    own, family = scales(twin.base)
    if interpolated:
        rows = [(i, t) for i, t in enumerate(times) if t <= other_times[-1]]
    else:
        at = {round(t / end / SAME_TIME): j for j, t in enumerate(other_times)} if end else {}
        rows = [(i, at[round(t / end / SAME_TIME)]) for i, t in enumerate(times) if round(t / end / SAME_TIME) in at]
    found = {}
    for name in names:
        if name in twin.skipped or twin.frame_moves and any(part in name for part in OF_THE_FRAME):
            continue
        _, column = ours[name]
        parts, back = twin.probes.get(name, ([name], lambda _, v: v[0]))
        if any(part not in theirs for part in parts):
            continue
        columns = [theirs[part][1] for part in parts]
        unit = "energy" if name.startswith("energy_") else ours[name][0]
        largest_value = own[name] if own[name] > NOTHING * family[name] else family[name]
        scale = max(largest_value, twin.moves.get(unit, 0.0), SMALL * family[name] if interpolated else 0.0)
        one = found[name] = []
        for i, j in rows:
            other = [runs.interpolate(other_times, c, j) if interpolated else c[j] for c in columns]
            one.append((times[i], relative(apart([column[i]], [back(times[i], other)]), scale)))
    return found


def ends(twin):
    """{name: relative difference} at the end: results of summary.json, fields of the last frame, and impulses."""
    found, columns = {}, twin.base.columns
    results, others = twin.base.summary["results"], twin.run.summary["results"]
    _, family = scales(twin.base)
    for name, one in results.items():
        carried = any(name.startswith(f"{probe}_") for probe in (*twin.probes, *twin.skipped))  # its column is compared
        pair = [one["value"], others.get(name, {}).get("value")]
        in_history = one.get("unit") == "Hz"
        counts = None not in pair and not f"_{name}".endswith(NO_NUMBERS + OF_ROUND_OFF)
        if counts and not carried and not in_history and not twin.frame_moves:
            column = columns.get(name.rpartition("_")[0], [])
            scale, largest_of_unit = max(size(pair), size(column)), family.get(one.get("unit"), float(one.get("unit") == "1"))
            found[f"result {name}"] = relative(apart(*([x] for x in pair)), scale if scale > NOTHING * largest_of_unit else largest_of_unit)
    if has_bodies(twin.base) and has_bodies(twin.run):
        time = twin.run.frame("body")[0]
        change = (lambda name, v: twin.field(time, name, v)) if twin.field else (lambda name, v: v)
        found.update((f"field {name}", d) for name, d in fields(twin.base, twin.run, twin.carry, change).items())
    found.update(impulses(twin))
    return found


def impulses(twin):
    """The difference of the impulse of each source, and of the momentum, over the largest of them, that of the twin included."""
    ours, theirs = (one.summary.get("ledger", {}) for one in (twin.base, twin.run))
    pairs = {f"impulse {name}": [ledger["accounts"][name]["impulse"]["value"] for ledger in (ours, theirs)]
             for name in ours.get("accounts", {}) if name in theirs.get("accounts", {})}
    if "momentum" in ours and not twin.frame_moves:
        pairs["momentum"] = [ledger["momentum"]["value"] for ledger in (ours, theirs)]
    pairs = {name: (twin.carry.vector(a), b) for name, (a, b) in pairs.items()}
    momenta = [ledger[key]["value"] for ledger in (ours, theirs) for key in ("momentum", "initial_momentum") if key in ledger]
    scale = max((size(v) for v in (*momenta, *(v for pair in pairs.values() for v in pair))), default=0.0)
    return {name: relative(apart(*pair), scale) for name, pair in pairs.items()}
