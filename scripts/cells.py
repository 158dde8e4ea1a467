"""Meshes of a case made finer or coarser: by its key `refine`, or by keys that count cells, each times a factor."""

UNEVEN = 0.02     # [-] a count of cells that rounding moves by more does not follow its factor
SPLITS = (1, 2, 4)  # [-] the values of `refine` that meshes from files can follow
PRESETS = {"fast": 0.5, "balanced": 1.0, "reference": 2.0}  # [-] `refine` of the presets `accuracy`


def counts_of_cells(resolved, path="", name=""):
    """{path of the key: its value} of all keys that count cells, `level` of a `mesh` too, in a case as a driver resolved it."""
    found = {}
    items = resolved.items() if isinstance(resolved, dict) else enumerate(resolved) if isinstance(resolved, list) else ()
    for key, value in items:
        here = f"{path}[{key}]" if isinstance(resolved, list) else f"{path}.{key}" if path else key
        if isinstance(key, str) and (key.startswith("cells") or (name, key) == ("mesh", "level")):
            found[here] = number_of(value)
        elif isinstance(value, (dict, list)):
            found.update(counts_of_cells(value, here, key))
    return found


def number_of(value):
    """A number or list of numbers of a resolved case, without what stands around it."""
    if isinstance(value, dict) and "value" in value:
        return number_of(value["value"])
    return [number_of(one) for one in value] if isinstance(value, list) else value


def multiplied(count, factor):
    """A count or a list of counts times a factor, as --set writes it, and how far rounding moves it from there."""
    if isinstance(count, list):
        parts = [multiplied(one, factor) for one in count]
        return "[" + ", ".join(text for text, _ in parts) + "]", max(moved for _, moved in parts)
    wanted = count * factor
    kept = 1 if count == 1 else max(1, round(wanted))  # one cell across stays: such a direction has no mesh
    return str(kept), 0.0 if count == 1 else abs(kept / wanted - 1)


def settings_of(counts, factor):
    """The keys to set for this factor, and the largest move by rounding."""
    made = {key: multiplied(count, factor) for key, count in counts.items()}
    return {key: text for key, (text, _) in made.items()}, max((moved for _, moved in made.values()), default=0.0)


def refine_of(resolved):
    """What `refine` of a case is, by the key itself or by its preset. [-]"""
    if "refine" in resolved:
        return number_of(resolved["refine"])
    return PRESETS.get(number_of(resolved.get("accuracy", "balanced")), 1.0)


def bodies_from_files(resolved):
    """Names of the bodies whose mesh is from a file: it is split by `refine`, and has no keys that count cells."""
    return [number_of(body.get("name")) for body in bodies_of(resolved) if number_of(body["mesh"].get("kind")) == "file"]


def bodies_that_stay(resolved):
    """Names of the deformable bodies that have one cell in every direction, which no factor makes finer."""
    found = []
    for body in bodies_of(resolved):
        counts = flat(counts_of_cells(body["mesh"]).values())
        if counts and set(counts) == {1} and not number_of(body.get("rigid", False)):
            found.append(number_of(body.get("name")))
    return found


def left_out(resolved, keys):
    """What deforms and is not refined when these keys alone are multiplied: other keys, and bodies whose meshes are from files."""
    rigid = tuple(f"bodies[{number}]." for number, body in enumerate(bodies_of(resolved)) if number_of(body.get("rigid", False)))
    counts = {key: count for key, count in counts_of_cells(resolved).items() if not key.startswith(rigid)}
    return [*(key for key, count in counts.items() if key not in keys and set(flat([count])) != {1}), *bodies_from_files(resolved)]


def all_rigid(resolved):
    """Whether a scene has rigid bodies only, so that its meshes are geometry."""
    bodies = bodies_of(resolved)
    return bool(bodies) and all(number_of(body.get("rigid", False)) for body in bodies)


def bodies_of(resolved):
    """The bodies of a scene; programs that build their bodies themselves have none."""
    bodies = resolved.get("bodies", [])
    return [body for body in bodies if isinstance(body, dict) and "mesh" in body] if isinstance(bodies, list) else []


def flat(counts):
    """Numbers and lists of numbers as one list."""
    return [number for count in counts for number in (count if isinstance(count, list) else [count])]


def refined(resolved, factor):
    """{refine: its value} of the case on a mesh that many times as fine; nothing where a mesh from a file cannot follow."""
    value = refine_of(resolved) * factor
    return {} if bodies_from_files(resolved) and value not in SPLITS else {"refine": f"{value:.10g}"}
