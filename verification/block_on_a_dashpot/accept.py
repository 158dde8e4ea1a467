"""How close is close enough, why, and what must break."""
from math import log

import reference
from verify import Breaks, Check, Falls, Figure, Pair, crossings

CLAIM = "A block released on springs with dashpots has the decrement, period and dissipated energy of a damped oscillator."
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "scene"

BLOCK = {"mass": 7850 * 0.1**3, "stiffness": 4 * 200e3, "damping": 4 * 60}
HUNG = {"gravity": 9.81, **BLOCK}
REST = reference.static_sag(**HUNG)
CYCLES = 6

LATE = "dashpots act half a step late, as if c dt/2 of the mass were missing, 0.025 %: half of that in the square root"


def downs(run):
    return [-height for height in run.column("height")]


def turns(run):
    """Where the block turns back, lowest and highest by turns: vertices of parabolas through three rows."""
    t, u = run.column("time"), downs(run)
    found = []
    for i in range(1, len(u) - 1):
        before, after = u[i] - u[i - 1], u[i + 1] - u[i]
        if before * after <= 0 and before != 0:
            left, right = before / (t[i] - t[i - 1]), after / (t[i + 1] - t[i])
            bend = (right - left) / (t[i + 1] - t[i - 1])
            slope = left + bend * (t[i] - t[i - 1])
            found.append(u[i] - slope**2 / (4 * bend))
    return found


def decrement(run):
    """Of whole swings, from lowest to highest, so that the place of rest does not enter."""
    u = turns(run)
    return Pair(log((u[0] - u[1]) / (u[2 * CYCLES] - u[2 * CYCLES + 1])) / CYCLES, reference.decrement(**BLOCK))


def period(run):
    """Between ways down through the place of rest."""
    passed = crossings(run.column("time"), downs(run), REST, rising=True)
    return Pair((passed[CYCLES] - passed[0]) / CYCLES, reference.period(**BLOCK), "s")


def lowest(run):
    return Pair(turns(run)[0], reference.sag(reference.period(**BLOCK) / 2, **HUNG), "m")


def heat(run):
    made = sum(run.account(f"spring_{corner}")["dissipated"]["damping"]["value"] for corner in "abcd")
    return Pair(made, reference.heat(run.case("time.end"), **HUNG), "J")


CHECKS = [
    Check("logarithmic decrement", decrement, 2e-4, LATE),
    Check("period", period, 2e-4, LATE),
    Check("lowest place", lowest, 1e-4, "what the decrement is wrong by counts a fourteenth here, 1e-5; a parabola stands for the turn "
                                        "between rows"),
    Check("heat", heat, 1e-4, "0.2 % of the energy still swing at the end, in a phase that ten periods have put wrong by 0.8 %: 2e-5"),
]

STUDIES = [
    Falls("period", along="time.safety", values=[0.9, 0.45, 0.225], order=0.9),
]

BREAKS = [
    Breaks("logarithmic decrement", "one of four dashpots left out", {"springs[3].damping": "0 N*s/m"}),
    Breaks("period", "the density of cast iron", {"bodies[0].material.density": "7200 kg/m^3"}),
    Breaks("lowest place", "no dashpots: twice the static sag", {f"springs[{i}].damping": "0 N*s/m" for i in range(4)}),
    Breaks("heat", "one of four springs twice as stiff", {"springs[0].stiffness": "400e3 N/m"}),
]


def swung(run):
    return [("Nereid", [1e3 * t for t in run.column("time")[::4]], [1e6 * height for height in run.column("height")[::4]])]


def exact(run):
    times = run.column("time")[::4]
    return [("damped oscillator", [1e3 * t for t in times], [-1e6 * reference.sag(t, **HUNG) for t in times])]


FIGURES = [Figure("height", "time [ms]", "height over the start [µm]", swung, exact, caption="A block let go on springs with dashpots.")]
