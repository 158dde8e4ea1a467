"""How close is close enough, why, and what must break."""
from reference import EXTRAPOLATED, FOOT, MESHES, PUSH
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ()
CLAIM = ("A block pressed on a wider one with an unlike grid and pushed aside has the forces of CalculiX, and its foot sticks and slips "
         "where it does there.")
EVIDENCE = "benchmark"
DRIVER = "scene"

def down(run):
    return -run.column("down")[-1]


def aside(run):
    return run.column("aside")[-1]


def with_same_cells(measure, name):
    return lambda run: Pair(measure(run), MESHES[factor(run)][name], "N")


def converged(measure, name):
    return lambda run: Pair(measure(run), EXTRAPOLATED[name], "N")


def factor(run):
    return run.overrides.get("refine", 1)


def refined(by, measure):
    return lambda run: measure(run.again({**run.overrides, "refine": by}))


def foot(run):
    """[(place along the foot, displacement aside)] at the end, in order."""
    fields = run.frame("body")[1]
    nx, _, nz = (round(n) for n in run.case("bodies[0].mesh.cells"))
    of_upper = 2 * (nx + 1) * (nz + 1)
    rows = list(zip(fields["points"], fields["displacement"]))[of_upper:]
    return sorted((p[0], u[0]) for p, u in rows if abs(p[1]) < 1e-9 and abs(p[2] - 1) < 1e-9)


def worst_of_foot(run):
    return Pair(max(abs(u - other) for (_, u), (_, _, other) in zip(foot(run), FOOT[1])), 0, "m", scale=PUSH)


def meshes(run):
    rows = []
    for by in (1, 2, 4):
        one = run.again({"refine": by})
        of_it = [(measure(one), name) for measure, name in ((down, "press"), (aside, "aside"))]
        rows.append([f"{7 * by} x {7 * by} on {20 * by} x {10 * by}", *over(of_it, MESHES[by]), *over(of_it, EXTRAPOLATED),
                     *over([(MESHES[by][name], name) for name in EXTRAPOLATED], EXTRAPOLATED)])
    return rows


def over(numbers, reference):
    return [f"{100 * (number / reference[name] - 1):+.2f} %" for number, name in numbers]


DEPARTURES = {}

PRESS, ASIDE, SLIP = "force of the press", "force aside", "displacement of the foot aside, worst node, over the push"
SAME = ("elements of both programs bend without locking and meet the same corners; so the difference is to be below the mesh error, which "
        "CalculiX has with these cells: ")
CHECKS = [
    Check(f"{PRESS}, beside the same cells", with_same_cells(down, "press"), 0.01, SAME + "1.0 %"),
    Check(f"{ASIDE}, beside the same cells", with_same_cells(aside, "aside"), 0.02, SAME + "2.3 %"),
    Check(SLIP, worst_of_foot, 0.02, "nodes of CalculiX move by up to 1.3 % of the push when its cells are halved, and so may ours"),
    Check(f"{PRESS}, twice the cells", refined(2, with_same_cells(down, "press")), 0.005,
          SAME + "0.4 %, and 0.1 % of what the penalty gives way"),
    Check(f"{ASIDE}, twice the cells", refined(2, with_same_cells(aside, "aside")), 0.01, SAME + "1.1 %"),
    Check(f"{PRESS}, four times the cells, beside the extrapolated one", refined(4, converged(down, "press")), 0.003,
          "twice the mesh error of CalculiX with these cells, 0.13 %", full=True),
    Check(f"{ASIDE}, four times the cells, beside the extrapolated one", refined(4, converged(aside, "aside")), 0.01,
          "the same, 0.5 %", full=True),
]

STUDIES = [
    Table("Forces over those of CalculiX with the same cells, and over the extrapolated ones; last those of CalculiX over these.",
          ["cells", "press", "aside", "press, extrapolated", "aside, extrapolated", "CalculiX: press", "CalculiX: aside"], meshes,
          full=True),
]

NO_FRICTION, ONE_SIDE = {"contacts[0].friction": 0}, {"planes[0].nodes": "[lower.y_low, upper.y_low]"}
BREAKS = [
    Breaks(CHECKS[0].name, "plane stress: one side of the slice is free", ONE_SIDE),
    Breaks(CHECKS[1].name, "no friction", NO_FRICTION),
    Breaks(SLIP, "no friction", NO_FRICTION),
    *(Breaks(check.name, "plane stress: one side of the slice is free", ONE_SIDE, full=True) for check in CHECKS[5:]),
    Breaks(CHECKS[3].name, "plane stress: one side of the slice is free", ONE_SIDE, full=True),
    Breaks(CHECKS[4].name, "no friction", NO_FRICTION, full=True),
]


def foot_aside(run):
    rows = foot(run)
    return [("Nereid", [x for x, _ in rows], [1e6 * u for _, u in rows])]


def reference_foot(run):
    return [("CalculiX, the same cells", [x for x, *_ in FOOT[1]], [1e6 * u for *_, u in FOOT[1]]),
            ("CalculiX, twice the cells", [x for x, *_ in FOOT[2]], [1e6 * u for *_, u in FOOT[2]])]


FIGURES = [Figure("foot", "place along the foot [m]", "displacement aside [um]", foot_aside, exact=reference_foot,
                  caption="How far nodes of the foot have moved aside after the press and the push, over those of CalculiX.")]
