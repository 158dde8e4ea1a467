"""scripts/defaults.py tells numerics from physics, departures from defaults, and makes the run with the defaults."""
import json
import sys
import tempfile
import types
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import defaults  # noqa: E402  (after the path)
import runs  # noqa: E402
import verify  # noqa: E402


def said(value):
    return {"value": value, "unit": None, "default": False}


def left(value):
    return {"value": value, "unit": None, "default": True}


BAR = {"bodies": [{"name": said("bar"), "mesh": {"kind": said("box")},
                   "element": {"kind": said("full"), "viscosity": {"linear": said(0.0), "quadratic": said(0.0)}}},
                  {"name": said("other"), "element": {"kind": said("one_point"), "hourglass": said(1.0)}}],
       "contacts": [{"kind": said("contact"), "method": said("penalty"), "penalty": said(1e9), "friction": said(0.3)}],
       "time": {"end": said(1.0), "safety": left(0.9)}}
AS_USUAL = {"bodies": [{"element": {"kind": said("one_point")}}], "time": {"end": said(1.0)}}


def run_of(resolved):
    return types.SimpleNamespace(summary={"provenance": {"resolved": resolved}})


def rows_of(*departs):
    return [verify.Row("check", "a", "", "", "", "", "pass", True, departs=list(one)) for one in departs]


class DeparturesTest(unittest.TestCase):
    def test_numerics_that_a_case_sets_away_from_their_defaults_are_departures(self):
        self.assertEqual([path for path, *_ in defaults.departures(run_of(BAR))],
                         ["bodies[0].element.kind", "bodies[0].element.viscosity.linear", "bodies[0].element.viscosity.quadratic",
                          "contacts[0].method", "contacts[0].penalty"])

    def test_a_default_that_is_written_down_is_none(self):
        self.assertEqual(defaults.departures(run_of(AS_USUAL)), [])

    def test_a_default_of_the_program_that_is_another_than_the_table_says_is_told(self):
        with self.assertRaisesRegex(verify.CannotRun, "time.safety is 0.8"):
            defaults.departures(run_of({"time": {"safety": left(0.8)}}))

    def test_the_default_of_hourglass_control_depends_on_its_kind(self):
        def words(kind, coefficient):
            element = {"hourglass_kind": said(kind), "hourglass": said(coefficient)}
            return [word for _, word, *_ in defaults.departures(run_of({"bodies": [{"element": element}]}))]
        self.assertEqual(words("viscous", 0.05), ["hourglass_kind"])
        self.assertEqual(words("stiffness", 0.1), ["hourglass_kind"])
        self.assertEqual(words("assumed_strain", 0.1), ["hourglass"])

    def test_they_are_shown_with_the_value_that_is_the_only_one(self):
        found = [(word, value) for _, word, value, _ in defaults.departures(run_of(BAR))]
        self.assertEqual(defaults.shown(found), "integration full, viscosity 0, method penalty, penalty")
        self.assertEqual(defaults.shown([("safety", 0.5), ("safety", 0.1)]), "safety")

    def test_checks_are_counted(self):
        bare, viscous = [], [("viscosity", 0.0)]
        self.assertEqual(defaults.of_checks([]), "")
        self.assertEqual(defaults.of_checks(rows_of(bare, bare)), "yes")
        self.assertEqual(defaults.of_checks(rows_of(viscous, viscous)), "no: viscosity 0")
        self.assertEqual(defaults.of_checks(rows_of(bare, viscous)), "1 of 2 checks; others viscosity 0")
        many = [(word, 1) for word in "abcdef"]
        self.assertEqual(defaults.of_checks(rows_of(many)), "no: a 1, b 1, c 1, d 1 and 2 more")

    def test_what_can_touch_is_a_contact(self):
        self.assertTrue(defaults.with_contact(run_of(BAR)))
        self.assertTrue(defaults.with_contact(run_of({"contacts": [], "planes": [{"kind": said("rigid")}]})))
        self.assertFalse(defaults.with_contact(run_of({"contacts": [], "planes": [{"kind": said("fixed")}]})))


