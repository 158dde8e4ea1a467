"""How close is close enough, why, and what must break."""
from reference import SPEED, STEEL, large_strains, profile, small_strains
from verify import Breaks, Check, Figure, Miss, Pair, Report, Table

CATALOGUE = ("I-2",)
CLAIM = "A bilinear bar that hits a wall has the stress sigma_y + rho c_p (V - V_y) behind its plastic front."
EVIDENCE = "exact"
DRIVER = "scene"

BIG = "verification/plastic_bar_on_a_wall/big.yaml"
AREA, LENGTH = 25e-6, 1.0   # [m2] [m]
PART = 0.01                 # of the catalogue's speed and yield stress: small strains
SMALL = {"stress": PART * small_strains(**STEEL, speed=SPEED)["stress"], "strain": PART * small_strains(**STEEL, speed=SPEED)["strain"]}
LARGE = large_strains(**STEEL, speed=SPEED)
PLATEAU = (0.05e-3, 0.34e-3)    # [s] from the arrival of all elastic ringing to before the end
BEHIND = (0.03, 0.13)           # [m] reference positions: past the start-up, behind the front at 0.18 m


def wall_stress(run):
    """Force of the wall over the initial area. [Pa]"""
    return run.mean("wall_force", *PLATEAU) / AREA


def nodes(run, frame):
    """Reference position and displacement along the bar, one per cross-section: [(m, m), ...]."""
    t, fields = run.frame("body", frame)
    here = {}
    for (x, _, _), (u, _, _) in zip(fields["points"], fields["displacement"]):
        here[round(x, 9)] = u
    return t, sorted(here.items())


def shortening(run):
    """Mean of -du/dX behind the front at the end of the run. [-]"""
    _, line = nodes(run, -1)
    inside = [(x, u) for x, u in line if BEHIND[0] <= x <= BEHIND[1]]
    (x0, u0), (x1, u1) = inside[0], inside[-1]
    return (u0 - u1) / (x1 - x0)


def of_changes(run):
    """Changes of a break or a study that hold for the bar at full speed as well."""
    return {key: value for key, value in run.overrides.items() if "yield" not in key}


def big(run):
    return run.other("scene", BIG, of_changes(run))


def meshes(run):
    rows = []
    for cells in (100, 200, 400, 800):
        change = {"bodies[0].mesh.cells": f"[{cells}, 1, 1]"}
        small, large = run.again(change), big(run.again(change))
        rows.append([str(cells), *(f"{100 * (got / exact - 1):+.2f} %" for got, exact in (
            (wall_stress(small), SMALL["stress"]), (shortening(small), SMALL["strain"]),
            (wall_stress(large), LARGE["stress"]), (shortening(large), LARGE["strain"])))])
    return rows


FULL = {"bodies[0].element.kind": "full"}
WIDENS = ("0.3 % of stress: the bar widens as it flows, and rings across; where a cell of one point flows, nothing resists that its ends "
          "widen by turns. With springs, which do not flow, it is -0.8 %, with eight points 0.3 %")
DEPARTURES = {"integration": "the strain behind the front is also checked with eight points"}

CHECKS = [
    Check("plateau stress, small strains", lambda run: Pair(wall_stress(run), SMALL["stress"], "Pa"), 0.01,
          "the catalogue's bound; the plastic front rings and is some elements wide"),
    Check("strain behind the front, eight points, small strains", lambda run: Pair(shortening(run.again(FULL)), SMALL["strain"], "1"), 0.01,
          "the catalogue's bound; the stress's error divided by the slope of hardening: 0.15 % of stress are 0.8 % of strain"),
    Miss("strain behind the front, small strains", lambda run: Pair(shortening(run), SMALL["strain"], "1"), 0.01, "the same", WIDENS),
    Check("plateau stress, full speed", lambda run: Pair(wall_stress(big(run)), LARGE["stress"], "Pa"), 0.01,
          "the catalogue's bound, against the theory for large strains"),
    Check("strain behind the front, eight points, full speed",
          lambda run: Pair(shortening(big(run.again(FULL))), LARGE["strain"], "1"), 0.01, "as at small strains"),
    Miss("strain behind the front, full speed", lambda run: Pair(shortening(big(run)), LARGE["strain"], "1"), 0.01, "as at small strains",
         WIDENS),
    Report("plateau stress, full speed, against the theory for small strains",
           lambda run: Pair(wall_stress(big(run)), small_strains(**STEEL, speed=SPEED)["stress"], "Pa"),
           "force per initial area: the section grows by 4 %, which stiffens the bar against the front"),
]

STUDIES = [Table("Errors over the number of cells along the bar.",
                 ["cells", "stress, small", "strain, small", "stress, full", "strain, full"], meshes, full=True)]

NOMINAL = {"bodies[0].material.tangent": "2.4 GPa"}  # E_t + sigma_y: the slope of force per initial area at full speed
BREAKS = [
    Breaks("plateau stress, small strains", "a digit lost in the tangent", {"bodies[0].material.tangent": "0.2 GPa"}),
    Breaks("strain behind the front, eight points, small strains", "the slope of force per initial area taken for that of stress", NOMINAL),
    Breaks("plateau stress, full speed", "a digit lost in the tangent", {"bodies[0].material.tangent": "0.2 GPa"}),
    Breaks("strain behind the front, eight points, full speed", "a section too wide to follow: lateral inertia",
           {"bodies[0].mesh.high": "[1 m, 200 mm, 200 mm]"}),
]


def strain_over_position(run):
    _, line = nodes(run, 1)
    middles = [((a[0] + b[0]) / 2, (a[1] - b[1]) / (b[0] - a[0])) for a, b in zip(line, line[1:])]
    return [("Nereid", [x for x, _ in middles], [1e3 * e / PART for _, e in middles])]


def exact_strain(run):
    t, _ = nodes(run, 1)
    corners = profile(**STEEL, speed=SPEED, length=LENGTH, t=t)
    return [("Kármán and Taylor", [x for x, _ in corners], [1e3 * e for _, e in corners])]


def force_over_time(run):
    return [("a hundredth of the speed", [1e3 * t for t in run.column("time")], [f / AREA / 1e6 / PART for f in run.column("wall_force")])]


def exact_force(run):
    return [("small strains", [0, 1e3 * run.column("time")[-1]], [SMALL["stress"] / 1e6 / PART] * 2)]


FIGURES = [
    Figure("strain", "reference position [m]", "100 x strain [1e-3]", strain_over_position, exact=exact_strain,
           caption="Strain along the bar at 0.18 ms, a hundred times: the elastic front at 0.91 m, the plastic one at 0.09 m."),
    Figure("stress", "time [ms]", "100 x force over area [MPa]", force_over_time, exact=exact_force,
           caption="Force of the wall over the area of the bar, a hundred times."),
]
