"""Points of a sweep: what each run of scripts/trade cost, how far its results are from the reference, and which points pay.

A result's reference is exact, or the finest of at least three meshes. Then it has an uncertainty, by Richardson's extrapolation and
Roache's index (convergence.py). An error below it says nothing: the point is not judged, and counts as if its error were this large.

A coarse mesh may be right by luck, where an error goes through zero. So the error that counts is the largest of the point's own and
those of the next two finer meshes of the sweep with the same settings, and a point without these is on no front.
"""
import csv
import dataclasses
import io
import math

from convergence import tendency

MESH = "mesh"  # the knob of the mesh
FINER = 2      # finer meshes that a confirmed point has
BETTER = 0.95  # [-] of the error of a cheaper run: less of a gain is none
ENOUGH = 0.9  # [-] of the cost or the error of the defaults: from here on a value pays, and is tried in pairs


# ------------------------------------------------------------------------------------------------
# What a case defines

@dataclasses.dataclass(frozen=True)
class Exact:
    """A result with an exact reference: measure(run) gives a verify.Pair."""
    name: str
    measure: object


@dataclasses.dataclass(frozen=True)
class Converged:
    """A result whose reference is that of the finest mesh: measure(run) gives a number."""
    name: str
    measure: object
    unit: str = ""


@dataclasses.dataclass(frozen=True)
class Meshes:
    """The meshes that make the reference of Converged results.

    factors   on the counts of cells
    settings  keys that are set in all of them
    of        keys of the mesh of a factor, where more than counts of cells belongs to it
    beside    {name: keys} of more runs with the mesh of the case; how far their results lie apart adds to the uncertainty
    """
    factors: tuple
    settings: dict = dataclasses.field(default_factory=dict)
    of: object = None
    beside: dict = dataclasses.field(default_factory=dict)


@dataclasses.dataclass(frozen=True)
class Series:
    """Lines of a figure of their own, error of one result over processor time: {line: {knob: label}}; meshes are the points of a line.

    name_of  what a mesh is called, of its factor
    """
    result: str
    lines: dict
    name_of: object = "x{:g}".format


@dataclasses.dataclass
class Reference:
    """The reference of a result; value None where it is exact and each run has its own.

    uncertainty  [-] over the value
    """
    value: float | None
    unit: str
    uncertainty: float
    known: str


def exact_reference():
    return Reference(None, "", 0.0, "exact")


def converged_reference(factors, values, unit, beside=None):
    """The finest mesh, and how far the finer ones would go; with how far the results `beside`, {name: value}, lie apart."""
    said, _, uncertainty = tendency(factors, values)
    finest = max(zip(factors, values))[1]
    if uncertainty is None or finest == 0 or not math.isfinite(uncertainty):
        return Reference(finest, unit, math.inf, said)
    apart = max(beside.values()) - min(beside.values()) if beside else 0.0
    said += f"; and {share(apart / abs(finest))} between {', '.join(beside)}" if beside else ""
    return Reference(finest, unit, (uncertainty + apart) / abs(finest), said)


# ------------------------------------------------------------------------------------------------
# Points

@dataclasses.dataclass
class Point:
    """One run of a sweep.

    knobs     {name: label} of what differs from the case; empty for the case itself
    ending    'good', or why there is no number: 'stopped: ...', 'refused: ...', 'not used: ...', 'left out'
    errors    {result: error [-]}
    """
    knobs: dict
    settings: dict
    ending: str = "left out"
    mesh: float = 1.0        # factor on the counts of cells
    errors: dict = dataclasses.field(default_factory=dict)
    elements: int = 0
    steps: int = 0
    updates: int = 0
    seconds: float = 0.0     # [s] of the processor, start and files included
    created: float = 0.0     # [-] the largest created energy over that of the scene
    warnings: int = 0        # of the program beyond those of the case itself

    def good(self):
        return self.ending == "good"

    def name(self):
        return ", ".join(f"{name} {label}" for name, label in self.knobs.items()) or "as the case has it"


def judged(error, uncertainty):
    """Whether an error is larger than what the reference may be off."""
    return error > uncertainty


def series_of(point):
    """What the meshes of one series have in common."""
    return frozenset((name, label) for name, label in point.knobs.items() if name != MESH)


def finer_of(point, points):
    """The next two finer meshes of the sweep with the same settings, as far as they have a result."""
    same = [one for one in points if one.good() and one.mesh > point.mesh and series_of(one) == series_of(point)]
    return sorted(same, key=lambda one: one.mesh)[:FINER]


def series(wanted, points):
    """{line: its points with a result, coarse meshes first}; a value that the case has anyway is in no point's knobs."""
    different = {pair for point in points for pair in point.knobs.items()}
    return {line: sorted((one for one in points if one.good() and series_of(one) == frozenset(values.items() & different)),
                         key=lambda one: one.mesh) for line, values in wanted.lines.items()}


