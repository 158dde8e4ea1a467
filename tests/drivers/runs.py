"""What a run of a driver leaves behind: the same bits on any number of threads, books that balance, and
the whole story where it stopped.

    python3 tests/drivers/runs.py DRIVERS                       DRIVERS: the folder with the programs
    python3 tests/drivers/runs.py DRIVERS Stops.test_inverted_element
"""
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASES = {  # by driver, and the name of a scene behind it
    "cask_drop": "cases/cask_drop/neptune.yaml", "two_blocks": "cases/two_blocks/bars.yaml",
    "patch_test": "cases/patch_test/three_on_four.yaml", "sliding": "cases/sliding/stop.yaml",
    "sliding.over_facets": "cases/sliding/over_facets.yaml", "scene.taylor_bar": "cases/scene/taylor_bar.yaml",
    "scene.oblique": "cases/scene/oblique.yaml", "plug_juncture.head": "cases/plug_juncture/head.yaml",
    "material_point": "cases/material_point/cycle.yaml", "contact_elements": "cases/contact_elements/random.yaml",
    "penalty_oscillator": "cases/penalty_oscillator/bounce.yaml"}
PATIENCE = 120  # [s] each run takes less than a second

# Small; the finer ones have so many tiles and apexes that every loop is shared among four threads.
CASK = ["mesh.level=1", "time.end=2 ms", "output.history_every=0.02 ms", "output.frames_every=0.5 ms"]
QUARTER = [*CASK, "model.kind=quarter"]
FINER_CASK = [*CASK, "mesh.level=3", "time.end=0.3 ms", "output.frames_every=0.1 ms"]
BARS = ["blocks.cells_along=20", "time.end=50 us", "output.frames_every=10 us"]
THICKER_BARS = [*BARS, "blocks.cells_across=12", "time.end=10 us", "output.frames_every=5 us"]
TAYLOR = ["time.end=10 us", "output.frames_every=5 us"]
NO_VISCOSITY = [f"{body}.viscosity.{term}=0" for body in ("element", "cladding") for term in ("linear", "quadratic")]


def program(driver):
    """The program behind a key of CASES."""
    return driver.split(".")[0]


class Run:
    """One run of a driver: what it said, and what stands in its folder."""

    drivers = None  # folder of the programs, from the command line

    def __init__(self, driver, values, out, *flags):
        by_key = dict(value.split("=", 1) for value in values)  # the last one counts
        words = [Run.drivers / program(driver), CASES[driver], "--out", out, *flags]
        for key, value in by_key.items():
            words += ["--set", f"{key}={value}"]
        done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
        self.status, self.stdout, self.stderr, self.out = done.returncode, done.stdout, done.stderr, Path(out)

    def summary(self):
        return json.loads((self.out / "summary.json").read_text(encoding="utf-8"))

    def history(self):
        """Column -> values, as numbers."""
        with open(self.out / "history.csv", newline="", encoding="utf-8") as stream:
            head, *rows = csv.reader(stream)
        return {name: [float(row[column]) for row in rows] for column, name in enumerate(head)}

    def frames(self, collection):
        """(time, file) of the frames that a .pvd lists."""
        listed = xml.parse(self.out / f"{collection}.pvd").getroot().iter("DataSet")
        return [(float(one.get("timestep")), self.out / one.get("file")) for one in listed]

    def files(self):
        """Path -> bytes of all results but the summary, which tells the time it took."""
        return {path.relative_to(self.out).as_posix(): path.read_bytes() for path in sorted(self.out.rglob("*"))
                if path.is_file() and path.name != "summary.json"}


class InATemporaryFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_to_end(self, driver, values, *flags, out="out", warning=""):
        run = Run(driver, values, self.folder / out, "--quiet", *flags)
        self.assertEqual((run.status, bool(run.stderr)), (0, bool(warning)), run.stderr)
        self.assertIn(warning, run.stderr)
        return run


