"""Two runs of one scene compared: histories, last frames, ledgers, and the bytes of what they wrote.

The results of the twin are carried back by the transformation that made it (Carry), so that vectors and tensors are compared, too.
"""
import csv
import math

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
    """Columns of history.csv: {name: (unit, numbers)}."""
    with (run.folder / "history.csv").open(newline="", encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    return {name.split(" [")[0]: (name.split(" [")[1].rstrip("]"), [float(row[i]) for row in rows]) for i, name in enumerate(head)}


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


UNITS = {"displacement": "m", "velocity": "m/s", "contact_force": "N", "stress": "Pa", "von_mises": "Pa", "pressure": "Pa",
         "plastic_strain": "1"}
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
