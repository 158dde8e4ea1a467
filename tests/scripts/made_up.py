"""A folder with a made-up driver and its case, for tests of scripts that run drivers."""
import stat
import sys
import tempfile
from pathlib import Path


def folder(test, case):
    """A folder of the test's own, with the case and a file `count` in which made-up drivers count their runs."""
    holder = tempfile.TemporaryDirectory()
    test.addCleanup(holder.cleanup)
    root = Path(holder.name)
    (root / "case.yaml").write_text(case)
    (root / "count").write_text("0")
    return root


def driver(root, name, text, **words):
    """Writes `text`, a program with {python}, {count} and other words in it, as a driver of the folder."""
    program = root / "drivers" / name
    program.parent.mkdir(exist_ok=True)
    program.write_text(text.format(python=sys.executable, count=str(root / "count"), **words))
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