class SameBits(InATemporaryFolder):
    """history.csv and every ParaView file, byte for byte, on 1, 2 and 4 threads and once again."""

    def compare(self, driver, values, warning=""):
        first = self.run_to_end(driver, values, "--threads", "1", out="first", warning=warning)
        files = first.files()
        self.assertIn("history.csv", files)
        self.assertTrue(any(name.endswith(".vtu") for name in files), "no .vtu file")
        self.assertTrue(any(name.endswith(".vtp") for name in files), "no .vtp file")
        for threads, out in (("1", "again"), ("2", "two"), ("4", "four")):
            with self.subTest(threads=threads, run=out):
                other = self.run_to_end(driver, values, "--threads", threads, out=out, warning=warning)
                self.assertEqual(other.summary()["cost"]["threads"], int(threads))
                self.assertEqual(other.summary()["results"], first.summary()["results"])
                self.assertEqual(other.summary()["ledger"], first.summary()["ledger"])
                self.assertEqual([*other.files()], [*files])
                differ = [name for name, data in other.files().items() if data != files[name]]
                self.assertEqual(differ, [], f"not the same bytes on {threads} threads")

    def test_full_cask(self):
        self.compare("cask_drop", CASK)

    def test_quarter_cask(self):
        self.compare("cask_drop", QUARTER)

    def test_finer_cask(self):
        self.compare("cask_drop", FINER_CASK)

    def test_two_blocks(self):
        self.compare("two_blocks", BARS)

    def test_thicker_blocks(self):
        self.compare("two_blocks", THICKER_BARS)


    def test_scene_with_a_wall(self):
        self.compare("scene.taylor_bar", TAYLOR)

    def test_scene_with_a_contact(self):
        self.compare("scene.oblique", [])


class Stops(InATemporaryFolder):
    """A run that the physics stops: status 3, the place, and everything up to then."""

    def stop(self, driver, values, word):
        run = Run(driver, values, self.folder / "out", "--quiet")
        self.assertEqual((run.status, run.stdout), (3, ""))
        ending = run.summary()["ending"]
        self.assertEqual(ending["word"], word)
        self.assertTrue(ending["reason"])
        last = run.stderr.splitlines()[-1]
        self.assertTrue(last.startswith(f"{driver}: stopped at "), last)
        for told in (word, f" in {ending['block']}", ending["reason"]):
            self.assertIn(told, last)
        self.check_that_all_is_there(run, ending["time"]["value"])
        return ending

    def check_that_all_is_there(self, run, end):
        times = run.history()["time [s]"]
        self.assertEqual(times[0], 0)
        self.assertEqual(times[-1], end)
        self.assertEqual(times, sorted(set(times)))
        self.assertGreater(len(times), 5)
        for collection in ("body", "contact"):
            frames = run.frames(collection)
            self.assertEqual(frames[-1][0], end, f"the last state is not in {collection}.pvd")
            for _, file in frames:
                self.assertTrue(file.is_file(), file)

    def test_inverted_element(self):
        ending = self.stop("cask_drop", [*CASK, *NO_VISCOSITY, "initial.speed=2000 m/s", "output.history_every=2 us"],
                           "inverted_element")
        self.assertIn(ending["block"], ("lead", "cladding"))
        self.assertGreaterEqual(ending["element"], 0)
        self.assertIn("volume or area", ending["reason"])

    def test_inverted_element_of_a_block(self):
        ending = self.stop("two_blocks", [*BARS, "closing_speed=10 km/s", "time.created_limit=1e6"], "inverted_element")
        self.assertIn(ending["block"], ("A", "B"))
        self.assertTrue(0 <= ending["element"] < 20, ending["element"])

    def test_energy_lost(self):
        by_penalty = ["contact.method=penalty", "contact.penalty_scale=1"]
        ending = self.stop("two_blocks", [*BARS, *by_penalty, "closing_speed=5 km/s", "time.created_limit=1e-3"], "energy_lost")
        self.assertEqual((ending["block"], ending["element"]), ("time integration", None))
        self.assertIn("the limit is 0.1 %", ending["reason"])


