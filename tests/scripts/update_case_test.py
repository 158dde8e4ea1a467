"""scripts/update_case renames words where they stand, and touches nothing else."""
import contextlib
import importlib.machinery
import importlib.util
import io
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True  # none beside a program without ending
loader = importlib.machinery.SourceFileLoader("update_case", str(SCRIPTS / "update_case"))
update_case = importlib.util.module_from_spec(importlib.util.spec_from_loader("update_case", loader))
loader.exec_module(update_case)

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
        text = '# Härte\r\ncontact: {"hardn\\x65ss": 2}\r\nname: é\r\n'
        self.assertEqual(updated("a.yaml", text)[0], '# Härte\r\ncontact: {penalty_scale: 2}\r\nname: é\r\n')

    def test_anchors_are_changed_where_they_are_defined(self):
        text = "one: &c {hardness: 2}\ncontacts:\n  - *c\n  - {<<: *c, name: b}\n"
        self.assertEqual(updated("a.yaml", text)[0], text.replace("hardness", "penalty_scale"))
        self.assertEqual(updated("a.yaml", "a: &a [*a]\ncontact: {hardness: 2}\n")[0], "a: &a [*a]\ncontact: {penalty_scale: 2}\n")

    def test_a_mistake_in_one_block_does_not_hide_the_others(self):
        text = "interface: {hardness: 10}\nmesh: {level: [1\ntime: {end: 1 s}\n"
        new, faults = updated("a.yaml", text)
        self.assertEqual(new, text.replace("hardness", "penalty_scale"))
        self.assertEqual([line for line, _ in faults], [3])


class TextTest(unittest.TestCase):
    def test_keys_of_settings_are_renamed_in_any_text(self):
        for old, new in (('run.again({"planes[0].stick": 0.1})', 'run.again({"planes[0].tangential_penalty": 0.1})'),
                         ('{f"contacts[{i}].created_in_a_bounce": 0.04}', '{f"contacts[{i}].energy_gain_limit": 0.04}'),
                         ("scene a.yaml --set contacts[0].hardness=4", "scene a.yaml --set contacts[0].penalty_scale=4"),
                         ("--set 'planes[1].kind=held'", "--set 'planes[1].kind=constrained'"),
                         ('{"planes[1].kind": "held"}', '{"planes[1].kind": "constrained"}'),
                         ('"planes[0].turning.value"', '"planes[0].angular_velocity.value"'),
                         ('(("penalty", p), ("created_in_a_bounce", b))', '(("penalty", p), ("energy_gain_limit", b))'),
                         ("`interface.hardness` of 20", "`interface.penalty_scale` of 20")):
            with self.subTest(old):
                self.assertEqual(updated("accept.py", old)[0], new)

    def test_what_only_looks_like_one_stays(self):
        for text in ('"springs[0].damping"', '"bodies[0].mesh.turn"', "hardness 20", "mycontact.hardness", '"planes[1].kind": "fixed"',
                     "contact.hardness_of_lead"):
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


if __name__ == "__main__":
    unittest.main()
