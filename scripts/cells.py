"""Meshes of a case made finer or coarser: every key that counts cells, times a factor."""

UNEVEN = 0.02     # [-] a count of cells that rounding moves by more does not follow its factor


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
