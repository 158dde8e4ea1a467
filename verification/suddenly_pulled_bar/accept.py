"""How close is close enough, why, and what must break."""
from defaults import NUMERICS
from reference import tip, turning_time
from verify import Breaks, Check, Falls, Figure, Pair

CLAIM = "A bar that is pulled suddenly stretches to twice its static elongation in the time $2L/c$."
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "scene"

BAR = {"force": 1e6, "length": 1, "area": 0.01, "density": 7850, "young": 210e9}
TURN = turning_time(1, 7850, 210e9)
USUAL = {f"bodies[0].element.viscosity.{term}": value for term, value in NUMERICS["viscosity"].items()}


def largest(run):
    return Pair(max(run.column("tip")), tip(TURN, **BAR), "m")


def time_of_largest(run):
    """Where the two straight flanks of the curve meet: the peak itself is rounded by the mesh."""
    up, down = run.at("tip", 0.7 * TURN), run.at("tip", 1.3 * TURN)
    speed = tip(TURN, **BAR) / TURN
    return Pair(TURN + 0.5 * (down - up) / speed, TURN, "s")


DEPARTURES = {"viscosity": "d'Alembert's waves have none; the default rounds the peak a little more, which one check has"}

CHECKS = [
    Check("largest displacement", largest, 0.01, "the mesh rounds the peak: 0.6 % with 50 cells, see the study"),
    Check("time of the largest displacement", time_of_largest, 2e-4,
          "the flanks are straight, so rows are joined without error; what rings about them are some 1e-4 of the largest displacement"),
    Check("largest displacement with the default viscosity", lambda run: largest(run.again(USUAL)), 0.03,
          "the viscosity takes the ringing behind the front, which falls with the mesh: some 1 % more with 50 cells"),
]

STUDIES = [
    Falls("largest displacement", along="bodies[0].mesh.cells", values=["[25, 1, 1]", "[50, 1, 1]", "[100, 1, 1]"], order=0.5),
]

BREAKS = [
    Breaks("largest displacement", "viscosity that swallows the wave", {"bodies[0].element.viscosity.linear": 1}),
    Breaks("time of the largest displacement", "the density of aluminium", {"bodies[0].material.density": "2700 kg/m^3"}),
    Breaks("largest displacement with the default viscosity", "a steel of 200 GPa", {"bodies[0].material.young": "200 GPa"}, full=True),
]


def moved(run):
    return [("Nereid", [1e3 * t for t in run.column("time")], [1e3 * u for u in run.column("tip")])]


def exact(run):
    times = [i / 200 * run.column("time")[-1] for i in range(201)]
    return [("d'Alembert", [1e3 * t for t in times], [1e3 * tip(t, **BAR) for t in times])]


FIGURES = [Figure("tip", "time [ms]", "displacement of the tip [mm]", moved, exact, caption="The tip of a bar that is pulled suddenly.")]
