"""The report of a run is one file that needs nothing else, shows all that the run has, and says what it does not have."""
import doctest
import html.parser
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
try:
    import report_page  # needs matplotlib
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
import numpy as np  # noqa: E402

import frames  # noqa: E402
import report_compare  # noqa: E402
import report_energy  # noqa: E402
import report_results  # noqa: E402
import report_run  # noqa: E402
import report_scene  # noqa: E402
import report_text  # noqa: E402
import screen  # noqa: E402
from made_up import script  # noqa: E402

NOTES = ["initial gaps   apexes  on facet", "touch              36        36", "               penalty 2e7 Pa/m",
         "touch: its apexes are 1.33 times as far apart as the nodes of its base, so that the stress beside the interface is wrong by up "
         "to 10 %: exchange 'apexes' and 'base', or take 'passes: two'",
         "bar and wall overlap by 0.1 m, 0.2 of an element, at (0, 0, 0) m at 0.1 s",
         "note: tip: the largest plastic strain depends on the mesh: '--accuracy' with '--of' estimates the mesh error of a result",
         "the smallest step was limited by element 4 of 'bar'"]
HEADER = "time [s],pull [N] mean,tip [m],energy_kinetic [J],energy_bar_elastic [J],energy_created_bar [J],energy_integration [J]"
HISTORY = HEADER + "\n0,0,0,100,0,0,0\n0.1,-2000,0.001,60,40,0.01,0\n0.2,0,0.002,90,10,0.02,0\n"


def quantity(value, unit):
    return {"value": value, "unit": unit}


def said(value, unit=None, default=False):
    return {"value": value, "unit": unit, "default": default}


def account(kind, created=0.0):
    return {"kind": kind, "work": quantity(-10.0, "J"), "stored": {"elastic": quantity(10.0, "J")}, "dissipated": {},
            "created": quantity(created, "J"), "created_relative": quantity(created / 100, "1"), "passed": quantity(50.0, "J"),
            "created_of_passed": quantity(0.0, "1"), "impulse": quantity([0, 0, 0], "N s")}


def summary(word="reached_end", friction=0.2, tip=0.002, reason=""):
    return {"driver": "scene", "ending": {"word": word, "reason": reason, "time": quantity(0.2, "s"), "block": None, "element": None},
            "results": {"tip_last": quantity(tip, "m"), "tip_largest": quantity(tip, "m"), "tip_largest_at": quantity(0.2, "s"),
                        "tip_smallest": quantity(0.0, "m"), "tip_smallest_at": quantity(0.0, "s"), "touch_deepest": quantity(None, "m"),
                        "plain_<b>": quantity(7.0, "1")},
            "ledger": {"initial_kinetic": quantity(100.0, "J"), "kinetic": quantity(90.0, "J"), "energy_scale": quantity(100.0, "J"),
                       "accounts": {"bar": account("block", 0.02), "touch": account("interface")}},
            "overlaps": [], "touched": [], "not_used": ["mesh.extra"], "notes": NOTES, "warnings": NOTES[3:5],
            "cost": {"elements": 8, "steps": 20, "element_updates": 160, "wall_seconds": 2.0, "threads": 1, "frames": 0,
                     "contact": {"steps": 3, "seconds": 0.5, "stages": {"search": 0.5}}},
            "provenance": {"version": "1.2.3", "commit": "abc", "case_path": "cases/<b>.yaml", "case_hash": "0123",
                           "resolved": {"time": {"created_limit": said(0.05, "1", True)},
                                        "bodies": [{"name": said("bar"),
                                                    "material": {"kind": said("elastic"), "young": said(2.1e11, "Pa")}}],
                                        "contacts": [{"name": said("touch"), "friction": said(friction, "1")}],
                                        "probes": [{"name": said("tip"), "quantity": said("displacement")}]}}}


