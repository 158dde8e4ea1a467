"""Uncertain inputs of a case: `scripts/trade CASE --vary KEY=±10% KEY=±0.1 KEY=LOW..HIGH`, with mean, spread and who makes it.

KEY is a key of the case seen from its root, `lead.young` or `bodies[0].material.young`. `±10%` and `±0.1 mm` are about what the case, or
`--set`, says; `+-` is the same sign. `LOW..HIGH UNIT` needs no value in the case. Inputs are independent, and uniform between their ends.
Every end is tried without a run first (`--dry-run` of the program), so a key that is wrong or not used ends the command at once.

The points are SciPy's scrambled Sobol sequence or Latin hypercube, the same for the same seed, so that runs are found again; twice the
points of Sobol's sequence has the first half in it. What they say is in sensitivity.py. The numerical error beside it is that of the
case's own values: how far the mesh of the sweep is from the finest of the meshes, and how far that is from the limit; or the error against
an exact answer.
"""
import csv
import dataclasses
import io
import math
import re
from pathlib import Path

import command_line
import processes
import trade_points as points
import verify
from runs import ROOT, BadArgument, CannotRun

PER_INPUT = 8  # runs for each input, where no number is asked for
MOST_ROWS = 16  # inputs in the figure
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
UNIT = r"(?P<unit>\s*[^\s\d.+-].*|\s+\S.*)?"
ABOUT = re.compile(rf"(?:±|\+-)\s*(?P<by>{NUMBER}){UNIT}\s*")
BETWEEN = re.compile(rf"(?P<low>{NUMBER})\s*\.\.\s*(?P<high>{NUMBER}){UNIT}\s*")
QUANTITY = re.compile(rf"(?P<value>{NUMBER}){UNIT}\s*")
EXPECTED = "expected is KEY=±10%, KEY=±0.1 or KEY=LOW..HIGH, with the unit where the key has one"


class NoInput(Exception):
    """A word of --vary that cannot be varied; says which and what is expected."""


@dataclasses.dataclass(frozen=True)
class Input:
    """A key of the case and the ends between which its value is uniform."""
    key: str
    low: float
    high: float
    unit: str

    def text(self, u):
        """What the key is set to at u in [-1, 1]."""
        return text_of(0.5 * (self.low + self.high) + 0.5 * (self.high - self.low) * u, self.unit)


def text_of(value, unit):
    return f"{value:.10g} {unit}".strip()


# ------------------------------------------------------------------------------------------------
# Words of --vary

def inputs_of(words, definition, drivers):
    """The inputs that the words say, each end of them tried by the program without a run."""
    found = [input_of(word, definition, drivers) for word in words]
    for one in found:
        if sum(other.key == one.key for other in found) > 1:
            raise NoInput(f"'{one.key}' is varied twice")
    for one in found:
        for u in (-1, 1):
            try_end(one, u, definition, drivers)
    return found


def input_of(word, definition, drivers):
    key, equals, given = (part.strip() for part in word.partition("="))
    about, between = ABOUT.fullmatch(given), BETWEEN.fullmatch(given)
    if not (key and equals and (about or between)):
        raise NoInput(f"'{word}' is no input: {EXPECTED}")
    if between:
        one = Input(key, float(between["low"]), float(between["high"]), unit_of(between))
    else:
        centre, unit = value_in_case(key, word, definition, drivers)
        by, said = float(about["by"]), unit_of(about)
        if said == "%":
            by *= abs(centre) / 100
        elif said != unit:
            raise NoInput(f"'{word}': the case has {key} as {text_of(centre, unit)}, so expected is ±A {unit}".rstrip() + ", or LOW..HIGH")
        one = Input(key, centre - by, centre + by, unit)
    if not one.low < one.high:
        raise NoInput(f"'{word}': the ends {text_of(one.low, one.unit)} and {text_of(one.high, one.unit)} are not apart; "
                      "expected is KEY=LOW..HIGH with LOW < HIGH")
    return one


def unit_of(match):
    return (match["unit"] or "").strip()


def value_in_case(key, word, definition, drivers):
    """(number, unit) of a key as the case, or what is set beside it, says it."""
    found = definition.change.get(key, lookup(case_text(definition.case), key))
    if found is None:
        refuse_fault(dry_run(definition, drivers, {key: "0"}), word, only="unknown")
        raise NoInput(f"'{word}': the case does not say '{key}', so there is nothing for ± to be about; expected is {key}=LOW..HIGH")
    quantity = QUANTITY.fullmatch(str(found).strip())
    if quantity is None:
        raise NoInput(f"'{word}': the case has {key} as '{found}', and expected is a number with its unit")
    return float(quantity["value"]), unit_of(quantity)


