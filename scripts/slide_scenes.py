"""Slides at random whose answer is known: a box slides on the flat face of another box, and the tangential force is the coefficient of
friction times the normal force. scripts/slides runs them.

A slide is drawn from a seed and its number alone. Ranges and durations come from mechanics:

- The block is so low that the moment of friction shifts the centre of pressure by at most an eighth of its length (LEAN). So every part of
  the sole stays pressed: lift-off begins at a sixth.
- The normal load grows smoothly over five of the longest natural periods of the bodies (PERIODS), and the measurement begins one period
  later. Rigid bodies have no period; their load grows over a third of the window.
- During the window, the block slides over at least two cells of the floor and one of its own. So nodes of both bodies pass edges.
- The load of elastic bodies is so small that nodes keep sliding forward, so that friction has one direction. A release of all friction
  sends a wave whose speed of nodes is at most a part of the speed of sliding: 0.3 up to a coefficient of 0.3 (WAVE). Beyond, constant
  friction excites vibrations of elastic blocks until they lift off, with several times the load; there the part is 0.002 (WAVE_ROUGH).
- The window of a driven elastic block with friction is at most 30 periods long (MOST_PERIODS), or 10 beyond a coefficient of 0.3
  (MOST_ROUGH): these vibrations grow with each period, the faster the more friction there is. The speed grows where it would be longer,
  up to 0.05 of that of shear waves (FASTEST).
- A free block keeps at least 0.6 of its speed.
"""
import dataclasses
import math
import random

KINDS = ("rigid", "steel", "soft")
MATERIALS = {  # density [kg/m^3], Young's modulus [Pa], Poisson's ratio [-]; of rigid bodies only the density counts
    "rigid": (1000.0, 10e6, 0.3), "steel": (7850.0, 210e9, 0.3), "soft": (1000.0, 10e6, 0.3)}
SPEEDS = {"rigid": (0.3, 20.0), "steel": (1.0, 40.0), "soft": (0.3, 2.0)}      # [m/s]
LARGEST_LOAD = {"rigid": 1e6, "steel": 50e6, "soft": 30e3}                    # [Pa]
CONTACTS = ("automatic", "two", "one_floor", "one")
GRAVITY = 9.81          # [m/s2]
LEAN = 1 / 8            # [-] shift of the centre of pressure over the length of the block, at most
PERIODS = 5             # of the longest natural period, over which the load grows
MOST_PERIODS, MOST_ROUGH = 30, 10  # in the window of a driven elastic block
FASTEST = 0.05          # [-] speed that such a block is given for that, over the speed of shear waves
SMOOTH = 0.3            # [-] largest coefficient of friction that excites no vibrations
WAVE, WAVE_ROUGH = 0.3, 0.002  # [-] speed of nodes in the wave that a release of friction sends, over the speed of sliding
KEPT = 0.6              # [-] part of its speed that a free block keeps
MOST_CELLS = 32         # of the floor in one direction
PRESSED = ("top", "trailing", "leading")


@dataclasses.dataclass(frozen=True)
class Slide:
    """One slide, in SI units and degrees. Lengths and cells are those of the block in its own directions x, y, z."""
    number: int
    kind: str                # material of the block, or rigid
    floor: str               # the same of the floor
    drive: str               # free: initial velocity and gravity; else the part of the block that is driven: top, trailing or leading face
    start: str               # moving: with full speed; resting: the speed grows as the load does
    moves: str               # block or floor
    friction: float
    speed: float
    direction: float         # of the velocity of the block relative to the floor, from x
    yaw: float               # of the block about z
    length: tuple
    cells: tuple
    floor_cell: float        # of the floor, along x and y
    floor_height: float
    floor_layers: int
    shift: tuple             # of the corner of the block from mesh lines of the floor, in cells of the floor
    gap: float
    load: float              # pressure on the top, or gravity [m/s2] of a free block
    ramp: float              # [s] over which load and speed grow
    settled: float           # [s] when the window begins
    end: float

    def name(self):
        return f"{self.number:06d}{'' if self.moves == 'block' else 'f'}"

    def other(self):
        """The same slide with the other body moving."""
        return dataclasses.replace(self, moves="floor" if self.moves == "block" else "block")

    def heading(self):
        """The unit vector of the velocity of the block relative to the floor."""
        return exact_direction(self.direction)

    def cell(self):
        """The smallest cell along the faces that touch."""
        return min(self.floor_cell, *(size / n for size, n in zip(self.length[:2], self.cells)))

    def floor_carries(self):
        """Whether nodes of the floor alone hold the block: the hull of those below it always has the centre of pressure in it."""
        return min(self.length[:2]) * (1 if self.yaw == 0 else math.sqrt(0.5)) >= 3 * self.floor_cell


