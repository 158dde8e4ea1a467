"""scripts/update_case renames words where they stand, and touches nothing else."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
update_case = made_up.script("update_case")

OLD = """# a scene; hardness in a comment stays
bodies:
  - name: a
    mesh: {kind: cylinder, turn: quarter}   # of the mesh: stays
    turn: {axis: [0, 0, 1], angle: 30 deg}
contacts:
  - {name: touch, hardness: 4,  "stick": 0.5, damping: 0.1, 'created_in_a_bounce': 0.01}  # a comment
springs: [{name: s, damping: 3 N*s/m}]
planes:
  - name: wall
    kind: held      # as written
    nodes: [held]
  - {name: floor, kind: "rigid", hardness: 2}
  - {name: driven, kind: driven, turning: {value: ["0", "0", "1"]}}
"""

NEW = """# a scene; hardness in a comment stays
bodies:
  - name: a
    mesh: {kind: cylinder, turn: quarter}   # of the mesh: stays
    rotate: {axis: [0, 0, 1], angle: 30 deg}
contacts:
  - {name: touch, penalty_scale: 4,  "tangential_penalty": 0.5, damping_ratio: 0.1, 'energy_gain_limit': 0.01}  # a comment
springs: [{name: s, damping: 3 N*s/m}]
planes:
  - name: wall
    kind: constrained      # as written
    nodes: [held]
  - {name: floor, kind: "rigid", penalty_scale: 2}
  - {name: driven, kind: driven, angular_velocity: {value: ["0", "0", "1"]}}