class Summary(InATemporaryFolder):
    """summary.json: the documented keys, the case in SI, results, and books that balance."""

    KEYS = ["driver", "ending", "results", "ledger", "overlaps", "touched", "cost", "provenance", "not_used", "notes", "warnings"]

    def check_form(self, run, driver, results, ending=("reached_end", "")):
        summary = run.summary()
        self.assertEqual([*summary], self.KEYS)
        self.assertEqual(summary["driver"], program(driver))
        self.assertEqual((summary["ending"]["word"], summary["ending"]["reason"]), ending)
        self.assertEqual(summary["ending"]["time"]["value"], run.history()["time [s]"][-1])
        for name, unit in results.items():
            self.assertEqual(summary["results"][name]["unit"], unit, name)
            self.assertIsInstance(summary["results"][name]["value"], float, name)
        self.assertGreater(summary["cost"]["steps"], 50)
        self.assertEqual(summary["cost"]["element_updates"],
                         summary["cost"]["elements"] * (summary["cost"]["steps"] + 1))
        provenance = summary["provenance"]
        self.assertEqual(provenance["case_path"], CASES[driver])
        self.assertRegex(provenance["case_hash"], r"^[0-9a-f]{16}$")
        for key in ("version", "commit", "compiler", "flags", "build_type", "processor"):
            self.assertTrue(provenance[key], key)
        return summary

    def check_ledger(self, ledger):
        """Recomputed from the accounts: the residuals that stand there are not believed."""
        initial, accounts = ledger["initial_kinetic"]["value"], ledger["accounts"]
        work = sum(account["work"]["value"] for account in accounts.values())
        residual = ledger["kinetic"]["value"] - initial - ledger["integration"]["value"] - work
        self.assertLess(abs(residual), 1e-10 * initial)
        self.assertLess(abs(ledger["energy_residual"]["value"]), 1e-10 * initial)
        before, after = ledger["initial_momentum"]["value"], ledger["momentum"]["value"]
        for axis in range(3):
            impulse = sum(account["impulse"]["value"][axis] for account in accounts.values())
            self.assertLess(abs(after[axis] - before[axis] - impulse), 1e-10 * self.momentum_scale(ledger), "xyz"[axis])
        for name, account in accounts.items():
            self.assertLess(abs(account["created_relative"]["value"]), 0.01, f"energy created by {name}")
            sources = sum(share["value"] for kind in ("stored", "dissipated") for share in account[kind].values())
            self.assertAlmostEqual((account["work"]["value"] + sources) / ledger["initial_available"]["value"],
                                   account["created_relative"]["value"], delta=1e-12)

    @staticmethod
    def momentum_scale(ledger):
        """Of the initial motion; two blocks have momenta that cancel, so that of half the energy each."""
        size = sum(component**2 for component in ledger["initial_momentum"]["value"]) ** 0.5
        return max(size, ledger["initial_kinetic"]["value"] / 10)  # [kg m/s] 10 m/s is the speed in both cases

    def check_cask(self, values, planes, warning=""):
        run = self.run_to_end("cask_drop", values, warning=warning)
        summary = self.check_form(run, "cask_drop", {
            "settlement_mean": "m", "time_of_settlement_mean": "s", "settlement_centre": "m", "bulge": "m",
            "smallest_step": "s", "largest_step": "s"})
        bodies = ["lead"] if "cladding.kind=none" in values else ["lead", "cladding", "interface"]
        if len(bodies) > 1 and "interface.kind=tied" not in values:
            bodies.append("interface_edges")
        self.assertEqual([*summary["ledger"]["accounts"]], [*bodies, *planes])
        self.check_ledger(summary["ledger"])
        results = summary["results"]
        self.assertGreater(results["settlement_mean"]["value"], 0.01)
        self.assertAlmostEqual(results["settlement_mean"]["value"], max(run.history()["settlement_mean [m]"]), delta=1e-4)
        floor = summary["ledger"]["accounts"]["floor"]["impulse"]["value"][2]
        gained = summary["ledger"]["momentum"]["value"][2] - summary["ledger"]["initial_momentum"]["value"][2]
        self.assertGreater(floor, 0)
        self.assertLess(abs(gained - floor), 1e-10 * gained, "nothing but the floor changes the vertical momentum")
        return summary

    def test_full_cask(self):
        self.check_cask(CASK, ["floor"])

    def test_quarter_cask(self):
        self.check_cask(QUARTER, ["floor", "x_plane", "y_plane"])

    def test_every_variant_of_the_cask(self):
        for change in ("cladding.kind=none", "interface.kind=tied", "interface.friction=0.3", "element.lead=full",
                       "interface.passes=two", "interface.method=penalty", "steel.hardening=kinematic"):
            with self.subTest(change):
                values = [*QUARTER, change]
                if "none" in change:  # without steel the steps are twenty times longer
                    values += ["mesh.level=3", "time.end=6 ms"]
                if "two" in change:
                    self.assertIn("interface_back", self.run_to_end("cask_drop", values, out="two").summary()["ledger"]["accounts"])
                    continue
                self.check_cask(values, ["floor", "x_plane", "y_plane"])

    def test_sector_of_the_cask(self):
        sector = [*CASK, "model.kind=sector", "mesh.level=2"]
        summary = self.check_cask(sector, ["floor", "first_plane", "second_plane"])
        self.assertFalse(any("lead: its step is limited by" in note for note in summary["notes"]), "the cladding limits the step")

    def test_quarter_is_a_quarter(self):
        full = self.run_to_end("cask_drop", CASK, out="full").summary()["ledger"]["initial_kinetic"]["value"]
        quarter = self.run_to_end("cask_drop", QUARTER, out="quarter").summary()["ledger"]["initial_kinetic"]["value"]
        self.assertAlmostEqual(4 * quarter / full, 1, delta=1e-12)

    def test_two_blocks(self):
        run = self.run_to_end("two_blocks", BARS)
        summary = self.check_form(run, "two_blocks", {
            "interface_stress_mean": "Pa", "interface_stress_peak": "Pa", "contact_time": "s", "impulse": "N s",
            "velocity_A": "m/s", "velocity_B": "m/s", "smallest_step": "s"})
        self.assertEqual([*summary["ledger"]["accounts"]], ["A", "B", "contact", "contact_back", "contact_edges"])
        self.check_ledger(summary["ledger"])
        for number, method in enumerate(("multiplier", "penalty")):  # two passes share one stress
            one, two = (self.run_to_end("two_blocks", [*BARS, f"contact.method={method}", f"contact.passes={passes}"],
                                        out=f"{passes}{number}").summary()["results"] for passes in ("one", "two"))
            for name in ("interface_stress_mean", "interface_stress_peak", "impulse"):
                self.assertAlmostEqual(two[name]["value"] / one[name]["value"], 1, delta=1e-6)

    def check_extremes(self, run, probes):
        """The last value of a probe is that of its column; its extremes are those of all steps, so no less than those of the rows."""
        history, results = run.history(), run.summary()["results"]
        times = history["time [s]"]
        for name, unit in probes.items():
            is_mean = f"{name} [{unit}]" not in history
            column = history[f"{name} [{unit}]" + (" mean" if is_mean else "")]
            self.assertEqual(results[f"{name}_last"], {"value": column[-1], "unit": unit})
            for word, value, sign in (("largest", max(column), 1), ("smallest", min(column), -1)):
                got, at = results[f"{name}_{word}"], results[f"{name}_{word}_at"]
                self.assertEqual((got["unit"], at["unit"]), (unit, "s"))
                self.assertGreaterEqual(sign * got["value"], sign * value - (1e-9 * abs(value) if is_mean else 0), name)
                if at["value"] in times and not is_mean:
                    self.assertEqual(got["value"], column[times.index(at["value"])], name)

    def test_taylor_bar(self):
        run = self.run_to_end("scene.taylor_bar", [])
        speed = run.history()["speed [m/s]"]
        self.assertGreater(speed[-1], 0)
        self.assertLessEqual(max(speed[:-1]), 0, "it did not stop at the first sample above")
        summary = self.check_form(run, "scene.taylor_bar", {"foot_last": "m", "wall_force_largest": "N", "plastic_strain_last": "1"},
                                  ending=("stopped_by_condition", f"speed is {speed[-1]:.6g} m/s, above 0 m/s"))
        self.check_extremes(run, {"length": "m", "foot": "m", "wall_force": "N", "speed": "m/s", "plastic_strain": "1",
                                  "kinetic_energy": "J"})
        self.assertEqual([*summary["ledger"]["accounts"]], ["bar", "wall", "x_plane", "y_plane"])
        self.check_ledger(summary["ledger"])
        # codes end at 21.1 to 21.5 mm (benchmarks of Taylor's bar); this mesh is a coarse one of them
        self.assertAlmostEqual(summary["results"]["length_last"]["value"], 21.4e-3, delta=0.4e-3)
        # all that the wall gave is the mean force times the time
        wall = summary["ledger"]["accounts"]["wall"]["impulse"]["value"][2]
        history = run.history()
        times, force = history["time [s]"], history["wall_force [N] mean"]
        given = sum(f * (b - a) for f, a, b in zip(force[1:], times, times[1:]))
        self.assertAlmostEqual(given / wall, 1, delta=1e-12)

    def test_oblique_impact(self):
        run = self.run_to_end("scene.oblique", [])
        gap = run.history()["gap [m]"][-1]
        summary = self.check_form(run, "scene.oblique", {"normal_force_largest": "N", "area_largest": "m^2"},
                                  ending=("stopped_by_condition", f"gap is {gap:.6g} m, above 0.0002 m"))
        self.check_extremes(run, {"normal_force": "N", "speed": "m/s", "gap": "m", "area": "m^2", "stress": "Pa"})
        self.check_ledger(summary["ledger"])

    def test_conditions_are_not_looked_at_before_their_time(self):
        summary = self.run_to_end("scene.oblique", ["stop[0].above=-1 m", "stop[0].after=30 us"]).summary()
        self.assertEqual(summary["ending"]["word"], "stopped_by_condition")
        self.assertTrue(30e-6 <= summary["ending"]["time"]["value"] < 31e-6, summary["ending"])

    def test_patch_test(self):
        matching = self.run_to_end("patch_test", ["blocks.cells_upper=[4, 4, 2]", "relaxation.residual=1e-6"]).summary()
        self.assertEqual(matching["ending"]["word"], "relaxed")
        for name in ("stress_error_largest", "pressure_error_largest"):
            self.assertLess(matching["results"][name]["value"], 2e-5)  # ten times the residual of the relaxation
        unlike = self.run_to_end("patch_test", [], out="unlike", warning="its apexes are 1.33 times as far apart").summary()
        self.assertTrue(any("its apexes are 1.33 times as far apart" in note for note in unlike["notes"]))
        self.assertGreater(unlike["results"]["stress_error_largest"]["value"], 0.1)  # nodes on facets cannot do better
        two = self.run_to_end("patch_test", ["contact.passes=two"], out="two").summary()
        self.assertLess(two["results"]["stress_error_mean"]["value"], 0.3 * unlike["results"]["stress_error_mean"]["value"])

    def check_answer(self, run, driver, results):
        """Of a driver that has no bodies: the same keys, and a case in SI."""
        summary = run.summary()
        self.assertEqual([*summary], self.KEYS)
        self.assertEqual((summary["driver"], summary["ending"]["word"]), (driver, "reached_end"))
        self.assertEqual(summary["ending"]["time"]["value"], run.history()["time [s]"][-1])
        for name, unit in results.items():
            self.assertEqual(summary["results"][name]["unit"], unit, name)
        self.assertEqual(summary["provenance"]["case_path"], CASES[driver])
        return summary

    def test_material_point(self):
        run = self.run_to_end("material_point", [])
        summary = self.check_answer(run, "material_point", {"stress_xx": "Pa", "strain_yy": "1", "plastic_strain": "1",
                                                            "back_stress_xx": "Pa",
                                                            "work_stored": "J/m^3", "work_dissipated": "J/m^3"})
        self.assertEqual(summary["ledger"]["accounts"], {})
        self.assertEqual(len(run.history()["stress_xx [Pa]"]), 501)

    def test_stress_that_no_strain_gives(self):
        run = Run("material_point", ["material.tangent=0 Pa", "path[0].strain.xx=0", "path[0].stress.xy=1 GPa"], self.folder / "out")
        self.assertEqual(run.status, 3)
        self.assertEqual(run.summary()["ending"]["word"], "not_converged")
        self.assertIn("path[0]", run.stderr)

    def test_strain_beyond_numbers(self):
        for strain in ("1e200", "-1e300", "1e155"):  # NaN or infinity in stress or work
            run = Run("material_point", ["path[0].strain.xy=" + strain], self.folder / "out")
            ending = run.summary()["ending"]
            self.assertEqual((run.status, ending["word"]), (3, "not_finite"), run.stderr)
            self.assertRegex(ending["reason"], r"is no finite number at increment \d+ of path\[0\]")
            self.assertTrue(all(math.isfinite(value) for column in run.history().values() for value in column))

    def test_contact_elements(self):
        run = self.run_to_end("contact_elements", ["elements=20"])
        summary = self.check_answer(run, "contact_elements", {"tetrahedral_gradient": "1", "line_moment": "1"})
        self.assertEqual(len(run.history()["gradient [1]"]), 60)
        self.assertLess(summary["results"]["tetrahedral_moment"]["value"], 1e-9)

    def test_penalty_oscillator(self):
        for kind in ("tetrahedral", "triangular", "line"):
            run = self.run_to_end("penalty_oscillator", [f"element={kind}", "phases=2"], out=kind)
            summary = self.check_answer(run, "penalty_oscillator", {"contact_time": "s", "peak_force": "N", "rebound_largest": "1"})
            self.assertEqual([*summary["ledger"]["accounts"]], ["contact"])
            self.check_ledger(summary["ledger"])

    def test_sliding_block_stops(self):
        summary = self.run_to_end("sliding", ["speed=1 m/s", "time.end=0.5 s"]).summary()
        self.check_ledger(summary["ledger"])
        results, exact = summary["results"], {"way": 1 / (2 * 0.3 * 9.81), "stop_time": 1 / (0.3 * 9.81)}
        self.assertAlmostEqual(results["way"]["value"] / exact["way"], 1, delta=0.01)
        self.assertAlmostEqual(results["stop_time"]["value"] / exact["stop_time"], 1, delta=0.02)  # and half a swing of the stick
        heat = summary["ledger"]["accounts"]["contact"]["dissipated"]["friction"]["value"]
        self.assertAlmostEqual(heat / summary["ledger"]["initial_kinetic"]["value"], 1, delta=0.01)

    def test_block_on_an_incline(self):
        incline = ["speed=0 m/s", "base.slope=30 deg", "base.ease=0.2 s", "time.end=1 s"]
        stays = self.run_to_end("sliding", [*incline, "contact.friction=0.6"])
        results = stays.summary()["results"]
        self.assertLess(abs(results["way_in_second_half"]["value"]), 1e-7)  # it stays: a millionth of its height
        self.assertLess(abs(results["way"]["value"]), 1e-4)  # its sticks have stretched and its rims slid while the pull grew
        goes = self.run_to_end("sliding", [*incline, "contact.friction=0.2"], out="goes")
        self.assertAlmostEqual(goes.summary()["results"]["acceleration"]["value"] / 3.20586, 1, delta=0.01)

    def test_block_over_facets(self):
        summary = self.run_to_end("sliding.over_facets", ["time.end=0.2 s"]).summary()
        self.check_ledger(summary["ledger"])
        self.assertGreater(summary["results"]["contact_reconnections"]["value"], 50)
        self.assertLess(summary["results"]["normal_force_ripple"]["value"], 0.06)

    def test_resolved_case_is_in_si(self):
        resolved = self.run_to_end("cask_drop", CASK).summary()["provenance"]["resolved"]
        for path, value, unit in (("initial.speed", 13.33, "m/s"), ("cylinder.radius", 0.1525, "m"),
                                  ("lead.young", 19.5e6 * 9.80665, "Pa"),
                                  ("lead.density", 1.13e-9 * 9.80665e12, "kg/m^3"), ("lead.poisson", 0.42, "1"),
                                  ("time.end", 2e-3, "s"), ("mesh.level", 1, "1")):
            with self.subTest(path):
                section, key = path.split(".")
                found = resolved[section][key]
                self.assertAlmostEqual(found["value"] / value, 1, delta=1e-14)
                self.assertEqual((found["unit"], found["default"]), (unit, False))

    def test_resolved_case_tells_defaults(self):
        resolved = self.run_to_end("two_blocks", BARS).summary()["provenance"]["resolved"]
        self.assertEqual(resolved["time"]["safety"], {"value": 0.9, "unit": "1", "default": True})
        self.assertEqual(resolved["contact"]["method"], {"value": "multiplier", "unit": None, "default": True})

    def test_history_has_units(self):
        history = self.run_to_end("cask_drop", CASK).history()
        for column in history:
            self.assertRegex(column, r"^[a-z_A-Z]+ \[[^\]]+\]( mean)?$")
        self.assertEqual([column for column in history if column.endswith(" mean")], ["floor_force [N] mean"])
        self.assertGreater(len(history["time [s]"]), 90)
        self.assertEqual(history["time [s]"][-1], 2e-3)


