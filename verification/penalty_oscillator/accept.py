"""How close is close enough, why, and what must break."""
from reference import bound, contact_time, critical_step, depth, largest_rebound, peak_force
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table

CATALOGUE = ("C-1",)
CLAIM = ("Two masses on one contact element of any kind touch for half a period, reach the exact peaks, gain only the energy that "
         "sampling creates, and are stable up to the linear limit.")
EVIDENCE = "exact"
DRIVER = "penalty_oscillator"

FINE = {"step": 0.002, "phases": 1}
STEPS = (0.05, 0.1, 0.2, 0.5)
KINDS = ("tetrahedral", "triangular", "line")


def changed(run, change):
    """With the changes of a break on top."""
    return run.other("penalty_oscillator", "verification/penalty_oscillator/case.yaml", {**change, **run.overrides})


def fine(name, exact, unit, kind="tetrahedral"):
    return lambda run: Pair(changed(run, {**FINE, "element": kind}).result(name), exact(), unit)


def rebound(step, kind="tetrahedral"):
    def measure(run):
        return Pair(changed(run, {"step": step, "element": kind}).result("rebound_largest"), largest_rebound(step), "")
    return measure


def beyond_bound(run):
    """The largest rebound over the bound of all phases, less one; zero where it stays below."""
    worst = max(changed(run, {"step": step}).result("rebound_largest") / bound(step) - 1 for step in STEPS)
    return Pair(max(worst, 0.0), 0, "", scale=1)


def limit(kind="tetrahedral"):
    return lambda run: Pair(changed(run, {**FINE, "element": kind}).result("critical_step"), critical_step(), "s")


def vote(kind="tetrahedral"):
    """The step an interface votes for lets a bounce create 0.5 %: 2 sqrt(0.005/1.005) of sqrt(m/k)."""
    exact = critical_step() * (0.005 / 1.005)**0.5
    return lambda run: Pair(changed(run, {**FINE, "element": kind}).result("voted_step"), exact, "s")


def largest(name):
    return lambda run: Pair(run.result(name), 0, "", scale=1)


def by_step(run):
    rows = []
    for step in STEPS:
        here = run.again({"step": step})
        rows.append([f"{step:g}", *(f"{here.result(name) / exact:.5f}" for name, exact in
                                    (("contact_time", contact_time()), ("peak_force", peak_force()), ("penetration", depth()))),
                     f"{here.result('rebound_smallest'):.5f}", f"{here.result('rebound_largest'):.5f}", f"{largest_rebound(step):.5f}",
                     f"{bound(step):.5f}"])
    return rows


AT = "at steps of 0.002 sqrt(m/k)"
CHECKS = [
    *[Check(f"{kind}: contact time", fine("contact_time", contact_time, "s", kind), 1e-5, f"{AT}, crossings drawn straight: second order")
      for kind in KINDS],
    *[Check(f"{kind}: peak force", fine("peak_force", peak_force, "N", kind), 1e-5,
            f"{AT}: second order, and the printed digits of the catalogue") for kind in KINDS],
    *[Check(f"{kind}: depth", fine("penetration", depth, "m", kind), 1e-5, "as the peak force") for kind in KINDS],
    *[Check(f"tetrahedral: rebound at steps of {step:g} sqrt(m/k)", rebound(step), 1e-9,
            "the worst of 400 phases, as the recursion of the reference has it: round-off") for step in STEPS],
    Check("triangular: rebound at steps of 0.2 sqrt(m/k)", rebound(0.2, "triangular"), 1e-9, "as over a facet"),
    Check("line: rebound at steps of 0.2 sqrt(m/k)", rebound(0.2, "line"), 1e-9, "as over a facet"),
    Check("rebound beyond the bound of all phases", beyond_bound, 1e-12, "a theorem: 1/sqrt(1 - D^2/4)"),
    *[Check(f"{kind}: critical step", limit(kind), 1e-5,
            "bisected with the closed element over 2000 steps: growth by 1e5 tells 4e-6 beyond the limit")
      for kind in KINDS],
    *[Check(f"{kind}: voted step", vote(kind), 1e-12, "a formula of masses and stiffness") for kind in KINDS],
    Report("ledger: created energy less what was gained", largest("booked_amiss"),
           "what the interface creates is booked to it, in all phases: round-off. No key books it amiss, so this gates nothing"),
    Report("momentum", largest("momentum_lost"),
           "contact gives what it takes: round-off. No key makes a force one-sided, so this gates nothing; all runs have a gate of it"),
    Report("rebound of the catalogue at 0.5 sqrt(m/k)", lambda run: Pair(changed(run, {"step": 0.5}).result("rebound_largest"), 1.0222, ""),
           "its worst phase lies between the 400 tried here; 40000 give 1.02222"),
]

