"""What the folders verification/taylor_* have in common: checks, tables, breaks and figure of one metal. See docs/experiments.md."""
import dataclasses
from pathlib import Path

from shots import LEVELS, SIZES, computed, digitised, ended, label, measured, points, read_shots, shoot, u_inputs
from validation import COLUMNS, SUMMARY_COLUMNS, summary, u_of_meshes
from verify import Breaks, Check, Figure, Miss, Pair, Report, Table

LOST, MESHES = "runs of three shots that did not come to their end", "numerical uncertainty of the length, worst of three shots"
FRICTIONS = (0, 0.05, 0.1, 0.2, 0.3)  # beyond, the foot sticks
LENGTH, FOOT = "length, mean of computed over measured of three shots", "foot, mean of computed over measured of three shots"


@dataclasses.dataclass
class Metal:
    """One family of bars.

    like            the batch whose temper is that of the constants
    quick           (source, label, speed, length) of three shots of that batch, which the quick suite has
    representative  (source, label, speed, temperature) of the shots in which inputs are varied
    spread          standard uncertainties of constants of the material over their values; likewise `speed` of the measured speed
    friction        at the wall, somewhere between none and this
    u_measured      {quantity: standard uncertainty over the measured value}
    two_meshes      a function of a shot: whether its fine mesh, which takes minutes to hours, has not been run
    """
    folder: Path
    like: str
    quick: list
    representative: list
    spread: dict
    speed: float
    friction: float
    u_measured: dict
    two_meshes: object = None

    def __post_init__(self):
        self.family = self.folder.name
        self.shots = read_shots(self.folder)
        self.three = [the(self.shots, *one) for one in self.quick]
        self.varied = [the(self.shots, source, what, speed, temperature=temperature)
                       for source, what, speed, temperature in self.representative]


    def levels(self, shot):
        """The meshes that were run of a shot, coarse to fine."""
        return range(len(LEVELS) - 1 if self.two_meshes and self.two_meshes(shot) else len(LEVELS))


def the(shots, source, what, speed, length=None, temperature=None):
    """The first shot of these."""
    return next(shot for shot in shots if (shot["source"], shot["label"], shot["speed"]) == (source, what, speed)
                and (length is None or abs(shot["length"] - length) < 0.02) and (temperature is None or shot["temperature"] == temperature))


# ------------------------------------------------------------------------------------------------
# Measures

def lost(shots, levels_of):
    """How many runs of these shots did not come to their end."""
    return lambda run: Pair(sum(not ended(shoot(run, shot, level)) for shot in shots for level in levels_of(shot)), 0, "", scale=1)


def not_run(metal):
    """How many fine meshes were not run."""
    return lambda run: Pair(sum(len(metal.levels(shot)) < len(LEVELS) for shot in metal.shots), 0, "", scale=1)


def of_meshes(shots):
    """Standard numerical uncertainty of the length, the largest of these shots."""
    return lambda run: Pair(max(u_of_meshes(SIZES, [computed(shoot(run, shot, level), shot)["length"] for level in range(len(LEVELS))])
                                for shot in shots), 0, "", scale=1)


def mean_ratio(shots, quantity, level_of):
    """Mean of computed over measured."""
    def measure(run):
        ratios = [computed(shoot(run, shot, level_of(shot)), shot)[quantity] / measured(shot)[quantity]
                  for shot in shots if quantity in measured(shot)]
        return Pair(sum(ratios) / len(ratios), 1, "")
    return measure


def points_of(metal, run):
    """All points of the family."""
    of_inputs = {label(shot): u_inputs(run, shot, metal.spread, metal.speed, metal.friction) for shot in metal.varied}

    def u_of_measurement(shot, quantity):
        return (metal.u_measured[quantity]**2 + (0 if quantity == "length" else digitised(shot)**2))**0.5

    return points(run, metal.family, metal.shots, lambda shot: shot["batch"], of_inputs, u_of_measurement,
                  lambda shot, quantity: quantity == "length" and shot["seen"] == "yes", metal.levels)


def uncertain(metal):
    """How many lengths have a numerical uncertainty above 1 %."""
    return lambda run: Pair(sum(one.quantity == "length" and not one.u_num <= 0.01 for one in points_of(metal, run)), 0, "", scale=1)


def beside_lengths(metal, run):
    """What has no verdict: shortening, whose relative error is larger than that of a length near one, and the part that stays as it was."""
    rows = []
    for shot in metal.shots:
        given, found = measured(shot), computed(shoot(run, shot, metal.levels(shot)[-1]), shot)
        short, seen = 1 - found["length"], 1 - given["length"]
        rows.append([label(shot), f"{seen:.3f}", f"{short:.3f}", f"{100 * (short / seen - 1):+.0f} %",
                     f"{given['rear']:.3f}" if "rear" in given else "", f"{found['rear']:.3f}"])
    return rows


def hits(metal):
    def measure(run):
        like = [one for one in points_of(metal, run) if one.group == metal.like]
        return Pair(sum(one.verdict() == "hit" for one in like), len(like), "")
    return measure


