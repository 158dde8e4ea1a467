"""Compares a cell of the matrix with the same scene on a mesh twice as fine: which cells, which results, and the table.

The mesh is that of every body, with 8 elements for each hexahedron and 4 for each triangle. The results of a scene are those that its known
answers name:

    a velocity   of a body's centre at the end, as a vector, over the largest speed in the scene
    a place      how far a body's centre has gone, as a vector, over the length of its path
    a spin       the part of the angular momentum that is left
    a drag       the force that drags a body over the normal force, over the coefficient of friction, or over 0.1 where that is more

Where no answer names one, they are the velocities of the centres of all deformable bodies. An answer that is only a bound on a place names
none. The change of a cell is that of the result that changes most. Scales are those of the finer mesh.
"""
import dataclasses
import random
import statistics

import axes
import judge
import numpy as np

SEED = 20261129                 # of the cells that are drawn
SLIDING = "sliding"             # the axis that is a matrix of its own
OLD = "all but sliding"
CLOCK = 20.0                    # a finer mesh has 8 times the elements and twice the steps: so much more time
LIMITS = (0.05, 0.1)            # [-] of a change
COLUMNS = ("axis", "value", "scene", "option", "matrix", "verdict", "reason", "note", "result", "change", "finer", "seconds",
           "finer_seconds", "driver", "draw")


# ------------------------------------------------------------------------------------------------
# Cells

def matrix_of(axis):
    return SLIDING if axis == SLIDING else OLD


def drawn(cells, number, seed):
    """So many of the cells of each matrix, or all where there are fewer, in their order. The draw follows from the seed and from the names
    of the cells, so that a new cell changes at most one place of it."""
    found = []
    for matrix in (OLD, SLIDING):
        mine = [cell for cell in cells if matrix_of(cell.axis) == matrix]
        by_chance = sorted(mine, key=lambda cell: random.Random(f"{seed} {cell.name()}").random())
        names = {cell.name() for cell in by_chance[:number]}
        found += [cell for cell in mine if cell.name() in names]
    return found


def elements(made):
    """{body: number of elements} of a scene."""
    counts = {}
    for entry in made.case["bodies"]:
        mesh = entry["mesh"]
        counts[entry["name"]] = int(np.prod(mesh["cells"])) if mesh["kind"] == "box" else len(made.meshes[mesh["path"]].cells)
    return counts


def finer_scene(cell):
    """The scene of a cell on the mesh twice as fine. Where a scene does not split its files in all directions, the key `refine` does."""
    coarse, fine = cell.make(), cell.make(2)
    before, after = elements(coarse), elements(fine)
    for entry in coarse.case["bodies"]:
        name, mesh = entry["name"], entry["mesh"]
        parts = 4 if mesh["kind"] == "file" and coarse.meshes[mesh["path"]].cells.shape[1] == 3 else 8
        if mesh["kind"] == "file" and after[name] < parts * before[name]:
            return dataclasses.replace(coarse, case={"refine": 2, **coarse.case})
    return fine


# ------------------------------------------------------------------------------------------------
# Results

VELOCITIES, PLACES = ("moves", "returns", "no_faster", "slides"), ("stands", "stays")


def speed_of(seen, body, frame):
    """The root mean square of a body's velocities, which a spin is part of. [m/s]"""
    mass = seen.bodies[body].mass
    return float(np.sqrt(mass @ np.einsum("ni,ni->n", frame.v, frame.v) / mass.sum()))


def largest_speed(seen):
    """[m/s] of a body in any frame; what begins in contact may have stopped before the first one."""
    return max(max(float(np.linalg.norm(judge.came_with(seen, body))), *(speed_of(seen, body, frame) for frame in seen.frames))
               for body in seen.bodies)


def path_of(seen, body):
    """The length of the path of a body's centre, from its speeds. [m]"""
    times = np.array([frame.time for frame in seen.frames])
    speeds = np.array([np.linalg.norm(seen.velocity(body, frame)) for frame in seen.frames])
    return float(np.sum(np.diff(times) * (speeds[1:] + speeds[:-1]) / 2))


def way_of(seen, body):
    return seen.centre(body, seen.frames[-1]) - seen.centre(body, seen.frames[0])


def results_of(seen, expected):
    """{name: (value, scale)} of a run: the results by which two meshes are compared."""
    last, found = seen.frames[-1], {}
    for word, body, *more in (answer for answer in expected.answers if len(answer) > 1 and isinstance(answer[1], str)):
        if word in VELOCITIES:
            found[f"velocity of {body}"] = (seen.velocity(body, last), largest_speed(seen))
        elif word == "separates":
            found[f"velocity of {more[0]} from {body}"] = (seen.velocity(more[0], last) - seen.velocity(body, last), largest_speed(seen))
        elif word in PLACES:
            found[f"place of {body}"] = (way_of(seen, body), path_of(seen, body))
        elif word == "spins":
            found[f"spin of {body}"] = (np.array([judge.spin_left(seen, body, more[0])]), 1.0)
        elif word == "drags":
            found[f"drag of {body}"] = (np.array([judge.dragged_by(seen, body, *more[2:])]), max(more[0], 0.1))
    deformable = [entry["name"] for entry in seen.case["bodies"] if not entry.get("rigid")]
    return found or {f"velocity of {body}": (seen.velocity(body, last), largest_speed(seen)) for body in deformable}


def change(coarse, fine):
    """(name, change) of the result that changes most from one mesh to the other; ("", None) where there is none."""
    changes = []
    for name, (value, scale) in fine.items():
        off = float(np.linalg.norm(coarse[name][0] - value))
        changes.append((off / scale if scale > 0 else 0.0 if off == 0 else float("inf"), name))
    return max(changes)[::-1] if changes else ("", None)


# ------------------------------------------------------------------------------------------------
# The table

def within(rows, limit):
    """'12 (80 %)' of the rows whose change is known."""
    count = sum(float(row["change"]) <= limit for row in rows)
    return f"{count} ({100 * count / len(rows):.0f} %)" if rows else ""


def table_of(rows):
    """The lines of a table in Markdown: how far the results of each class of cells are from those of the finer mesh."""
    lines = ["| matrix | cells that are | cells | with results on both meshes | " + " | ".join(
        f"within {100 * limit:g} %" for limit in LIMITS) + " | median change |", "|---|---|" + "---|" * (3 + len(LIMITS))]
    for matrix in (OLD, SLIDING):
        for word in judge.CLASSES:
            mine = [row for row in rows if row["matrix"] == matrix
                    and judge.class_of(row["verdict"], row["reason"], row["note"]) == word]
            known = [row for row in mine if row["change"]]
            middle = f"{100 * statistics.median(float(row['change']) for row in known):.2g} %" if known else ""
            if mine:
                lines.append(f"| {matrix} | {word} | {len(mine)} | {len(known) or ''} | "
                             + " | ".join(within(known, limit) for limit in LIMITS) + f" | {middle} |")
    return lines
