"""The page of a report: HTML of one run, or of some runs over each other. No address on it leads outside of it."""
import math

from report_compare import settings
from report_curves import energies, histories
from report_results import cost, results
from report_run import ENDINGS, dict_of, number_of
from report_scene import Times, set_up, shots
from report_text import anchor, duration, esc, folded, missing, named, quantity, run_heading, share, table, tag

STYLE = """
:root { --line: #cfcfcf; --quiet: #555; --good: #1b6e3a; --warn: #8a5200; --bad: #a3161a; --paper: #f6f6f3; }
* { box-sizing: border-box; }
body { font: 15px/1.45 Georgia, 'Times New Roman', serif; max-width: 74rem; margin: 1.5rem auto; padding: 0 1.2rem; color: #111; }
h1, h2, h3 { line-height: 1.2; font-weight: 600; } h1 { font-size: 1.7rem; margin: 0 0 .4rem; }
h2 { font-size: 1.3rem; margin: 2.2rem 0 .7rem; padding-bottom: .25rem; border-bottom: 1.5px solid #111; }
h3 { font-size: 1.05rem; margin: 1.3rem 0 .4rem; }
a { color: #0b4f8a; text-decoration: none; } a:hover { text-decoration: underline; }
nav { font-size: .9rem; margin: .8rem 0; } nav a { margin-right: .9rem; white-space: nowrap; }
.ended { font-size: 1.1rem; margin: .3rem 0; padding: .5rem .8rem; border-left: 5px solid var(--quiet); background: var(--paper); }
.ended.good { border-color: var(--good); } .ended.stopped { border-color: var(--bad); } .ended.interrupted { border-color: var(--warn); }
.quiet, figcaption, caption { color: var(--quiet); font-size: .87rem; } caption { text-align: left; padding: .2rem 0; }
.facts { display: flex; flex-wrap: wrap; gap: .3rem 1.8rem; margin: .7rem 0; padding: 0; list-style: none; }
.facts b { font-weight: 600; } .facts span.name { color: var(--quiet); font-size: .87rem; margin-right: .35rem; }
ul.said { list-style: none; padding: 0; margin: .5rem 0; }
ul.said li { border-left: 4px solid var(--line); padding: .3rem .8rem; margin: .45rem 0; break-inside: avoid; }
ul.said li.ending { border-color: var(--bad); } ul.said li.warning { border-color: #d98a00; }
ul.said .kind { font-weight: 600; margin-right: .4rem; } li.ending .kind { color: var(--bad); } li.warning .kind { color: var(--warn); }
ul.said .remedy { display: block; margin-top: .15rem; }
.missing { border: 1px dashed #888; padding: .4rem .7rem; color: var(--quiet); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; margin: .4rem 0 1rem; }
th { text-align: left; border-bottom: 1px solid #111; padding: .25rem .7rem .25rem 0; vertical-align: bottom; }
td { border-bottom: 1px solid var(--line); padding: .2rem .7rem .2rem 0; vertical-align: baseline; } sup { line-height: 0; }
tr { break-inside: avoid; } tr:target { background: #fff3c4; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.apart { font-weight: 600; }
figure { margin: .3rem 0; break-inside: avoid; } figure img { width: 100%; height: auto; display: block; }
.row { display: grid; gap: .8rem 1.4rem; margin: .6rem 0; align-items: start; }
.row.two { grid-template-columns: repeat(2, minmax(0, 1fr)); } .row.three { grid-template-columns: repeat(3, minmax(0, 1fr)); }
.row.curves.two { max-width: 52rem; }
.shot { position: relative; border: 1px solid var(--line); } .shot svg.triad { position: absolute; left: .3rem; bottom: .3rem; }
.whole { white-space: nowrap; }
.swatch { display: inline-block; width: 1.1em; height: .8em; border: 1px solid #555; margin-right: .4em; vertical-align: -.05em; }
.bar { display: inline-block; width: 8rem; height: .65rem; border: 1px solid #888; vertical-align: middle; }
.bar i { display: block; height: 100%; background: #4a7fb0; }
pre { background: var(--paper); padding: .6rem; overflow-x: auto; font-size: .78rem; } code { font-size: .88em; overflow-wrap: anywhere; }
details { margin: .5rem 0; } summary { cursor: pointer; font-weight: 600; }
.key { display: inline-block; min-width: 1.35em; text-align: center; font-weight: 600; border: 1px solid #111; border-radius: 3px;
  padding: 0 .2em; margin-right: .35em; font-size: .85em; }
.swatch, .bar i, .ended, svg rect { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
@media (max-width: 50rem) { .row.two, .row.three { grid-template-columns: minmax(0, 1fr); } }
@media print { @page { size: A4; margin: 14mm; } body { font-size: 10pt; max-width: none; margin: 0; padding: 0; } nav { display: none; }
  h2, h3 { break-after: avoid; } .wide { overflow: visible; } table { font-size: .78rem; } pre { white-space: pre-wrap; }
  .row.two { grid-template-columns: repeat(2, minmax(0, 1fr)); } .row.three { grid-template-columns: repeat(3, minmax(0, 1fr)); }
  .row.curves { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
"""