def ends(metal, run):
    """How each shot ended on each mesh."""
    rows = []
    for shot in metal.shots:
        runs = [shoot(run, shot, level) for level in metal.levels(shot)]
        words = [one.summary["ending"]["word"] for one in runs] + ["not run"] * (len(LEVELS) - len(runs))
        rows.append([label(shot), shot["batch"], *words,
                     f"{runs[-1].column('plastic_strain')[-1]:.2f}", f"{min(one.result('bar_smallest_corner') for one in runs):.2f}",
                     f"{100 * max(abs(one.created()) for one in runs):.3f} %"])
    return rows


def of_friction(metal, run):
    """Computed over measured values by the friction at the wall, on the coarse mesh, of those shots whose foot was measured."""
    rows = []
    for shot in {label(shot): shot for shot in [*metal.three, *metal.varied] if "foot" in measured(shot)}.values():
        found = [computed(shoot(run, shot, 0, {"planes[2].friction": friction} if friction else None), shot) for friction in FRICTIONS]
        rows += [[label(shot), name, *(f"{one[name] / measured(shot)[name]:.3f}" for one in found)] for name in ("length", "foot")]
    return rows


# ------------------------------------------------------------------------------------------------
# What accept.py has

def checks(metal):
    alike = [shot for shot in metal.shots if shot["batch"] == metal.like]
    agreed = "a model error of 7 % was agreed on before the first run"
    over, why = "lengths with a numerical uncertainty above 1 %", "the criteria ask for less"
    unsure = [Miss(over, uncertain(metal), 0, why, "bars that flow into a disc, fast or hot; a fourth mesh was not run", full=True)
              if metal.two_meshes else Check(over, uncertain(metal), 0, why, full=True, like=MESHES)]
    unfinished = [Miss("fine meshes that were not run", not_run(metal), 0, "every shot has three meshes",
                       "each takes minutes to hours; the table of ends names them, and their numerical uncertainty is that of two meshes",
                       full=True)] if metal.two_meshes else []
    return [
        Check(LOST, lost(metal.three, lambda _: [0]), 0, "none may"),
        Check(MESHES, of_meshes(metal.three), 0.01, "what is below 1 % hides in no comparison", full=True),
        Check(LENGTH, mean_ratio(metal.three, "length", lambda _: 0), 0.07, agreed),
        Check(FOOT, mean_ratio(metal.three, "foot", lambda _: 0), 0.15,
              "twice that: the foot depends on the flow stress at one place and on friction there"),
        Check("runs of all shots that did not come to their end", lost(metal.shots, metal.levels), 0, "none may", full=True, like=LOST),
        Check("length, mean of computed over measured of the batch of the constants",
              mean_ratio(alike, "length", lambda shot: metal.levels(shot)[-1]), 0.07, agreed, full=True, like=LENGTH),
        *unsure,
        *unfinished,
        Report("hits among the points of the batch of the constants", hits(metal), "the model error of a hit cannot be told", full=True),
    ]


def studies(metal):
    return [
        Table("Bias and scatter by quantity and batch.", SUMMARY_COLUMNS, lambda run: summary(points_of(metal, run)), full=True),
        Table("All points.", list(COLUMNS), lambda run: [one.row() for one in points_of(metal, run)], full=True),
        Table("How each shot ended on three meshes; largest plastic strain, smallest corner, energy created.",
              ["shot", "batch", "coarse", "middle", "fine", "strain", "corner", "created"], lambda run: ends(metal, run), full=True),
        Table("Shortening over the first length, and undeformed rear part over it (within 1 % of the radius): no verdict.",
              ["shot", "measured", "computed", "error", "rear, measured", "rear, computed"], lambda run: beside_lengths(metal, run),
              full=True),
        Table("Computed over measured values by the friction at the wall, which is zero in all other tables; coarse mesh.",
              ["shot", "quantity", *map(str, FRICTIONS)], lambda run: of_friction(metal, run), full=True),
    ]


def breaks(half_of_the_yield_stress):
    soft = {"bodies[0].material.rate_coefficient": 0, "bodies[0].material.yield": half_of_the_yield_stress}
    said = "the rate forgotten, and half of the yield stress"
    return [
        Breaks(LOST, "ended too early", {"time.end": "10 us"}),
        Breaks(LENGTH, said, soft),
        Breaks(FOOT, said, soft),
        Breaks(MESHES, "hourglass springs, which do not flow, of five times the usual stiffness",
               {"bodies[0].element.hourglass_kind": "stiffness", "bodies[0].element.hourglass": 0.5}, full=True),
    ]


def figures(metal):
    shots = sorted(metal.three, key=lambda shot: shot["speed"])
    speeds = [shot["speed"] for shot in shots]
    return [Figure("length", "speed [m/s]", "final length over first length [-]",
                   lambda run: [("Nereid", speeds, [computed(shoot(run, shot, 0), shot)["length"] for shot in shots])],
                   exact=lambda _: [("measured", speeds, [measured(shot)["length"] for shot in shots])], caption="Lengths of three shots.")]