def case_text(case):
    import yaml
    return yaml.safe_load((ROOT / case).read_text(encoding="utf-8"))


def lookup(node, key):
    """What stands at bodies[0].material.young; None where nothing does."""
    for name in re.findall(r"[^.\[\]]+", key):
        if isinstance(node, list) and name.isdigit() and int(name) < len(node):
            node = node[int(name)]
        elif isinstance(node, dict) and name in node:
            node = node[name]
        else:
            return None
    return node


def try_end(one, u, definition, drivers):
    """Raises NoInput where the program refuses this end, or does not use the key."""
    text = one.text(u)
    said = dry_run(definition, drivers, {one.key: text})
    refuse_fault(said, f"{one.key}={text}")
    unused = [line for line in (said.stdout + said.stderr).splitlines() if line.startswith(f"not used: {one.key} ")]
    if unused:
        raise NoInput(f"'{one.key}' is not used by this case as it is set; --set KEY=VALUE sets what it needs")


def refuse_fault(said, word, only=""):
    if said.returncode != 0 and only in said.stderr:
        lines = [line.strip() for line in said.stderr.splitlines() if line.strip()]
        raise NoInput(f"'{word}' is refused" + (f": {lines[0]}" if lines else ""))


def dry_run(definition, drivers, settings):
    program = Path(drivers).resolve() / definition.driver
    words = [str(program), str(ROOT / definition.case), "--dry-run"]
    for key, value in {**definition.change, **settings}.items():
        words += ["--set", f"{key}={value}"]
    try:
        return processes.run(words, capture_output=True, text=True)
    except OSError as error:
        raise CannotRun(f"{program} is not built") from error


# ------------------------------------------------------------------------------------------------
# Points

def points_of(inputs, number, sampling, seed):
    """Points u in [-1, 1]^inputs, as many as asked for; of Sobol's sequence a power of two, which keeps its balance."""
    import sensitivity  # needs numpy, which a sweep does not
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise CannotRun("--vary needs SciPy: apt-get install -y --no-install-recommends python3-scipy") from error
    number = number or PER_INPUT * inputs
    least = sensitivity.least_runs(inputs)
    if number < least:
        raise NoInput(f"--points {number} is too few for {inputs} inputs: expected are {least} or more")
    if sampling == "sobol":
        return 2 * qmc.Sobol(inputs, scramble=True, seed=seed).random_base2(math.ceil(math.log2(number))) - 1
    return 2 * qmc.LatinHypercube(inputs, seed=seed).random(number) - 1


# ------------------------------------------------------------------------------------------------
# The study

@dataclasses.dataclass
class Row:
    """One run: where, how it ended ('good', or as in points.Point), and its results."""
    u: list
    settings: dict
    ending: str
    values: dict
    warned: bool = False


@dataclasses.dataclass
class Study:
    """A result over all inputs, and the numerical error of the case's own values, all in `unit`: `scale` of it make one of SI."""
    name: str
    unit: str
    scale: float
    base: float
    numerical: float
    known: str
    found: object


def rows_of(sweep, inputs, at, runs_of):
    """The runs at the points."""
    settings = [{one.key: one.text(u) for one, u in zip(inputs, where)} for where in at]
    rows = []
    for where, setting, (ending, run) in zip(at, settings, runs_of(sweep, settings)):
        row = Row([float(u) for u in where], setting, ending, {})
        if run is not None:
            row.warned = bool(run.warnings)
            row.ending = "good" if run.ending in verify.GOOD_ENDINGS else f"stopped: {run.ending}"
        if row.ending == "good":
            row.values = {one.name: value_of(one, run)[0] for one in sweep.of.results}
            if not all(math.isfinite(value) for value in row.values.values()):
                row.ending = "no number"
        rows.append(row)
    return rows


def value_of(result, run):
    """(the number of a run, its exact value or None, its unit)."""
    try:
        got = result.measure(run)
    except (ZeroDivisionError, IndexError, ValueError):  # a measure may look for what does not happen in a bad run
        return math.nan, None, ""
    return (got, None, result.unit) if isinstance(result, points.Converged) else (got.got, got.expected, got.unit)