def exact_direction(degrees):
    """(cosine, sine) of an angle, exact where it is a multiple of 90 degrees.

    >>> exact_direction(180.0), exact_direction(90.0)
    ((-1.0, 0.0), (0.0, 1.0))
    """
    quarter = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}
    return quarter.get(degrees % 360) or (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))


def rounded(value, digits=6):
    """
    >>> rounded(0.123456789)
    0.123457
    """
    return float(f"{value:.{digits}g}")


def shear_speed(kind):
    """Speed of shear waves [m/s].

    >>> round(shear_speed("steel"))
    3208
    """
    density, young, poisson = MATERIALS[kind]
    return math.sqrt(young / (2 * (1 + poisson)) / density)


# ------------------------------------------------------------------------------------------------
# Drawing

def draw(seed, number):
    """The slide of this number.

    >>> draw(1, 0) == draw(1, 0), draw(1, 0) == draw(2, 0), draw(1, 4).kind
    (True, False, 'steel')
    """
    chance = random.Random(f"slides {seed} {number}")
    some = chance.uniform
    kind = KINDS[number % len(KINDS)]
    floor = "rigid" if kind == "rigid" or chance.random() < 0.25 else kind
    drive = chance.choices(("free", "top", "trailing", "leading"), (30, 25, 25, 20))[0]
    start = "moving" if drive == "free" or chance.random() < 0.6 else "resting"
    moves = chance.choice(("block", "floor"))
    friction = 0.0 if chance.random() < 0.15 else round(some(0.02, 0.9), 3)
    low, high = SPEEDS[kind]
    speed = rounded(low * (high / low) ** chance.random(), 4)
    direction = chance.choices((0.0, 180.0, round(some(0, 360), 2)), (50, 15, 35))[0]
    yaw = chance.choices((0.0, 45.0, round(some(1, 89), 2)), (55, 5, 40))[0]

    cells = [chance.randint(2, 5), chance.randint(2, 5)]
    size = some(0.05, 0.2) / cells[0]                        # of a cell of the block
    across = size * (1.0 if chance.random() < 0.4 else some(0.7, 1.4))
    length = [rounded(cells[0] * size), rounded(cells[1] * across)]
    arm = 1.0 if drive == "top" else 0.5                     # of the moment of friction, in heights of the block
    height = min(some(0.3, 1.0) * length[0], LEAN * min(length) / (arm * max(friction, 0.02)))
    length.append(rounded(height))
    cells.append(max(1, round(height / size)))

    ratio = chance.choices((1.0, 2.0, 0.5, rounded((1 / 3) * 9 ** chance.random(), 4)), (20, 10, 10, 60))[0]
    floor_cell = length[0] / cells[0] / ratio
    layers, flat = chance.randint(1, 2), some(0.7, 1.3)
    shift = chance.choices(((0, 0), (0, 1), (1, 0), (1, 1)), (35, 10, 20, 35))[0]
    shift = tuple(part * round(some(0.01, 0.99), 4) for part in shift)
    apart = 0.0 if chance.random() < 0.35 else 10 ** some(-6, -3)   # in cells
    pressed = some(0.2, 1.0)

    while True:
        floor_cell = rounded(floor_cell)
        slide = Slide(number, kind, floor, drive, start, moves, friction, speed, direction, yaw, tuple(length), tuple(cells), floor_cell,
                      rounded(floor_cell * flat * layers), layers, shift, 0.0, 0.0, 0.0, 0.0, 0.0)
        slide = timed(dataclasses.replace(slide, gap=rounded(apart * slide.cell())))
        slide = dataclasses.replace(slide, load=load_of(slide, pressed))
        if max(n for _, _, n in floor_extent(slide)) <= MOST_CELLS:
            return slide
        floor_cell *= 1.25


