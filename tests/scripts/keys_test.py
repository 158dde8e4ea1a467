"""scripts/keys: a program that does not say its keys is told, and ranges of keys are taken apart in one place."""
import contextlib
import doctest
import io
import sys
import unittest

from made_up import SCRIPTS, driver, folder, script

sys.path.insert(0, str(SCRIPTS))
import keys_schema  # noqa: E402  (after the path)
from runs import PROGRAMS  # noqa: E402


class Keys(unittest.TestCase):
    def test_programs_that_do_not_say_their_keys_are_told(self):
        root, keys = folder(self, ""), script("keys")
        for name in PROGRAMS:
            driver(root, name, "#!{python}\nprint('{{}}')\n")
        self.assertEqual(keys.described(root / "drivers"), {name: {} for name in PROGRAMS})
        driver(root, "modes", "#!{python}\nimport sys\nsys.exit('modes: a case is expected')\n")
        driver(root, "sliding", "#!{python}\nprint('no JSON')\n")
        driver(root, "scene", "#!/nosuch\n")
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit) as end:
            keys.described(root / "drivers")
        self.assertEqual(end.exception.code, 2)
        for words in ("modes --keys does not say the keys of the program: modes: a case is expected", "sliding --keys does not say",
                      "scene --keys does not say"):
            self.assertIn(words, said.getvalue())

    def test_examples_of_the_modules(self):
        done = doctest.testmod(keys_schema)
        self.assertEqual((done.failed, done.attempted > 0), (0, True))


if __name__ == "__main__":
    unittest.main()