def studies_of(sweep, rows, base):
    """The Study of each result; base is the run of the case itself, and the references of the sweep are set."""
    import sensitivity
    good = [row for row in rows if row.ending == "good"]
    u = [row.u for row in good]
    found = []
    for one in sweep.of.results:
        value, exact, unit = value_of(one, base)
        reference = sweep.references[one.name]
        if reference.value is None:
            numerical, known = abs(value - exact), "against the exact answer"
        else:
            numerical = abs(value - reference.value) + reference.uncertainty * abs(reference.value)
            known = f"against the finest of the meshes ({reference.known})"
            unit = unit or base.summary["results"].get(one.name, {}).get("unit", "")
        unit, scale = readable(unit, value)
        try:
            found.append(Study(one.name, unit, scale, scale * value, scale * numerical, known,
                               sensitivity.estimate(u, [scale * row.values[one.name] for row in good])))
        except sensitivity.TooFew as error:
            raise CannotRun(str(error)) from error
    return found


def readable(unit, value):
    """The unit in which a number of SI is read, and how many of it make one: short lengths in mm, short times in ms or us."""
    if unit == "m" and 0 < abs(value) < 1:
        return "mm", 1e3
    if unit == "s" and 0 < abs(value) < 1:
        return ("ms", 1e3) if abs(value) >= 1e-3 else ("us", 1e6)
    return "" if unit == "1" else unit, 1.0


def study(sweep, words, runs_of):
    """All of it: (inputs, rows, studies)."""
    options = sweep.options
    inputs = inputs_of(words, sweep.of, options.drivers)
    at = points_of(len(inputs), options.points, options.sampling, options.seed)
    base = sweep.first()
    if base.ending not in verify.GOOD_ENDINGS:
        raise CannotRun(f"the case itself has no result: stopped: {base.ending}")
    sweep.set_references(base.summary["provenance"]["resolved"])
    rows = rows_of(sweep, inputs, at, runs_of)
    return inputs, rows, studies_of(sweep, rows, base)


# ------------------------------------------------------------------------------------------------
# What is written

def signed(value, error):
    """4.321 ± 0.052, the error with two digits and the value with as many places; no error where it is below the fifth digit."""
    if error <= 1e-5 * abs(value):
        return f"{value:.5g}"
    places = 1 - math.floor(math.log10(error))
    if places > 12 or places < -3:
        return f"{value:.4g} ± {error:.2g}"
    return f"{value:.{max(places, 0)}f} ± {error:.{max(places, 0)}f}"


def percent(number):
    return f"{100 * number.value:.1f} ± {100 * number.error:.1f} %"


def order(one):
    """Numbers of the inputs, that with the largest share first."""
    return sorted(range(len(one.found.share)), key=lambda i: (-one.found.share[i].value, -abs(one.found.change[i].value)))


@dataclasses.dataclass
class Bar:
    """What one input does to a result: its share of the variance, and the change from its low end to its high one, each with its error."""
    key: str
    share: tuple
    change: tuple


@dataclasses.dataclass
class Spread:
    """What the figure shows of a result; the largest share stands last in `bars`, so that it is drawn on top."""
    name: str
    unit: str
    numerical: float
    rest: tuple
    bars: list


def spreads(inputs, studies):
    """The Spread of each result."""
    def pair(number):
        return number.value, number.error

    return [Spread(one.name, one.unit, one.numerical, pair(one.found.rest),
                   [Bar(inputs[i].key, pair(one.found.share[i]), pair(one.found.change[i])) for i in order(one)[:MOST_ROWS][::-1]])
            for one in studies]


def spread_table(rows, studies):
    good = [row for row in rows if row.ending == "good"]
    lines = []
    for one in studies:
        values = [one.scale * row.values[one.name] for row in good]
        unit = f" {one.unit}" if one.unit else ""
        lines.append([one.name, f"{one.base:.5g}{unit}", signed(one.found.mean.value, one.found.mean.error) + unit,
                      signed(one.found.deviation.value, one.found.deviation.error) + unit,
                      f"{min(values):.5g} to {max(values):.5g}{unit}", f"{one.numerical:.2g}{unit}, {one.known}"])
    return points.table(["result", "at the case's values", "mean", "standard deviation", "in the runs", "numerical error"], lines)


def share_table(inputs, one):
    unit = f" [{one.unit}]" if one.unit else ""
    lines = [[f"`{inputs[i].key}`", f"{inputs[i].low:.6g}", f"{inputs[i].high:.6g} {inputs[i].unit}".strip(), percent(one.found.share[i]),
              signed(one.found.change[i].value, one.found.change[i].error)] for i in order(one)]
    lines.append(["together, or missed by the fit", "", "", percent(one.found.rest), ""])
    return points.table(["input", "low", "high", "share of the variance", f"change from low to high{unit}"], lines)