def counted(point, result, points, references):
    """The error that counts: the largest of the point's own, those of the next two finer meshes, and the reference's uncertainty."""
    return max(references[result].uncertainty, *(one.errors[result] for one in [point, *finer_of(point, points)]))


def front(points, cost, error):
    """The points that no other one beats in both, cheapest first; a dearer one must be better by a twentieth."""
    best, found = math.inf, []
    for point in sorted((one for one in points if math.isfinite(error(one))), key=lambda one: (cost(one), error(one))):
        if error(point) < BETTER * best:
            best = error(point)
            found.append(point)
    return found


def confirmed(points):
    """The points that count: those with two finer meshes, or as many as any point of a sweep with fewer meshes."""
    finer = [len(finer_of(one, points)) for one in points]
    return [one for one, number in zip(points, finer) if number >= min(FINER, max(finer))]


def front_of(points, result, references, cost, surely=False):
    """The front of one result; points that have no number do not count, and `surely` none that finer meshes do not confirm."""
    good = [one for one in points if one.good()]
    return front(confirmed(good) if surely else good, cost, lambda one: counted(one, result, good, references))


def updates_of(point):
    return point.updates


def seconds_of(point):
    return point.seconds


def pays(point, base, points, references):
    """Whether a value alone makes the run cheaper, or any result better, by more than a tenth."""
    if not point.good() or not point.knobs:
        return False
    cheaper = point.updates < ENOUGH * base.updates or point.seconds < ENOUGH * base.seconds and point.updates <= base.updates
    return cheaper or any(counted(point, name, points, references) < ENOUGH * counted(base, name, points, references)
                          for name in references)


def worth_pairing(points, base, references):
    """The values that pay and that, in some result, neither another value alone nor the case itself beats."""
    both = [base, *points]
    on = [front_of(both, name, references, cost) for name in references for cost in (updates_of, seconds_of)]
    return [one for one in points if pays(one, base, both, references) and any(one in each for each in on)]


def pairs(points, base, references):
    """Two values worth pairing, of two knobs that set no common key, with the cost that is expected of both; the cheapest first."""
    good = worth_pairing(points, base, references)
    found = []
    for i, one in enumerate(good):
        for other in good[i + 1:]:
            if one.knobs.keys() & other.knobs.keys() or one.settings.keys() & other.settings.keys():
                continue
            expected = one.seconds * other.seconds / base.seconds
            found.append((expected, both(one, other)))
    return sorted(found, key=lambda pair: pair[0])


def both(one, other):
    """The point that has what two points of different knobs set; the mesh is that of the one that sets it."""
    return Point({**one.knobs, **other.knobs}, {**one.settings, **other.settings}, mesh=one.mesh if MESH in one.knobs else other.mesh)


def unproved(points, meshes, references):
    """Finer meshes that points of the fronts lack: (expected cost, Point), the cheapest first.

    meshes  {factor: the point of this mesh alone}, the case itself included
    """
    found = {}
    on = {id(one): one for name in references for cost in (updates_of, seconds_of) for one in front_of(points, name, references, cost)}
    for point in on.values():
        own = {name: label for name, label in point.knobs.items() if name != MESH}
        if not own or point.mesh not in meshes:
            continue
        coarse = meshes[point.mesh]
        kept = {key: text for key, text in point.settings.items() if key not in coarse.settings}
        for factor in sorted(one for one in meshes if one > point.mesh)[:FINER]:
            finer = meshes[factor]
            new = Point({**finer.knobs, **own}, {**finer.settings, **kept}, mesh=factor)
            if not any(one.settings == new.settings for one in points) and not finer.settings.keys() & kept.keys():
                found[new.name()] = (point.seconds * finer.seconds / coarse.seconds if coarse.seconds else 0.0, new)
    return sorted(found.values(), key=lambda pair: pair[0])


# ------------------------------------------------------------------------------------------------
# Figures

@dataclasses.dataclass(frozen=True)
class Panel:
    """What a panel of the figure shows: one result over one cost, points as (cost, error [%]).

    beaten       those that another one beats
    alone        those that finer meshes do not confirm
    front        those that no other one beats, as (cost, error [%], number in the table)
    base         the case itself
    uncertainty  [%] of the reference; infinite without one, and then there are no points
    """
    beaten: list
    alone: list
    front: list
    base: tuple
    uncertainty: float


COSTS = {"element updates": updates_of, "processor time [s]": seconds_of}
LEAST = 1e-8    # [-] where round-off is drawn


def panel_of(points, base, result, references, cost):
    """The Panel of the points that have a result."""
    uncertainty = references[result].uncertainty
    if uncertainty == math.inf:
        return Panel([], [], [], (), math.inf)

    def place(point):
        return cost(point), 100 * max(counted(point, result, points, references), LEAST)

    best, sure = front_of(points, result, references, cost, surely=True), confirmed(points)
    numbers = {id(one): number + 1 for number, (one, _) in enumerate(front_points(points, result, references))}
    return Panel([place(one) for one in sure if one not in best], [place(one) for one in points if one not in sure],
                 [(*place(one), numbers[id(one)]) for one in best], place(base), 100 * uncertainty)