STUDIES = [
    Falls("tetrahedral: contact time", along="step", values=[0.2, 0.1, 0.05], order=1.9),
    Table("Over the exact values, at a first sample half a step behind the touch; rebound over all phases.",
          ["step over sqrt(m/k)", "contact time", "peak force", "depth", "least rebound", "largest rebound", "reference", "bound"],
          by_step),
]

APEX, BASE = "the apex weighs as much as its base", "the mass of the base given to each of its nodes"
TWICE = "a step more than twice too long"
BREAKS = [
    Breaks("tetrahedral: rebound at steps of 0.05 sqrt(m/k)", "a step ten times too long", {"step": 0.5}),
    Breaks("tetrahedral: rebound at steps of 0.5 sqrt(m/k)", "one phase taken for the worst", {"phases": 1}),
    Breaks("tetrahedral: peak force", "a step of 0.5 sqrt(m/k)", {"step": 0.5}),
    Breaks("tetrahedral: contact time", "the force weighed by the area of the base facet", {"area": "base"}),
    Breaks("tetrahedral: peak force", "the force weighed by the area of the base facet", {"area": "base"}),
    Breaks("tetrahedral: depth", "the mass of the base given to each of its nodes", {"masses.base": "9 kg"}),
    Breaks("triangular: contact time", BASE, {"masses.base": "6 kg"}),
    Breaks("line: peak force", APEX, {"masses.apex": "3 kg"}),
    Breaks("tetrahedral: critical step", "the spring counted twice", {"stiffness": "2e6 N/m"}),
    Breaks("tetrahedral: voted step", "the base taken for a rigid wall", {"masses.base": "1e9 kg"}),
    *(Breaks(f"{kind}: {what}", mistake, {"masses.base": "6 kg"} if kind == "triangular" else {"masses.apex": "3 kg"}, full=True)
      for kind, what, mistake in (("line", "contact time", APEX), ("triangular", "peak force", BASE), ("triangular", "depth", BASE),
                                  ("line", "depth", APEX))),
    *(Breaks(f"{kind}: rebound at steps of {step} sqrt(m/k)", mistake, {"step": 0.5}, full=True)
      for kind, step, mistake in (("tetrahedral", 0.1, "a step five times too long"), ("tetrahedral", 0.2, TWICE),
                                  ("triangular", 0.2, TWICE), ("line", 0.2, TWICE))),
    *(Breaks(f"{kind}: {what}", mistake, change, full=True) for kind in ("triangular", "line")
      for what, mistake, change in (("critical step", "the spring counted twice", {"stiffness": "2e6 N/m"}),
                                    ("voted step", "the base taken for a rigid wall", {"masses.base": "1e9 kg"}))),
    Breaks("rebound beyond the bound of all phases", "a step half as long again as asked for", {"step": 0.75}),
]


def bounce(run):
    """At a fine and at a coarse step, from the touch on."""
    shown = []
    for name, step in (("0.05", 0.05), ("0.5", 0.5)):
        here = run.again({"step": step})
        first = next(i for i, gap in enumerate(here.column("gap")) if gap < 0)
        t, gap = here.column("time"), here.column("gap")
        touch = t[first] - (t[first] - t[first - 1]) * gap[first] / (gap[first] - gap[first - 1])
        shown.append((f"steps of {name} sqrt(m/k)", [1e3 * (x - touch) for x in t[first:]],
                      [f / 1e3 for f in here.column("force")[first:]]))
    return shown


def exact_bounce(_run):
    from math import pi, sin
    times = [contact_time() * i / 200 for i in range(201)]
    return [("exact", [1e3 * t for t in times], [peak_force() / 1e3 * sin(pi * t / contact_time()) for t in times])]


SHOWN = [0.05 * 10**(i / 12) for i in range(13)]


def rebounds(run):
    found = [run.again({"step": f"{step:.6f}", "phases": 200}) for step in SHOWN]
    return [("largest of 200 phases", SHOWN, [here.result("rebound_largest") for here in found]),
            ("smallest of 200 phases", SHOWN, [here.result("rebound_smallest") for here in found])]


def exact_rebounds(_run):
    fine_steps = [0.05 * 10**(i / 120) for i in range(121)]
    return [("recursion", fine_steps, [largest_rebound(step, 100) for step in fine_steps]), ("bound", fine_steps,
        [bound(step) for step in fine_steps])]


FIGURES = [Figure("force", "time since the touch [ms]", "force [kN]", bounce, exact=exact_bounce,
                  caption="The force of one bounce at a fine and at a coarse step."),
           Figure("rebound", "step over sqrt(m/k) [-]", "speed apart over speed of approach [-]", rebounds, exact=exact_rebounds,
                  caption="What sampling creates: the worst phase swings with the step below a bound that no phase exceeds.")]
