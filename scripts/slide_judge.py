"""What a slide of slide_scenes.py did, from its history, and whether that is right.

Everything follows from momenta and impulses, so the contact code is not asked for its own forces:

    normal impulse on the block        N = change of its momentum along z, less the impulse of weight or pressure
    tangential impulse on the block    T = change of its momentum along x and y, less the impulses of drive and weight

T must be -mu N along the direction of sliding, whatever the block oscillates. A free block must have the speed v0 - mu/m (integral of N),
which is v0 - mu g t as long as it rests on the floor; a driven one the speed of its drive. All are means over the window of the slide.
"""
import csv
import dataclasses
import math

# [-] largest error of the force, over the larger of mu N and N/10; largest error of the speed, over the speed at the start
LIMITS = {"rigid": (0.01, 1e-3), "steel": (0.01, 1e-3), "soft": (0.03, 0.03)}
LIFT = 0.05      # [-] of a cell: a block that rises by more above its start, in the mean of its nodes, has been lifted
OPEN = 0.1       # [-] of the mean normal force: below, the block does not rest on the floor
RIGHT, WRONG, RATTLING, STOPPED, WARNED = "right", "wrong", "rattling", "stopped", "warned"
VERDICTS = (RIGHT, RATTLING, WARNED, STOPPED, WRONG)


@dataclasses.dataclass
class Measured:
    """What a run did in its window; ratios [-]."""
    drive: float      # tangential over normal force, along the direction of sliding
    force: float      # error of the tangential force
    speed: float      # error of the speed
    lift: float       # rise of the block above its start, over the smallest cell
    least: float      # smallest normal force between two rows over its mean
    normal: float     # mean normal force [N]

    def good(self, kind):
        force, speed = LIMITS[kind]
        return self.force <= force and self.speed <= speed and self.lift <= LIFT  # false for a NaN


def read_history(path):
    """{column: values} of history.csv, without units."""
    with path.open(newline="", encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    return {name.split(" [")[0]: list(map(float, values)) for name, values in zip(head, zip(*rows))}


def measure(slide, columns):
    """What the columns of a history say of a slide."""
    times = columns["time"]
    first = min(range(len(times)), key=lambda i: abs(times[i] - slide.settled))
    rows, span = range(first, len(times)), times[-1] - times[first]
    none = [0.0] * len(times)
    tangential = [[p - columns[f"momentum_{c}"][0] - w - d for p, w, d in
                   zip(columns[f"momentum_{c}"], columns[f"weight_{c}"], columns.get(f"drive_{c}", none))] for c in "xy"]
    normal = [p - columns["momentum_z"][0] - w for p, w in zip(columns["momentum_z"], columns["weight_z"])]

    N = (normal[-1] - normal[first]) / span
    T = [(part[-1] - part[first]) / span for part in tangential]
    head, mu = slide.heading(), slide.friction
    off = math.hypot(*(t + mu * N * h for t, h in zip(T, head)))
    steps = [(normal[i + 1] - normal[i]) / (times[i + 1] - times[i]) for i in range(first, len(times) - 1)]
    rise = max(columns["rise"]) / slide.cell()
    return Measured(drive=-(T[0] * head[0] + T[1] * head[1]) / N if N else math.inf, force=off / (max(mu, 0.1) * N) if N > 0 else math.inf,
                    speed=error_of_speed(slide, columns, rows, normal), lift=rise, least=min(steps) / N if N > 0 else -math.inf, normal=N)


def error_of_speed(slide, columns, rows, normal):
    """Mean error of the velocity of the sole relative to the floor in these rows, over the speed at the start.

    Of a driven block only that along the drive counts: it is free to drift aside, and without friction nothing stops it.
    """
    times, head, first, last = columns["time"], slide.heading(), rows[0], rows[-1]
    span = times[last] - times[first]
    due = slide.speed
    if slide.drive == "free":
        lost = [slide.friction * impulse / mass_of(slide) for impulse in normal]
        due -= sum((lost[i] + lost[i + 1]) / 2 * (times[i + 1] - times[i]) for i in rows[:-1]) / span
    off = []
    for c, h in zip("xy", head):
        way = [s - f for s, f in zip(columns[f"sole_{c}"], columns[f"floor_{c}"])]
        off.append((way[last] - way[first]) / span - due * h)
    return math.hypot(*off) / slide.speed if slide.drive == "free" else abs(off[0] * head[0] + off[1] * head[1]) / slide.speed


def mass_of(slide):
    from slide_scenes import MATERIALS
    return MATERIALS[slide.kind][0] * math.prod(slide.length)


def verdict(slide, status, warned, measured, reference):
    """The verdict of a run with this exit status, and whether it warned.

    `reference` is what the declared pass did, None where it stopped or was not asked. Elastic blocks may rattle: the reference misses the
    limits too, and its block leaves the floor in the window.
    """
    if status != 0 or measured is None:
        return STOPPED
    if measured.good(slide.kind):
        return RIGHT
    if slide.kind != "rigid" and reference is not None and not reference.good(slide.kind) and reference.least < OPEN:
        return RATTLING
    return WARNED if warned else WRONG
