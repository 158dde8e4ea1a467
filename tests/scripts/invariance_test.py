"""scripts/invariance: limits from disturbed runs, what is carried back, its table, and arguments that are wrong."""
import contextlib
import io
import json
import math
import sys
import tempfile
import types
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
invariance = made_up.script("invariance")
import compare_runs  # noqa: E402  (after the path)
import invariance_changes as changes  # noqa: E402
import twins  # noqa: E402
from twins import Quantity  # noqa: E402


def run(folder, name, columns, results=None):
    """A made-up run without frames and ledger."""
    place = Path(folder) / name
    place.mkdir()
    rows = zip(*columns.values())
    (place / "history.csv").write_text("\n".join([",".join(columns), *(",".join(repr(x) for x in row) for row in rows)]) + "\n")
    summary = {"results": {key: {"value": value} for key, value in (results or {}).items()}, "cost": {"steps": 3}}
    return types.SimpleNamespace(folder=place, summary=summary, columns={key.split(" [")[0]: one for key, one in columns.items()},
                                 column=lambda key: columns[f"{key} [s]"], ending="reached_end")


class LimitsTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name
        self.base = self.made("base", [1.0, 1.0, 1.0, 1.0])

    def made(self, name, tip, results=None):
        return run(self.folder, name, {"time [s]": [0.0, 1.0, 2.0, 3.0], "tip [m]": tip}, results)

    def limits(self, *growths):
        return invariance.Limits(self.base, [self.made(f"disturbed_{i}", [1 + d for d in growth]) for i, growth in enumerate(growths)])

    def judged(self, limits, tip):
        return invariance.judged(changes.Twin(self.base, self.made("twin", tip)), limits)[0]

    def test_a_result_may_differ_by_ten_times_of_what_a_disturbance_has_grown_to(self):
        limits = self.limits([0, 1e-6, 0, 1e-5], [0, -2e-6, 0, 0])
        self.assertEqual(limits.of("tip", 0.0), 1e-11)
        self.assertAlmostEqual(limits.of("tip", 1.5), 2e-5)
        self.assertAlmostEqual(limits.of("tip", 2.0), 2e-5)  # what has grown stays
        difference, name, limit, time = self.judged(limits, [1.0, 1.0 + 3e-5, 1.0, 1.0])
        self.assertAlmostEqual(difference, 3e-5)
        self.assertEqual((name, time), ("tip", 1.0))
        self.assertGreater(difference, limit)

    def test_where_a_disturbance_has_grown_large_nothing_is_judged(self):
        limits = self.limits([0, 0, 2e-3, 1e-9])
        self.assertIsNone(limits.of("tip", 2.5))
        self.assertEqual(self.judged(limits, [1.0, 1.0, 7.0, 7.0])[0], 0.0)
        self.assertGreater(self.judged_early(limits), 1e-11)
        self.assertEqual(limits.grown()[2], {"tip": 2.0})

    def judged_early(self, limits):
        twin = run(self.folder, "early", {"time [s]": [0.0, 1.0, 2.0, 3.0], "tip [m]": [1.0, 1.1, 7.0, 7.0]})
        return invariance.judged(changes.Twin(self.base, twin), limits)[0][0]

    def test_what_is_no_number_differs(self):
        self.assertEqual(self.judged(self.limits([0, 0, 0, 0]), [1.0, 1.0, math.nan, 1.0])[0], math.inf)

    def test_the_largest_difference_is_infinite_where_one_is_no_number_in_any_order(self):
        self.assertEqual(compare_runs.largest({"tip": 0.25, "push": 0.5, "speed": 0.0}), 0.5)
        names = ("tip", "push", "speed")
        for no_number in names:
            found = {name: math.nan if name == no_number else 0.5 for name in names}
            self.assertEqual(compare_runs.largest(found), math.inf, no_number)

    def test_rows_at_other_times_are_not_compared(self):
        other = run(self.folder, "other", {"time [s]": [0.0, 1.5, 2.0 + 1e-12, 3.0], "tip [m]": [1.0, 9.0, 1.0, 1.0]})
        self.assertEqual([time for time, _ in compare_runs.curves(changes.Twin(self.base, other))["tip"]], [0.0, 2.0, 3.0])

    def test_counts_and_times_of_events_are_no_results(self):
        ours = self.made("ours", [1.0] * 4, {"touch_reconnections": 4, "tip_largest_at": 1.0, "touch_deepest": 2.0})
        theirs = self.made("theirs", [1.0] * 4, {"touch_reconnections": 5, "tip_largest_at": 2.0, "touch_deepest": 1.0})
        self.assertEqual(compare_runs.ends(changes.Twin(ours, theirs)), {"result touch_deepest": 0.5})


    def test_what_is_round_off_beside_its_unit_is_compared_with_that(self):
        def of(ours, theirs):
            base, twin = (self.made(f"{name}_{ours}_{theirs}", [1.0] * 4) for name in ("one", "other"))
            base.summary["results"] = {"touch_deepest": {"value": ours, "unit": "m"}, "bar_fraction": {"value": 0.0, "unit": "1"}}
            twin.summary["results"] = {"touch_deepest": {"value": theirs, "unit": "m"}, "bar_fraction": {"value": 1e-32, "unit": "1"}}
            return compare_runs.ends(changes.Twin(base, twin))

        self.assertEqual(of(0.0, 1e-17), {"result touch_deepest": 1e-17, "result bar_fraction": 1e-32})
        self.assertEqual(of(0.0, 1e-3)["result touch_deepest"], 1.0)

    def test_results_that_measure_round_off_are_no_results(self):
        ours, theirs = (self.made(f"with_{value}", [1.0] * 4, {"asymmetry": value, "x_residual": value}) for value in (1e-16, 3e-16))
        self.assertEqual(compare_runs.ends(changes.Twin(ours, theirs)), {})

    def test_a_small_result_has_the_round_off_of_large_ones_of_its_unit(self):
        self.base.summary["results"] = {"touch_deepest": {"value": 1e-6, "unit": "m"}}
        limits = self.limits([0, 0, 0, 0])
        self.assertAlmostEqual(limits.of("result touch_deepest") / 1e-5, 1.0)


