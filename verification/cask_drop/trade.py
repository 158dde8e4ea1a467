"""What accuracy costs on the cask drop: the quarter at level 2, beside the full model and a sector, against the quarter at level 8."""
from accept import FEW_FRAMES, settlement, time_of
from trade_points import Converged, Meshes, Series

TITLE = "the cask drop"
CHANGE = {"model.kind": "quarter", "mesh.level": 2, **FEW_FRAMES}


def flow(run):
    """What plastic flow of the cladding takes, over the energy at the start. [-]"""
    return run.column("energy_cladding_plastic")[-1] / run.ledger("initial_kinetic")


RESULTS = [Converged("settlement", settlement, "m"), Converged("its time", time_of, "s"), Converged("flow of the cladding", flow)]
MESHES = Meshes((2, 3, 4))
KNOBS = {"mesh": (0.5, 1.5, 2, 3)}
CROSS = [{"mesh": ("x0.5", "x1", "x1.5", "x2", "x3"), "symmetry": ("full", "quarter", "sector"), "element": ("one_point", "full")}]
PRESETS = {2: ": fast", 3: ": balanced"}  # of cases/cask_drop/neptune.yaml, which has level 3; `reference` has 6
SERIES = Series("settlement", {f"{kind}, {points}": {"symmetry": kind, "element": element} for kind in ("full", "quarter", "sector")
                               for points, element in (("one point", "one_point"), ("eight points", "full"))},
                name_of=lambda factor: f"level {2 * factor:g}{PRESETS.get(2 * factor, '')}")
