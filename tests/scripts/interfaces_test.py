"""Tests of scripts/interfaces: the examples in its texts, and that each scene can be made by each rule."""
import doctest
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
interfaces = made_up.script("interfaces")
import interface_scenes  # noqa: E402  (after the path)


class Texts(unittest.TestCase):
    def test_examples(self):
        for module in (interfaces, interface_scenes):
            failed, tried = doctest.testmod(module)
            self.assertEqual(failed, 0, module.__name__)
            self.assertGreater(tried, 0, module.__name__)


class Scenes(unittest.TestCase):
    def test_each_rule_has_its_contact(self):
        for name, scene in interfaces.SCENES.items():
            for rule, (who, keys) in interface_scenes.RULES.items():
                case, measure = scene.make(rule, *next(iter(scene.meshes.values())))
                self.assertTrue(callable(measure))
                for contact in case["contacts"]:
                    self.assertEqual(contact.get("kind") == "automatic", who == "automatic", name)
                    self.assertEqual({key: contact[key] for key in keys}, keys, name)

    def test_the_finer_side_has_the_apexes(self):
        for upper, lower, apexes in ((6, 4, "upper.z_low"), (4, 6, "lower.z_high")):
            case, _ = interface_scenes.patch("points, finer side", upper, lower)
            self.assertEqual(case["contacts"][0]["apexes"], apexes)


if __name__ == "__main__":
    unittest.main()
