"""Commands and pictures of pages: what scripts/pages runs in place of a command, and which script writes which picture.

A command that is not in COMMANDS runs as it stands on its page. An entry that no page has, or a rule that no picture has, is a fault of
scripts/pages, so nothing stays here that is of no use.
"""
import dataclasses

# Pages whose commands CI runs at every change; a page that is not there is left out.
CI = ("README.md", "docs/tutorial.md")

# Where commands are looked for.
PAGES = ("README.md", "docs/*.md", "docs/theory/*.md", "verification/*/README.md")


@dataclasses.dataclass(frozen=True)
class Instead:
    """What runs in place of a command.

    run      a line of the shell in a copy of the tree; empty: nothing runs
    because  why
    statuses exit statuses that are expected
    says     a regular expression that the output must have with another status than 0
    needs    a program without which nothing runs
    """
    run: str
    because: str
    statuses: tuple = (0,)
    needs: str = ""
    says: str = ""


BUILDS = "installs packages and builds the programs: run by CI itself, scripts/run_tests and scripts/reproduce_cask_drop"
HOURS = "takes an hour or more"
TEMPLATE = "has a placeholder"
VERIFY = '"$PYTHON" scripts/verify.py'  # by the Python that runs scripts/pages, as scripts/verify chooses one that can draw
SCENE = "build/release/drivers/scene"
SHORT_CASE = "cases/scene/oblique.yaml"
# Of scripts/invariance: docs/invariance.md has the known differences beyond their limits. The status of a bad argument is 2, too, so that
# a row with this verdict must be there.
MAY_DIFFER = {"statuses": (0, 2), "says": r"(?m)^  \S+ +(round-off|bits) .* DIFFERS"}

