"""The report of the verification suite: one HTML file that needs nothing else.

An overview that begins with what was run, a page per case, a page of limitations. The page of a case shows its set-up before its results.
Pages are parts of the file, shown one at a time by their address (#case); printed, they follow one another.
"""
import base64
import collections
import html
import math
import re

import markdown

import defaults
import figure as drawing
import verification_setup as setup
import verification_tables as tables
from report_text import duration
from runs import ROOT
from verification_outcome import Outcome

STYLE = """
:root { --line: #c8c8c8; --quiet: #5a5a5a; --good: #1b6e3a; --miss: #9a5b00; --bad: #a3161a; }
body { font: 16px/1.5 Georgia, 'Times New Roman', serif; max-width: 66rem; margin: 2rem auto; padding: 0 1rem; color: #111; }
h1, h2, h3 { font-weight: 600; line-height: 1.2; } h1 { font-size: 1.7rem; } h2 { font-size: 1.35rem; margin-top: 2rem; }
h3 { font-size: 1.05rem; margin-top: 1.6rem; }
nav { font-size: .9rem; margin-bottom: 1.5rem; } a { color: #0b4f8a; text-decoration: none; } a:hover { text-decoration: underline; }
table { border-collapse: collapse; font-size: .86rem; width: 100%; margin: .6rem 0 1.2rem; }
th { text-align: left; border-top: 1.5px solid #111; border-bottom: 1px solid #111; padding: .3rem .5rem; }
td { border-bottom: 1px solid var(--line); padding: .25rem .5rem; vertical-align: top; }
table tr:last-child td { border-bottom: 1.5px solid #111; }
td.number { text-align: right; white-space: nowrap; } td.word { white-space: nowrap; }
.pass { color: var(--good); } .MISS { color: var(--miss); font-weight: 600; } .FAIL { color: var(--bad); font-weight: 600; }
.quiet { color: var(--quiet); font-size: .86rem; }
.bar { display: inline-block; width: 6rem; height: .7rem; border: 1px solid #777; position: relative; vertical-align: middle; }
.bar i { position: absolute; left: 0; top: 0; bottom: 0; background: #777; }
figure { margin: 1rem 0; } figure img { max-width: 100%; } figcaption { font-size: .86rem; color: var(--quiet); }
code { font-size: .86em; } pre { background: #f5f5f5; padding: .6rem; overflow-x: auto; font-size: .82rem; }
img.formula { vertical-align: middle; }
table.facts { width: auto; } table.facts td:first-child { white-space: nowrap; padding-right: 1.2rem; color: var(--quiet); }
.wide { overflow-x: auto; } caption { text-align: left; font-size: .86rem; color: var(--quiet); padding: .2rem 0; }
.missing { border: 1px dashed #888; padding: .4rem .7rem; color: var(--quiet); } summary { cursor: pointer; font-size: .86rem; }
.shot { position: relative; max-width: 42rem; border: 1px solid var(--line); } .shot figure { margin: 0; }
.shot img { display: block; width: 100%; height: auto; } .shot svg.triad { position: absolute; left: .3rem; bottom: .3rem; }
.legend { font-size: .86rem; color: var(--quiet); max-width: 42rem; margin: .4rem 0 1rem; } .whole { white-space: nowrap; }
.swatch { display: inline-block; width: 1.1em; height: .8em; border: 1px solid #555; margin-right: .4em; vertical-align: -.05em; }
.dot { display: inline-block; width: .6em; height: .6em; border-radius: 50%; } .swatch, .dot { print-color-adjust: exact; }
section.page { display: none; } section.page:target { display: block; }
body:has(section.page:target) section#overview { display: none; } section#overview { display: block; }
@media print { section.page, body:has(section.page:target) section#overview { display: block; page-break-before: always; } }
"""


def write(folder, level, names, asked):
    """Writes report.html from the newest outcomes of the level; returns its path. A folder that was asked for must have one."""
    outcomes, missing = {}, []
    for name in names:
        try:
            outcomes[name] = Outcome.load(folder / level / f"{name}.json")
        except (OSError, ValueError, TypeError):
            missing.append(name)
    path = folder / "report.html"
    path.write_text(page(outcomes, missing, level, asked, folder / "runs"), encoding="utf-8")
    return path


