"""Numbers and HTML of a report: units with prefixes, tables, pictures within the page."""
import base64
import html
import math
import re

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
ROUND_OFF = 1e-12  # of the energy of a scene
TAKES_PREFIX = {"s": (-9, 0), "m": (-9, 0), "N": (-3, 9), "Pa": (-3, 9), "J": (-9, 9), "J/m^3": (0, 9), "Hz": (0, 9),
                "N*s": (-3, 6), "N s": (-3, 6)}


def esc(text):
    return html.escape(str(text), quote=True)


def scale_of(size, unit):
    """(factor, unit with prefix) in which values of this size are between 1 and 1000; the factor divides."""
    low, high = TAKES_PREFIX.get(unit, (0, 0))
    if not math.isfinite(size) or size == 0:
        return 1.0, shown_unit(unit)
    usable = [(factor, prefix) for factor, prefix in PREFIXES if 10.0 ** low * 0.99 <= factor <= 10.0 ** high * 1.01]
    factor, prefix = next(((f, p) for f, p in usable if abs(size) >= 0.9995 * f), usable[-1] if usable else (1.0, ""))
    return factor, prefix + shown_unit(unit)


def axis_scale(size, unit):
    """(factor, unit) of an axis: of a unit without prefixes a power of ten, so that no tick has one."""
    factor, shown = scale_of(size, unit)
    if size > 0 and math.isfinite(size) and not 1e-2 <= size / factor < 1e5:
        power = 3 * math.floor(math.log10(size / factor) / 3)
        factor, shown = factor * 10.0 ** power, f"$10^{{{power}}}$ {shown}".strip()
    return factor, shown


def shown_unit(unit):
    """The unit as it is printed: m² of m^2; nothing of a pure number."""
    if unit in ("1", None):
        return ""
    return unit.replace("^2", "²").replace("^3", "³").replace("*", "·").replace("m2", "m²").replace(" ", "\u00a0")


def number(value, digits=5):
    """A number as text of HTML."""
    if value is None or not math.isfinite(value):
        return "none" if value is None or math.isnan(value) else "∞" if value > 0 else "−∞"
    said = f"{value:.{digits}g}"
    mantissa, e, exponent = said.partition("e")
    mantissa = mantissa.replace("-", "−")
    if e and mantissa in ("1", "−1"):
        return f"{mantissa.replace('1', '10')}<sup>{str(int(exponent)).replace('-', '−')}</sup>"
    return f"{mantissa}·10<sup>{str(int(exponent)).replace('-', '−')}</sup>" if e else mantissa


def quantity(value, unit, digits=5):
    """A number with its unit; the whole value in SI shows when the pointer is on it."""
    if not math.isfinite(value):
        return number(value)
    factor, shown = scale_of(value, unit)
    whole = f"{value!r} {unit if unit != '1' else ''}".strip()
    return f"<span title='{esc(whole)}'>{number(value / factor, digits)}{'&nbsp;' + esc(shown) if shown else ''}</span>"


def plain_quantity(value, unit, digits=5):
    """The same without tags."""
    return re.sub(r"<sup>(.*?)</sup>", r"^\1", re.sub(r"</?span[^>]*>", "", quantity(value, unit, digits))).replace("&nbsp;", " ")


def engineering(text):
    """A value of a case as "2.1e+11 Pa", with a prefix where its unit takes one: "210 GPa"."""
    found = re.fullmatch(r"(-?[\d.]+(?:e[-+]?\d+)?) (\S.*)", text)
    if not found or found.group(2) not in TAKES_PREFIX:
        return text
    return plain_quantity(float(found.group(1)), found.group(2), 6).replace("\u00a0", " ")


def share(part, digits=3):
    """A part as per cent; parts below the round-off of sums are told as such."""
    if not math.isfinite(part):
        return "–"
    return "≈ 0" if 0 < abs(part) < ROUND_OFF else f"{number(100 * part, digits)} %"


def duration(seconds):
    if not math.isfinite(seconds):
        return "unknown"
    if seconds < 90:
        return f"{seconds:.3g} s"
    return f"{seconds / 60:.1f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def table(columns, rows, kinds="", caption=""):
    """A table; `kinds` has a letter for each column: t text, n number. Cells are HTML; a column without any text is left out."""
    def cell(tag, kind, text):
        return f"<{tag}{' class=number' if kind == 'n' else ''}>{text}</{tag}>"

    kinds = kinds.ljust(len(columns), "t")
    used = [i for i in range(len(columns)) if not rows or any(cells(row)[i] != "" for row in rows)]
    rows = [(row[0], [row[1][i] for i in used]) if isinstance(row, tuple) else [row[i] for i in used] for row in rows]
    columns, kinds = [columns[i] for i in used], [kinds[i] for i in used]
    head = "".join(cell("th", kind, text) for kind, text in zip(kinds, columns))
    lines = ["".join(cell("td", kind, text) for kind, text in zip(kinds, cells(row))) for row in rows]
    body = "".join(f"<tr{row_id(row)}>{line}</tr>" for row, line in zip(rows, lines))
    said = f"<caption>{caption}</caption>" if caption else ""
    top = f"<thead><tr>{head}</tr></thead>" if any(columns) else ""
    return f"<div class=wide><table>{said}{top}<tbody>{body}</tbody></table></div>"


def row_id(row):
    return f" id='{esc(row[0])}'" if isinstance(row, tuple) else ""


def cells(row):
    """A row is a list of cells, or (anchor, list of cells)."""
    return row[1] if isinstance(row, tuple) else row


def picture(data, kind, alt, caption="", style=""):
    """A figure whose picture is in the page; data are bytes."""
    source = f"data:image/{kind};base64," + base64.b64encode(data).decode()
    image = f"<img alt='{esc(alt)}' src='{source}'{f' style={chr(39)}{style}{chr(39)}' if style else ''}>"
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>" if caption else f"<figure>{image}</figure>"


def folded(title, inner, is_open=False):
    return f"<details{' open' if is_open else ''}><summary>{title}</summary>{inner}</details>"


def missing(text):
    return f"<p class=missing>{text}</p>"


# ------------------------------------------------------------------------------------------------
# Runs

def tag(run):
    return f"<span class=key>{run.key}</span>" if run.key else ""


def named(run):
    return f"<span class=whole>{tag(run)}{esc(run.name)}</span>"


def anchor(run, name):
    return f"{run.key}-{name}" if run.key else name


def run_heading(run, runs):
    return f"<h3>{named(run)}</h3>" if len(runs) > 1 else ""