# {the command without its comment: Instead}
COMMANDS = {
    # README
    "scripts/reproduce_cask_drop": Instead("", BUILDS),
    "scripts/run_tests": Instead("", BUILDS),
    "cmake --preset release": Instead("", BUILDS),
    "cmake --build --preset release --target scene": Instead("", BUILDS),
    "scripts/verify": Instead("scripts/verify.py --only-check", "installs and builds; all cases are run by scripts/run_tests"),
    "scripts/invariance CASE": Instead("scripts/invariance cases/two_blocks/bars.yaml --only rotated", TEMPLATE),
    "scripts/slides --jobs 2": Instead("scripts/slides --jobs 2 --count 2", HOURS),
    "scripts/prove": Instead("", "builds ten times; hours"),
    # docs/accuracy.md
    f"{SCENE} CASE.yaml --set refine=2 --out DIR": Instead(f"{SCENE} cases/scene/taylor_bar.yaml --set refine=2 --out out/finer", TEMPLATE),
    f"{SCENE} CASE.yaml --set accuracy=fast --out DIR": Instead(f"{SCENE} cases/scene/taylor_bar.yaml --set accuracy=fast --out out/fast",
                                                                TEMPLATE),
    f"{SCENE} CASE.yaml --accuracy 2% --of tip_last --out DIR":
        Instead(f"{SCENE} cases/scene/taylor_bar.yaml --accuracy 10% --of length_last --out out/accurate", TEMPLATE),
    # docs/adding.md
    "scripts/verify suddenly_pulled_bar": Instead(f"{VERIFY} suddenly_pulled_bar", "builds first"),
    "scripts/verify suddenly_pulled_bar --full --write": Instead(f"{VERIFY} suddenly_pulled_bar --full --write", "builds first"),
    # docs/cask_drop.md
    "scripts/cask_study": Instead("scripts/cask_study --quick --default 1", HOURS),
    "scripts/view.py out/cask_drop --cut --out cask.png":
        Instead("build/release/drivers/cask_drop cases/cask_drop/neptune.yaml --set model.kind=sector --out out/cask_drop --quiet && "
                "scripts/view.py out/cask_drop --cut --out cask.png", "the run before it builds; a sector takes a second"),
    # docs/coarse_meshes.md
    "scripts/coarse --jobs 2 --write": Instead("scripts/coarse --jobs 2 --scenes 6 --confirm 1 --plates 1", HOURS),
    "scripts/coarse --limits --write": Instead("scripts/coarse --limits --write --scenes 6 --confirm 1 --plates 1",
                                              "judges the runs of an hour"),
    # docs/experiments.md
    "scripts/experiments --write": Instead("scripts/experiments --points docs/experiments.csv", HOURS),
    # docs/forecast.md
    "scripts/forecast": Instead("scripts/forecast cases/two_blocks", "takes ten minutes"),
    # docs/invariance.md
    "scripts/invariance my.yaml --only rotated --only moving":
        Instead(f"cp {SHORT_CASE} my.yaml && scripts/invariance my.yaml --only rotated --only moving", "a case of the reader",
                **MAY_DIFFER),
    'scripts/invariance my.yaml --set "time.end=1 ms" --out out/mine':
        Instead(f'cp {SHORT_CASE} my.yaml && scripts/invariance my.yaml --set "time.end=1 ms" --only rotated --out out/mine',
                "a case of the reader; one change in place of all", **MAY_DIFFER),
    "scripts/invariance cases/scene/oblique.yaml": Instead("scripts/invariance cases/scene/oblique.yaml", "", **MAY_DIFFER),
    "scripts/invariance --suite --longest 2": Instead(
        "scripts/import_mesh cases/tutorial/bracket.inp out/bracket.vtu && scripts/invariance --suite --longest 0.01 --only rotated",
        f"{HOURS}; a case of the tutorial needs the mesh", **MAY_DIFFER),
    # docs/meshes.md
    "gmsh -3 bar.geo -o bar.msh": Instead(
        "printf '%s\\n' 'Point(1) = {0, 0, 0}; a[] = Extrude {1, 0, 0} {Point{1}; Layers{2}; Recombine;};"
        " b[] = Extrude {0, 1, 0} {Line{a[1]}; Layers{2}; Recombine;}; Extrude {0, 0, 1} {Surface{b[1]}; Layers{2}; Recombine;}' > bar.geo"
        " && gmsh -3 bar.geo -o bar.msh", "a geometry of the reader", needs="gmsh"),
    "scripts/import_mesh bar.msh bar.vtu": Instead(
        "test -f bar.msh || printf '%s\\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$Nodes' 8 '1 0 0 0' '2 1 0 0' '3 1 1 0' '4 0 1 0'"
        " '5 0 0 1' '6 1 0 1' '7 1 1 1' '8 0 1 1' '$EndNodes' '$Elements' 1 '1 5 2 1 1 1 2 3 4 5 6 7 8' '$EndElements' > bar.msh;"
        " scripts/import_mesh bar.msh bar.vtu", "a mesh of gmsh, or one cube where that is not installed"),
    # docs/reactor_head.md
    "ffmpeg -framerate 25 -i out/head/frames/frame_%04d.png head.mp4":
        Instead("ffmpeg -framerate 25 -i out/head/frames/frame_%04d.png head.mp4", "a program that need not be there", needs="ffmpeg"),
    # docs/running.md
    "DRIVER CASE.yaml --out DIR [--set key=value]... [--threads N] [--quiet] [--dry-run] "
    "[--checkpoint-every TIME] [--resume] [--accuracy 2% [--of RESULT] [--longest MINUTES]]":
        Instead(f"{SCENE} cases/scene/taylor_bar.yaml --out out/all --set time.safety=0.8 --threads 2 --quiet --dry-run "
                "--checkpoint-every '1 ms'", "a form"),
    f"{SCENE} case.yaml --out out/run --checkpoint-every '1 ms'":
        Instead(f"cp cases/scene/sliding_blocks.yaml case.yaml && {SCENE} case.yaml --out out/run --checkpoint-every '1 ms'",
                "a case of the reader"),
    # docs/scene.md
    "build/release/drivers/modes ANY_SCENE.yaml --set modes.lowest=20 --out out/its_modes":
        Instead("build/release/drivers/modes cases/modes/square_plate.yaml --set modes.lowest=20 --out out/its_modes", TEMPLATE),
    # docs/trade.md
    "scripts/trade two_blocks --budget 10":
        Instead("scripts/trade two_blocks --budget 10 --knobs step=0.45 --no-pairs", "takes ten minutes"),
    "scripts/trade taylor_bar --knobs mesh element step=0.9,0.45":
        Instead("scripts/trade taylor_bar --knobs mesh element step=0.9,0.45 --snakemake out/flow",
                "takes minutes; this only plans its runs"),
    "scripts/trade cases/scene/taylor_bar.yaml --result length_last --finest 1,1.5,2":
        Instead("scripts/trade cases/scene/taylor_bar.yaml --result length_last --finest 1,1.5,2 --knobs step=0.45 --no-pairs",
                "takes minutes"),
    "scripts/trade cases/cask_drop/neptune.yaml --result settlement_mean --vary lead.young=±10% 'interface.clearance=0..0.1 mm'":
        Instead("scripts/trade cases/cask_drop/neptune.yaml --result settlement_mean "
                "--vary lead.young=±10% 'interface.clearance=0..0.1 mm' --set model.kind=sector --set mesh.level=1 --points 8 "
                "--finest 1,2,3 --set 'time.end=1 ms'", "takes an hour"),
    "cd out/flow && snakemake --cores 2": Instead("cd out/flow && snakemake --cores 2", "a program that need not be there",
                                                  needs="snakemake"),
    # docs/verification.md
    "scripts/verify --full --jobs 2": Instead("scripts/verify.py --only-check --full --jobs 2", "the full suite, which runs this"),
    "scripts/verify taylor_bar two_blocks": Instead(f"{VERIFY} taylor_bar two_blocks", "builds first"),
    "scripts/extremes --jobs 2": Instead("scripts/extremes --axis shift --cell bars --jobs 2", HOURS),
    "scripts/extremes --random 1000 --seed 7": Instead("scripts/extremes --random 4 --seed 7", HOURS),
    "scripts/refine cases/scene/taylor_bar.yaml --levels 3 --result length_last":
        Instead("scripts/refine cases/scene/taylor_bar.yaml --levels 3 --by 0.5,0.75,1 --result length_last", "takes eight minutes"),
    "scripts/slides --ci": Instead("", "the test verify.slides"),
    "scripts/refine cases/cask_drop/neptune.yaml --by 1,2,3,4 --along mesh.level":
        Instead("scripts/refine cases/cask_drop/neptune.yaml --by 1,2,3 --along mesh.level --set model.kind=sector", HOURS),
    # verification/extremes/README.md
    "scripts/extremes --axis speed": Instead("scripts/extremes --axis speed --cell drop", "takes minutes"),
    "scripts/extremes --random 300 --seed 7 --automatic": Instead("scripts/extremes --random 4 --seed 7 --automatic", HOURS),
    "scripts/extremes --finer 60 --jobs 2": Instead("scripts/extremes --finer 1 --axis shift --cell bars --jobs 2", HOURS),
    "scripts/extremes --ci --jobs 2": Instead("", "the test verify.extremes"),
}

