"""Energies of a run in groups: what a history or a ledger has by source and channel, as kinetic, elastic, plastic, ..."""
import numpy as np

from report_run import dict_of, number_of

GROUPS = {"elastic": ("elastic", "compression", "cavitation", "weight", "transverse_shear"),
          "plastic": ("plastic",),
          "hourglass and other artificial": ("hourglass", "distortion", "drilling", "residual_bending"),
          "viscosity of shocks": ("viscous",),
          "contact": ("restitution", "penalty", "tangential_penalty", "thinning", "removed"),
          "friction": ("friction",),
          "inelastic impact": ("inelastic_impact",),
          "damping": ("damping",),
          "radiated": ("radiated",)}
OUTSIDE = ("external_work", "potential")  # stored: what it lost went into the scene
CHANNELS = sorted((channel for channels in (*GROUPS.values(), OUTSIDE) for channel in channels), key=len, reverse=True)
WHOLE = ("energy_integration", "energy_residual")
SMALL = 5e-3  # of the largest energy: less is not drawn


def group_of(channel):
    return next((name for name, channels in GROUPS.items() if channel in channels), "other")


def is_created(column):
    return column.startswith("energy_created_") or column in WHOLE


def over_time(run):
    """({group: values}, work from outside) of the histories, in J."""
    groups, outside = {}, np.zeros(len(run.columns[run.first]))
    for column in run.energies():
        if is_created(column):
            continue
        if column == "energy_kinetic":
            groups["kinetic"] = run.columns[column]
            continue
        channel = next((one for one in CHANNELS if column.endswith(f"_{one}")), "")
        if channel in OUTSIDE:
            outside = outside - run.columns[column]
        else:
            name = group_of(channel)
            groups[name] = groups.get(name, 0) + run.columns[column]
    order = ["kinetic", *GROUPS, "other"]
    return {name: groups[name] for name in order if name in groups}, outside


def drawn(groups):
    """The groups that are large enough to see, and {name: largest share} of the others, which are not drawn."""
    size = {name: float(np.nanmax(np.abs(values))) for name, values in groups.items()}
    most = max(size.values(), default=0.0) or 1.0
    large = {name: values for name, values in groups.items() if size[name] >= SMALL * most}
    return large, {name: size[name] / most for name in groups if name not in large and size[name] > 0}


def at_end(run):
    """{group: [J]} of the ledger at the end; empty without one."""
    if not run.accounts():
        return {}
    found, outside = {"kinetic": run.ledger("kinetic")}, 0.0
    for account in run.accounts().values():
        for channel, value in {**dict_of(account, "stored"), **prefixed(dict_of(account, "dissipated"))}.items():
            channel = channel.removeprefix("lost ")
            if channel in OUTSIDE:
                outside -= number_of(value)
            else:
                found[group_of(channel)] = found.get(group_of(channel), 0.0) + number_of(value)
    initial = run.ledger("initial_kinetic")
    order = ["kinetic", *GROUPS, "other"]
    kept = {name: found[name] for name in order if name in found}
    return {"kinetic at the start": initial, "stored at the start": run.ledger("initial_stored"), "work from outside": outside,
            **{f"{name} at the end" if name == "kinetic" else name: value for name, value in kept.items()},
            "created by all sources": sum(number_of(one.get("created")) for one in run.accounts().values()),
            "time integration": run.ledger("integration"), "residual": run.ledger("energy_residual")}


def prefixed(channels):
    """Channels of losses, whose names some stores have as well."""
    return {f"lost {channel}": value for channel, value in channels.items()}


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
