"""scripts/case_values.py: which texts of a case say the same."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import case_values  # noqa: E402  (after the path)

if case_values.yaml is None:
    sys.exit(77)

CASE = "bodies:\n  - {name: a, young: 1 Pa}\n  - {name: b, young: 2 Pa}\ntime: {end: 1 ms}\n"


def digest(text):
    return case_values.read(text.encode())[0]


class CaseValuesTest(unittest.TestCase):
    def test_comments_layout_and_order_of_keys_do_not_count(self):
        for same in ("# a\n" + CASE, CASE.replace("\n", "  # b\n"), CASE + "\n\n",
                     "time: {end: 1 ms}\n" + CASE.replace("time: {end: 1 ms}\n", ""),
                     CASE.replace("{name: a, young: 1 Pa}", "{young: 1 Pa, name: a}"), CASE.replace("time: {end", "time:\n  {  end"),
                     CASE.replace("{name: a, young: 1 Pa}", "young: 1 Pa\n    name: a"), CASE.replace("time", '"time"')):
            with self.subTest(same):
                self.assertEqual(digest(same), digest(CASE))

    def test_values_count_as_they_are_written(self):
        others = [CASE.replace("1 ms", other) for other in ("2 ms", "1.0 ms", "1e-3 s", "'1 ms'", "1  ms", "", "[1 ms]", "{is: 1 ms}")]
        others += [CASE.replace("name: a", "name: 'a'"), CASE.replace("young: 1 Pa", "Young: 1 Pa"), CASE + "more: 1\n",
                   CASE.replace("  - {name: a, young: 1 Pa}\n", ""),
                   "bodies:\n  - {name: b, young: 2 Pa}\n  - {name: a, young: 1 Pa}\ntime: {end: 1 ms}\n"]
        self.assertEqual(len({digest(text) for text in [CASE, *others]}), 1 + len(others))

    def test_words_over_several_lines_count_as_they_are_written(self):
        texts = ("a: b\n  c\n", "a: b\n   c\n", "a: b c\n", 'a: "b\n  c"\n', "a: |\n  b c\n", "a: |\n  b c\n\n", "a: >\n  b c\n")
        self.assertEqual(len({digest(text) for text in texts}), len(texts))
        self.assertEqual(digest("a: b\n  c\n"), digest("a: b\n  c  # why\n"))

    def test_lists_are_no_maps_and_words_no_lists(self):
        self.assertEqual(len({digest(text) for text in ("a: [b, c]\n", "a: [[b, c]]\n", "a: {b: c}\n", "a: 'b, c'\n", "a: [b c]\n")}), 5)

    def test_an_alias_is_what_it_repeats(self):
        self.assertEqual(digest("a: &one {b: 1}\nc: *one\n"), digest("a: {b: 1}\nc: {b: 1}\n"))
        self.assertEqual(digest("a: &one 1\nb: &one 2\nc: *one\n"), digest("a: 1\nb: 2\nc: 2\n"))

    def test_aliases_of_aliases_take_no_time(self):
        text = "a0: &a0 [x, x]\n" + "".join(f"a{n}: &a{n} [*a{n - 1}, *a{n - 1}]\n" for n in range(1, 100))
        self.assertTrue(digest(text).startswith("values "))

    def test_what_programs_refuse_or_may_take_otherwise_counts_byte_by_byte(self):
        for text in ("a: 1\na: 1\n", "a: !!float 1\n", "a: {<<: {b: 1}}\n", "a: &a [*a]\n", "a: *b\n", "a: [1\n", "a:\t1\n", "a: 1\r\n",
                     "%YAML 1.1\n---\na: 1\n", "a: 1\n---\nb: 1\n", "? [a]\n: 1\n",
                     "a: b\u2028c\n", "a: \x00\n", "", "# only\n", "[" * 5000):
            with self.subTest(text):
                self.assertTrue(digest(text).startswith("bytes "), digest(text))
        self.assertTrue(case_values.read(b"a: \xff\n")[0].startswith("bytes "))

    def test_texts_are_all_values(self):
        self.assertEqual(case_values.read(b"a: x\nb: [y, {c: 'z'}]\n")[1], {"x", "y", "z"})

    def test_every_case_of_the_tree_is_read(self):
        root = Path(__file__).resolve().parents[2]
        cases = [*root.glob("cases/*/*.yaml"), *root.glob("verification/*/*.yaml")]
        self.assertGreater(len(cases), 50)
        self.assertEqual([path.name for path in cases if not case_values.read(path.read_bytes())[0].startswith("values ")], [])


if __name__ == "__main__":
    unittest.main()