def page(outcomes, missing, level, asked, runs):
    """The text of the report; `runs` is the folder of the runs."""
    parts = [overview(outcomes, missing, level, asked, runs), *(case_page(out, runs) for out in outcomes.values()), limitations(outcomes)]
    head = ("<meta charset='utf-8'><meta name='viewport' content='width=device-width'><title>Nereid: verification</title>"
            f"<style>{STYLE}</style>")
    return f"<!doctype html>\n<html lang='en'><head>{head}</head><body>\n" + "\n".join(parts) + "\n</body></html>\n"


NAVIGATION = "<nav><a href='#overview'>Overview</a> · <a href='#limitations'>Limitations</a></nav>"


# ------------------------------------------------------------------------------------------------
# Overview

def overview(outcomes, missing, level, asked, runs):
    failed_to_run, others = [name for name in missing if name in asked], [name for name in missing if name not in asked]
    text = ["<section id='overview'>", "<h1>Nereid: verification</h1>", NAVIGATION, "<h2>What was run</h2>",
            facts(outcomes, missing, level, runs)]
    if failed_to_run:
        text.append(f"<p class='FAIL'>Not run: {', '.join(failed_to_run)}.</p>")
    if others:
        text.append(f"<p class='quiet'>Without results at this level, since no command asked for them: {', '.join(others)}.</p>")
    text.append("<p class='quiet'><em>exact</em>: against a closed form. <em>order</em>: the error falls at the predicted rate. "
                "<em>invariant</em>: must hold in any configuration. <em>benchmark</em>: other codes agree in a stated range, which "
                "verifies nothing. <em>experiment</em>: against measurements. A <em>break</em> is a plausible mistake that a check must "
                "notice. The bar is error over limit.</p>")
    for letter, title in tables.SECTIONS.items():
        of_section = [out for out in outcomes.values() if tables.section_of(out.catalogue, out.evidence) == letter]
        if of_section:
            text += [f"<h2>{title}</h2>", "<table><tr><th>case</th><th>claim</th><th>evidence</th><th>closest check</th><th>error</th>"
                     "<th>limit</th><th></th><th>defaults</th><th>breaks</th><th></th></tr>",
                     *(overview_row(out) for out in of_section), "</table>"]
    return "\n".join([*text, "</section>"])


def facts(outcomes, missing, level, runs):
    """What was run, in a table: cases, checks, programs, runs, machine, and what was not run."""
    outs = list(outcomes.values())
    rows = [row for out in outs for row in out.rows]
    kinds = {kind: [row for row in rows if row.kind == kind] for kind in ("check", "study", "break", "miss")}
    evidence = collections.Counter(row.evidence or out.evidence for out in outs for row in out.rows if row.kind == "check")
    failed = [out.name for out in outs if not out.good()]
    unlike = ", ".join(f"<a href='#{name}'>{name}</a>" for name in failed)
    noticed = sum(row.good for row in kinds["break"])
    said = [("level", f"{level}; <code>scripts/verify --{level}</code>"),
            ("cases", f"{len(outs)} of {len(outs) + len(missing)} have an outcome at this level"),
            ("checks", f"{len(kinds['check'])}" + (f": {counted(evidence)}" if evidence else "")),
            ("studies and breaks", f"{len(kinds['study'])} refinement studies; {len(kinds['break'])} breaks, {noticed} of them noticed"),
            ("known misses", f"<a href='#limitations'>{len(kinds['miss'])}</a>"),
            ("failures", f"<span class='FAIL'>{len(failed)} fail</span>: {unlike}" if failed else
             "none: every check passes and every break is noticed" if outs else "no case was judged"),
            ("programs", programs_of(outs)), ("runs", runs_of(outs, runs)), ("machine", machine_of(outs)),
            ("left out", left_out_of(outs, level))]
    return "<table class='facts'>" + "".join(f"<tr><td>{name}</td><td>{text}</td></tr>" for name, text in said if text) + "</table>"


