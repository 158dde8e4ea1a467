"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import of_a_box
from verify import Breaks, Check, Figure, Pair, Report, Table, created

CATALOGUE = ("C-4",)
CLAIM = "An oblique impact of two free blocks with friction conserves momentum and angular momentum."
EVIDENCE = "invariant"
DRIVER = "scene"

MASS = 7850 * 0.03**3  # [kg] of the upper block
MOMENTUM, SPIN = of_a_box(MASS, (0.03, 0.03, 0.03), (0.006, -0.004, 0.0169), (8, 3, -20))
P0 = sqrt(sum(p * p for p in MOMENTUM))  # [kg m/s]
L0 = P0 * 0.03                           # [kg m2/s] momentum times the size of the block


def change(run, name):
    """The largest change of a component of a vector of the ledger."""
    return max(abs(a - b) for a, b in zip(run.ledger(name), run.ledger(f"initial_{name}")))


def momentum(run):
    return Pair(change(run, "momentum"), 0, "kg m/s", scale=P0)


def angular_momentum(run):
    return Pair(change(run, "angular_momentum"), 0, "kg m2/s", scale=L0)


def start(run):
    """The momentum the scene starts with is the one meant."""
    return Pair(run.ledger("initial_momentum")[2], MOMENTUM[2], "kg m/s")


def heat(run):
    """Energy that friction took, over the initial one: the impact did rub."""
    return Pair(run.account("interface")["dissipated"]["friction"]["value"] / run.ledger("initial_kinetic"), 0, "", scale=1)


def parted(run):
    """Force at the end over the largest: the blocks have parted, so the impact is whole."""
    force = run.column("normal_force")
    return Pair(force[-1] / max(force), 0, "", scale=1)


OPTIONS = [("as it is", {}), ("sides exchanged", {"contacts[0].apexes": "lower.z_high", "contacts[0].base": "upper.z_low"}),
           ("two passes", {"contacts[0].passes": "two"}), ("weights of the paper", {"contacts[0].weights": "paper"}),
           ("a penalty times the area of the base", {"contacts[0].method": "penalty", "contacts[0].area": "base"}), ("by a penalty",
                                                                {"contacts[0].method": "penalty"}),
           ("no friction", {"contacts[0].friction": 0})]


def options(run):
    rows = []
    for name, change_of in OPTIONS:
        one = run.again(change_of)
        sources = [a for n, a in one.summary["ledger"]["accounts"].items() if n.startswith("interface")]
        rubbed = sum(a["dissipated"].get("friction", {"value": 0.0})["value"] for a in sources)
        booked = [sum(a["angular_impulse"]["value"][i] for a in sources) for i in range(3)]
        rows.append([name, f"{momentum(one).error():.1e}", f"{angular_momentum(one).error():.1e}",
                     f"{sqrt(sum(b * b for b in booked)) / L0:.1e}", f"{100 * rubbed / one.ledger('initial_kinetic'):.2f} %",
                     f"{100 * one.created():.3f} %"])
    return rows


CHECKS = [
    Check("momentum at the start", start, 1e-12, "round-off: the scene is the one meant"),
    Check("change of momentum", momentum, 1e-12, "the catalogue's bound: contact gives what it takes"),
    Check("change of angular momentum", angular_momentum, 1e-12, "the catalogue's bound, with consistent weights"),
    Check("created energy", created, 1e-5, "multipliers create nothing but where iterations end too early: 1e-6; a penalty has 9e-5"),
    Check("force at the end", parted, 0, "an impact that is over"),
    Report("heat of friction", heat, "it must be there for the audit to mean something"),
]

STUDIES = [
    Table("Changes over the momentum of the upper block, and over that times its side; what the interface books as angular "
          "impulse; heat and created energy over the initial kinetic energy.",
          ["option", "momentum", "angular momentum", "angular impulse booked", "heat", "created"], options),
]

BREAKS = [
    Breaks("change of angular momentum", "equal weights for friction, as the paper has them", {"contacts[0].weights": "paper"}),
    Breaks("change of momentum", "gravity left on", {"gravity": "[0 m/s^2, 0 m/s^2, -9.81 m/s^2]"}),
    Breaks("force at the end", "stopped early", {"time.end": "8 us"}),
    Breaks("momentum at the start", "another steel", {"bodies[1].material.density": "7800 kg/m^3"}, full=True),
    Breaks("created energy", "the usual penalty", {"contacts[0].method": "penalty"}, full=True),
]


def momenta(run):
    times = [1e6 * t for t in run.column("time")]
    both = [[a + b for a, b in zip(run.column(f"upper_{c}"), run.column(f"lower_{c}"))] for c in "xz"]
    return [("upper, z", times, run.column("upper_z")), ("lower, z", times, run.column("lower_z")), ("both, z", times, both[1]),
            ("upper, x", times, run.column("upper_x")), ("lower, x", times, run.column("lower_x")), ("both, x", times, both[0])]


def kept(run):
    end = 1e6 * run.column("time")[-1]
    return [(f"kept, {'xyz'[i]}", [0, end], [MOMENTUM[i]] * 2) for i in (2, 0)]


FIGURES = [Figure("momentum", "time [us]", "momentum [N s]", momenta, exact=kept, error=False,
                  caption="Momentum of the two blocks down (z) and along (x): the impact takes it from one, friction too, and gives it to "
                          "the other.")]