SECTIONS = (("warnings", "Warnings"), ("setup", "Set-up"), ("pictures", "Pictures"), ("histories", "Histories"),
            ("energy", "Energy balance"), ("results", "Results"), ("cost", "Cost"), ("provenance", "Provenance"))


def page(runs, wanted):
    title = wanted.title or " and ".join(run.name for run in runs[:3]) + (f" and {len(runs) - 3} more" if len(runs) > 3 else "")
    times = Times(runs, wanted)
    sections = {"warnings": warnings(runs), "setup": set_up(runs, wanted), "pictures": shots(runs, wanted, times),
                "histories": histories(runs, wanted, times), "energy": energies(runs, times), "results": results(runs),
                "cost": cost(runs), "provenance": provenance(runs)}
    if len(runs) > 1:
        sections = {"differences": differences(runs), **sections}
    titles = {"differences": "What differs in the cases", **dict(SECTIONS)}
    navigation = "<nav>" + "".join(f"<a href='#{key}'>{titles[key]}</a>" for key in sections) + "</nav>"
    body = [f"<h1>{esc(title)}</h1>", head(runs), navigation]
    body += [f"<section id='{key}'><h2>{titles[key]}</h2>{text}</section>" for key, text in sections.items()]
    meta = "<meta charset='utf-8'><meta name='viewport' content='width=device-width, initial-scale=1'>"
    return (f"<!doctype html>\n<html lang='en'><head>{meta}<title>{esc(title)}</title><style>{STYLE}</style></head>\n<body>\n"
            + "\n".join(body) + "\n</body></html>\n")


# ------------------------------------------------------------------------------------------------
# Head

def head(runs):
    if len(runs) == 1:
        return ended(runs[0]) + facts(runs[0])
    rows = [[named(run), sentence_of_end(run), esc(run.summary.get("driver", "unknown")), esc(run.provenance().get("version", "unknown")),
             f"<span class=whole>{esc(run.written())}</span>"] for run in runs]
    return table(["run", "how it ended", "program", "version", "written"], rows)


def ended(run):
    kind = "good" if run.good else "interrupted" if run.word in ("interrupted", "") else "stopped"
    made = [f"program {run.summary.get('driver')}" if run.summary.get("driver") else "program unknown",
            f"version {run.provenance().get('version')}" if run.provenance().get("version") else "version unknown",
            f"written {run.written()}", f"case {run.provenance().get('case_path')}" if run.provenance().get("case_path") else ""]
    return f"<p class='ended {kind}'>{sentence_of_end(run)}</p><p class=quiet>{esc(' · '.join(filter(None, made)))}</p>"


def sentence_of_end(run):
    if not run.word:
        last = f" Its histories end at {quantity(run.end, run.first_unit)}." if math.isfinite(run.end) else ""
        return f"It is unknown how the run <b>{esc(run.name)}</b> ended: it has no summary.{last}"
    at = f" at {quantity(run.end, 's')}" if run.over_time and run.cost().get("steps") else ""
    reason = run.reason() if run.reason() != run.word else ""
    blamed = dict_of(run.summary, "ending")
    who = f" in {blamed['block']}" if blamed.get("block") else ""
    who += f", element {blamed['element']}" if blamed.get("element") is not None else ""
    said = f"The run <b>{esc(run.name)}</b> {ENDINGS.get(run.word, esc(run.word))}{at}{esc(who)}"
    return said + (f": {esc(reason)}" if reason else "") + f" (<code>{esc(run.word)}</code>, exit status {run.status})."


def facts(run):
    steps, wall = run.cost().get("steps"), run.cost().get("wall_seconds")
    said, _ = run.sentences()
    warned = sum(one.kind in ("ending", "warning") for one in said)
    shown = [("warnings", f"<a href='#warnings'>{warned}</a>") if run.summary else None, ("elements", run.cost().get("elements")),
             ("steps", steps), ("time on the clock", duration(wall) if wall is not None else None),
             ("rows", len(run.columns[run.first]) if run.first else None), ("frames", len(run.frames) or None)]
    shown = [one for one in shown if one and one[1] not in (None, 0)]
    if run.ledger("energy_scale") > 0:
        made = sum(number_of(one.get("created")) for one in run.accounts().values())
        shown.append(("created energy", share(made / run.ledger("energy_scale"), 2)))
    return "<ul class=facts>" + "".join(f"<li><span class=name>{name}</span><b>{value}</b></li>" for name, value in shown) + "</ul>"


