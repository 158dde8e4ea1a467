"""Programs and workers that end with the script that started them, however that ends."""
import ctypes
import os
import shutil
import signal
import subprocess
import sys

NOTHING = subprocess.DEVNULL
PR_SET_PDEATHSIG = 1  # of Linux, see prctl(2)
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # of glibc, see mallopt(3)
LIBC = ctypes.CDLL(None, use_errno=True) if sys.platform == "linux" else None
SETPRIV = shutil.which("setpriv") if sys.platform == "linux" else None  # of util-linux


def ends_with_parent(parent):
    """To be called in a new process: kills it when its parent, the process of this number, ends. Does nothing but on Linux."""
    if LIBC is None:
        return
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:  # it ended before the call
        os._exit(1)


def run(words, **options):
    """As subprocess.run; the program does not outlive this process, unless this one is killed in the milliseconds in which it starts.

    To ask for that signal in between fork and exec, fork copies the tables of all memory of this process, which takes longer than the start
    of a program; setpriv asks for it where there is one. A program whose path begins in the folder `cwd` is started the other way.
    """
    if SETPRIV and os.path.isabs(shutil.which(words[0]) or ""):
        return subprocess.run([SETPRIV, "--pdeathsig", "KILL", "--", *words], **options)
    parent = os.getpid()
    return subprocess.run(words, preexec_fn=lambda: ends_with_parent(parent), **options)


def start(words, **options):
    """As subprocess.Popen, of a program whose path is whole; it does not outlive this process either."""
    if SETPRIV:
        return subprocess.Popen([SETPRIV, "--pdeathsig", "KILL", "--", *words], **options)
    parent = os.getpid()
    return subprocess.Popen(words, preexec_fn=lambda: ends_with_parent(parent), **options)


def keep_freed_memory():
    """Memory that is freed stays with this process: arrays that come and go cost half of a judge's time otherwise. Does nothing but with
    glibc."""
    if LIBC is not None and hasattr(LIBC, "mallopt"):
        LIBC.mallopt(M_MMAP_THRESHOLD, 32 << 20)
        LIBC.mallopt(M_TRIM_THRESHOLD, 2**31 - 1)


def is_alive(number):
    """Whether there is a process of this number."""
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return True
