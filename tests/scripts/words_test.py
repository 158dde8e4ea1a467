"""scripts/words.py: the table of renamed words is sound, so that a reader of cases can be tested against it."""
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import words  # noqa: E402  (after the path)


class WordsTest(unittest.TestCase):
    def test_no_new_word_is_an_old_one_in_the_same_place(self):
        old = {(section, one.key, one.old) for one in words.RENAMED for section in one.where}
        for one in words.RENAMED:
            for section in one.where:
                self.assertNotIn((section, one.key, one.new), old)

    def test_an_old_word_has_one_new_name_in_each_place(self):
        places = [(section, one.key, one.old) for one in words.RENAMED for section in one.where]
        self.assertEqual(len(places), len(set(places)))

    def test_what_gives_a_word_away_gives_away_the_old_one_only(self):
        for one in words.RENAMED:
            if one.refuse:
                self.assertTrue(re.search(one.refuse, one.old))
                self.assertFalse(re.search(one.refuse, one.new))

    def test_every_word_has_a_line_of_the_table(self):
        self.assertEqual(len(words.table()), len(words.RENAMED) + 2)
        self.assertEqual({line.count("|") for line in words.table()}, {5})


    def test_the_reader_of_cases_has_the_same_table(self):
        source = (Path(__file__).resolve().parents[2] / "lib/input/retired.cpp").read_text(encoding="utf-8")
        rows = re.findall(r'{"(\w+)", "(\w+)", "(\w*)", "([^"]*)"}', source)
        self.assertEqual(rows, [(one.old, one.new, one.key, " ".join(one.where)) for one in words.RENAMED])


if __name__ == "__main__":
    unittest.main()