class Links(html.parser.HTMLParser):
    """Addresses, names of places, and tags of a page."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.places, self.tags, self.open = [], [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.tags.add(tag)
        self.addresses += [value for key, value in found.items() if key in ("src", "href", "action", "data")]
        self.places += [found["id"]] if "id" in found else []
        if tag not in ("meta", "br", "img", "line", "rect"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in ("meta", "br", "img", "line", "rect"):
            assert self.open.pop() == tag, tag


class ReportTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)

    def run_of(self, name="run", history=HISTORY, **words):
        folder = self.root / name
        folder.mkdir()
        if history:
            (folder / "history.csv").write_text(history)
        if words.pop("finished", True):
            (folder / "summary.json").write_text(json.dumps(summary(**words)))
        return folder

    def assertIn(self, part, whole):
        self.assertTrue(part in whole, part)  # without a page of a megabyte

    def words_of_page(self, *folders):
        """The page without its diagrams, which take most of the time."""
        with unittest.mock.patch("figure_report.svg_of", return_value=b"<svg></svg>"):
            return self.page(*folders)

    def page(self, *folders, **words):
        text = report_page.page(report_run.read(folders), report_scene.Wanted(with_pictures=False, **words))
        self.links = Links(text)
        self.assertEqual(self.links.open, [])
        return text

    def test_nothing_on_the_page_is_from_outside(self):
        for folders in ([self.run_of("one")], [self.root / "one", self.run_of("two", friction=0.4)]):
            text = self.page(*folders)
            for address in self.links.addresses:
                self.assertTrue(address.startswith(("#", "data:")), address)
                self.assertTrue(address[0] != "#" or address[1:] in self.links.places, address)
            self.assertEqual(len(self.links.places), len(set(self.links.places)))
            self.assertFalse(self.links.tags & {"script", "link", "iframe", "object", "embed", "base"})
            self.assertNotRegex(text, r"url\(|@import")

    def test_all_histories_and_results_are_on_the_page(self):
        text = self.page(self.run_of())
        for name in ("history of pull", "history of tip", "energies of run", "created energy of run"):
            self.assertIn(f"alt='{name}", text)
        for name in ("tip", "touch_deepest", "plain_&lt;b&gt;"):
            self.assertIn(f"<td>{name}</td>", text)
        self.assertIn("<td>steps</td><td class=number>20</td>", text)
        self.assertFalse("plain_<b>" in text)
        self.assertIn("none", re.search("touch_deepest.*?</tr>", text).group())
        for value in ("2.1e+11 Pa", "210 GPa", "1.2.3", "0123", "element 4 of &#x27;bar&#x27;", "cases/&lt;b&gt;.yaml"):
            self.assertIn(value, text)
        self.assertNotIn("<b>.yaml", text)

    def test_forces_are_told_to_be_means(self):
        self.assertRegex(self.page(self.run_of()), "means over the time since the row before.*: pull")

    def test_only_the_probes_that_are_asked_for_are_drawn(self):
        text = self.page(self.run_of(), probes=["tip"])
        self.assertNotIn("history of pull", text)
        self.assertIn("history of tip", text)

    def test_warnings_come_first_with_remedy_and_place(self):
        text = self.page(self.run_of())
        self.assertLess(text.index("<section id='warnings'>"), text.index("<section id='setup'>"))
        self.assertIn("<b>Remedy:</b> exchange &#x27;apexes&#x27; and &#x27;base&#x27;, or take &#x27;passes: two&#x27;.", text)
        self.assertIn("<a href='#source-touch'>touch in the set-up</a>", text)
        self.assertIn("<a href='#overlaps'>", text)
        self.assertIn("<a href='#histories'>the history of tip</a>", text)
        self.assertIn("did not use these keys of the case: mesh.extra", text)
        kinds = re.findall("<li class=(ending|warning|note|information)>", text)
        self.assertEqual(kinds, ["warning"] * 3 + ["note"])
        self.assertRegex(text, "<pre>initial gaps[^<]*penalty 2e7 Pa/m</pre>")

    def test_a_run_that_the_physics_stopped_says_why_before_all_else(self):
        text = self.page(self.run_of(word="energy_created", reason="bar created 7 %"))
        self.assertRegex(text, "class='ended stopped'>.*because energy was created.*bar created 7 %.*exit status 3")
        self.assertRegex(text, "<li class=ending>.*<a href='#energy'>the energy balance, bar</a>")

    def test_what_is_missing_is_said(self):
        text = self.page(self.run_of("unfinished", HISTORY + "0.3,1", finished=False))
        for words in ("summary.json is missing, so the run was not finished", "row 5 is damaged or cut", "The cost is unknown",
                      "There are no results", "The provenance is unknown", "It is unknown how the run <b>unfinished</b> ended"):
            self.assertIn(words, text)
        self.assertIn("history of pull", text)
        text = self.page(self.run_of("bare", history=""))
        self.assertIn("history.csv cannot be read", text)
        self.assertIn("There are no histories", text)
        broken = self.run_of("broken")
        (broken / "summary.json").write_text("[1, 2")
        self.assertIn("summary.json cannot be read", self.page(broken))
        (broken / "summary.json").write_text("[1, 2]")
        self.assertIn("expected is an object", self.page(broken))

    def test_a_run_without_pictures_says_why(self):
        runs = report_run.read([self.run_of()])
        self.assertEqual(report_page.page(runs, report_scene.Wanted()).count("the run has no frames of bodies"), 2)

    def test_two_runs_stand_over_each_other(self):
        text = self.page(self.run_of("coarse"), self.run_of("fine", friction=0.3, tip=0.0021))
        self.assertRegex(text, r"<code>contacts\[0\].friction</code></td><td>0.2</td><td>0.3</td>")
        self.assertRegex(text, "tip_last</td><td>mm</td>.*?>2<.*?>2.1<.*?[+]5 %")
        self.assertEqual(text.count("alt='history of tip'"), 1)
        self.assertIn("<a href='#B-source-touch'>", text)

    def test_columns_without_a_number_are_told_apart_from_columns_of_zeros(self):
        history = "time [s],tip [m],idle [m],lost [m],half [m]\n0,1,0,nan,nan\n0.1,2,0,nan,3\n0.2,3,0,inf,4\n"
        text = self.page(self.run_of(history=history))
        self.assertIn("Without a finite number in any row, and not drawn: lost.", text)
        self.assertRegex(text, "Zero but for round-off in every row, and not drawn: idle\\.")
        self.assertRegex(text, "alt='history of [^']*half")
        self.assertNotRegex(text, "alt='history of [^']*(lost|idle)")
        text = self.page(self.run_of("other", history.replace(",nan,", ",5,")), self.root / "run")
        self.assertIn("alt='history of lost'", text)
        self.assertRegex(text, "has no finite number in any row of lost")

    def test_a_damaged_collection_of_frames_is_said(self):
        folder = self.run_of()
        (folder / "body.pvd").write_text("<VTKFile>")
        self.assertIn("body.pvd is no collection of ParaView, so its frames are not shown", self.page(folder))

    def test_runs_with_nothing_in_common_are_shown(self):
        text = self.page(self.run_of("one"), self.run_of("other", "mode [1],frequency [Hz]\n1,5\n2,7\n", finished=False))
        self.assertIn("history of frequency", text)
        self.assertIn("has no frequency", text)
        self.assertIn("has no pull, tip", text)

    def test_differences(self):
        for ours, theirs, expected in ((1.0, 1.0, "0"), (1.0, 1.02, "+2 %"), (2.0, 1.0, "<b>−50 %</b>"), (0.0, 1.0, "from 0"),
                                       (-584.0, -173.0, "<b>+70.4 %</b>"), (-1.0, -2.0, "<b>−100 %</b>"), (1.0, None, "–"),
                                       (1e-15, -1e-15, report_results.ROUND_OFF), (float("nan"), 1.0, "–")):
            self.assertEqual(report_results.difference(ours, theirs, 1e-9), expected)

    def test_numbers_have_units_with_prefixes(self):
        for value, unit, expected in ((358780.04, "N", "358.78 kN"), (5.41e-5, "s", "54.1 µs"), (9e-4, "m^2", "0.0009 m²"),
                                      (2.1e11, "Pa", "210 GPa"), (0.0, "m", "0 m"), (-3e-7, "1", "−3·10^−7")):
            self.assertEqual(report_text.plain_quantity(value, unit), expected)
        self.assertEqual(report_text.engineering("2.1e+11 Pa"), "210 GPa")
        self.assertEqual(report_text.engineering("7850 kg/m^3"), "7850 kg/m^3")

    def test_energies_add_up(self):
        run, = report_run.read([self.run_of()])
        groups, outside = report_energy.over_time(run)
        found = {name: list(values) for name, values in groups.items()}
        self.assertEqual(found, {"kinetic": [100, 60, 90], "bodies: elastic": [0, 40, 10]})
        self.assertFalse(outside.any())
        self.assertEqual(sum(groups.values()).tolist(), [100, 100, 100])
        created, limit = report_energy.created_over_time(run)
        self.assertEqual((list(created), limit), (["bar"], 5.0))

    def test_energy_that_comes_from_outside_is_what_the_scene_gains(self):
        head = "time [s],energy_kinetic [J],energy_bar_elastic [J],energy_push_external_work [J],energy_gravity_potential [J]"
        run, = report_run.read([self.run_of(history=f"{head}\n0,100,0,0,0\n0.1,120,5,-30,5\n0.2,90,40,-20,-10\n")])
        groups, outside = report_energy.over_time(run)
        self.assertEqual(outside.tolist(), [0, 25, 30])
        self.assertEqual((sum(groups.values()) - outside).tolist(), [100, 100, 100])

    def test_every_source_is_in_a_group_of_its_own_kind(self):
        kinds = {"bar": "block", "touch": "interface", "wall": "rigid_plane", "base": "fixed", "push": "pressure", "rope": "spring",
                 "rim": "radiation", "relaxation": "relaxation", "gravity": "gravity", "bar_elastic": "nosuch"}
        channels = {"bar": {"stored": ["elastic", "hourglass"], "dissipated": ["plastic", "inelastic_impact"]},
                    "touch": {"stored": ["restitution"], "dissipated": ["friction"]}, "wall": {"dissipated": ["friction"]},
                    "base": {"dissipated": ["inelastic_impact"]}, "push": {"stored": ["external_work"]},
                    "rope": {"stored": ["elastic"], "dissipated": ["damping"]}, "rim": {"dissipated": ["radiated"]},
                    "relaxation": {"dissipated": ["removed"]}, "gravity": {"stored": ["potential"]},
                    "bar_elastic": {"stored": ["elastic"], "dissipated": ["nosuch"]}}
        expected = {"kinetic": 1, "bodies: elastic": 1, "bodies: plastic": 1, "bodies: hourglass and other artificial": 1,
                    "bodies: inelastic impact": 1, "contacts: stored": 1, "contacts: friction": 1, "planes: friction": 1,
                    "planes: inelastic impact": 1, "springs: elastic": 1, "springs: damping": 1, "relaxation: removed": 1,
                    "loads: radiated": 1, "others": 2}
        columns = [f"energy_{name}_{one}" for name, some in channels.items() for part in some.values() for one in part]
        head = ",".join(["time [s]", "energy_kinetic [J]", *(f"{column} [J]" for column in columns)])
        folder = self.run_of(history=head + "\n" + ",".join(["0"] + ["1"] * (len(columns) + 1)) + "\n")
        made = summary()
        made["ledger"]["accounts"] = {name: {**account(kind), **{key: {one: quantity(1.0, "J") for one in channels[name].get(key, [])}
                                                                for key in ("stored", "dissipated")}} for name, kind in kinds.items()}
        (folder / "summary.json").write_text(json.dumps(made))
        run, = report_run.read([folder])
        groups, outside = report_energy.over_time(run)
        self.assertEqual(({name: values[0] for name, values in groups.items()}, outside[0]), (expected, -2))
        end = report_energy.at_end(run)
        self.assertEqual({name: end[name] for name in [*expected][1:]}, {name: expected[name] for name in [*expected][1:]})
        self.assertEqual((end["work of loads"], end["work of gravity"]), (-1, -1))
        (folder / "summary.json").unlink()  # kinds are unknown: by channels alone, and the relaxation by its name
        groups, _ = report_energy.over_time(report_run.read([folder])[0])
        self.assertEqual({name: values[0] for name, values in groups.items() if name not in ("kinetic", "elastic")}, {
            "stored": 1, "plastic": 1, "hourglass and other artificial": 1, "friction": 2, "inelastic impact": 2, "damping": 1,
            "radiated": 1, "relaxation: removed": 1, "others": 1})

    def test_every_kind_of_source_has_a_group(self):
        text = (ROOT / "lib/base/account.hpp").read_text()
        words = re.findall('"(\\w+)"', re.search(r"words_of_source_kinds\{(.*?)\}", text, re.S).group(1))
        self.assertEqual(set(words), set(report_energy.FAMILIES))
        for name in ("stored", "dissipated"):
            for channel in re.findall('"(\\w+)"', re.search(rf"words_of_{name}\{{(.*?)\}}", text, re.S).group(1)):
                self.assertTrue(channel in report_energy.CHANNELS, channel)

    def changed(self, name, change, **words):
        """A run whose summary is changed by a function."""
        folder = self.run_of(name, **words)
        made = json.loads((folder / "summary.json").read_text())
        change(made)
        (folder / "summary.json").write_text(json.dumps(made))
        return folder

    def test_the_set_up_shows_what_the_case_says_of_plates_and_of_the_relaxation(self):
        def change(made):
            case = made["provenance"]["resolved"]
            case["bodies"][0].update(element={"thickness": said(0.002, "m"), "layers": said(5, "1", True)}, rigid=said(True),
                                     move=said([0.0, 0.0, 0.1], "m"))
            case["relaxation"] = {"after": said(0.005, "s"), "residual": said(1e-7, "1"), "samples": said(5, "1", True)}
            made["ledger"]["accounts"]["relaxation"] = account("relaxation")

        text = self.words_of_page(self.changed("one", change))
        self.assertIn("<td>thickness 2 mm</td>", text)
        self.assertIn("<td>elastic, rigid</td>", text)
        self.assertIn("move [0, 0, 0.1] m", text)
        self.assertRegex(text, "<td>relaxation</td><td>relaxation</td><td>after 5 ms, residual 1e-07</td>")

    def test_set_ups_that_differ_are_not_told_to_be_the_same(self):
        def thick(size, default):
            def change(made):
                made["provenance"]["resolved"]["bodies"][0]["element"] = {"thickness": said(size, "m", default)}
            return change

        same = "the same as of A"
        for default in (False, True):  # a default is in no table of the set-up
            one, two, three = (self.changed(f"{default}_{i}", thick(size, default)) for i, size in enumerate((0.002, 0.003, 0.003)))
            self.assertNotIn(same, self.words_of_page(one, two))
            self.assertIn("the same as of B", self.words_of_page(one, two, three))
            self.assertIn(same, self.words_of_page(two, three))

    def test_the_page_says_what_differences_and_created_energy_are(self):
        text = self.words_of_page(self.run_of("coarse"), self.run_of("fine", tip=0.0021))
        self.assertIn("in per cent of the magnitude of A; positive: B is larger", text)
        self.assertIn("spurious energy in the account of one source, whose work, stores and losses do not add up to zero", text)

    def test_noise_has_no_difference(self):
        def smallest(value, other):
            def change(made):
                made["results"]["tip_smallest"], made["results"]["plain"] = quantity(value, "m"), quantity(other, "m")
            return change

        one, two = self.changed("one", smallest(1e-12, 1e-13)), self.changed("two", smallest(1.9e-12, -1e-12))
        text = self.page(one, two)
        for name in ("tip_smallest", "plain"):
            self.assertRegex(text, f"<td>{name}</td>(?:(?!</tr>).)*{report_results.ROUND_OFF}")
        two = self.changed("three", smallest(1e-8, 1e-8))
        for name in ("tip_smallest", "plain"):
            self.assertNotRegex(self.page(one, two), f"<td>{name}</td>(?:(?!</tr>).)*{report_results.ROUND_OFF}")

    def test_differences_as_text(self):
        text = report_compare.text(report_run.read([self.run_of("coarse"), self.run_of("fine", friction=0.3, tip=0.0021)]))
        self.assertRegex(text, r"contacts\[0\].friction +0.2 +0.3\n")
        self.assertRegex(text, r"tip_last +mm +2 +2.1 +[+]5 %\n")
        self.assertRegex(text, r"bodies: elastic +10 +10 % +10 +10 %\n")
        self.assertNotRegex(text, "</|&[a-z]+;")
        self.assertEqual(doctest.testmod(report_compare).failed, 0)
        text = report_compare.text(report_run.read([self.run_of("whole"), self.run_of("cut", finished=False)]))
        self.assertIn("B: summary.json is missing", text)

    def test_a_length_of_zero_has_a_unit(self):
        class Flat:
            def box(self):
                return np.array([[0.0, 0.1], [0.0, 0.02], [0.0, 0.0]])

        self.assertRegex(report_scene.size_of(Flat()), "100.mm × 20.mm × 0.mm")

    def test_a_picture_is_drawn_again_after_a_fault(self):
        os.environ.get("DISPLAY") or self.enterContext(unittest.mock.patch.dict(os.environ, {"DISPLAY": ":0"}))
        counted = self.root / "tries"
        counted.write_text("")

        def work(faults):
            counted.write_text(counted.read_text() + "x")
            if len(counted.read_text()) <= faults:
                os.abort()
            return "drawn"

        with unittest.mock.patch.dict(os.environ, {"PATH": ""}):  # no other display
            self.assertEqual(screen.drawn(lambda: work(screen.TRIES - 1)), "drawn")
            self.assertEqual(len(counted.read_text()), screen.TRIES)
            counted.write_text("")
            with self.assertRaisesRegex(screen.NotDrawn, "3 tries failed: the process that draws ended by signal 6"):
                screen.drawn(lambda: work(99))
            self.assertEqual(len(counted.read_text()), screen.TRIES)
            with self.assertRaisesRegex(screen.NotDrawn, "ended with status 1"):  # as of Xlib without its display
                screen.drawn(lambda: os._exit(1))
            with self.assertRaisesRegex(SystemExit, "said"):
                screen.drawn(lambda: sys.exit("said"))

    def test_each_try_has_a_display_of_its_own(self):
        screens, places = screen.Screens(), []
        with unittest.mock.patch.dict(os.environ, {"DISPLAY": ":of_the_user"}), unittest.mock.patch.object(screen, "SCREENS", screens):
            screens.start = lambda: setattr(screens, "server", unittest.mock.Mock()) or places.append(screens)
            screens.authority = unittest.mock.Mock()
            with unittest.mock.patch.object(screen.shutil, "which", return_value="/Xvfb"), self.assertRaises(screen.NotDrawn):
                screen.drawn(lambda: os.abort())
        self.assertEqual(len(places), screen.TRIES - 1)  # the first try was on the display of the user

    @unittest.skipIf(importlib.util.find_spec("vtk") is None, "no VTK")
    def test_a_report_without_a_picture_is_written(self):
        folder, programs = self.run_of(), self.root / "programs"
        write_frame(folder / "0.vtu", True)
        (folder / "body.pvd").write_text('<VTKFile><Collection><DataSet timestep="0" file="0.vtu"/></Collection></VTKFile>')
        programs.mkdir()
        (programs / "Xvfb").write_text("#!/bin/sh\nexit 1\n")
        (programs / "Xvfb").chmod(0o755)
        environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
        environment.pop("DISPLAY", None)

        def made(script):
            done = subprocess.run([sys.executable, ROOT / "scripts" / script, folder], capture_output=True, text=True, timeout=120,
                                  env=environment)
            return done.returncode, done.stderr.splitlines()

        status, lines = made("report")
        self.assertEqual(status, 0)
        self.assertEqual((folder / "report.html").read_text().count("This picture could not be drawn: 3 tries failed"), 3)
        self.assertEqual(len(lines), 3, lines)
        for line in lines:
            self.assertRegex(line, "report: no picture '.*': 3 tries failed: Xvfb did not start")
        self.assertEqual(made("view.py"), (1, ["view.py: 3 tries failed: Xvfb did not start"]))

    def test_times_have_units(self):
        time_of = script("report").time_of
        for text, expected in (("2e-4", 2e-4), ("0.2ms", 2e-4), ("20 us", 2e-5), ("0", 0.0), ("1s", 1.0)):
            self.assertAlmostEqual(time_of(text), expected)

    @unittest.skipIf(importlib.util.find_spec("vtk") is None, "no VTK")
    def test_frames_of_both_kinds_are_read_alike(self):
        for deformed in (False, True):
            data = frames.load(write_frame(self.root / "frame.vtu", deformed))
            start, now = frames.positions(data)
            self.assertEqual(start[7].tolist(), [1.0, 1.0, 1.0] if not deformed else [1.0, 1.0, 0.5])
            self.assertEqual((now - start)[7].tolist(), [0.0, 0.0, 0.5])
            numbers, names = frames.bodies(data)
            self.assertEqual((numbers.tolist(), names), ([0], {0: "bar"} if deformed else {}))
            self.assertEqual([frames.unit_of(data, name) for name in ("displacement", "stress")], ["m", ""])

    @unittest.skipIf(importlib.util.find_spec("vtk") is None or not (os.environ.get("DISPLAY") or shutil.which("Xvfb")), "no screen")
    def test_frames_are_drawn(self):
        folder = self.run_of()
        write_frame(folder / "0.vtu", True)
        (folder / "body.pvd").write_text('<VTKFile><Collection><DataSet timestep="0" file="0.vtu"/></Collection></VTKFile>')

        def made(*words):
            command = [sys.executable, ROOT / "scripts" / "report", folder, *words]
            done = subprocess.run(command, capture_output=True, text=True, timeout=120)
            return done.returncode, done.stderr

        self.assertEqual(made(), (0, ""))
        text = (folder / "report.html").read_text()
        self.assertEqual(text.count("data:image/png"), 3)  # two of the set-up, and the only frame
        self.assertIn("magnitude of the displacement", text)
        shutil.copy(folder / "body.pvd", folder / "walls.pvd")
        view, out = ROOT / "scripts/view.py", self.root / "view.png"
        for words, status, said in ((["--cut", "--cut-at", "1000"], 0, ""), (["--cut", "bar", "--edges"], 0, ""),
                                    (["--cut", "--cut-at", "1000", "--show", "body"], 2, "nothing to draw in")):
            done = subprocess.run([sys.executable, view, folder, "--out", out, *words], capture_output=True, text=True, timeout=120)
            self.assertEqual((done.returncode, said in done.stderr), (status, True), done.stderr)
        legend_apart(self, view, folder, out)
        (folder / "contact.pvd").write_text("<VTKFile>")
        done = subprocess.run([sys.executable, view, folder, "--out", out], capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stderr), (2, f"view.py: {folder}/contact.pvd is no collection of ParaView\n"))
        self.assertEqual(made("--field", "nosuch"), (2, "report: no field is called 'nosuch'; there are: displacement\n"))


def legend_apart(test, view, folder, out):
    """The legend of bodies lies right of the body, in the colour in which the body is drawn."""
    import vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for size in ("300 250", "1400 300"):
        words = [folder, "--out", out, "--field", "body", "--show", "body", "--size", *size.split(), "--elevation", "50", "--azimuth", "30"]
        done = subprocess.run([sys.executable, view, *words], capture_output=True, text=True, timeout=120)
        test.assertEqual(done.returncode, 0, done.stderr)
        reader = vtk.vtkPNGReader()
        reader.SetFileName(str(out))
        reader.Update()
        wide, high, _ = reader.GetOutput().GetDimensions()
        picture = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(high, wide, -1)[:, :, :3].astype(float)
        coloured = picture.max(axis=2) - picture.min(axis=2) > 40  # neither words nor paper
        there = coloured.any(axis=0)
        ends = [i for i in range(1, wide) if there[i] != there[i - 1]]
        body, legend = (picture[:, a:b][coloured[:, a:b]] for a, b in (ends[:2], ends[-2:]))
        words_of_legend = (picture[:int(0.9 * high), ends[1]:].min(axis=2) < 200).any(axis=0)
        test.assertGreater(list(words_of_legend).index(True), 15)
        darkest, brightest = np.quantile(body, [0.05, 0.95], axis=0) / np.median(legend, axis=0)  # without pixels at rims
        test.assertTrue(darkest.min() > 0.75 and brightest.max() < 1.05 and np.ptp(darkest) < 0.05, (darkest, brightest))


def write_frame(path, deformed):
    """One hexahedron whose upper nodes have moved by half a metre along z."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)]

    def array(name, kind, values, components=1):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                + " ".join(map(str, values)) + "</DataArray>")

    def whole(name, values, more=""):
        return (f'<DataArray type="Int32" Name="{name}" NumberOfTuples="{len(values)}" {more}format="ascii">'
                + " ".join(map(str, values)) + "</DataArray>")

    moved = [x for corner in corners for x in (0, 0, 0.5 * corner[2])]
    field = (whole("points_are_deformed", [1]) + whole("displacement [m]", [1]) + whole("bar", [0, 3]) if deformed else
             whole("units", [1], 'NumberOfComponents="1" ComponentName0="displacement [m]" '))
    path.write_text(f'<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid><FieldData>{field}</FieldData>'
                    '<Piece NumberOfPoints="8" NumberOfCells="1">'
                    f'<PointData>{array("displacement", "Float64", moved, 3)}</PointData>'
                    f'<CellData>{array("body" if deformed else "part_id", "Int32", [0])}</CellData>'
                    f'<Points>{array("p", "Float64", [x for corner in corners for x in corner], 3)}</Points>'
                    f'<Cells>{array("connectivity", "Int32", [0, 1, 2, 3, 4, 5, 7, 6])}{array("offsets", "Int32", [8])}'
                    f'{array("types", "UInt8", [12])}</Cells></Piece></UnstructuredGrid></VTKFile>')
    return path


if __name__ == "__main__":
    unittest.main()