# ------------------------------------------------------------------------------------------------
# Warnings

def warnings(runs):
    parts = []
    for run in runs:
        parts += [run_heading(run, runs), *(missing(f"{tag(run)}{esc(one)}") for one in run.missing)]
        said, gaps = run.sentences()
        warned = [one for one in said if one.kind in ("ending", "warning")]
        others = [one for one in said if one.kind in ("note", "information")]
        if warned:
            parts.append(listed(run, warned))
        elif run.summary:
            parts.append("<p>The run gave no warning.</p>")
        else:
            parts.append("<p>Warnings are unknown, since they are in summary.json.</p>")
        if others:
            parts.append(folded(f"{len(others)} {'note' if len(others) == 1 else 'notes'}", listed(run, others), True))
        if gaps:
            parts.append(folded("Initial gaps of contacts", f"<pre>{esc(chr(10).join(gaps))}</pre>"))
    return "".join(parts)


def listed(run, said):
    words = {"ending": "Stopped", "warning": "Warning", "note": "Note", "information": "Information"}
    lines = []
    for one in said:
        remedy = f"<span class=remedy><b>Remedy:</b> {esc(one.remedy)}.</span>" if one.remedy else ""
        if not one.remedy and one.kind == "warning":
            remedy = "<span class='remedy quiet'>No remedy was shown to help.</span>"
        where = f"<span class=quiet>See <a href='#{esc(target(run, one.where[0]))}'>{esc(one.where[1])}</a>.</span>" if one.where else ""
        word = "Interrupted" if one.kind == "ending" and run.word == "interrupted" else words[one.kind]
        text = one.text if one.text.endswith(".") else one.text + "."
        lines.append(f"<li class={one.kind}><span class=kind>{word}</span>{esc(text)} {remedy} {where}</li>")
    return "<ul class=said>" + "".join(lines) + "</ul>"


def target(run, name):
    """The anchor of a place; sections serve all runs."""
    return name if name in dict(SECTIONS) else anchor(run, name)


# ------------------------------------------------------------------------------------------------
# Provenance

def provenance(runs):
    parts = []
    for run in runs:
        parts.append(run_heading(run, runs))
        made = run.provenance()
        if not made:
            parts.append(missing(f"{tag(run)}The provenance is unknown, since it is in summary.json."))
            continue
        driver, path = run.summary.get("driver", ""), made.get("case_path", "")
        with_threads = f" --threads {run.cost()['threads']}" if run.cost().get("threads") else ""
        rows = [["program", esc(f"{driver}, version {made.get('version', 'unknown')}, commit {made.get('commit', 'unknown')}")],
                ["built by", esc(f"{made.get('compiler', '')} {made.get('flags', '')}, {made.get('build_type', '')}"
                                 + (", for the processor that built it" if made.get("native") else ""))],
                ["processor", esc(made.get("processor", "unknown"))],
                ["case", f"<code>{esc(path)}</code>, hash <code>{esc(made.get('case_hash', ''))}</code>"],
                ["command", f"<code>{esc(driver)} {esc(path)} --out {esc(run.folder)}{with_threads}</code>, made from the summary; "
                 "what <code>--set</code> changed is in the table of values"],
                ["written", esc(run.written())]]
        parts.append(table(["", ""], rows))
        values = run.values()
        lines = [[f"<code>{esc(name)}</code>", esc(value), "default" if default else ""] for name, (value, default) in values.items()]
        if lines:
            given = sum(not default for _, default in values.values())
            title = f"All {len(lines)} values of the case; {given} were given, the others are defaults"
            parts.append(f"<div id='{esc(anchor(run, 'case'))}'>{folded(title, table(['key', 'value', ''], lines))}</div>")
    return "".join(parts)


# ------------------------------------------------------------------------------------------------
# Differences of cases

def differences(runs):
    having = [run for run in runs if run.resolved()]
    parts = [missing(f"{tag(run)}The values of its case are unknown, since they are in summary.json.") for run in runs if run not in having]
    if len(having) < 2:
        return "".join(parts)
    columns, rows, alike = settings(having)
    if not rows:
        return "".join([*parts, "<p>All values of the cases are the same.</p>"])
    shown = table(columns, rows)
    said = f"<p class=quiet>{alike} values are the same.</p>"
    if alike == 0:
        said = "<p>The cases have no value in common.</p>"
    return "".join([*parts, folded(f"{len(rows)} values", shown) if len(rows) > 40 else shown, said])
