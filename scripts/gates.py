"""What every run must keep, whatever its case asks: energy and both momenta are explained, and no source creates energy.

    unexplained energy             kinetic - initial - integration - sum of works, over the largest of these and the energy of the
                                   scene: what was stored at the start may have passed and returned
    unexplained momentum           momentum - initial - sum of impulses, over the largest of these
    unexplained angular momentum   the same of moments about the origin
    created energy                 the largest of any source at any row of history.csv, over the energy of the scene

The first three are round-off, so their limit is one number for all runs. Where impulses and momentum vanish by symmetry they are no
scale; there the sum of the nodes' momenta m |v| is one. It is at least 2 K / max |v|, which frames and history give; that or
the momentum that passed, times the largest distance from the origin, is the scale of the moments. A program of WITHOUT_FRAMES has no
length, so its moments are not judged where they vanish.
"""
import math

UNEXPLAINED = 1e-10  # [-] sums of some 1e5 steps round off by 1e-12; a source that is missing shows as a whole number
LEAST_AVAILABLE = 1e-6  # [-] of the initial kinetic energy, as in the ledger
CREATED = 0.01       # [-] twice the default bound of a single bounce; without it a contact may create 5 % before it stops the run

WITHOUT_FRAMES = ("penalty_oscillator",)

LIMITS = {"unexplained energy over the largest that passed": UNEXPLAINED,
          "unexplained momentum over the largest that passed": UNEXPLAINED,
          "unexplained angular momentum over the largest that passed": UNEXPLAINED,
          "created energy of any source at any time": CREATED}
ENERGY, MOMENTUM, ANGULAR, MADE = LIMITS


def errors(run):
    """{gate: its error, or None where nothing gives a scale} of a run; empty for a program that keeps no accounts. [-]"""
    ledger = run.summary["ledger"]
    accounts = ledger.get("accounts", {}).values()
    if not accounts:
        return {}
    found = {ENERGY: over(value_of(ledger["energy_residual"]),
                         [value_of(ledger[name]) for name in ("initial_kinetic", "kinetic")] + [value_of(one["work"]) for one in accounts] +
                         [energy_scale(ledger)]),
            MOMENTUM: unexplained(run, accounts, "momentum", "impulse", momentum_of_nodes),
            ANGULAR: unexplained(run, accounts, "angular_momentum", "angular_impulse", moment_of_nodes),
            MADE: created(run)}
    if run.ending in ("inverted_element", "not_finite"):  # it says itself that its numbers may be none
        return {gate: None if gate != MADE and error is not None and not math.isfinite(error) else error for gate, error in found.items()}
    return found


def unexplained(run, accounts, what, impulse, of_nodes):
    """The residual over what passed; if that is too small to be a scale, over the sum of the nodes' momenta as well."""
    ledger = run.summary["ledger"]
    residual = length(ledger[f"{what}_residual"])
    passed = [length(ledger[f"initial_{what}"]), length(ledger[what]), *(length(one[impulse]) for one in accounts)]
    error = over(residual, passed)
    if error <= UNEXPLAINED or not math.isfinite(residual):
        return error
    nodes = of_nodes(run)
    if nodes is None:
        return None if run.driver in WITHOUT_FRAMES else error
    return over(residual, [*passed, nodes])


def created(run):
    """The largest created energy of any source at any time over the energy scale of the ledger; 0 without any energy. [-]"""
    largest = max((abs(value) if value == value else math.inf for name, column in run.columns.items() if name.startswith("energy_created_")
                   for value in column), default=0.0)
    return over(largest, [energy_scale(run.summary["ledger"])])


def energy_scale(ledger):
    """The energy of the scene, without the floor below which a run is not stopped. [J]"""
    return max(value_of(ledger["initial_available"]), LEAST_AVAILABLE * value_of(ledger["initial_kinetic"]),
               value_of(ledger["initial_stored"]), value_of(ledger["external_work"]))


# ------------------------------------------------------------------------------------------------
# Scales from frames

def momentum_of_nodes(run):
    """A lower bound of the largest sum of m |v| over the nodes at any frame; 0 where all frames are at rest. [kg m/s]"""
    return max((bound for bound, _ in frames_of(run)), default=0.0)


def moment_of_nodes(run):
    """That or the largest momentum that passed, times the largest distance from the origin; None without frames. [kg m2/s]"""
    seen, ledger = frames_of(run), run.summary["ledger"]
    if not seen:
        return None
    passed = [length(ledger["initial_momentum"]), length(ledger["momentum"])]
    passed += [length(one["impulse"]) for one in ledger["accounts"].values()]
    return max(*passed, *(bound for bound, _ in seen)) * max(arm for _, arm in seen)


def frames_of(run):
    """[(2 K / max |v|, max |x|)] of each frame of the bodies."""
    if "energy_kinetic" not in run.columns or not (run.folder / "body.pvd").is_file():
        return []
    found = []
    for number in range(run.frames("body")):
        time, fields = run.frame("body", number)
        fastest = max((math.hypot(*v) for v in fields.get("velocity", [])), default=0.0)
        farthest = max((math.hypot(*x) for x in fields.get("points", [])), default=0.0)
        found.append((2 * run.at("energy_kinetic", time) / fastest if fastest > 0 else 0.0, farthest))
    return found


# ------------------------------------------------------------------------------------------------
# Numbers of the summary

def value_of(entry):
    """A number of the summary; what is not finite stands there as null."""
    value = entry["value"]
    return math.nan if value is None else value


def length(entry):
    return math.hypot(*(math.nan if c is None else c for c in entry["value"] or [None]))


def over(residual, scales):
    """A residual over the largest scale; infinite for what is no number, 0 for nothing over nothing."""
    if not all(math.isfinite(one) for one in (residual, *scales)):
        return math.inf
    residual, scale = abs(residual), max(abs(one) for one in scales)
    return residual / scale if scale > 0 else (0.0 if residual == 0 else math.inf)