def counted(counts, most=None):
    """The entries of a counter, the most frequent first: 'exact 12, order 3'."""
    return ", ".join(f"{plain(str(name))} {count}" for name, count in counts.most_common(most))


def programs_of(outs):
    """Versions, commits and builds of the programs; how many cases each has where there are several."""
    def build(made):
        native = "for the processor that built it" if made.get("native") else ""
        return ", ".join(filter(None, [made.get("compiler"), made.get("flags"), made.get("build_type"), native]))

    def commit(made):
        text, _, dirty = made.get("commit", "unknown").partition("-")
        return f"version {made.get('version', 'unknown')}, commit {text[:12]}" + (", with changes that are not committed" if dirty else "")

    having = [out.provenance for out in outs if out.provenance]
    programs = collections.Counter(out.program for out in outs if out.provenance)
    parts = [counted(programs) + " cases"] if programs else ["unknown: no run was finished"]
    for found in (collections.Counter(map(commit, having)), collections.Counter(map(build, having))):
        parts += [f"{plain(text)}" + (f" ({count} cases)" if len(found) > 1 else "") for text, count in found.most_common()]
    return "; ".join(parts)


def runs_of(outs, runs):
    """How many runs there are, how many were new, and their time."""
    names = dict.fromkeys(name for out in outs for name in out.folders)
    records = [record for name in names if (record := setup.record_of(runs / name))]
    seconds = sum(record.get("processor_seconds") or record["seconds"] for record in records)
    count, made = len(names) + sum(out.runs for out in outs if not out.folders), sum(out.made for out in outs)
    said = f"{count} runs, {made} of them new when their case was judged; processor time {duration(seconds)}"
    return said + (f" of the {len(records)} that are kept" if len(records) < count else "")


def machine_of(outs):
    processors = collections.Counter(out.provenance["processor"] for out in outs if out.provenance.get("processor"))
    threads = sorted({out.cost["threads"] for out in outs if out.cost.get("threads")})
    said = [plain(name) + (f" ({count} cases)" if len(processors) > 1 else "") for name, count in processors.most_common()]
    return "; ".join([*said, *([f"threads of a run: {', '.join(map(str, threads))}"] if threads else [])])


def left_out_of(outs, level):
    """How much of the full level this one leaves out."""
    counts = collections.Counter(kind for out in outs for kind, _ in out.left_out)
    names = [f"{counts[kind]} {words[counts[kind] != 1]}" for kind, words in setup.KINDS.items() if counts[kind]]
    return f"{', '.join(names)}, which are of the full level only" if names else "" if level == "quick" else "nothing"


def overview_row(out):
    closest = out.closest()
    name, error, limit, bar = ("", "", "", "")
    if closest:
        name, error, limit = plain(closest.name), closest.error, closest.limit
        filled = min(1.0, closest.size / closest.within) if closest.within and math.isfinite(closest.size) else float(closest.size > 0)
        bar = f"<span class='bar'><i style='width:{100 * filled:.0f}%'></i></span>"
    word = "FAIL" if not out.good() else f"{len(out.misses())} MISS" if out.misses() else "pass"
    number = f"<br><span class='quiet'>{', '.join(out.catalogue)}</span>" if out.catalogue else ""
    breaks = [row for row in out.rows if row.kind == "break"]
    return ("<tr><td><a "
            f"href='#{out.name}'>{out.name.replace('_', ' ')}</a>{number}</td><td>{inline(out.claim)}</td>"
            f"<td>{', '.join(out.kinds())}</td>"
            f"<td>{name}</td><td class='number'>{error}</td><td class='number'>{limit}</td><td>{bar}</td>"
            f"<td>{plain(defaults.of_checks(out.gated()))}</td>"
            f"<td class='number'>{sum(row.good for row in breaks)}/{len(breaks)}</td><td class='word {word.split()[-1]}'>{word}</td></tr>")


# ------------------------------------------------------------------------------------------------
# A case