class CarriedTest(unittest.TestCase):
    def probe(self, quantity, component="y", **more):
        return {"name": Quantity("p"), "quantity": Quantity(quantity), "component": Quantity(component), **more}

    def back(self, matrix, quantity, vector, component="y", velocity=None, time=0.0):
        tree = {"probes": [self.probe(quantity, component)]}
        probes, skipped = changes.with_components(tree, matrix, velocity)
        self.assertEqual(skipped, {})
        names, back = probes["p"]
        self.assertEqual([one["name"].value for one in tree["probes"]], names)
        return back(time, vector)

    def test_components_come_back(self):
        turn, mirror, v = twins.rotation((1, -2, 0.7), 2.1), twins.reflection((0.3, 0.4, 0.5)), [1.0, -2.0, 3.0]
        self.assertAlmostEqual(self.back(turn, "velocity", twins.product(turn, v)), -2.0)
        self.assertAlmostEqual(self.back(mirror, "force", twins.product(mirror, v)), -2.0)
        self.assertAlmostEqual(self.back(mirror, "angular_velocity", [-x for x in twins.product(mirror, v)]), -2.0)
        self.assertAlmostEqual(self.back(turn, "stress", twins.tensor(turn, [1, 2, 3, 4, 5, 6]), "xy"), 4)
        self.assertAlmostEqual(self.back(twins.IDENTITY, "displacement", [1, 2, 3], "y", [10, 20, 30], 0.1), 0.0)
        self.assertAlmostEqual(self.back(twins.IDENTITY, "velocity", [13, 24, 30], "magnitude", [10, 20, 30]), 5.0)

    def test_what_cannot_be_carried_is_named(self):
        turn = twins.rotation((1, -2, 0.7), 2.1)
        for quantity, more, velocity in (("extent", {}, None), ("stress", {"take": Quantity("largest")}, None),
                                         ("momentum", {}, [1, 0, 0])):
            _, skipped = changes.with_components({"probes": [self.probe(quantity, "xx", **more)]}, turn, velocity)
            self.assertIn("p", skipped)

    def formula_of(self, matrix, probe, values, velocity=None):
        """What `p + 1` has in the twin, whose probes have these values at the time 2 s; it is 1 more than p in the base."""
        tree = {"probes": [probe, {"name": Quantity("f"), "value": Quantity("p + 1")}]}
        _, skipped = changes.with_components(tree, matrix, velocity)
        self.assertEqual(skipped, {})
        *_, image, formula = tree["probes"]
        self.assertEqual((image["name"].value, formula["name"].value), ("p", "f"))
        parts = dict(zip((one["name"].value for one in tree["probes"]), values))
        return eval(image["value"].value.replace("^", "**"), {"sqrt": math.sqrt, "t": 2.0}, parts) + 1  # pylint: disable=eval-used

    def test_formulas_have_what_they_have_in_the_base(self):
        turn, mirror, v = twins.rotation((1, -2, 0.7), 2.1), twins.reflection((0.3, 0.4, 0.5)), [1.0, -2.0, 3.0]
        self.assertAlmostEqual(self.formula_of(turn, self.probe("acceleration"), twins.product(turn, v)), -1.0)
        self.assertAlmostEqual(self.formula_of(mirror, self.probe("angular_velocity"), [-x for x in twins.product(mirror, v)]), -1.0)
        self.assertAlmostEqual(self.formula_of(turn, self.probe("stress", "xz"), twins.tensor(turn, [1, 2, 3, 4, 5, 6])), 7.0)
        self.assertAlmostEqual(self.formula_of(twins.IDENTITY, self.probe("displacement"), [1, 2, 3], [10, 20, 30]), -37.0)
        self.assertAlmostEqual(self.formula_of(twins.IDENTITY, self.probe("velocity", "magnitude"), [13, 24, 30], [10, 20, 30]), 6.0)

    def test_formulas_of_what_is_not_compared_are_not_compared(self):
        tree = {"probes": [self.probe("extent"), {"name": Quantity("f"), "value": Quantity("2*p")},
                           {"name": Quantity("g"), "value": Quantity("f/3")}, {"name": Quantity("h"), "value": Quantity("3*t")}]}
        _, skipped = changes.with_components(tree, twins.rotation((1, -2, 0.7), 2.1))
        self.assertEqual(sorted(skipped), ["f", "g", "p"])
        contact = {"probes": [{**self.probe("force"), "of": Quantity("touch")}, *tree["probes"][1:]]}
        self.assertEqual(sorted(changes.without_probes_of(contact, {"touch"})), ["f", "g", "p"])
        self.assertEqual([one["name"].value for one in contact["probes"]], ["h"])

    def test_a_direction_of_a_gauge_needs_no_components(self):
        gauge = {"name": Quantity("p"), "quantity": Quantity("strain"), "along": Quantity([1.0, 0.0, 0.0], "1"),
                 "near": Quantity([1.0, 2.0, 0.0], "m")}
        body = {"name": Quantity("bar"), "mesh": {"kind": Quantity("box")}}
        twin = twins.moved({"bodies": [body], "probes": [gauge]}, twins.rotation((0, 0, 1), math.pi / 2))
        probes, skipped = changes.with_components(twin, twins.rotation((0, 0, 1), math.pi / 2))
        self.assertEqual((probes, skipped, len(twin["probes"])), ({}, {}, 1))
        for key, exact in (("along", [0, 1, 0]), ("near", [-2, 1, 0])):
            for got, expected in zip(twin["probes"][0][key].value, exact):
                self.assertAlmostEqual(got, expected)

    def test_zones_of_sets_turn(self):
        def set_of(kind, **keys):
            return {"name": Quantity("pad"), kind: {key: Quantity(value, "m") for key, value in keys.items()}}

        sets = [set_of("cylinder", **{"from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0]}, radius=0.5),
                set_of("sphere", centre=[1.0, 0.0, 0.0]), set_of("plane", point=[1.0, 0.0, 0.0], normal=[1.0, 0.0, 0.0]),
                set_of("box", low=[0.0, 0.0, 0.0], high=[1.0, 2.0, 3.0])]
        tree = {"bodies": [{"name": Quantity("bar"), "mesh": {"kind": Quantity("box")}, "sets": sets}]}
        cylinder, ball, plane, *half_spaces, box = twins.moved(tree, twins.rotation((0, 0, 1), math.pi / 2), (0, 0, 5))["bodies"][0]["sets"]
        found = [*cylinder["cylinder"]["from"].value, *cylinder["cylinder"]["to"].value, *ball["sphere"]["centre"].value,
                 *plane["plane"]["normal"].value, *half_spaces[1]["half_space"]["point"].value,
                 *half_spaces[1]["half_space"]["normal"].value]
        for got, expected in zip(found, [0, 0, 5, 0, 1, 5, 0, 1, 5, 0, 1, 0, -2, 1, 8, 0, -1, 0]):
            self.assertAlmostEqual(got, expected)
        self.assertEqual((len(half_spaces), box["name"].value, len(box["all_of"].value)), (6, "pad", 6))
        self.assertEqual(cylinder["cylinder"]["radius"].value, 0.5)

    def test_a_frame_moves_along_all_planes(self):
        way = changes.across([(0, 0, 2), (0, 0, -1), (1, 0, 0)])
        self.assertAlmostEqual(abs(way[1]), 1.0)
        with self.assertRaises(changes.CannotChange):
            changes.across([(0, 0, 2), (0, 1, 1), (1, 0, 0)])


class CommandTest(unittest.TestCase):
    def refused(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as end:
            invariance.main(list(words))
        self.assertEqual(end.exception.code, 2)
        return said.getvalue()

    def test_wrong_arguments_are_told(self):
        self.assertIn("nowhere.yaml is no file", self.refused("nowhere.yaml"))
        self.assertIn("did you mean rotated?", self.refused(__file__, "--only", "rotate"))
        self.assertIn("no case is given", self.refused())

    def test_the_table_has_a_row_a_case_and_keeps_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            rows = [{"change": "rotated", "verdict": "DIFFERS", "difference": 0.5, "because": ""},
                    {"change": "moving", "verdict": "skipped", "difference": None, "because": "it relaxes"}]
            (Path(folder) / "bar.json").write_text(json.dumps(rows))
            page = Path(folder) / "page.md"
            page.write_text(f"# Page\n\n{invariance.BEGIN}\nold\n{invariance.END}\nafter\n")
            invariance.put_table(page, invariance.table_of(Path(folder)))
            text = page.read_text()
            self.assertIn("| bar | **5.0e-01** |", text)
            self.assertIn("- `moving`: it relaxes (1)", text)
            self.assertNotIn("old", text)
            self.assertTrue(text.startswith("# Page\n") and text.endswith("after\n"))


if __name__ == "__main__":
    unittest.main()