class Store:
    """A store whose program says of every key only whether it was set; a file sets the viscosity to zero."""

    def __init__(self, folder):
        self.folder = self.scratch = folder
        (folder / "history.csv").write_text("time [s]\n0\n")
        runs.write_record(folder, {"seconds": 0, "inputs": {}, "files": {}})

    def run(self, driver, case, overrides, threads=None):
        linear = overrides.get("element.viscosity.linear", 0.0)
        method = overrides.get("contact.method", "multiplier")
        resolved = {"element": {"viscosity": {"linear": said(linear)}}, "contact": {"method": said(method)}}
        text = json.dumps({"ending": {"word": "reached_end"}, "provenance": {"resolved": resolved}})
        (self.folder / "summary.json").write_text(text)
        return verify.Run(self, driver, case, overrides, self.folder, True)


class ByDefaultTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.store = Store(Path(holder.name))
        self.run_of_file = self.store.run("scene", "case.yaml", {})

    def test_what_the_file_sets_is_set_back_and_what_a_check_sets_stays(self):
        by_default = defaults.ByDefault(self.store)
        base = by_default.base(self.run_of_file)
        self.assertTrue(by_default.changed)
        self.assertEqual(base.case("element.viscosity.linear"), 0.06)
        hard = base.again({"contact.method": "penalty"})
        self.assertEqual((hard.case("contact.method"), hard.case("element.viscosity.linear")), ("penalty", 0.06))
        self.assertEqual(base.again({"element.viscosity.linear": 0.5}).case("element.viscosity.linear"), 0.5)

    def test_what_the_case_changes_in_all_its_runs_is_set_back_too(self):
        by_default = defaults.ByDefault(self.store)
        base = by_default.base(self.store.run("scene", "case.yaml", {"contact.method": "penalty"}))
        self.assertEqual(base.case("contact.method"), "multiplier")
        self.assertEqual(base.again({"time.end": "1 s"}).case("contact.method"), "multiplier")

    def test_the_keys_that_a_check_hands_on_are_those_of_the_case(self):
        by_default = defaults.ByDefault(self.store)
        self.assertEqual(by_default.base(self.run_of_file).overrides, {})

    def test_another_case_of_a_check_is_set_back_too(self):
        by_default = defaults.ByDefault(self.store)
        self.assertEqual(by_default.base(self.run_of_file).other("scene", "b.yaml").case("element.viscosity.linear"), 0.06)


class ReasonsTest(unittest.TestCase):
    def judged(self, reasons, full=True, one_by_default=True):
        case = verify.Case.__new__(verify.Case)
        case.accept = types.SimpleNamespace(DEPARTURES=reasons, CHECKS=[])
        out = verify.Outcome("bar", "full", rows=rows_of([("viscosity", 0.0)], [("method", "penalty")], *([[]] if one_by_default else [])))
        case.judge_departures(out, run_of(AS_USUAL), full)
        return out

    def test_one_check_or_report_has_the_defaults(self):
        reasons = {"viscosity, method": "made up"}
        self.assertFalse(self.judged(reasons, one_by_default=False).good())
        self.assertTrue(self.judged(reasons, full=False, one_by_default=False).good())

    def test_each_departure_has_its_reason(self):
        out = self.judged({"viscosity, method": "made up"})
        self.assertTrue(out.good())
        self.assertEqual(out.departures, {"viscosity": "made up", "method": "made up"})

    def test_a_departure_without_a_reason_fails(self):
        for reasons in ({}, {"viscosity": "made up"}, {"viscosity": "made up", "method": ""}):
            out = self.judged(reasons)
            self.assertFalse(out.good())
            self.assertIn("method", out.rows[-1].because)

    def test_a_reason_of_no_departure_fails_where_all_checks_ran(self):
        reasons = {"viscosity, method, safety": "made up"}
        self.assertFalse(self.judged(reasons).good())
        self.assertTrue(self.judged(reasons, full=False).good())


class ProgramTest(unittest.TestCase):
    def test_the_defaults_are_those_of_the_pages(self):
        """Each number of NUMERICS stands in docs/scene.md as the default of its key."""
        page = (verify.ROOT / "docs" / "scene.md").read_text(encoding="utf-8")
        for section, keys in (("", defaults.CONTACT), ("time.", defaults.NUMERICS["time"])):
            for key, value in keys.items():
                if value is not None:
                    shown = f"`{value}`" if isinstance(value, str) else f"{value:g}"
                    with self.subTest(key):
                        self.assertIn(f"| `{section}{key}` | {shown} |", page)


if __name__ == "__main__":
    unittest.main()