# {pictures: (the script that writes them, the words of it that say so)}; the first that fits counts.
PICTURES = {
    "docs/figures/cask_table2.svg": ("scripts/cask_inputs", "study cask_table2"),
    "docs/figures/cask_unknown.svg": ("scripts/cask_inputs", "study cask_unknown"),
    "docs/figures/cask_drop.png": ("scripts/pictures", '"cask_drop.png"'),
    "docs/figures/cask_*.svg": ("scripts/cask_study", "{name}"),
    "docs/figures/experiments.svg": ("scripts/experiments", "docs/figures/{name}"),
    "docs/figures/contact_trade.svg": ("scripts/contact_trade", "docs/figures/{name}"),
    "docs/figures/interface_rules.svg": ("scripts/interfaces", "docs/figures/{name}"),
    "docs/figures/trade_*_series.svg": ("scripts/trade", "docs/figures/trade_{{definition.name}}_series.svg"),
    "docs/figures/trade_*.svg": ("scripts/trade", "docs/figures/trade_{{definition.name}}.svg"),
    "verification/*/*.svg": ("scripts/verification_tables.py", '(folder / f"{{picture}}.svg").write_text'),
    "verification/extremes/extremes.png": ("scripts/extremes", '"extremes.png"'),
    "docs/figures/tutorial_*.png": ("scripts/tutorial_pictures", '"{name}"'),
    "docs/figures/*": ("scripts/pictures", '"{name}"'),
}