def case_page(out, runs):
    folder = ROOT / "verification" / out.name
    title, text = authored(folder / "README.md", out)
    parts = [f"<section class='page' id='{out.name}'>", NAVIGATION, f"<h1>{html.escape(title)}</h1>", text, setup.what_ran(runs, out),
             *(["<h3>Results</h3>"] if out.figures else []), *map(picture, out.figures),
             "<h3>Checks</h3>", rows_table([row for row in out.rows if row.kind not in ("study", "break")], out)]
    for kind, heading in (("study", "Studies"), ("break", "Breaks")):
        rows = [row for row in out.rows if row.kind == kind]
        if rows:
            parts += [f"<h3>{heading}</h3>", rows_table(rows, out)]
    for heading, columns, body in out.tables:
        parts += [f"<h3>{inline(heading)}</h3>", table(columns, body)]
    reasons = [row for row in out.rows if row.because]
    if reasons:
        parts += ["<h3>Reasons of the limits</h3><ul>", *(f"<li>{inline(row.name)}: {inline(row.because)}.</li>" for row in reasons),
                  "</ul>"]
    if out.departures:
        lines = (f"<li>{inline(line[2:])}</li>" for line in tables.departure_lines(out))
        parts += ["<h3>What is not the default</h3><ul>", *lines, "</ul>"]
    parts += [ledger(out), cost(out), provenance(out), "</section>"]
    return "\n".join(parts)


def authored(path, out):
    """Title and text of what a README says in front of its table; the claim where there is none."""
    text = path.read_text(encoding="utf-8") if path.is_file() else f"# {out.name.replace('_', ' ')}\n\n{out.claim}"
    text = text.split(tables.BEGIN)[0].strip()
    title, _, body = text.partition("\n")
    return title.lstrip("# "), rendered(body)


def picture(entry):
    name, caption, svg = entry
    said = inline(caption) if caption else name.replace("_", " ").capitalize() + "."
    return f"<figure><img alt='{html.escape(name)}' src='{as_address(svg)}'><figcaption>{said}</figcaption></figure>"


def rows_table(rows, out):
    lines = []
    for row in rows:
        word = "FAIL" if not row.good else "MISS" if row.kind == "miss" else "pass" if row.kind != "report" else "quiet"
        numbers = "".join(f"<td class='number'>{html.escape(text)}</td>" for text in (row.expected, row.got, row.error, row.limit))
        lines.append(f"<tr><td>{inline(tables.named(row, out))}</td>{numbers}<td class='word {word}'>{html.escape(row.word)}</td></tr>")
    return "<table><tr><th></th><th>expected</th><th>got</th><th>error</th><th>limit</th><th></th></tr>" + "".join(lines) + "</table>"


def table(columns, body):
    return ("<table><tr>" + "".join(f"<th>{inline(c)}</th>" for c in columns) + "</tr>"
            + "".join("<tr>" + "".join(f"<td>{inline(c)}</td>" for c in line) + "</tr>" for line in body) + "</table>")


def ledger(out):
    """Where the energy of the shown run is at its end."""
    accounts = out.ledger.get("accounts", {})
    if not accounts:
        return ""
    initial = out.ledger["initial_kinetic"]["value"]
    body = [["kinetic, at the start", joule(initial), "", "", ""], ["kinetic, at the end", joule(out.ledger["kinetic"]["value"]), "", "",
                                                                    ""]]
    for source, account in accounts.items():
        stored = ", ".join(f"{key} {joule(value['value'])}" for key, value in account["stored"].items() if value["value"])
        lost = ", ".join(f"{key} {joule(value['value'])}" for key, value in account["dissipated"].items() if value["value"])
        body.append([source, joule(account["work"]["value"]), stored, lost, joule(account["created"]["value"])])
    body.append(["unexplained", joule(out.ledger["energy_residual"]["value"]), "", "", ""])
    return "<h3>Ledger</h3>" + table(["", "energy, or work done", "stored", "dissipated", "created"], body)


def joule(value):
    return "0" if value == 0 else f"{value:.4g} J"


