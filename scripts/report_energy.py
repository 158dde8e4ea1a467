"""Energies of a run in groups: what a history or a ledger has by source and channel, as kinetic, elastic, friction of contacts."""
import math

import numpy as np

from report_run import dict_of, number_of
from report_text import ROUND_OFF, esc, named, number, scale_of, share

# {kind of an account: whose energies are in one group}; kinds as summary.json has them.
FAMILIES = {"block": "bodies", "interface": "contacts", "rigid_plane": "planes", "spring": "springs", "relaxation": "relaxation",
            "gravity": "gravity",
            **dict.fromkeys(("constrained", "fixed", "symmetry", "floor", "driven"), "planes"),
            **dict.fromkeys(("body_force", "pressure", "force", "moment", "radiation", "bubble"), "loads")}
WITHOUT_SUMMARY = {"relaxation": "relaxation", "gravity": "gravity"}  # {source: its kind}: no other source has these names
WORDS = {"elastic": ("elastic", "compression", "cavitation", "weight", "transverse_shear"),
         "stored": ("restitution", "penalty", "tangential_penalty"),
         "plastic": ("plastic",),
         "hourglass and other artificial": ("hourglass", "distortion", "drilling", "residual_bending"),
         "viscosity of shocks": ("viscous",),
         "friction": ("friction",),
         "inelastic impact": ("inelastic_impact",),
         "damping": ("damping",),
         "thinning": ("thinning",),
         "removed": ("removed",),
         "radiated": ("radiated",)}
OTHERS = "others"
AT_START = "kinetic at the start", "stored at the start"
AT_END = "created by all sources", "time integration", "residual"
OUTSIDE = ("external_work", "potential")  # stored: what it lost went into the scene
CHANNELS = sorted((channel for channels in (*WORDS.values(), OUTSIDE) for channel in channels), key=len, reverse=True)
WHOLE = ("energy_integration", "energy_residual")
SMALL = 5e-3  # of the largest energy: less is not drawn


def family_of(kind):
    return FAMILIES.get(kind, "")


def group_of(kind, channel):
    """The name of the group of a channel of a source, as "contacts: friction"; without a kind, "friction"; 'others' if it has none."""
    word = next((name for name, channels in WORDS.items() if channel in channels), "")
    family = family_of(kind)
    if not word or kind and not family:
        return OTHERS
    return f"{family}: {word}" if family else word


def in_order(named_values):
    """The same names and values, by whose they are: at the start, works, kinetic, of bodies, of contacts, ..., others, at the end."""
    families = [*dict.fromkeys(FAMILIES.values()), ""]
    order = [*AT_START, *(f"work of {family or OTHERS}" for family in families), "kinetic", "kinetic at the end",
             *(f"{family}: {word}" if family else word for family in families for word in WORDS), OTHERS, *AT_END]
    return {name: named_values[name] for name in order if name in named_values}


def is_created(column):
    return column.startswith("energy_created_") or column in WHOLE


def source_of(column, kinds):
    """(kind, channel) of a column energy_SOURCE_CHANNEL; an empty channel if it is none that is known."""
    inner = column.removeprefix("energy_")
    channel = next((one for one in CHANNELS if inner.endswith(f"_{one}")), "")
    found = [name for name in kinds if inner.startswith(f"{name}_")]
    if found:
        source = max(found, key=len)
        return kinds[source], inner.removeprefix(f"{source}_")
    return "", channel


def over_time(run):
    """({group: values}, work from outside) of the histories, in J."""
    groups, outside = {}, np.zeros(len(run.columns[run.first]))
    kinds = WITHOUT_SUMMARY | {name: str(account.get("kind", "")) for name, account in run.accounts().items()}
    for column in run.energies():
        if is_created(column):
            continue
        kind, channel = source_of(column, kinds)
        if channel in OUTSIDE:
            outside = outside - run.columns[column]
        else:
            name = "kinetic" if column == "energy_kinetic" else group_of(kind, channel)
            groups[name] = groups.get(name, 0) + run.columns[column]
    return in_order(groups), outside


def drawn(groups):
    """The groups that are large enough to see, and {name: largest share} of the others, which are not drawn."""
    size = {name: float(np.nanmax(np.abs(values))) for name, values in groups.items()}
    most = max(size.values(), default=0.0) or 1.0
    large = {name: values for name, values in groups.items() if size[name] >= SMALL * most}
    return large, {name: size[name] / most for name in groups if name not in large and size[name] > 0}


# ------------------------------------------------------------------------------------------------
# The balance at the end

def at_end(run):
    """{group: [J]} of the ledger at the end; empty without one."""
    if not run.accounts():
        return {}
    found = dict(zip(AT_START, (run.ledger("initial_kinetic"), run.ledger("initial_stored"))))
    found["kinetic at the end"] = run.ledger("kinetic")
    for account in run.accounts().values():
        kind = str(account.get("kind", ""))
        for channel, value in [*dict_of(account, "stored").items(), *dict_of(account, "dissipated").items()]:
            is_outside = channel in OUTSIDE
            name = f"work of {family_of(kind) or OTHERS}" if is_outside else group_of(kind, channel)
            found[name] = found.get(name, 0.0) + (-number_of(value) if is_outside else number_of(value))
    created = sum(number_of(one.get("created")) for one in run.accounts().values())
    return in_order({**found, **dict(zip(AT_END, (created, run.ledger("integration"), run.ledger("energy_residual"))))})


def balance(runs):
    """(columns, rows) of where the energy is at the end, two columns for each run."""
    ends = [at_end(run) for run in runs]
    names = in_order({name: None for end in ends for name in end})
    most = max((abs(value) for end in ends for value in end.values() if math.isfinite(value)), default=0.0)
    factor, shown = scale_of(most, "J")
    rows = []
    for name in names:
        if any(abs(end.get(name, 0.0)) > ROUND_OFF * most for end in ends) or name == "residual":
            row = [esc(name)]
            for run, end in zip(runs, ends):
                scale = run.ledger("energy_scale")
                part = end[name] / scale if name in end and scale > 0 else math.nan
                row += [number(end[name] / factor) if name in end else "–", share(part)]
            rows.append(row)
    return ["", *(text for run in runs for text in ((f"{named(run)} " if run.key else "") + f"[{shown}]", "of the scene"))], rows


def created_over_time(run):
    """({source: per cent of the energy of the scene}, the limit [%]); empty where that energy is unknown or zero."""
    scale = run.ledger("energy_scale")
    if not scale > 0:
        return {}, None
    found = {}
    for column in run.energies():
        if is_created(column) and column != "energy_residual":
            name = column.removeprefix("energy_created_").removeprefix("energy_").replace("integration", "time integration")
            if np.any(run.columns[column]):
                found[name] = 100 * run.columns[column] / scale
    limit = number_of(dict_of(dict_of(run.resolved(), "time"), "created_limit"))
    return found, 100 * limit if limit > 0 else None