def counted_text(rows):
    """How many runs there are, and why some have no result."""
    endings = [row.ending for row in rows if row.ending != "good"]
    said = f"{len(rows) - len(endings)} of {len(rows)} runs have a result"
    said += "".join(f"; {endings.count(one)} {one}" for one in sorted(set(endings)))
    warned = sum(row.warned for row in rows)
    said += f"; {warned} with a warning of the program" if warned else ""
    return said + (". Those without are left out of what follows, which says nothing about them." if endings else ".")


def page_of(inputs, rows, studies, figure):
    """The tables as Markdown."""
    parts = [counted_text(rows) + " Errors after ± are twice the standard error of the sampling.", spread_table(rows, studies)]
    for one in studies:
        rest = one.found.rest
        parts += [f"![Who makes the spread: {one.name}]({figure})" if one is studies[0] else "",
                  f"*{one.name}*. The inputs one by one predict {100 * one.found.predicted:.1f} % of the variance of runs left out of the "
                  "fit." + (f" What is left, {100 * rest.value:.0f} %, inputs do together, or the runs are too few to show it: a share may "
                            "be larger by up to that." if rest.value > 0.1 else ""), share_table(inputs, one)]
    return "\n\n".join(part for part in parts if part) + "\n"


def as_csv(inputs, rows, studies):
    stream = io.StringIO()
    out = csv.writer(stream, lineterminator="\n")
    out.writerow([*(one.key for one in inputs), "ending", *(f"{one.name} [{one.unit or 1}]" for one in studies)])
    for row in rows:
        values = [f"{one.scale * row.values[one.name]:.10g}" if row.values else "" for one in studies]
        out.writerow([*row.settings.values(), row.ending, *values])
    return stream.getvalue()


def markers(name):
    return f"<!-- written by scripts/trade --vary, {name} -->", f"<!-- end of what scripts/trade --vary, {name}, writes -->"


def put(text, name, page):
    """The text with the page between the markers of this name."""
    begin, end = markers(name)
    before, found, rest = text.partition(begin)
    _, ended, after = rest.partition(end)
    if not (found and ended):
        raise BadArgument(f"the page has no '{begin}' with its end '{end}'")
    return f"{before}{begin}\n\n{page}\n{end}{after}"


def write(sweep, words, runs_of):
    """Makes the study and writes FOLDER/NAME.csv, .md and .svg; with --into also a page and its figure."""
    options = sweep.options
    name = options.name or f"{sweep.of.name}_vary"
    if options.into:
        put(options.into.read_text(encoding="utf-8"), name, "")
    inputs, rows, studies = study(sweep, words, runs_of)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / f"{name}.csv").write_text(as_csv(inputs, rows, studies), encoding="utf-8")
    (options.out / f"{name}.md").write_text(page_of(inputs, rows, studies, f"{name}.svg"), encoding="utf-8")
    drawn = options.out / f"{name}.svg"
    import figure
    import figure_vary
    figure.save(figure_vary.vary_figure(spreads(inputs, studies)), drawn, png=False)
    print((options.out / f"{name}.md").read_text(encoding="utf-8"))
    print(f"{options.out / name}.csv, .md, .svg")
    if options.into:
        beside = options.into.parent / "figures" / f"{name}.svg"
        beside.write_bytes(drawn.read_bytes())
        page = page_of(inputs, rows, studies, f"figures/{name}.svg")
        options.into.write_text(put(options.into.read_text(encoding="utf-8"), name, page), encoding="utf-8")


# ------------------------------------------------------------------------------------------------
# Options

def add_options(parser):
    parser.add_argument("--vary", nargs="+", metavar="KEY=RANGE", help="uncertain inputs: KEY=±10%%, KEY=±0.1 or KEY=LOW..HIGH")
    parser.add_argument("--points", type=command_line.count, metavar="N",
                        help="of --vary: runs (default: 8 for each input; Sobol: a power of two)")
    parser.add_argument("--sampling", choices=("sobol", "latin"), default="sobol", help="of --vary: the points")
    parser.add_argument("--seed", type=command_line.seed, default=1, help="of --vary: another one gives other points")
    parser.add_argument("--name", help="of --vary: what the files are called (default: NAME_vary)")
    parser.add_argument("--into", type=command_line.file_to_read, metavar="PAGE",
                        help="of --vary: a page with markers for this name, and its figures/")
