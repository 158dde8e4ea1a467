"""What docs/adding.md quotes of a verification case is what stands there."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "verification" / "suddenly_pulled_bar"
GENERATED = "<!-- written by"


class AddingTest(unittest.TestCase):
    def test_files_of_the_example_are_quoted_as_they_are(self):
        page = (ROOT / "docs" / "adding.md").read_text(encoding="utf-8")
        quoted = re.findall(r"^```\w+\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        for name in ("case.yaml", "reference.py", "accept.py", "README.md"):
            with self.subTest(name):
                text = (CASE / name).read_text(encoding="utf-8").split(GENERATED)[0].rstrip() + "\n"
                self.assertTrue(text in quoted, f"docs/adding.md quotes another {name}")


if __name__ == "__main__":
    unittest.main()
