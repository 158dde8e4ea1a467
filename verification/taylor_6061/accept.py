"""How close is close enough, why, and what must break. The criteria are in criteria.md, and were written before the first run."""
import sys
from pathlib import Path

from reference import FRICTION, SPEED, SPREAD, U_MEASURED

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "taylor_shots"))
from metal import Metal, breaks, checks, figures, points_of, studies  # noqa: E402

CATALOGUE = ()
CLAIM = "Bars of 6061-T6 that struck a wall are as long, and as thick at the foot, as they were measured, within what is not known."
EVIDENCE = "experiment"
DRIVER = "scene"

METAL = Metal(Path(__file__).parent, like="T6",
              quick=[("Wilkins", "6061-T6", 275, 46.94), ("House", "6061-T6", 279, 22.785), ("Gust", "6061-T6", 358, 32.9)],
              representative=[("Wilkins", "6061-T6", 132, 294), ("Wilkins", "6061-T6", 275, 294), ("Wilkins", "6061-T6", 478, 294),
                              ("House", "6061-T6", 235, 294), ("Gust", "6061-T6", 194, 635)],
              spread=SPREAD, speed=SPEED, friction=FRICTION, u_measured=U_MEASURED,
              two_meshes=lambda shot: shot["length"] > 80 and shot["speed"] > 550)


def validation_points(run):
    return points_of(METAL, run)


CHECKS = checks(METAL)
STUDIES = studies(METAL)
BREAKS = breaks("162 MPa")
FIGURES = figures(METAL)
