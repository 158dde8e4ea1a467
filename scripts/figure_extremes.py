"""The matrix of verification/extremes as a figure: a row for each axis, a cell for each run, coloured by its verdict."""
import figure

COLOURS = {"good": "#009E73", "refused": "#56B4E9", "warned": "#E69F00", "broken": "#D55E00"}
PER_LINE = 60


def lines_of(rows):
    """[(axis, its first cell here, rows)]: an axis goes on in further lines."""
    axes = {}
    for row in rows:
        axes.setdefault(row["axis"], []).append(row)
    return [(name if at == 0 else "", at, cells[at:at + PER_LINE]) for name, cells in axes.items() for at in range(0, len(cells), PER_LINE)]


def labels_of(cells):
    """[(place, value, cells up to the next one)]: a value stands over its first cell."""
    starts = [x for x, row in enumerate(cells) if x == 0 or row["value"] != cells[x - 1]["value"]]
    return [(x, cells[x]["value"], end - x) for x, end in zip(starts, [*starts[1:], len(cells) + 3])]


def is_crowded(cells):
    """Whether values do not fit beside each other: then they stand up, and the line is higher."""
    return any(len(value) > 4 * room + 3 for _, value, room in labels_of(cells))


def draw(rows, path):
    """Draws the matrix and writes it as PNG."""
    lines = lines_of(rows)
    places, y = [], 0.0
    for _, _, cells in lines:
        y -= 2.1 if is_crowded(cells) else 1.0
        places.append(y)
    low = y - 1
    drawn, axes = figure.new_figure(width=figure.DOUBLE_COLUMN, height=22 - 6.4 * low)
    for y, (_, _, cells) in zip(places, lines):
        for x, row in enumerate(cells):
            axes.add_patch(figure.Rectangle((x + 0.06, y - 0.42), 0.88, 0.62, facecolor=COLOURS[row["verdict"]], linewidth=0))
        for x, value, _ in labels_of(cells):
            axes.plot([x, x], [y - 0.45, y + 0.25], color="#333333", linewidth=0.4)
            axes.text(x + 0.1, y + 0.24, value, fontsize=3.6, rotation=55 if is_crowded(cells) else 20, va="bottom", ha="left")
    axes.set_yticks(places, [name for name, _, _ in lines])
    axes.set_xticks([])
    axes.minorticks_off()
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)
    axes.set_xlim(-0.5, PER_LINE + 0.5)
    axes.set_ylim(low - 0.6, 0.0)
    for n, (verdict, colour) in enumerate(COLOURS.items()):
        count = sum(row["verdict"] == verdict for row in rows)
        axes.add_patch(figure.Rectangle((n * 11, low - 0.4), 0.9, 0.6, facecolor=colour, linewidth=0))
        axes.text(n * 11 + 1.4, low - 0.1, f"{verdict} {count}", fontsize=8, va="center")
    figure.save(drawn, path)
    path.with_suffix(".svg").unlink()