def panels(points, base, references):
    """{result: [Panel, ...]}, one for each of COSTS."""
    return {name: [panel_of(points, base, name, references, cost) for cost in COSTS.values()] for name in references}


def series_lines(lines, wanted, references):
    """{line: (points that finer meshes confirm, the others)}, points as (processor time [s], error that counts [%], name of the mesh)."""
    found = [one for some in lines.values() for one in some]

    def places(some):
        return [(one.seconds, 100 * counted(one, wanted.result, found, references), wanted.name_of(one.mesh)) for one in some]

    drawn = {}
    for line, some in lines.items():
        sure = [one for one in some if len(finer_of(one, found)) >= FINER]
        drawn[line] = places(sure), places([one for one in some if one not in sure])
    return drawn


# ------------------------------------------------------------------------------------------------
# Tables

def share(value):
    """An error in per cent, or as a power of ten where it is tiny."""
    if not math.isfinite(value):
        return str(value)
    return "0" if value == 0 else f"{100 * value:.2g} %" if 1e-5 <= value < 1 else f"{100 * value:.0f} %" if value >= 1 else f"{value:.0e}"


def error_text(error, uncertainty):
    if uncertainty == math.inf:
        return "not judged: no reference"
    return share(error) if judged(error, uncertainty) else f"below the reference's {share(uncertainty)}"


def ratio_text(value, base):
    return f"{value / base:.2g}" if base > 0 else ""


def table(head, rows):
    """A table of Markdown."""
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in [head, ["---"] * len(head), *rows])


def count_text(number):
    return f"{number:,}"


def reference_table(references):
    return table(["result", "reference", "its uncertainty", "known by"],
                 [[name, "exact" if one.value is None else f"{one.value:.5g} {one.unit}".strip(), share(one.uncertainty), one.known]
                  for name, one in references.items()])


def alone_table(points, base, references):
    """Each value on its own: cost over that of the defaults, and for each result the error, with its ratio to the defaults' one."""
    rows = []
    for point in [base, *(one for one in points if len(one.knobs) == 1)]:
        if not point.good():
            rows.append([point.name(), "", "", *[point.ending] * len(references), ""])
            continue
        errors = []
        for name, one in references.items():
            text = error_text(point.errors[name], one.uncertainty)
            if point is not base and judged(point.errors[name], one.uncertainty) and judged(base.errors[name], one.uncertainty):
                text += f" (x{ratio_text(point.errors[name], base.errors[name])})"
            errors.append(text)
        cost = [count_text(base.updates), f"{base.seconds:.2f} s"] if point is base else \
            ["x" + ratio_text(point.updates, base.updates), "x" + ratio_text(point.seconds, base.seconds)]
        rows.append([point.name(), *cost, *errors, point.warnings or ""])
    return table(["setting", "element updates", "processor time", *references, "warnings"], rows)


def front_points(points, result, references):
    """[(point, which front it is on)] of one result, cheapest first."""
    by_updates, by_seconds = (front_of(points, result, references, cost, surely=True) for cost in (updates_of, seconds_of))
    union = [one for one in points if one in by_updates or one in by_seconds]
    return [(one, "both" if one in by_updates and one in by_seconds else "updates" if one in by_updates else "time")
            for one in sorted(union, key=lambda one: (one.updates, one.seconds))]


def front_table(points, result, references):
    """The points of a result that no other one beats, by either cost."""
    uncertainty = references[result].uncertainty
    return table(["", "settings", "element updates", "processor time", "error", "error that counts", "front of"],
                 [[number + 1, point.name(), count_text(point.updates), f"{point.seconds:.2f} s",
                   error_text(point.errors[result], uncertainty), share(counted(point, result, points, references)), which]
                  for number, (point, which) in enumerate(front_points(points, result, references))])


def as_csv(points, references):
    """All points, one a line."""
    stream = io.StringIO()
    out = csv.writer(stream, lineterminator="\n")
    out.writerow(["settings", "ending", "elements", "steps", "element updates", "processor seconds [s]", "created energy [-]", "warnings",
                  *(f"error of {name} [-]" for name in references), *(f"error that counts of {name} [-]" for name in references),
                  *(f"judged: {name}" for name in references), "finer meshes"])
    good = [one for one in points if one.good()]
    for one in points:
        if one.good():
            errors = [one.errors[name] for name in references]
            out.writerow([one.name(), one.ending, one.elements, one.steps, one.updates, f"{one.seconds:.3f}", f"{one.created:.3g}",
                          one.warnings, *(f"{error:.6g}" for error in errors),
                          *(f"{counted(one, name, points, references):.6g}" for name in references),
                          *("yes" if judged(error, ref.uncertainty) else "below the reference's uncertainty"
                            for error, ref in zip(errors, references.values())), len(finer_of(one, good))])
        else:
            out.writerow([one.name(), one.ending, *[""] * (7 + 3 * len(references))])
    return stream.getvalue()
