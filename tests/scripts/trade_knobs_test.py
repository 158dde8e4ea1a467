"""scripts/trade_knobs.py: what a knob sets in a case as a driver resolved it, and what the command line asks for."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import trade_knobs as knobs  # noqa: E402  (after the path)


def entry(value, unit="1", default=False):
    return {"value": value, "unit": unit, "default": default}


RESOLVED = {
    "time": {"safety": entry(0.9, default=True)},
    "output": {"history_every": entry(2e-7, "s")},
    "bodies": [{"mesh": {"cells": entry([4, 1, 2])}, "element": {"kind": entry("one_point"), "viscosity": {"linear": entry(0.06)}}},
               {"mesh": {"cells_along": entry(8)}, "element": {"layers": entry(5)}}],
    "planes": [{"kind": entry("symmetry"), "nodes": entry(["a"])}, {"kind": entry("rigid"), "method": entry("multiplier")}],
    "contacts": [{"method": entry("multiplier"), "passes": entry("one")}]}


def knob(name):
    return next(one for one in knobs.KNOBS if one.name == name)


class SettingsTest(unittest.TestCase):
    def test_a_key_is_set_wherever_its_section_has_it(self):
        self.assertEqual(knobs.settings(knob("element"), "full", RESOLVED), {"bodies[0].element.kind": "full"})
        self.assertEqual(knobs.settings(knob("layers"), 7, RESOLVED), {"bodies[1].element.layers": "7"})
        self.assertEqual(knobs.settings(knob("linear_viscosity"), 0, RESOLVED), {"bodies[0].element.viscosity.linear": "0"})

    def test_contacts_and_rigid_planes_are_contacts_and_others_are_not(self):
        self.assertEqual(knobs.settings(knob("method"), "penalty", RESOLVED),
                         {"planes[1].method": "penalty", "contacts[0].method": "penalty"})

    def test_what_a_value_needs_beside_it_is_set_too(self):
        self.assertEqual(knobs.settings(knob("area"), "base", RESOLVED), {"contacts[0].area": "base", "contacts[0].method": "penalty"})

    def test_the_mesh_is_multiplied_and_one_cell_stays(self):
        self.assertEqual(knobs.settings(knob("mesh"), 2, RESOLVED),
                         {"bodies[0].mesh.cells": "[8, 1, 4]", "bodies[1].mesh.cells_along": "16"})

    def test_the_level_of_a_case_is_its_mesh(self):
        self.assertEqual(knobs.settings(knob("mesh"), 2, {"mesh": {"level": entry(3)}}), {"mesh.level": "6"})
        sector = {"model": {"cells_around": entry(1)}, "mesh": {"level": entry(3)}}
        self.assertEqual(knobs.settings(knob("mesh"), 2, sector), {"model.cells_around": "1", "mesh.level": "6"})

    def test_a_mesh_from_a_file_follows_refine(self):
        files = {"bodies": [{"mesh": {"kind": entry("file")}}, *RESOLVED["bodies"]]}
        self.assertEqual(knobs.settings(knob("mesh"), 2, files), {"refine": "2"})
        for value in (0.5, 1, 1.5):
            self.assertEqual(knobs.settings(knob("mesh"), value, files), {})

    def test_a_quantity_is_multiplied_with_its_unit(self):
        self.assertEqual(knobs.settings(knob("history"), 4, RESOLVED), {"output.history_every": "8e-07 s"})

    def test_what_is_so_already_or_is_not_there_sets_nothing(self):
        for name, value in (("step", 0.9), ("element", "one_point"), ("mesh", 1), ("weights", "paper"), ("symmetry", "quarter")):
            with self.subTest(name):
                self.assertEqual(knobs.settings(knob(name), value, RESOLVED), {})

    def test_every_knob_has_a_name_of_its_own_and_a_path(self):
        self.assertEqual(len({one.name for one in knobs.KNOBS}), len(knobs.KNOBS))
        for one in knobs.KNOBS:
            self.assertTrue(one.path == knobs.MESH or all(path.count(".") == 1 for path in one.path.split()), one.name)


class ChosenTest(unittest.TestCase):
    def setUp(self):
        self.known = knobs.of_case({"mesh": (0.5, 2), "passes": None, "grading": {"to the foot": {"a.b": "1"}}})

    def values(self, *words):
        return {one.name: labels for one, labels in knobs.chosen(list(words), self.known)}

    def test_without_words_all_knobs_but_those_left_out(self):
        names = list(self.values())
        self.assertNotIn("passes", names)
        self.assertEqual(names[-1], "grading")
        self.assertEqual(len(names), len(knobs.KNOBS))

    def test_a_case_has_its_own_values(self):
        self.assertEqual(self.values("mesh"), {"mesh": {"x0.5": 0.5, "x2": 2}})

    def test_meshes_may_be_keys_of_the_case_and_keep_their_factor(self):
        (mesh, labels), *_ = knobs.of_case({"mesh": {"x2": {"bodies[0].mesh.cells": "[8, 1, 2]"}}})
        self.assertEqual(knobs.settings(mesh, labels["x2"], RESOLVED), {"bodies[0].mesh.cells": "[8, 1, 2]"})
        self.assertEqual([knobs.factor_of(mesh, "x2"), knobs.factor_of(knob("step"), "0.9")], [2, 1])

    def test_values_of_the_command_line(self):
        self.assertEqual(self.values("step=0.45,0.9", "element=full", "mesh=x2,3"),
                         {"step": {"0.45": 0.45, "0.9": 0.9}, "element": {"full": "full"}, "mesh": {"x2": 2, "x3": 3}})
        self.assertEqual(self.values("grading=to the foot"), {"grading": {"to the foot": {"a.b": "1"}}})

    def test_what_is_no_knob_and_no_value_is_told_with_what_there_is(self):
        for word, expected in (("mehs", "there are mesh"), ("step=fast", "another number"), ("step=", "another number"),
                               ("element=2", "one_point, full"), ("grading=2", "to the foot")):
            with self.subTest(word), self.assertRaisesRegex(knobs.NoKnob, expected):
                self.values(word)


if __name__ == "__main__":
    unittest.main()
