"""How close is close enough, why, and what must break. The criteria are in criteria.md, and were written before the first run."""
import sys
from pathlib import Path

from reference import FRICTION, SPEED, SPREAD, U_MEASURED

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "taylor_shots"))
from metal import Metal, breaks, checks, figures, points_of, studies  # noqa: E402

CATALOGUE = ()
CLAIM = "Bars of 4340 steel that struck a wall are as long, and as thick at the foot, as they were measured, within what is not known."
EVIDENCE = "experiment"
DRIVER = "scene"

METAL = Metal(Path(__file__).parent, like="JC",
              quick=[("JC", "4340", 208, 25.4), ("JC", "4340", 282, 12.7), ("JC", "4340", 343, 8.1)],
              representative=[("JC", "4340", 208, 295), ("JC", "4340", 343, 295), ("House", "4340 'Rc = 58'", 240, 294),
                              ("Gust", "4340 'Rc = 40'", 237, 732), ("Gust", "4340 'Rc = 40'", 160, 1285)],
              spread=SPREAD, speed=SPEED, friction=FRICTION, u_measured=U_MEASURED)


def validation_points(run):
    return points_of(METAL, run)


CHECKS = checks(METAL)
STUDIES = studies(METAL)
BREAKS = breaks("396 MPa")
FIGURES = figures(METAL)
