"""Which numerics of a run are not the program's defaults, and the same run with the defaults.

Numerics are the settings by which the same bodies, contacts and loads are computed differently. Geometry, meshes, materials, friction,
contact heights and intervals of output are none. A departure is a numeric that the case sets, and not to its default.
"""
from runs import CannotRun, Run

ELEMENT = {"kind": "one_point", "hourglass_kind": "assumed_strain", "hourglass": 1, "layers": 5, "rotary_inertia": "scaled",
           "thinning": "by_law", "drilling": 0.1, "distortion": 0.1, "lead": "one_point"}  # the last is `kind` in cask_drop
CONTACT = {"method": "multiplier", "restitution": 1, "passes": "one", "weights": "consistent", "penalty": None, "penalty_scale": 20,
           "tangential_penalty": 1, "damping_ratio": 0, "area": "apex", "energy_gain_limit": 0.005}

# {section: {key: default}}; None where the default is no value of the key
NUMERICS = {"element": ELEMENT, "viscosity": {"linear": 0.06, "quadratic": 1.0},
            "contacts": CONTACT, "planes": CONTACT, "contact": CONTACT, "interface": CONTACT, "base": CONTACT,
            "time": {"safety": 0.9, "created_limit": 0.05, "overlap_limit": 0.5, "corner_limit": 0},
            "relaxation": {"residual": 1e-6, "samples": 5}}
OF_KIND = {"stiffness": 0.1, "viscous": 0.05}  # the default of `hourglass`
OF_FLUIDS = {"distortion": 0.001}  # whose elements have no kind
WORDS = {"kind": "integration", "lead": "integration", "linear": "viscosity", "quadratic": "viscosity"}


def departures(run):
    """[(path in the case, word, value, default)] of the numerics that the case of a run sets, and not to the default."""
    found = []

    def look(node, path, section):
        if isinstance(node, list):
            for number, part in enumerate(node):
                look(part, f"{path}[{number}]", section)
            return
        for key, part in node.items() if isinstance(node, dict) else ():
            if not (isinstance(part, dict) and "default" in part):
                look(part, f"{path}.{key}".lstrip("."), key)
            elif key in NUMERICS.get(section, {}) and part["value"] != usual(section, key, node):
                if part["default"]:
                    raise CannotRun(f"the program's default of {path}.{key} is {part['value']}, not what scripts/defaults.py says")
                found.append((f"{path}.{key}", WORDS.get(key, key), part["value"], NUMERICS[section][key]))

    look(run.summary["provenance"].get("resolved", {}), "", "")
    return found


def usual(section, key, node):
    """The default of a key beside the others of its section."""
    if section == "element" and key in OF_FLUIDS and not any(word in node for word in ("kind", "lead")):
        return OF_FLUIDS[key]
    kind = node.get("hourglass_kind", {}).get("value")
    return OF_KIND.get(kind, NUMERICS[section][key]) if key == "hourglass" else NUMERICS[section][key]


def shown(found):
    """The departures as a text: 'viscosity 0, method penalty'; a word alone where its values differ."""
    values = {}
    for word, value in found:
        values.setdefault(word, set()).add(f"{value:g}" if isinstance(value, (int, float)) else str(value))
    return ", ".join(f"{word} {values[word].pop()}" if len(values[word]) == 1 and word != "penalty" else word for word in values)


def of_checks(rows):
    """How many of these rows depart from nothing, in a few words: 'yes', or what the others depart in; nothing where there is no row."""
    if not rows:
        return ""
    kept = sum(not row.departs for row in rows)
    words = shown([one for row in rows for one in row.departs]).split(", ")
    said = ", ".join(words[:4]) + (f" and {len(words) - 4} more" if len(words) > 4 else "")
    return "yes" if kept == len(rows) else f"{kept} of {len(rows)} checks; others {said}" if kept else f"no: {said}"


def with_contact(run):
    """Whether anything in the case of a run can touch."""
    case = run.summary["provenance"].get("resolved", {})
    return any(case.get(key) for key in ("contacts", "contact", "interface", "base")) or any(
        plane["kind"]["value"] in ("rigid", "floor") for plane in case.get("planes", []))


class ByDefault:
    """A store in which every run has the defaults, whatever its case file and CHANGE set; what a check sets itself stays.

    A given `penalty` cannot be taken out of a file and need not be: the default method does not use it.
    """

    def __init__(self, store):
        self.store, self.scratch, self.changed, self.of_case = store, store.scratch, False, {}

    def base(self, run):
        """The base run of a case with the defaults."""
        self.of_case = dict(run.overrides)
        return self.run(run.driver, run.case_file, run.overrides)

    def run(self, driver, case, overrides, threads=None):
        of_check = tuple(key for key, value in overrides.items() if (key, value) not in self.of_case.items())
        back = {path: default for path, _, _, default in departures(self.store.run(driver, case, overrides, threads))
                if default is not None and not path.startswith(of_check)}
        self.changed |= bool(back)
        run = self.store.run(driver, case, {**overrides, **back}, threads)
        return Run(self, driver, run.case_file, overrides, run.folder, False)  # a check may hand its overrides to another case
