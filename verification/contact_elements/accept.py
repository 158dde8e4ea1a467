"""How close is close enough, why, and what must break."""
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ("C-0",)
CLAIM = ("B of the tetrahedral, triangular and line element is the gradient of the height, has no net force and no net moment, rotates "
         "with the element and does not depend on the node order, slivers included; so does Eq. 8a as corrected.")
EVIDENCE = "invariant"
DRIVER = "contact_elements"

KINDS = {"tetrahedral": 3, "triangular": 2, "line": 1}
CORRECTED, PRINTED = {"formula": "corrected"}, {"formula": "printed"}


def largest(name, change=()):
    def measure(run):
        here = run.again(dict(change)) if change else run
        return Pair(here.result(name), 0, "", scale=1)
    return measure


def formulas(run):
    rows = []
    for formula in ("height", "corrected", "printed"):
        here = run.again({"formula": formula})
        rows.append([formula, *(f"{here.result('tetrahedral_' + name):.1e}" for name in ("gradient", "force", "moment", "motion",
            "order"))])
    return rows


TOLERANCE = "the catalogue's bound, over the largest B of the element and, of moments, over its longest edge; "
CHECKS = [
    *[Check(f"{kind}: gradient", largest(f"{kind}_gradient"), 1e-9, TOLERANCE + "the differences have an error of their own of 1e-10")
      for kind in KINDS],
    *[Check(f"{kind}: net force", largest(f"{kind}_force"), 1e-9, TOLERANCE + "weights sum to one",
            like="tetrahedral: net force") for kind in KINDS],
    *[Check(f"{kind}: net moment", largest(f"{kind}_moment"), 1e-9, TOLERANCE + "round-off grows with the sharpness",
            like="tetrahedral: net moment") for kind in KINDS],
    *[Check(f"{kind}: rigid motion", largest(f"{kind}_motion"), 1e-9, TOLERANCE + "round-off grows with the sharpness",
            like="tetrahedral: rigid motion") for kind in KINDS],
    *[Check(f"{kind}: order of nodes", largest(f"{kind}_order"), 1e-9, TOLERANCE + "round-off grows with the sharpness",
            like="triangular: order of nodes")
      for kind in ("tetrahedral", "triangular")],
    Check("Eq. 8a corrected: gradient", largest("tetrahedral_gradient", CORRECTED), 1e-9,
          TOLERANCE + "its terms cancel, the more the sharper the element"),
]

STUDIES = [Table("The tetrahedral element by three formulas: largest errors over the largest B.",
                 ["formula", "gradient", "force", "moment", "rigid motion", "order of nodes"], formulas)]

BREAKS = [
    Breaks("tetrahedral: gradient", "Eq. 8a as printed", PRINTED),
    Breaks("tetrahedral: net force", "Eq. 8a as printed", PRINTED),
    Breaks("tetrahedral: net moment", "Eq. 8a as printed", PRINTED),
    Breaks("tetrahedral: rigid motion", "Eq. 8a as printed", PRINTED),
    Breaks("triangular: gradient", "differences at a step that sees the curvature", {"step": 0.05}),
    Breaks("line: gradient", "differences at a step that sees the curvature", {"step": 0.05}),
    Breaks("Eq. 8a corrected: gradient", "differences at a step that sees the curvature", {"step": 0.05}, full=True),
    *(Breaks(f"triangular: {what}", "slivers a million times as sharp: round-off beyond the limit", {"squeeze": 1e8}, full=True)
      for what in ("rigid motion", "order of nodes")),
]


def errors(run):
    """The upper edge of the cloud: the largest error in every third of a decade of sharpness."""
    from math import floor, log10
    shown = []
    for kind, nodes in KINDS.items():
        bins = {}
        for n, sharp, error in zip(run.column("base_nodes"), run.column("sharpness"), run.column("gradient")):
            if n == nodes:
                at = floor(3 * log10(sharp))
                bins[at] = max(bins.get(at, 0.0), error)
        shown.append((kind, [10**((at + 0.5) / 3) for at in sorted(bins)], [bins[at] for at in sorted(bins)]))
    return shown


def limit(_run):
    return [("limit", [1, 3000], [1e-9, 1e-9])]


FIGURES = [Figure("errors", "longest edge over smallest length [-]", "B less central differences, over B [-]", errors, exact=limit,
                  log=True,
                  caption="The gradient of three contact elements beside differences of their heights: round-off, and nothing else.")]
