"""What comes out of a verification case: what the suite, its tables and its report have in common."""
import dataclasses
import json
import os

EVIDENCE = ("exact", "order", "invariant", "benchmark", "experiment")


@dataclasses.dataclass
class Row:
    """One line of the table, and whether all is as it should be; kind is gate, check, report, miss, study, break or fault."""
    kind: str
    name: str
    expected: str
    got: str
    error: str
    limit: str
    word: str
    good: bool
    because: str = ""
    size: float | None = None    # the error as a number
    within: float | None = None  # its limit
    full: bool = False           # not in the quick suite
    departs: list = dataclasses.field(default_factory=list)  # [word, value] of numerics that are not the defaults
    chaotic: bool = False        # its error is one of many within the limit
    evidence: str = ""           # of a check or a miss


@dataclasses.dataclass
class Outcome:
    """All that tables and report need of a case; goes to JSON and back."""
    name: str
    level: str
    program: str = ""
    case: str = ""
    claim: str = ""
    evidence: str = ""
    catalogue: list = dataclasses.field(default_factory=list)
    rows: list = dataclasses.field(default_factory=list)
    tables: list = dataclasses.field(default_factory=list)   # (title, columns, rows of texts)
    studies: list = dataclasses.field(default_factory=list)  # (title, along, sizes, errors)
    figures: list = dataclasses.field(default_factory=list)  # (name, caption, SVG)
    departures: dict = dataclasses.field(default_factory=dict)  # why, by word
    ledger: dict = dataclasses.field(default_factory=dict)
    provenance: dict = dataclasses.field(default_factory=dict)
    cost: dict = dataclasses.field(default_factory=dict)
    runs: int = 0
    made: int = 0
    seconds: float = 0.0  # of all runs, when they were made
    folders: list = dataclasses.field(default_factory=list)   # names of the folders of its runs, that of the base run first
    left_out: list = dataclasses.field(default_factory=list)  # (kind, name) of what the level leaves out

    def good(self):
        return bool(self.rows) and all(row.good for row in self.rows)

    def misses(self):
        return [row for row in self.rows if row.kind == "miss"]

    def gated(self):
        return [row for row in self.rows if row.kind in ("check", "miss")]

    def kinds(self):
        """Kinds of evidence: that of the case, then those that single checks have beside it."""
        return list(dict.fromkeys([self.evidence, *sorted({row.evidence for row in self.gated() if row.evidence})]))

    def closest(self):
        """The check whose error is the largest part of its limit, of those that are not chaotic if there are such."""
        gates = [row for row in self.rows if row.kind == "check" and row.size is not None]
        gates = [row for row in gates if not row.chaotic] or gates
        return max(gates, key=lambda row: row.size / row.within if row.within else row.size, default=None)

    def save(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        unfinished = folder / f"{self.name}.{os.getpid()}"
        unfinished.write_text(json.dumps(dataclasses.asdict(self), indent=1), encoding="utf-8")
        unfinished.replace(folder / f"{self.name}.json")

    @staticmethod
    def load(path):
        read = json.loads(path.read_text(encoding="utf-8"))
        read["rows"] = [Row(**row) for row in read["rows"]]
        return Outcome(**read)
