"""scripts/processes.py: what a script has started ends with it."""
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
import made_up  # noqa: E402  (after the path)
import processes  # noqa: E402
import runs  # noqa: E402

# A script that starts a program and waits for it; the program says its number.
PARENT = f"""
import sys
sys.path.insert(0, {str(SCRIPTS)!r})
import processes
processes.run([sys.executable, "-c", "import os, time; print(os.getpid(), flush=True); time.sleep(60)"])
"""

# The same for run_alone.
ALONE = """
import runs
runs.run_alone(["sleep", "60"])
"""

# A program that never ends and says its number as the name of a file.
ENDLESS = """#!{python}
import os, time
open(os.path.join({numbers!r}, str(os.getpid())), "w")
time.sleep(60)
"""

# Programs, script and its words, for each script that starts programs.
SCRIPTS_WITH_PROGRAMS = [
    ("sliding", "forecast", str(SCRIPTS.parent / "cases/sliding")),
    ("two_blocks scene", "verify.py", "--jobs", "2", "--out", "{out}", "two_blocks", "bars_of_unequal_length"),
    ("two_blocks", "verify.py", "--jobs", "1", "--out", "{out}", "two_blocks"),
    ("two_blocks", "trade", "two_blocks", "--jobs", "2", "--out", "{out}"),
    ("two_blocks", "refine", str(SCRIPTS.parent / "cases/two_blocks/bars.yaml"), "--out", "{out}"),
    ("two_blocks", "accuracy", "--only", "two_bars_time", "--out", "{out}"),
]
try:
    import numpy  # noqa: F401
    import yaml  # noqa: F401
    SCRIPTS_WITH_PROGRAMS.append(("scene", "extremes", "--axis", "speed", "--jobs", "2", "--no-figure", "--out", "{out}"))
except ImportError:
    pass


def wait_for(what):
    """What comes, if not nothing, within half a minute."""
    for _ in range(3000):
        found = what()
        if found:
            return found
        time.sleep(0.01)
    return None


def below(number):
    """The processes that a process, or one below it, has started."""
    parents = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(path.parent.name)] = int(path.read_text(encoding="utf-8").rsplit(")", 1)[1].split()[1])
        except (FileNotFoundError, ProcessLookupError):
            pass
    found, wave = [], [number]
    while wave:
        wave = [one for one, parent in parents.items() if parent in wave]
        found += wave
    return found


class ProcessesTest(unittest.TestCase):
    @unittest.skipUnless(sys.platform == "linux", "the system has no such signal")
    def test_a_program_ends_with_the_script_that_is_killed(self):
        for end in (subprocess.Popen.kill, subprocess.Popen.terminate):
            with subprocess.Popen([sys.executable, "-c", PARENT], stdout=subprocess.PIPE, text=True) as parent:
                program = int(parent.stdout.readline())
                self.assertTrue(processes.is_alive(program))
                end(parent)
                parent.wait()
                for _ in range(500):
                    if not running(program):
                        break
                    time.sleep(0.01)
                self.assertFalse(running(program))

    @unittest.skipUnless(sys.platform == "linux", "the system has no such signal")
    def test_programs_and_workers_of_each_script_end_with_it(self):
        for names, script, *words in SCRIPTS_WITH_PROGRAMS:
            with self.subTest(script), tempfile.TemporaryDirectory() as folder:
                root = Path(folder)
                for name in names.split():
                    made_up.driver(root, name, ENDLESS, numbers=str(root / "numbers"))
                (root / "numbers").mkdir()
                words = [word.format(out=root / "out") for word in words]
                with subprocess.Popen([sys.executable, script, "--drivers", root / "drivers", *words], cwd=SCRIPTS,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as started:
                    found = wait_for(lambda: started.poll() is not None or [int(path.name) for path in (root / "numbers").iterdir()])
                    if not isinstance(found, list):
                        self.fail(f"{script} ended: {started.stderr.read()}" if found else "nothing was started")
                    found += below(started.pid)
                    started.kill()
                    started.wait()
                    self.assertTrue(wait_for(lambda: not any(map(running, found))), found)

    @unittest.skipUnless(sys.platform == "linux", "the system has no such signal")
    def test_a_program_that_runs_alone_ends_with_the_script_that_is_killed(self):
        with subprocess.Popen([sys.executable, "-c", ALONE], cwd=SCRIPTS) as parent:
            found = wait_for(lambda: len(below(parent.pid)) == 2 and below(parent.pid))  # the program and what it runs by
            time.sleep(0.1)  # until both are what they will be
            parent.kill()
            parent.wait()
            self.assertTrue(wait_for(lambda: not any(map(running, found))), found)

    def test_run_alone_tells_status_and_memory(self):
        self.assertEqual(runs.run_alone(["sh", "-c", "echo said; exit 3"])[:2], (3, "said\n"))
        self.assertEqual(runs.run_alone(["sh", "-c", "kill -9 $$"])[0], -9)
        self.assertEqual(runs.run_alone(["sleep", "60"], 0.2)[0], None)
        self.assertEqual(runs.run_alone(["no_such_program"])[:2], (127, "no_such_program: No such file or directory\n"))
        status, _, memory = runs.run_alone([sys.executable, "-c", "bytearray(100_000_000)"])
        self.assertEqual(status, 0)
        self.assertTrue(100e6 < memory < 150e6, memory)

    def test_a_program_that_ends_is_not_alive(self):
        done = subprocess.Popen(["true"])
        done.wait()
        self.assertFalse(processes.is_alive(done.pid))

    def test_run_gives_what_a_program_says(self):
        done = processes.run([sys.executable, "-c", "print(7)"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, "7\n"))


def running(number):
    """Whether a process goes on; one that has ended and waits to be asked for its status does not."""
    try:
        return Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


if __name__ == "__main__":
    unittest.main()
