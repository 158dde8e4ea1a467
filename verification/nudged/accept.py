"""How close is close enough, why, and what must break."""
import math

import throws
from reference import LIMIT
from verify import Breaks, Check, Figure, Miss, Pair, Table

CLAIM = ("A displacement of 1e-12 m changes no velocity by more than 1e-6 m/s, and neither do a mirror, other numbers or another order of "
         "bodies, but for six known misses of sixty.")
EVIDENCE = "invariant"
CATALOGUE = ()
DRIVER = "scene"
CASE = "verification/nudged/case.yaml"

# what differs by decisions that are not mended, by twin and seed: README.md, "Misses"
MISSED = {"mirrored, other numbers": (2, 11, 21, 22, 29), "bodies in another order": (19,)}
TWINS = {"nudged": throws.nudged, "mirrored, other numbers": throws.mirrored, "bodies in another order": throws.in_another_order}
OWN = "a shape of the program's own in a mirror"


def run_of(run, label, scene, more):
    path = throws.put_down(run.runner.scratch / "nudged", label, scene)
    return run.other(DRIVER, str(path), more)


VELOCITIES = {}   # by the folder of a run: the times and velocities of all frames


def velocities_of(one):
    if one.folder not in VELOCITIES:
        frames = (one.frame("body", number) for number in range(one.frames("body")))
        VELOCITIES[one.folder] = [(at, fields["velocity"]) for at, fields in frames]
    return VELOCITIES[one.folder]


def difference(numbers, signs, ours, theirs):
    return max(abs(a - s * b) for node, v in zip(numbers, ours) for a, b, s in zip(v, theirs[node], signs))


def curve(run, seed, name):
    """(times [s], the largest difference of a velocity of any node [m/s]) of a scene and its twin; a break is set in the twin alone."""
    scene = throws.throw(seed)
    twin, numbers, signs = TWINS[name](scene, seed)
    base = run_of(run, f"{seed}_base", scene, {})
    other = run_of(run, f"{seed}_{name.split(',')[0].replace(' ', '_')}", twin, run.overrides)
    if base.ending != other.ending or base.frames("body") != other.frames("body"):
        return [0.0], [math.inf]
    times, found = [], []
    for (at, ours), (_, theirs) in zip(velocities_of(base), velocities_of(other)):
        times.append(at)
        found.append(difference(numbers, signs, ours, theirs))
    return times, found


def largest(name):
    """Over all scenes; a break shows in the first of them."""
    seeds = [seed for seed in throws.SEEDS if seed not in MISSED.get(name, ())]
    return lambda run: Pair(max(max(curve(run, seed, name)[1]) for seed in (seeds[:3] if run.overrides else seeds)), 0, "m/s", scale=1)


def count(name):
    """How many of all scenes differ from their twins by more than the limit."""
    return lambda run: Pair(sum(max(curve(run, seed, name)[1]) > LIMIT for seed in throws.SEEDS), 0, "scenes", scale=1)


def own_shape(run):
    """Of case.yaml and mirrored.yaml, whose nodes stand at mirrored places: the largest difference of a velocity."""
    base, twin = run.other(DRIVER, CASE), run.other(DRIVER, "verification/nudged/mirrored.yaml", run.overrides)
    places = [start_of(one) for one in (base, twin)]
    number = {tuple(round(1e9 * x) for x in p): node for node, p in enumerate(places[1])}
    numbers = [number[tuple(round(1e9 * x) for x in (-p[0], *p[1:]))] for p in places[0]]
    frames = zip(velocities_of(base), velocities_of(twin))
    return Pair(max(difference(numbers, (-1, 1, 1), ours, theirs) for (_, ours), (_, theirs) in frames), 0, "m/s", scale=1)


def start_of(one):
    _, fields = one.frame("body", 0)
    return [[a + b for a, b in zip(*pair)] for pair in zip(fields["points"], fields["displacement"])]


def row(run, seed):
    scene = throws.throw(seed)
    found = (f"{max(curve(run, seed, name)[1]):.1e}" + (" (missed)" if seed in MISSED.get(name, ()) else "") for name in TWINS)
    return [seed, scene.kind, "declared" if scene.declared else "automatic", scene.friction, *found]


CHECKS = [Check(name, largest(name), LIMIT,
                "a gap that is larger by 1e-12 m is closed by 1e-7 m/s more in a step of 1e-5 s; a decision by round-off moves a velocity "
                "by 1e-4 m/s and more. Six other nudges of each scene moved 1e-9 to 8e-8 m/s", chaotic=True) for name in TWINS] + [
    Check(OWN, own_shape, 1e-9, "round-off of places, 1e-17 m, is five decades less than the displacement; seen: 2e-13"),
    Miss("mirrored, other numbers: scenes that differ by more", count("mirrored, other numbers"), 0.5, "none may",
         "in the mirror faces are cut along their other diagonal, which decides over what a free apex is beside a warped face"),
    Miss("bodies in another order: scenes that differ by more", count("bodies in another order"), 0.5, "none may",
         "of two boxes that are alike the one that is listed first has the apexes")]

STUDIES = [Table("The largest difference of a velocity in each scene [m/s].", ["seed", "scene", "contact", "friction", *TWINS],
                 lambda run: [row(run, seed) for seed in throws.SEEDS], full=True)]

BREAKS = [Breaks(name, "another friction in the twin", {"contacts[0].friction": "0.301"}) for name in (*TWINS, OWN)]


def growths(name):
    """Of scenes with different bodies: times [ms], and the largest difference so far, as the power of ten."""
    def curves(run):
        found = []
        for seed in (1, 2, 9, 18):
            times, differences = curve(run, seed, name)
            so_far = [max(differences[:n + 1]) for n in range(len(differences))]
            found.append((f"{seed}: {throws.throw(seed).kind}", [1e3 * t for t in times], so_far))
        return found
    return curves


FIGURES = [Figure("growth", "time [ms]", "largest difference of a velocity so far [m/s]", growths("nudged"), log=True,
                  exact=lambda run: [("limit", [0.1, 1e3 * throws.END], [LIMIT, LIMIT])],
                  caption="Differences of velocities after a displacement of 1e-12 m, in four of the scenes, with the limit.")]