def cost(out):
    if "steps" not in out.cost:
        return f"<h3>Cost</h3><p>{out.runs} runs of {out.seconds:.1f} s in all.</p>"
    return (f"<h3>Cost</h3><p>The shown run: {out.cost['elements']} elements, {out.cost['steps']} steps, {out.cost['wall_seconds']:.2g} s. "
            f"All {out.runs} runs of the {out.level} level: {out.seconds:.1f} s on one core.</p>")


def provenance(out):
    made = out.provenance
    if not made:
        return ""
    words = f"scripts/verify {out.name} --{out.level}"
    said = [f"{out.program} {out.case}", f"commit {made.get('commit')}", made.get("compiler"), made.get("flags"), made.get("processor"),
            f"case {made.get('case_hash')}"]
    return (f"<h3>Provenance</h3><p class='quiet'>{html.escape('; '.join(filter(None, said)))}. "
            f"Made again by <code>{words}</code>.</p>")


# ------------------------------------------------------------------------------------------------
# Limitations

def limitations(outcomes):
    """Every known miss with its analysis, and what the page of all cases says of what is not verified and not possible."""
    parts = ["<section class='page' id='limitations'>", NAVIGATION, "<h1>Limitations</h1>", "<h2>Known misses</h2>"]
    misses = [(out, row) for out in outcomes.values() for row in out.misses()]
    parts.append("<p>None at this level.</p>" if not misses else "<ul>" + "".join(
        f"<li><a href='#{out.name}'>{out.name.replace('_', ' ')}</a>: {inline(row.name)}, error {row.error}, limit {row.limit}. "
        f"{sentence(row.because)}</li>" for out, row in misses) + "</ul>")
    reported = [(out, row) for out in outcomes.values() for row in out.rows if row.kind == "report"]
    if reported:
        parts += ["<h2>Reported and not gated</h2>", "<ul>" + "".join(
            f"<li><a href='#{out.name}'>{out.name.replace('_', ' ')}</a>: {inline(row.name)}, {row.error} off. {sentence(row.because)}</li>"
            for out, row in reported) + "</ul>"]
    page = (ROOT / tables.PAGE).read_text(encoding="utf-8")
    for heading in ("What is not verified", "Limitations"):
        found = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", page, re.DOTALL | re.MULTILINE)
        if found:
            parts += [f"<h2>{heading}</h2>", rendered(found.group(1))]
    return "\n".join([*parts, "</section>"])


# ------------------------------------------------------------------------------------------------
# Text

def rendered(text):
    """Markdown with $formulas$ as HTML."""
    formulas = []

    def keep(found):
        formulas.append(formula(found.group(1) or found.group(2)))
        return f"\ue000{len(formulas) - 1}\ue001"

    text = re.sub(r"\$\$(.+?)\$\$|(?<![\\\w])\$([^$\n]+?)\$", keep, text, flags=re.DOTALL)
    text = re.sub(r"\[([^\]]+)\]\((?!http)[^)]*\)", r"\1", text)  # links into the tree lead nowhere from here
    out = markdown.markdown(text, extensions=["tables", "fenced_code"])
    return re.sub("\ue000(\\d+)\ue001", lambda found: formulas[int(found.group(1))], out)


def inline(text):
    """One line of Markdown; what looks like a tag is text."""
    pieces = re.split(r"(`[^`]*`)", str(text))
    out = rendered("".join(piece if piece.startswith("`") else piece.replace("<", "&lt;") for piece in pieces))
    return out[3:-4] if out.startswith("<p>") and out.count("<p>") == 1 else out


def sentence(text):
    return inline(text[:1].upper() + text[1:] + ".")


def plain(text):
    return html.escape(text)


def formula(tex):
    """A formula as a picture, or its text where it cannot be drawn."""
    drawn = drawing.formula_svg(tex)
    if drawn is None:
        return f"<code>{html.escape(tex)}</code>"
    svg, height, depth = drawn
    style = f"height:{height:.3f}em;vertical-align:{-depth:.3f}em"
    return f"<img class='formula' alt='{html.escape(tex, quote=True)}' src='{as_address(svg)}' style='{style}'>"


def as_address(svg):
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()
