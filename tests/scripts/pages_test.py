"""scripts/pages: what it takes for a command, what it finds without a run, and that a command that fails is a fault at its line."""
import contextlib
import io
import runpy
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import page_commands  # noqa: E402  (after the path)

PAGES = runpy.run_path(str(ROOT / "scripts/pages"))

PAGE = """# A page

    build/release/drivers/scene cases/bar.yaml --out out/bar    # a comment with 'quotes'
    scripts/look out/bar --deep "a # b"        # ends with status 3
    scripts/look \\
        --deep 1

Text with `scripts/look --deep`, `scripts/gone`, `lib/mesh` and `scripts/look RUN... --wide`.

    lib/base        arrays, numbers
    scripts/        the commands

```yaml
scripts: no command
```

```sh
cd out && ls
```

![drawn](figures/bar.svg) ![not drawn](figures/other.svg)
"""
TREE = {
    "README.md": PAGE.replace("figures/", "docs/figures/"), "cases/bar.yaml": "",
    "drivers/driver.cpp": 'if (word == "--keys") app.add_option("--out,-o", out); app.add_flag("--resume", yes)',
    "scripts/look": "#!/usr/bin/python3\nimport deeper\n",
    "scripts/deeper.py": "parser.add_argument('-d', '--deep')\nrun(['two', '--wide'])  # --wide\nwrite('bar.svg')\n",
    "scripts/shell": "#!/bin/bash\ncase $1 in\n  --short|--long) ;;\nesac\nif [ \"$2\" = --last ]; then\n  tool --other\nfi\n",
    "docs/figures/bar.svg": "", "docs/figures/other.svg": "", "docs/figures/spare.png": "",
}


def commands(text):
    return [(one.line, one.text, one.status) for one in PAGES["commands_of"]("docs/page.md", text)]


class PagesTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)
        for path, text in TREE.items():
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            (self.root / path).write_text(text, encoding="utf-8")

    def faults(self, line, text):
        return PAGES["faults_of"](self.root, PAGES["Command"]("docs/page.md", line, text, 0))

    def test_commands_of_a_page(self):
        self.assertEqual(commands(PAGE), [
            (3, "build/release/drivers/scene cases/bar.yaml --out out/bar", 0), (4, 'scripts/look out/bar --deep "a # b"', 3),
            (5, "scripts/look --deep 1", 0), (18, "cd out && ls", 0)])

    def test_lines_that_go_on_are_one_command(self):
        self.assertEqual(commands("\n    DRIVER CASE.yaml --out DIR\n           [--resume]\n"),
                         [(2, "DRIVER CASE.yaml --out DIR [--resume]", 0)])

    def test_a_block_without_a_program_is_no_command(self):
        self.assertEqual(commands("\n    lib/base  arrays\n    scripts/  the commands\n\n    time [ms], pressure [MPa]\n"), [])

    def test_code_in_a_line_of_text(self):
        self.assertEqual([one.text for one in PAGES["spoken_of"]("docs/page.md", PAGE)],
                         ["scripts/look --deep", "scripts/gone", "scripts/look RUN... --wide"])

    def test_what_is_not_there(self):
        self.assertEqual(self.faults(1, "scripts/look out/bar --deep 1 && build/release/drivers/scene cases/bar.yaml --resume"), [])
        self.assertEqual(self.faults(1, "scripts/shell --long --short --last && build/release/drivers/scene --keys"), [])
        for text, says in (("scripts/gone", "docs/page.md:7: 'scripts/gone' does not exist"),
                           ("build/release/drivers/scene cases/gone.yaml", "'cases/gone.yaml' does not exist"),
                           ("build/release/drivers/gone cases/bar.yaml", "is no program"),
                           ("scripts/look out/bar --wide", "'scripts/look' has no option '--wide'"),
                           ("scripts/look out/bar --dee", "'scripts/look' has no option '--dee'"),
                           ("scripts/shell --sho", "has no option '--sho'"), ("scripts/shell --other", "has no option '--other'"),
                           ("build/release/drivers/scene CASE.yaml --resum", "has no option '--resum'"),
                           ("build/release/drivers/scene CASE.yaml --wide=1", "has no option '--wide'")):
            with self.subTest(text=text):
                (fault,) = self.faults(7, text)
                self.assertIn(says, fault)

    def test_pictures_have_a_script_and_a_page(self):
        pages = {"docs/page.md": PAGE}
        rules = {"docs/figures/bar.svg": ("scripts/deeper.py", "{name}"), "docs/figures/gone.svg": ("scripts/look", "gone")}
        with mock.patch.object(page_commands, "PICTURES", rules):
            found = PAGES["picture_faults"](self.root, pages)
        self.assertEqual(len(found), 3, found)
        for fault, says in zip(found, ("no script is known that writes docs/figures/other.svg", "spare.png:1: no page shows it",
                                       "no page shows a picture 'docs/figures/gone.svg'")):
            self.assertIn(says, fault)
        (self.root / "docs/figures/bar.svg").unlink()
        with mock.patch.object(page_commands, "PICTURES", {"docs/figures/*": ("scripts/look", "{name}")}):
            found = PAGES["picture_faults"](self.root, pages)
        self.assertIn("docs/page.md:21: docs/figures/bar.svg does not exist", found)
        self.assertIn("docs/page.md:21: scripts/look does not write docs/figures/other.svg: it has no 'other.svg'", found)

    def test_a_command_that_fails_is_a_fault_at_its_line(self):
        command, instead = PAGES["Command"], page_commands.Instead
        found = [command("docs/page.md", 1, "echo one > made && test -e build/release/drivers", 0),
                 command("docs/page.md", 2, "test -f made && exit 3", 3), command("docs/page.md", 3, "echo bad >&2; exit 4", 0),
                 command("docs/page.md", 4, "never", 0), command("docs/page.md", 5, "nowhere", 0), command("docs/page.md", 6, "sleep 9", 0),
                 command("docs/page.md", 7, "either", 0), command("docs/page.md", 8, "wrong", 0)]
        plans = {"never": instead("", "takes hours"), "nowhere": instead("exit 1", "a program", needs="no-such-program"),
                 "either": instead("echo bad: DIFFERS; exit 2", "may differ", (0, 2), says="DIFFERS$"),
                 "wrong": instead("echo DIFFERS >&2; exit 2", "may differ", (0, 2), says="DIFFERS$")}
        with mock.patch.object(page_commands, "COMMANDS", plans), contextlib.redirect_stdout(io.StringIO()) as said:
            faults = PAGES["run_page"](found, self.root, self.root / "drivers", 0.5)
        self.assertEqual([fault.split(": ")[0] for fault in faults], ["docs/page.md:3", "docs/page.md:6", "docs/page.md:8"])
        self.assertIn("expected is 0 or 2, with 'DIFFERS$' in its output", faults[2])
        self.assertIn("ends with status 4, expected is 0: bad", faults[0])
        self.assertIn("longer than 0.5 s", faults[1])
        self.assertIn("never (takes hours)", said.getvalue())
        self.assertIn("nowhere (no-such-program is not installed)", said.getvalue())
        self.assertFalse((self.root / "made").exists())

    def test_what_may_fail_has_words_by_which_it_is_known(self):
        command, instead = PAGES["Command"]("docs/page.md", 1, "either", 0), page_commands.Instead
        for plan, count in ((instead("exit 2", "", (0, 2)), 1), (instead("exit 2", "", (0, 2), says="x"), 0), (instead("", ""), 0)):
            with mock.patch.object(page_commands, "COMMANDS", {"either": plan}):
                self.assertEqual(len(PAGES["table_faults"]([command])), count)

    def test_without_a_page_of_ci_nothing_runs(self):
        with mock.patch.object(page_commands, "CI", ("gone.md",)), contextlib.redirect_stderr(io.StringIO()) as said:
            with self.assertRaises(SystemExit) as end:
                PAGES["main"](["--ci", "--list"])
        self.assertEqual(end.exception.code, 2)
        self.assertIn("none of its pages is there: gone.md", said.getvalue())

    def test_the_pages_of_this_tree_have_no_fault_that_shows_without_a_run(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            status = PAGES["main"](["--list"])
        self.assertEqual(status, 0, said.getvalue()[-2000:])


if __name__ == "__main__":
    unittest.main()