def load_of(slide, part):
    """Pressure on a driven block [Pa], a part of the largest; gravity of a free one [m/s2]."""
    if slide.drive == "free":
        return GRAVITY
    most = LARGEST_LOAD[slide.kind]
    if slide.kind == "rigid":
        return rounded(most * 10 ** (-3 * (1 - part)), 4)
    slow = (WAVE if slide.friction <= SMOOTH else WAVE_ROUGH) * slide.speed
    return rounded(part * min(most, MATERIALS[slide.kind][0] * shear_speed(slide.kind) * slow / max(slide.friction, SMOOTH)), 4)


def timed(slide):
    """The slide with its times; the speed grows where a free block would lose too much of it, or the window would be too long."""
    way = max(2.2 * slide.floor_cell, 1.1 * max(size / n for size, n in zip(slide.length[:2], slide.cells)))  # in the window
    period = 0.0
    if slide.kind != "rigid":
        heights = slide.length[2] + (0 if slide.floor == "rigid" else slide.floor_height)
        period = max(4 * heights, 2 * max(slide.length[:2])) / shear_speed(slide.kind)
    speed = slide.speed
    while True:
        window = way / (speed * (KEPT if slide.drive == "free" else 1))
        ramp = window / 3 if slide.kind == "rigid" else PERIODS * period
        end = ramp + period + window
        if slide.drive == "free":
            fast = slide.friction * GRAVITY * (end - ramp / 2) <= (1 - KEPT) * speed
        else:
            most = math.inf if slide.friction == 0 else MOST_PERIODS if slide.friction <= SMOOTH else MOST_ROUGH
            fast = slide.kind == "rigid" or window <= most * period or speed > FASTEST * shear_speed(slide.kind)
        if fast:
            return dataclasses.replace(slide, speed=rounded(speed, 4), ramp=rounded(ramp), settled=rounded(ramp + period), end=rounded(end))
        speed *= 1.2


# ------------------------------------------------------------------------------------------------
# The scene

def travelled(slide):
    """The longest way of the block relative to the floor [m]."""
    return slide.speed * (slide.end - (slide.ramp / 2 if slide.start == "resting" else 0))


def floor_extent(slide):
    """[(low, high, cells)] of the floor along x and y: it reaches a cell further than the block on its way."""
    (a, b), (c, s) = slide.length[:2], exact_direction(slide.yaw)
    half = (abs(a * c) + abs(b * s)) / 2, (abs(a * s) + abs(b * c)) / 2
    found = []
    for size, reach, head, shift in zip((a, b), half, slide.heading(), slide.shift):
        way = head * travelled(slide)
        low, high = size / 2 - reach + min(0.0, way), size / 2 + reach + max(0.0, way)
        below = math.ceil(-low / slide.floor_cell - shift - 1e-6) + 1
        above = math.ceil(high / slide.floor_cell + shift + 1e-6) + 1
        found.append((-(below + shift) * slide.floor_cell, (above - shift) * slide.floor_cell, below + above))
    return found


def faces(slide):
    """{trailing: surface, leading: surface} of the block: those whose normals are nearest to the direction."""
    (hx, hy), (c, s) = slide.heading(), exact_direction(slide.yaw)
    along = {"x_high": hx * c + hy * s, "y_high": hy * c - hx * s}
    along |= {"x_low": -along["x_high"], "y_low": -along["y_high"]}
    return {"trailing": min(along, key=along.get), "leading": max(along, key=along.get)}


