"""For tests of scripts: a script as a module, and a folder with a made-up driver and its case."""
import importlib.machinery
import importlib.util
import stat
import sys
import tempfile
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"


def script(name):
    """A program of the folder scripts that has no ending, as a module."""
    sys.dont_write_bytecode = True  # none beside it
    if str(SCRIPTS) not in sys.path:
        sys.path.insert(0, str(SCRIPTS))
    loader = importlib.machinery.SourceFileLoader(name, str(SCRIPTS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    sys.modules[name] = module  # dataclasses look for it
    loader.exec_module(module)
    return module


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