class Head(InATemporaryFolder):
    """Shield plates below the plugs of a head: what each gap hands on, and books that balance."""

    PLATES = [f"plate_{i + 1}" for i in range(6)]
    PLUGS = ["small", "intermediate", "large"]

    def values(self, *settings, **options):
        """Results of a run as numbers, and its ledger."""
        summary = self.run_to_end("plug_juncture.head", ["output.frames_every=1 s", *settings], **options).summary()
        return {name: result["value"] for name, result in summary["results"].items()}, summary["ledger"]

    def check_books(self, ledger):
        scale = max(ledger["external_work"]["value"], ledger["initial_kinetic"]["value"])
        self.assertLess(abs(ledger["energy_residual"]["value"]), 1e-10 * scale)
        given = [ledger["initial_momentum"]["value"][2], *(account["impulse"]["value"][2] for account in ledger["accounts"].values())]
        self.assertLess(max(map(abs, ledger["momentum_residual"]["value"])), 1e-10 * max(map(abs, given)))
        for name, account in ledger["accounts"].items():
            self.assertLess(abs(account["created_relative"]["value"]), 1e-3, f"energy created by {name}")

    def test_what_each_gap_hands_on(self):
        got, ledger = self.values("time.end=6 ms")
        self.check_books(ledger)
        self.assertEqual([name for name in ledger["accounts"] if name.startswith("pressure")], ["pressure_plate_1"])
        # the impulse of a triangle of 10 MPa and 4 ms on a ring of 48 corners
        area = 24 * math.sin(math.pi / 24) * (0.9**2 - 0.2**2)
        given = area * 10e6 * 4e-3 / 2
        kept = sum(got[f"momentum_{body}"] for body in self.PLATES + self.PLUGS)
        self.assertAlmostEqual(kept / given, 1, delta=1e-3)  # the area changes as the plate bends
        strikes = [*(f"impulse_{plate}" for plate in self.PLATES), "impulse_1", "impulse_2"]
        into = [given, *(got[name] for name in strikes)]
        for body, taken, handed in zip(self.PLATES + self.PLUGS[:2], into, into[1:]):
            self.assertAlmostEqual(got[f"momentum_{body}"] / given, (taken - handed) / given,
                                   delta=1e-3 if body == "plate_1" else 1e-9, msg=body)
        closes = [got[f"closes_{gap}"] for gap in [*self.PLATES, "1"]]
        self.assertEqual(closes, sorted(closes))
        self.assertNotIn("closes_2", got)
        # a rigid plate of 50 mm is 5 mm up after 0.6440 ms
        self.assertAlmostEqual(got["closes_plate_1"] / 0.6440e-3, 1, delta=0.01)
        self.assertAlmostEqual(got["part_of_momentum_plate_6"], got["momentum_plate_6"] / given, delta=1e-3)

    def test_sector_quarter_and_whole(self):
        """Up to the second gap: later, strikes of nodes upon nodes make round-off grow."""
        sector, _ = self.values("mesh.level=1", "time.end=0.9 ms", out="sector")
        for kind in ("quarter", "full"):
            other, ledger = self.values("mesh.level=1", "time.end=0.9 ms", f"model.kind={kind}", out=kind)
            self.check_books(ledger)
            for name in ("closes_plate_1", "impulse_plate_1", "momentum_plate_1", "momentum_plate_2", "peak_force_plate_1"):
                self.assertAlmostEqual(other[name] / sector[name], 1, delta=1e-4, msg=f"{kind} {name}")

    def test_what_strikes(self):
        few = ("time.end=0.8 ms",)
        for kind, settings in (("velocity", ["struck_by.speed=20 m/s"]), ("block", ["struck_by.speed=20 m/s", "struck_by.height=0.1 m"])):
            got, ledger = self.values(*few, f"struck_by.kind={kind}", *settings, out=kind)
            self.check_books(ledger)
            start, now = (ledger[name]["value"][2] for name in ("initial_momentum", "momentum"))
            self.assertAlmostEqual(now / start, 1, delta=1e-10)  # nothing reaches the flange
            if kind == "velocity":  # a sector is one of 48
                self.assertAlmostEqual(48 * start * got["part_of_momentum_plate_1"] / got["momentum_plate_1"], 1, delta=1e-9)
            self.assertGreater(got["impulse_plate_1"], 0)
        _, ledger = self.values(*few, "struck_by.plugs=all", out="all")
        self.assertEqual([name for name in ledger["accounts"] if name.startswith("pressure")],
                         ["pressure_plate_1", "pressure_intermediate", "pressure_large"])


