"""How close is close enough, why, and what must break. The criteria are in criteria.md, and were written before the first run."""
import sys
from pathlib import Path

from reference import FRICTION, SPEED, SPREAD, U_MEASURED

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "taylor_shots"))
from metal import Metal, breaks, checks, figures, points_of, studies  # noqa: E402

CATALOGUE = ()
CLAIM = "Bars of copper that struck a wall are as long, and as thick at the foot, as they were measured, within what is not known."
EVIDENCE = "experiment"
DRIVER = "scene"

METAL = Metal(Path(__file__).parent, like="soft",
              quick=[("JC", "OFHC", 190, 25.4), ("Gust", "ETP", 277, 30.0), ("Gust", "ETP", 181, 30.0)],
              representative=[("Gust", "ETP", 126, 295), ("JC", "OFHC", 190, 295), ("Gust", "ETP", 349, 295),
                              ("House", "OFHC", 176, 294), ("Gust", "ETP", 206, 724), ("Gust", "OFHC", 135, 1230)],
              spread=SPREAD, speed=SPEED, friction=FRICTION, u_measured=U_MEASURED,
              two_meshes=lambda shot: shot["speed"] > 320 or shot["temperature"] > 1100 and shot["density"] not in (8909, 8927))


def validation_points(run):
    return points_of(METAL, run)


CHECKS = checks(METAL)
STUDIES = studies(METAL)
BREAKS = breaks("45 MPa")
FIGURES = figures(METAL)
