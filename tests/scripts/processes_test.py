"""scripts/processes.py: what a script has started ends with it."""
import subprocess
import sys
import time
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
import processes  # noqa: E402  (after the path)

# A script that starts a program and waits for it; the program says its number.
PARENT = f"""
import sys
sys.path.insert(0, {str(SCRIPTS)!r})
import processes
processes.run([sys.executable, "-c", "import os, time; print(os.getpid(), flush=True); time.sleep(60)"])
"""


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