class NotUsed(InATemporaryFolder):
    """Keys that the chosen kinds do not use are told."""

    def test_keys_of_another_kind(self):
        values = [*CASK, "time.end=0.1 ms", "steel.kind=elastic"]
        summary = self.run_to_end("cask_drop", values).summary()
        told = [re.sub(r" \(.*", "", entry) for entry in summary["not_used"]]
        self.assertEqual(told, ["steel.yield", "steel.tangent"])
        for entry in summary["not_used"]:
            self.assertRegex(entry, rf" \({re.escape(CASES['cask_drop'])}:\d+:\d+\)$")
        self.assertNotIn("yield", summary["provenance"]["resolved"]["steel"])

    def test_hardness_beside_a_given_penalty(self):
        values = [*BARS, "time.end=1 us", "contact.method=penalty", "contact.penalty_scale=2", "contact.penalty=5e13 Pa/m"]
        run = Run("two_blocks", values, self.folder / "out")
        self.assertEqual(run.status, 0)
        self.assertIn("not used: contact.penalty_scale (--set contact.penalty_scale=2:9)\n", run.stdout)
        self.assertEqual(run.summary()["results"]["contact_penalty"], {"value": 5e13, "unit": "Pa/m"})

    def test_nothing_is_listed_where_all_is_used(self):
        run = self.run_to_end("cask_drop", [*CASK, "time.end=0.1 ms"], warning="concentrated in single elements")
        self.assertEqual(run.summary()["not_used"], [])


