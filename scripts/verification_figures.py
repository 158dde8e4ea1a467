"""Figures of verification cases: results over references with their error below, errors of studies over sizes."""
import io
import math

import figure as drawing


def svg_of(picture):
    """The figure as the text of an SVG; the same data give the same text."""
    stream = io.StringIO()
    drawing.write_svg(picture, stream)
    return stream.getvalue()


def case_figure(one, curves):
    """The SVG of a Figure of accept.py."""
    results, exact = curves.results, curves.exact
    errors = [] if one.log or not one.error else errors_of(results, exact)
    picture, axes = drawing.new_figure(width=120, height=92 if errors else 70, rows=2 if errors else 1,
                                       ratios=[3, 1] if errors else None)
    upper, lower = axes if errors else (axes, axes)
    for label, left, right, low, high in curves.ranges:
        drawing.draw_range(upper, left, right, low, high, label)
    for number, (label, across, up) in enumerate(exact):
        drawing.draw_reference(upper, across, up, number, label)
    for number, (label, across, up) in enumerate(results):
        draw_result(upper, across, up, number + bool(exact), label)
    if one.log:
        upper.set_xscale("log")
        upper.set_yscale("log")
    if one.equal:
        upper.set_aspect("equal", adjustable="datalim")
    upper.set_ylabel(one.up)
    for number, across, error in errors:
        draw_result(lower, across, error, number + 1)
    if errors:
        lower.axhline(0, color="black", linewidth=0.6)
        lower.set_ylabel("error [%]")
        picture.align_ylabels()
    lower.set_xlabel(one.across)
    drawing.place_legend(upper)
    return svg_of(picture)


RINGS = 12  # [-] way up and down over the range, from which a curve is a band: dashes would only blur it


def draw_result(axes, across, up, number, label=None):
    """A curve in the style of its number; one that rings is a thin line below all others."""
    way = sum(abs(b - a) for a, b in zip(up, up[1:]))
    rings = len(up) > 0 and way > RINGS * (max(up) - min(up))
    (drawing.draw_band if rings else drawing.draw_curve)(axes, across, up, number, label)


def errors_of(results, exact):
    """(number of the result, abscissae, error in % of the largest exact value), where both are functions of the abscissa."""
    found = []
    for number, (_, across, up) in enumerate(results):
        if not exact or (len(exact) > 1 and number >= len(exact)):
            continue
        _, exact_across, exact_up = exact[number if len(exact) > 1 else 0]
        scale = max((abs(value) for value in exact_up if math.isfinite(value)), default=0.0)
        if scale == 0 or len(exact_across) < 2 or not (rises(across) and rises(exact_across)):
            continue
        inside = [(x, y) for x, y in zip(across, up) if exact_across[0] <= x <= exact_across[-1]]
        if inside:
            truth = drawing.interpolated([x for x, _ in inside], exact_across, exact_up)
            found.append((number, [x for x, _ in inside], [100 * (y - e) / scale for (_, y), e in zip(inside, truth)]))
    return found


def rises(values):
    return all(b >= a for a, b in zip(values, values[1:]))


def study_figure(check, along, sizes, errors):
    """The SVG of a study: its errors over the sizes, with the slopes of first and second order."""
    picture, axes = drawing.new_figure(width=88, height=66)
    drawing.draw_orders(axes, sizes, errors)
    drawing.draw_curve(axes, sizes, errors, 1, check)
    axes.set_xlabel(f"{along}" if len(str(along)) < 40 else "size")
    axes.set_ylabel("relative error")
    drawing.place_legend(axes)
    return svg_of(picture)
