"""How close is close enough, why, and what must break."""
from reference import slowed, weight
from verify import Breaks, Check, Figure, Pair

CLAIM = ("Of each pair of bodies in an automatic contact the force is known: weights in a stack and of a bar on a ridge, friction of a "
         "block that slides.")
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "scene"

SLIDE, RIDGES = "verification/pair_forces/slide.yaml", "verification/pair_forces/ridges.yaml"
UPPER = weight(1100, 0.1, 0.1, 0.1)
ABOVE = UPPER + weight(1100, 0.15, 0.15, 0.1)
ALL = ABOVE + weight(1100, 0.2, 0.2, 0.1)
BAR = weight(1100, 0.1, 0.01, 0.01)
FRICTION, PRESSED, START, END = 0.3, 3.925 * 2000, 39.25, 5e-3  # [-] [N] [N s] [s]


def slide(run):
    """The run of the block that slides; in a break of that case the run itself."""
    return run if str(run.case_file).endswith("slide.yaml") else run.other("scene", SLIDE)


def last(name, exact):
    return lambda run: Pair(run.column(name)[-1], exact, "N", scale=ABOVE)


def of_slide(name, exact, scale=None):
    return lambda run: Pair(slide(run).column(name)[-1], exact, "N s", scale=scale)


def on_the_ridge(run):
    there = run if str(run.case_file).endswith("ridges.yaml") else run.other("scene", RIDGES)
    return Pair(there.column("upper_on_lower")[-1], -BAR, "N")


def third_law(run):
    """The row where the force on the middle block by the lower one and that on the lower one by the middle one cancel least."""
    sums = [a + b for a, b in zip(run.column("middle_on_lower"), run.column("lower_on_middle"))]
    return Pair(max(sums, key=abs), 0, "N", scale=ABOVE)


def coulomb(run):
    """The row whose tangential force is farthest from friction times the normal one, from the second on: contact begins in the first."""
    there = slide(run)
    pairs = [(-drag, FRICTION * carried) for drag, carried in zip(there.column("drag")[2:], there.column("carried")[2:])]
    return Pair(*max(pairs, key=lambda pair: abs(pair[0] - pair[1])), "N", scale=FRICTION * PRESSED)


def by_a_penalty(measure, of=lambda run: run):
    return lambda run: measure(of(run).again({"contacts[0].method": "penalty"}))


DEPARTURES = {"method": "two checks are of forces by a penalty, which the program books in other places"}

AT_REST = "at rest to 1e-6 of all forces, damped over hundreds of steps"
VIBRATES = ("the weight acts from the first moment on, and the block vibrates with a period of 40 us: 40 us / 2 pi of 5 ms is 0.13 %, and "
            "as much again by a second mode")
CHECKS = [
    Check("stack: upper block on the middle one", last("upper_on_middle", -UPPER), 1e-5, AT_REST),
    Check("stack: two blocks on the lower one", last("middle_on_lower", -ABOVE), 1e-5, AT_REST),
    Check("stack: lower block on the middle one", last("lower_on_middle", ABOVE), 1e-5, AT_REST),
    Check("stack: all blocks on the ground", last("ground_force", ALL), 1e-5, AT_REST),
    Check("stack: exchanged names, the worst row", third_law, 1e-12, "one impulse with either sign"),
    Check("stack: upper block on the lower one", last("upper_on_lower", 0), 1e-12, "they do not touch"),
    Check("ridges: a bar through edges that cross", on_the_ridge, 1e-4,
          "at rest to 1e-6 of all forces; the bars bend with a long period, of which 3e-5 is left"),
    Check("slide: friction over normal force, from the second row on", coulomb, 5e-5,
          "friction follows the normal impulse of each step; iterations end at 1e-6 of the largest one"),
    Check("slide: impulse of the weight on the floor", of_slide("pressed", -PRESSED * END), 0.003, VIBRATES),
    Check("slide: impulse of friction on the floor", of_slide("dragged", FRICTION * PRESSED * END), 0.003, VIBRATES),
    Check("slide: momentum of the block", of_slide("momentum", slowed(START, FRICTION, PRESSED, END)), 0.003, VIBRATES),
    Check("slide: impulse on the third block", of_slide("untouched", 0, PRESSED * END), 1e-12, "it is not touched"),
    Check("by a penalty, stack: two blocks on the lower one", by_a_penalty(last("middle_on_lower", -ABOVE)), 1e-5, AT_REST),
    Check("by a penalty, slide: impulse of friction on the floor",
          by_a_penalty(of_slide("dragged", FRICTION * PRESSED * END), slide), 0.004,
          "as by multipliers, and the springs of the penalty add vibrations of their own"),
]

BREAKS = [
    Breaks("stack: upper block on the middle one", "the wrong pair", {"probes[0].between": "[lower, middle]"}),
    Breaks("stack: two blocks on the lower one", "an upper block of steel", {"bodies[2].material.density": "7850 kg/m^3"}),
    Breaks("stack: lower block on the middle one", "the weight of the middle block left out", {"bodies[1].material.density": "1 kg/m^3"}),
    Breaks("stack: all blocks on the ground", "a middle block of steel", {"bodies[1].material.density": "7850 kg/m^3"}),
    Breaks("stack: exchanged names, the worst row", "names that are not exchanged", {"probes[2].between": "[lower, middle]"}),
    Breaks("stack: upper block on the lower one", "the pair above", {"probes[3].between": "[middle, upper]"}),
    Breaks("ridges: a bar through edges that cross", "a density off by a thousandth", {"bodies[1].material.density": "1101.1 kg/m^3"},
           case=RIDGES),
    Breaks("slide: friction over normal force, from the second row on", "a friction off by a thirtieth", {"contacts[0].friction": 0.31},
           case=SLIDE),
    Breaks("slide: impulse of the weight on the floor", "a weight off by a fiftieth", {"loads[0].value": '["0", "0", "-2040"]'},
           case=SLIDE),
    Breaks("slide: impulse of friction on the floor", "the force on the block", {"probes[2].between": "[block, floor]"}, case=SLIDE),
    Breaks("slide: momentum of the block", "no friction", {"contacts[0].friction": 0}, case=SLIDE),
    Breaks("slide: impulse on the third block", "the floor in its place", {"probes[4].between": "[floor, block]"}, case=SLIDE),
    Breaks("by a penalty, stack: two blocks on the lower one", "the wrong pair", {"probes[1].between": "[middle, upper]"}),
    Breaks("by a penalty, slide: impulse of friction on the floor", "a friction off by a thirtieth", {"contacts[0].friction": 0.31},
           case=SLIDE),
]


def impulses(run):
    there = slide(run)
    times = [1e3 * t for t in there.column("time")]
    return [("friction", times, there.column("dragged")), ("weight", times, [-p for p in there.column("pressed")])]


def exact_impulses(run):
    times = slide(run).column("time")
    shown = [1e3 * t for t in times]
    return [("mu m g t", shown, [FRICTION * PRESSED * t for t in times]), ("m g t", shown, [PRESSED * t for t in times])]


FIGURES = [Figure("impulses", "time [ms]", "impulse on the floor [N s]", impulses, exact_impulses,
                  caption="Impulses of the block that slides on its floor.")]