class Folders(InATemporaryFolder):
    """What is written, where, and what is said."""

    def test_dry_run_makes_no_folder(self):
        run = Run("cask_drop", CASK, self.folder / "out", "--dry-run")
        self.assertEqual((run.status, run.stderr), (0, ""))
        self.assertRegex(run.stdout, r"\d+ nodes, \d+ elements, mass .* kg\nfirst step .* s, limited by ")
        self.assertEqual([*self.folder.iterdir()], [])

    def test_dry_run_leaves_a_folder_alone(self):
        self.run_to_end("two_blocks", [*BARS, "time.end=1 us"])
        before = {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in self.folder.rglob("*")}
        Run("two_blocks", BARS, self.folder / "out", "--dry-run")
        after = {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in self.folder.rglob("*")}
        self.assertEqual(before, after)

    def test_bad_case_makes_no_folder(self):
        run = Run("cask_drop", [*CASK, "lead.poisson=0.5"], self.folder / "out")
        self.assertEqual((run.status, run.stdout), (2, ""))
        self.assertEqual([*self.folder.iterdir()], [])

    def test_quiet_says_nothing(self):
        run = Run("two_blocks", [*BARS, "contact.method=penalty", "contact.penalty_scale=2", "contact.penalty=5e13 Pa/m"],
                  self.folder / "out",
                  "--quiet")
        self.assertEqual((run.status, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual(len(run.summary()["not_used"]), 1)  # told there all the same

    def test_quiet_dry_run_says_nothing(self):
        run = Run("two_blocks", BARS, self.folder / "out", "--quiet", "--dry-run")
        self.assertEqual((run.status, run.stdout, run.stderr), (0, "", ""))

    def test_results_are_told(self):
        run = Run("two_blocks", BARS, self.folder / "out")
        for name, result in run.summary()["results"].items():
            self.assertRegex(run.stdout, rf"(?m)^{name} +\S+ {re.escape(result['unit'])}$")

    def test_a_folder_within_folders_is_made(self):
        self.run_to_end("two_blocks", [*BARS, "time.end=1 us"], out="a/b/c")
        self.assertTrue((self.folder / "a/b/c/summary.json").is_file())


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    Run.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
