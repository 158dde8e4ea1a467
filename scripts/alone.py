"""Runs a program for so many seconds at most; prints its status, or None if it was ended, and the most memory that was resident [bytes].

    python3 -S alone.py SECONDS PROGRAM WORD...

A program starts with what its parent has resident, and its largest counts that; so this small process starts it. What the program prints
goes to stderr. It ends with this process, and this process with its parent, however that ends (processes.py).
"""
import contextlib
import os
import signal
import subprocess
import sys

import processes

CANNOT_START = 127  # as of a shell


def main():
    seconds, words, here = float(sys.argv[1]), sys.argv[2:], os.getpid()
    ended = []
    try:
        program = subprocess.Popen(words, stdout=sys.stderr, preexec_fn=lambda: processes.ends_with_parent(here))
    except OSError as error:
        print(f"{words[0]}: {error.strerror}", file=sys.stderr)
        print(CANNOT_START, 0)
        return

    def end(*_):
        ended.append(True)
        with contextlib.suppress(ProcessLookupError):  # it has just ended by itself
            os.kill(program.pid, signal.SIGKILL)
    signal.signal(signal.SIGALRM, end)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    _, status, used = os.wait4(program.pid, 0)
    signal.setitimer(signal.ITIMER_REAL, 0)
    print(None if ended else os.waitstatus_to_exitcode(status), 1024 * used.ru_maxrss)


if __name__ == "__main__":
    main()