"""


def updated(name, text):
    changes, faults = update_case.changes_of(name, text)
    return update_case.rewritten(text, changes), faults


class YamlTest(unittest.TestCase):
    def setUp(self):
        try:
            import yaml  # noqa: F401
        except ImportError:
            self.skipTest("needs python3-yaml")

    def test_words_are_renamed_where_they_stand_and_nowhere_else(self):
        self.assertEqual(updated("case.yaml", OLD), (NEW, []))

    def test_a_second_time_changes_nothing(self):
        self.assertEqual(updated("case.yaml", NEW), (NEW, []))

    def test_sections_of_the_drivers_have_the_same_words(self):
        self.assertEqual(updated("a.yaml", "interface: {hardness: 10}\n")[0], "interface: {penalty_scale: 10}\n")
        self.assertEqual(updated("a.yaml", "contact:\n  hardness: 2\n  damping: 0\n")[0],
                         "contact:\n  penalty_scale: 2\n  damping_ratio: 0\n")

    def test_line_ends_quotes_escapes_and_letters_stay(self):
        text = '# Härte\r\ncontact: {"hardn\\x65ss":2}\r\nname: é\r\n'
        self.assertEqual(updated("a.yaml", text)[0], '# Härte\r\ncontact: {"penalty_scale":2}\r\nname: é\r\n')

    def test_anchors_are_changed_where_they_are_defined(self):
        text = "one: &c {hardness: 2}\ncontacts:\n  - *c\n  - {<<: *c, name: b}\n"
        self.assertEqual(updated("a.yaml", text)[0], text.replace("hardness", "penalty_scale"))
        self.assertEqual(updated("a.yaml", "a: &a [*a]\ncontact: {hardness: 2}\n")[0], "a: &a [*a]\ncontact: {penalty_scale: 2}\n")

    def test_a_mistake_in_one_block_does_not_hide_the_others(self):
        text = "interface: {hardness: 10}\nmesh: {level: [1\ntime: {end: 1 s}\n"
        new, faults = updated("a.yaml", text)
        self.assertEqual(new, text.replace("hardness", "penalty_scale"))
        self.assertEqual([line for line, _ in faults], [3])


    def test_probes_of_plates_get_the_place_that_they_had(self):
        bodies = "bodies:\n  - {name: skin, element: &thin {thickness: 2 mm}}\n  - {name: more, element: {<<: *thin}}\n  - {name: bar}\n"
        old = bodies + ("probes:\n  - {name: a, quantity: stress, of: skin, component: xx}   # a comment\n"
                        "  - name: b\n    quantity: pressure\n    of: more\n  - {name: c, quantity: stress, of: bar, component: xx}\n"
                        "  - {name: d, quantity: stress, of: skin, component: xx, place: top}\n"
                        "  - {name: e, quantity: displacement, of: skin.rim}\n")
        new = old.replace("xx}   # a", "xx, place: membrane}   # a").replace("- name: b\n", "- place: membrane\n    name: b\n")
        self.assertEqual(updated("a.yaml", old), (new, []))
        self.assertEqual(updated("a.yaml", new), (new, []))

    def test_what_was_the_largest_of_the_layers_is_told(self):
        old = ("bodies: [{name: skin, element: {thickness: 2 mm}}]\nprobes:\n"
               "  - {name: a, quantity: von_mises, of: skin}\n  - {name: b, quantity: stress, of: skin, component: xx}\n")
        text, faults = updated("a.yaml", old)
        self.assertEqual(text, old.replace("xx}", "xx, place: membrane}"))
        self.assertEqual([line for line, _ in faults], [3])
        self.assertIn("'membrane'", faults[0][1])

    def test_values_and_comments_that_are_old_words_stay(self):
        for text in ('contacts: [{name: "hardness", apexes: stick, base: "created_in_a_bounce"}]\n',
                     "probes: [{name: 'created_in_a_bounce', of: \"hardness\"}]\n", "planes: [{name: held, nodes: ['held']}]\n",
                     "time: {end: 1 s}  # contacts[0].hardness, \"hardness\", planes[0].kind=held\n"):
            with self.subTest(text):
                self.assertEqual(updated("a.yaml", text), (text, []))

    def test_an_anchor_of_the_same_name_stays(self):
        self.assertEqual(updated("a.yaml", "contact: {&stick stick: 1}\n")[0], "contact: {&stick tangential_penalty: 1}\n")

    def test_an_old_word_beside_its_new_one_is_a_fault_and_nothing_changes(self):
        text = "interface: {stick: 1}\ncontact:\n  penalty_scale: 1\n  hardness: 2\n"
        new, faults = updated("a.yaml", text)
        self.assertEqual(new, text)
        self.assertEqual(faults, [(4, "'hardness' stands beside its new name 'penalty_scale': take one of them out")])

    def test_every_document_of_a_file_is_read(self):
        self.assertEqual(updated("a.yaml", "contact: {hardness: 1}\n---\nbase: {stick: 2}\n"),
                         ("contact: {penalty_scale: 1}\n---\nbase: {tangential_penalty: 2}\n", []))

    def test_what_is_nested_too_deep_is_a_fault(self):
        text = "contact: {hardness: 1}\na: " + 3000 * "[" + 3000 * "]" + "\n"
        new, faults = updated("a.yaml", text)
        self.assertEqual(new, text.replace("hardness", "penalty_scale"))
        self.assertEqual(faults, [(2, "is nested too deep to be read; look for old words by hand")])


class TextTest(unittest.TestCase):
    def test_keys_of_settings_are_renamed_in_any_text(self):
        for old, new in (('run.again({"planes[0].stick": 0.1})', 'run.again({"planes[0].tangential_penalty": 0.1})'),
                         ('{f"contacts[{i}].created_in_a_bounce": 0.04}', '{f"contacts[{i}].energy_gain_limit": 0.04}'),
                         ("scene a.yaml --set contacts[0].hardness=4", "scene a.yaml --set contacts[0].penalty_scale=4"),
                         ("--set 'planes[1].kind=held'", "--set 'planes[1].kind=constrained'"),
                         ('{"planes[1].kind": "held"}', '{"planes[1].kind": "constrained"}'),
                         ('"planes[0].turning.value"', '"planes[0].angular_velocity.value"'),
                         ("`interface.hardness` of 20", "`interface.penalty_scale` of 20")):
            with self.subTest(old):
                self.assertEqual(updated("accept.py", old)[0], new)

    def test_what_only_looks_like_one_stays(self):
        for text in ('"springs[0].damping"', '"bodies[0].mesh.turn"', "hardness 20", "mycontact.hardness", '"planes[1].kind": "fixed"',
                     "contact.hardness_of_lead", '{"name": "hardness"}', "probes[0].of=hardness", "bodies[0].kind=held"):
            with self.subTest(text):
                self.assertEqual(updated("accept.py", text)[0], text)

    def test_fenced_yaml_in_a_page_is_a_case(self):
        text = "damping: of a text\n\n```yaml\ncontact: {damping: 0.1}\n```\n\n    contact.damping\n"
        self.assertEqual(updated("a.md", text)[0],
                         "damping: of a text\n\n```yaml\ncontact: {damping_ratio: 0.1}\n```\n\n    contact.damping_ratio\n")


class CommandTest(unittest.TestCase):
    def test_check_says_and_changes_nothing_and_without_it_the_file_is_rewritten(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as said:
            path = Path(folder) / "run.sh"
            path.write_bytes(b"one\n--set contacts[0].hardness=4 # \xe4\n")
            self.assertEqual(update_case.main(["--check", str(path)]), 1)
            self.assertIn("run.sh:2: hardness -> penalty_scale", said.getvalue())
            self.assertIn(b"hardness", path.read_bytes())
            self.assertEqual(update_case.main([str(path)]), 0)
            self.assertEqual(path.read_bytes(), b"one\n--set contacts[0].penalty_scale=4 # \xe4\n")
            self.assertEqual(update_case.main(["--check", str(path)]), 0)

    def test_meshes_that_are_frames_of_runs_are_told_in_notes(self):
        try:
            import yaml  # noqa: F401
        except ImportError:
            self.skipTest("needs python3-yaml")
        case = "bodies:\n" + "".join(f"  - {{name: {name}, mesh: {{kind: file, path: {path}}}}}\n" for name, path in (
            ("a", "new.vtu"), ("b", "old.vtu"), ("c", "plain.vtu"), ("d", "out/body/body_000003.vtu"), ("e", "missing.vtu")))
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()) as said:
            folder = Path(folder)
            (folder / "new.vtu").write_text('<DataArray type="Int32" Name="points_are_deformed" NumberOfTuples="1">', encoding="utf-8")
            (folder / "old.vtu").write_text('<DataArray type="Float32" Name="units" NumberOfComponents="1" '
                                            'ComponentName0="displacement [m]">', encoding="utf-8")
            (folder / "plain.vtu").write_text('<DataArray type="Float64" Name="points">', encoding="utf-8")
            path = folder / "case.yaml"
            path.write_text(case, encoding="utf-8")
            self.assertEqual(update_case.main(["--check", str(path)]), 0)
            self.assertEqual(path.read_text(encoding="utf-8"), case)
            self.assertEqual(update_case.main([str(folder / "nosuch.yaml")]), 2)
        notes = said.getvalue().splitlines()[:-1]
        self.assertEqual(len(notes), 3)
        for note, line, name, what in zip(notes, (2, 3, 5), ("new.vtu", "old.vtu", "out/body/body_000003.vtu"),
                                          ("the mesh is the deformed shape", "of an older version", "is not there")):
            self.assertIn(f"case.yaml:{line}: note: '{name}' ", note)
            self.assertIn(what, note)

    def test_bytes_that_are_not_utf8_stay_in_yaml_too(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            path = Path(folder) / "case.yaml"
            path.write_bytes(b"contact:\n  # caf\xe9\n  hardness: 10\n")
            self.assertEqual(update_case.main([str(path)]), 0)
            self.assertEqual(path.read_bytes(), b"contact:\n  # caf\xe9\n  penalty_scale: 10\n")

    def test_files_that_cannot_be_done_give_a_status(self):
        for text in ("a: [\n", "contact: {hardness: 1, penalty_scale: 2}\n"):
            with self.subTest(text), tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()) as said:
                path = Path(folder) / "case.yaml"
                path.write_text(text, encoding="utf-8")
                self.assertEqual(update_case.main([str(path)]), 2)
                self.assertEqual(path.read_text(encoding="utf-8"), text)
                self.assertRegex(said.getvalue(), r"case.yaml:\d+: ")


if __name__ == "__main__":
    unittest.main()
