"""What the runs write into the tree: the table of a case in its README, the table of all cases in docs/verified.md.

`stale` says where the tree differs from the runs. An error counts as the same within a twentieth of itself or a
hundredth of its limit: another processor rounds otherwise; and below 1e-8, where it is rounding, within its limit. Of a
chaotic check only the limit and the verdict count.
"""
import re

import defaults
from verification_outcome import EVIDENCE, Outcome

BEGIN, END = "<!-- written by scripts/verify.py -->", "<!-- end of what scripts/verify.py writes -->"
PAGE = "docs/verified.md"  # holds the table of all cases
SECTIONS = {"E": "Elements", "P": "Plates", "M": "Materials", "I": "Impact", "C": "Contact", "F": "Fluids", "W": "Whole problems",
            "invariant": "Invariants", "": "Others"}
ROUNDING = 1e-8


# ------------------------------------------------------------------------------------------------
# A case

def case_block(out):
    """The generated part of the README of a case."""
    pictures = [f"![{caption or name.replace('_', ' ')}]({name}.svg)\n" for name, caption, _ in out.figures if name]
    lines = [BEGIN, "", *pictures, HEAD, "|---|---|---|---|---|---|"]
    lines += [case_line(row, out) for row in out.rows]
    reasons = [row for row in out.rows if row.because]
    if reasons:
        lines += ["", REASONS, ""]
        lines += [f"- {row.name}: {row.because}." for row in reasons]
    if out.departures:
        lines += ["", DEPARTURES, "", *departure_lines(out)]
    for title, columns, body in out.tables:
        lines += ["", title, "", "| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
        lines += ["| " + " | ".join(line) + " |" for line in body]
    lines += ["", f"All {out.runs} runs together take about {rough(out.seconds)} s on one core.", "", END]
    return "\n".join(lines)


HEAD, REASONS, DEPARTURES = "| check | expected | got | error | limit | |", "Reasons of the limits:", "What is not the default:"
WORD = re.compile(rf" \(({'|'.join(EVIDENCE)})\)$")  # behind the name of a check: its evidence
KINDS = {"falls": "*study:* {} along ", "breaks": "*must fail:* {} → "}  # how rows of studies and breaks begin


def patched_block(old, out):
    """A block of the full level, with the rows, reasons and departures of a quick outcome in the place of the old ones."""
    lines = old.splitlines()
    stays = stays_of(out)
    lines = patch(lines, HEAD, 2, "| ", kept_lines(old, out), lambda line: WORD.sub("", entries(line)[0]), stays)
    reasons = {row.name: f"- {row.name}: {row.because}." for row in out.rows if row.because}
    names = [*reasons, *(name for kind, name in out.left_out)]

    def named_in(line):
        return max((name for name in names if line.startswith(f"- {name}: ")), key=len, default="")
    lines = patch(lines, REASONS, 2, "- ", reasons, named_in, stays)
    gated = any(kind in ("check", "miss") for kind, _ in out.left_out)
    departs = {line.split(": ", 1)[1]: line for line in departure_lines(out)}
    lines = patch(lines, DEPARTURES, 2, "- ", departs, lambda line: line.split(": ", 1)[-1], lambda _: gated)
    return "\n".join(lines)


def kept_lines(old, out):
    """{name: line} of the rows of an outcome; the old line where it says the same, as that of a break also has its smallest fault."""
    written = written_rows(old)
    lines = {row.name: written.get(named(row, out), "") for row in out.rows}
    return {row.name: lines[row.name] if same_row(lines[row.name], row) else case_line(row, out) for row in out.rows}


def written_rows(text):
    """{first entry: line} of the rows of the first table with six columns; a later table may have rows of the same name."""
    written = {}
    for line in text.splitlines():
        if line.startswith("| ") and len(entries(line)) == 6:
            written.setdefault(entries(line)[0], line)
    return written


def stays_of(out):
    """Whether the line of this name is of something that the quick level leaves out."""
    names = {name for kind, name in out.left_out if kind not in KINDS}
    begins = tuple(KINDS[kind].format(name) for kind, name in out.left_out if kind in KINDS)
    return lambda name: name in names or bool(begins) and name.startswith(begins)


def patch(lines, head, below, mark, new, name_of, stays):
    """Lines with those that begin with `mark`, from `below` a line `head` on, brought up to date: `new` by name, and old ones that stay.
    A new one that had no line stands behind the one that comes before it in `new`."""
    if head not in lines:
        return lines
    start = lines.index(head) + below
    end = start
    while end < len(lines) and lines[end].startswith(mark):
        end += 1
    names = [name_of(line) for line in lines[start:end]]
    kept = [(name, new.get(name, line)) for name, line in zip(names, lines[start:end]) if name in new or stays(name)]
    there, place = {name for name, _ in kept}, 0
    for name, line in new.items():
        if name not in there:
            kept.insert(place, (name, line))
        place = next(number for number, (one, _) in enumerate(kept, 1) if one == name)
    return [*lines[:start], *(line for _, line in kept), *lines[end:]]


def departure_lines(out):
    """Numerics of the checks that are not the defaults, and why; words of one reason together."""
    found = [one for row in out.gated() for one in row.departs]
    return [f"- {defaults.shown([one for one in found if out.departures.get(one[0]) == why])}: {why}."
            for why in dict.fromkeys(out.departures.values())]


def named(row, out):
    """The name of a row, and its evidence where that is not what the case says."""
    return row.name if row.evidence in ("", out.evidence) else f"{row.name} ({row.evidence})"


def case_line(row, out):
    return f"| {named(row, out)} | {row.expected} | {row.got} | {row.error} | {row.limit} | {row.word} |"


def rough(seconds):
    """To one digit: timings are not what the page is about, and should not change at every run."""
    if seconds < 1:
        return 1
    power = 10 ** (len(str(int(seconds))) - 1)
    return round(seconds / power) * power


# ------------------------------------------------------------------------------------------------
# All cases

def section_of(catalogue, evidence):
    """The letter of the first number of the catalogue; for what has no number whether it is an invariant."""
    if catalogue and catalogue[0][0] in SECTIONS:
        return catalogue[0][0]
    return evidence if evidence in SECTIONS else ""


def quick_part(out):
    """The rows that the quick suite has too."""
    return Outcome(out.name, out.level, evidence=out.evidence, rows=[row for row in out.rows if not row.full])


def suite_line(out):
    """One case in the table of all: its closest check, of those that the quick suite runs."""
    quick = quick_part(out)
    closest, missed = quick.closest(), len(quick.misses())
    error, limit, name = (closest.error, closest.limit, closest.name) if closest else ("", "", "")
    status = "FAIL" if not out.good() else f"{missed} MISS" if missed else "pass"
    numbers = f" {', '.join(out.catalogue)}" if out.catalogue else ""
    case = f"[{out.name}](../verification/{out.name}/README.md){numbers}"
    cells = (case, out.claim, ", ".join(quick.kinds()), name, error, limit, defaults.of_checks(quick.gated()), status)
    return f"| {' | '.join(cells)} |"


def suite_block(lines, sections):
    """The generated part of the page of all cases: lines by name of the case, a table for each section."""
    text = [BEGIN, ""]
    for letter, title in SECTIONS.items():
        of_section = [lines[name] for name in sorted(lines) if sections[name] == letter]
        if of_section:
            text += [f"**{title}**", "", "| case | claim | evidence | closest check | error | limit | defaults | |",
                     "|---|---|---|---|---|---|---|---|",
                     *of_section, ""]
    return "\n".join([*text, END])


def lines_of(text):
    """The lines of the table of all that stand in the text of the page, by name of the case."""
    block = text[text.find(BEGIN):text.find(END)] if BEGIN in text else ""
    return {found.group(1): line for line in block.splitlines() if (found := re.match(r"\| \[(\w+)\]\(\.\./verification/", line))}


def page_lines(root):
    """The lines that stand in the tree; none where the page is missing."""
    page = root / PAGE
    return lines_of(page.read_text(encoding="utf-8")) if page.is_file() else {}


def old_block(path):
    """The generated part of a page; empty where there is none."""
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    return text[text.index(BEGIN):text.index(END) + len(END)] if BEGIN in text and END in text else ""


def put_block(path, block):
    """Puts the block in place of the old one, or behind the text where there is none."""
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    pattern = re.compile(re.escape(BEGIN) + ".*?" + re.escape(END), re.DOTALL)
    text = pattern.sub(lambda _: block, text) if pattern.search(text) else text.rstrip("\n") + "\n\n" + block + "\n"
    path.write_text(text, encoding="utf-8")


def write(root, outcomes, names, kind_of):
    """Writes tables and figures of these outcomes into the tree; lines of other cases stay as they are. Of a quick outcome rows,
    reasons and departures are brought up to date in a page that has them, and all else there stays.

    names    of all cases
    kind_of  the numbers of the catalogue and the evidence of a case, by its name
    """
    for name, out in outcomes.items():
        folder = root / "verification" / name
        for picture, _, svg in out.figures:
            if picture:
                (folder / f"{picture}.svg").write_text(svg, encoding="utf-8")
        old = old_block(folder / "README.md") if out.level == "quick" else ""
        put_block(folder / "README.md", patched_block(old, out) if HEAD in old else case_block(out))
    page = root / PAGE
    page.parent.mkdir(exist_ok=True)
    old = page_lines(root)
    lines = {name: suite_line(outcomes[name]) if name in outcomes else old[name] for name in names if name in outcomes or name in old}
    put_block(page, suite_block(lines, {name: section_of(*kind_of(name)) for name in lines}))


# ------------------------------------------------------------------------------------------------
# Is the tree what the runs say?

def stale(root, names, folder):
    """Where tables in the tree differ from the quick outcomes in `folder`: one sentence each."""
    faults = []
    suite = page_lines(root)
    faults += [f"{PAGE}: has a line of {name}, which is no case" for name in suite if name not in names]
    for name in names:
        try:
            out = Outcome.load(folder / f"{name}.json")
        except OSError:
            faults.append(f"{name}: has no quick outcome in {folder}; run scripts/verify {name} first")
            continue
        faults += stale_case(root / "verification" / name, out)
        if name not in suite:
            faults.append(f"{PAGE}: has no line of {name}; scripts/verify --full --write makes it")
        elif not same_line(suite[name], suite_line(out), quick_part(out).closest()):
            faults.append(f"{PAGE}: the line of {name} is stale:\n  {suite[name]}\n  {suite_line(out)}")
    return faults


def stale_case(folder, out):
    path = folder / "README.md"
    if not path.is_file():
        return [f"{path}: is missing"]
    text = path.read_text(encoding="utf-8")
    written, faults = written_rows(text[text.find(BEGIN):]), []
    for row in out.rows:
        name = named(row, out)
        if name not in written:
            faults.append(f"{path}: has no row '{name}'; scripts/verify {out.name} --full --write makes it")
        elif not same_row(written[name], row):
            faults.append(f"{path}: is stale:\n  {written[name]}\n  {case_line(row, out)}")
    faults += [f"{path}: does not say why {word} is not the default" for word, why in out.departures.items() if f": {why}.\n" not in text]
    faults += [f"{folder / one}.svg: is missing" for one, _, _ in out.figures if one and not (folder / f"{one}.svg").is_file()]
    return faults


def entries(line):
    return [entry.strip() for entry in line.strip()[1:-1].split(" | ")]


def same_row(line, row):
    old = entries(line)
    if len(old) != 6 or old[4] != row.limit or old[5] != row.word:
        return False
    return row.chaotic or row.kind in ("gate", "study", "break", "report") or same_error(old[3], row.error, row.within)


def same_line(old, new, closest):
    """Lines of the table of all: the same claim, evidence and status; the closest check may be another of the same size."""
    before, after = entries(old), entries(new)
    if len(before) != len(after) or before[:3] != after[:3] or before[6:] != after[6:]:
        return False
    if before[3] != after[3] or before[5] != after[5]:  # rounding decides which of several is closest
        return min(number(before[4]), number(after[4])) < ROUNDING
    return same_error(before[4], after[4], closest.within if closest else None)


def same_error(old, new, within):
    a, b = number(old), number(new)
    if a is None or b is None:
        return old == new
    if within and max(a, b) <= min(ROUNDING, within):
        return True
    return abs(a - b) <= 0.05 * max(a, b) + 0.01 * (within or 0)


def number(text):
    """The number of an error as `share` writes it."""
    found = re.fullmatch(r"([-+0-9.e]+)( %)?", text.strip())
    return float(found.group(1)) * (0.01 if found.group(2) else 1) if found else None