def scene(slide, contact):
    """The case in YAML.

    >>> "kind: automatic" in scene(draw(1, 0), "automatic"), "passes: two" in scene(draw(1, 0), "two")
    (True, True)
    """
    grown = f"min(1,t/{slide.ramp!r})^2*(3-2*min(1,t/{slide.ramp!r}))"
    speed = f"{slide.speed!r}" + (f"*{grown}" if slide.start == "resting" else "")
    head = slide.heading()
    (x0, x1, nx), (y0, y1, ny) = floor_extent(slide)
    lines = [f"# Slide {slide.name()} of scripts/slides, {contact}: a {slide.kind} block on a {slide.floor} floor, {slide.drive}.", "",
             "bodies:", "  - name: floor",
             f"    mesh: {{kind: box, low: {lengths(x0, y0, -slide.floor_height)}, high: {lengths(x1, y1, 0.0)}, "
             f"cells: [{nx}, {ny}, {slide.floor_layers}]}}", *body(slide.floor),
             "  - name: block",
             f"    mesh: {{kind: box, low: {lengths(0.0, 0.0, 0.0)}, high: {lengths(*slide.length)}, cells: {list(slide.cells)}}}"]
    if slide.yaw:
        about = lengths(slide.length[0] / 2, slide.length[1] / 2, 0.0)
        lines.append(f"    rotate: {{axis: [0, 0, 1], angle: {slide.yaw!r} deg, about: {about}}}")
    lines += [f"    move: {lengths(0.0, 0.0, slide.gap)}", *body(slide.kind), "", "contacts:", f"  - {pair(slide, contact)}", "", "planes:"]
    held = "floor" if slide.floor == "rigid" else "floor.z_low"
    away = ", ".join(f'"{-part!r}*{speed}"' for part in (*head, 0.0))
    lines.append(f"  - {{name: ground, kind: fixed, nodes: [{held}]}}" if slide.moves == "block" else
                 f"  - {{name: ground, kind: driven, nodes: [{held}], velocity: {{value: [{away}], unit: m/s}}}}")
    if slide.drive in PRESSED:
        nodes = "block" if slide.kind == "rigid" else f"block.{'z_high' if slide.drive == 'top' else faces(slide)[slide.drive]}"
        given = f', velocity: {{value: "{speed}", unit: m/s}}' if slide.moves == "block" else ""
        lines.append(f"  - {{name: drive, kind: constrained, nodes: [{nodes}], normal: [{head[0]!r}, {head[1]!r}, 0]{given}}}")
    lines += ["", "loads:"]
    if slide.drive in PRESSED:
        lines.append(f'  - {{name: weight, kind: pressure, surface: block.z_high, value: "{slide.load!r}*{grown}", unit: Pa}}')
    else:
        lines.append(f'  - {{name: weight, kind: body_force, body: block, value: ["0", "0", "-{slide.load!r}*{grown}"], unit: m/s^2}}')
    if slide.start == "moving":
        sign = 1 if slide.moves == "block" else -1
        first = ", ".join(f'"{sign * part * slide.speed!r}"' for part in (*head, 0.0))
        lines += ["", "initial:", f"  - {{body: {slide.moves}, velocity: [{first}], unit: m/s}}"]
    lines += ["", "probes:", *probes(slide, held), "",
              f"time: {{end: {slide.end!r} s}}", "", f"output: {{history_every: {slide.end / 200!r} s, frames_every: {slide.end!r} s}}"]
    return "\n".join(lines) + "\n"


def lengths(*values):
    return "[" + ", ".join(f"{value!r} m" for value in values) + "]"


def body(kind):
    """The lines of a body after its mesh."""
    density, young, poisson = MATERIALS[kind]
    material = f"    material: {{kind: elastic, density: {density!r} kg/m^3, young: {young!r} Pa, poisson: {poisson!r}}}"
    return ["    rigid: true", material] if kind == "rigid" else [material]


def pair(slide, contact):
    """The contact of the scene; `one` is the reference: the nodes of the sole over the face of the floor."""
    sides = {"automatic": "kind: automatic", "two": "apexes: block.skin, base: floor.skin, passes: two",
             "one_floor": "apexes: floor.z_high, base: block.skin", "one": "apexes: block.z_low, base: floor.z_high"}
    return f"{{name: touch, {sides[contact]}, friction: {slide.friction!r}}}"


def probes(slide, held):
    """What the judge reads: momenta and impulses, and where sole and floor are."""
    wanted = [(f"momentum_{c}", "momentum", "block", c) for c in "xyz"] + [(f"weight_{c}", "impulse", "weight", c) for c in "xyz"]
    if slide.drive in PRESSED:
        wanted += [(f"drive_{c}", "impulse", "drive", c) for c in "xy"]
    wanted += [(f"sole_{c}", "displacement", "block.z_low", c) for c in "xy"] + [("rise", "displacement", "block", "z")]
    wanted += [(f"floor_{c}", "displacement", held, c) for c in "xy"]
    return [f"  - {{name: {name}, quantity: {quantity}, of: {of}, component: {component}}}" for name, quantity, of, component in wanted]
