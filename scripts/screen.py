"""A screen for pictures: each picture is drawn by a process of its own, so that a fault of a display costs a try and not the script.

The display is that of the user, or without one an Xvfb that starts with the first picture and ends with the script. If the process ends
without a picture, by a signal or because its display is gone, it is started again on another Xvfb, TRIES times in all.
"""
import atexit
import os
import pickle
import resource
import select
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import traceback

import processes

TRIES = 3
LONGEST_START = 60.0     # [s] until a display can be used
LONGEST_PICTURE = 600.0  # [s] of one try
SCREEN = ("-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset")  # -noreset: it stays as it is when a picture is done
COOKIE = b"MIT-MAGIC-COOKIE-1"
EVERY_DISPLAY = 0xFFFF   # of an X authority: an entry that is not for one display alone


class NotDrawn(Exception):
    """There is no picture; says why."""


def missing():
    """Why there can be no screen; empty if there can be one."""
    return "" if os.environ.get("DISPLAY") or shutil.which("Xvfb") else "there is no screen and no Xvfb (Debian's xvfb)"


def use_one_thread():
    """To be called before VTK computes: a process with its threads cannot be copied."""
    import vtk
    vtk.vtkSMPTools.SetBackend("Sequential")


def drawn(work):
    """What `work()` returns or raises in a process of its own with a display; NotDrawn if that process ends without either at each try."""
    faults = []
    while len(faults) < TRIES:
        try:
            answer = answer_of(work, SCREENS.place())
        except NotDrawn as error:
            faults.append(str(error))
            SCREENS.change()
            continue
        if isinstance(answer, BaseException):
            raise answer
        return answer[0]
    raise NotDrawn(f"{TRIES} tries failed: {'; '.join(dict.fromkeys(faults))}")


# ------------------------------------------------------------------------------------------------
# The process that draws

def answer_of(work, place):
    """(value,) of a call with these variables of the environment, or its exception; NotDrawn if the process ends without either."""
    read, write = os.pipe()
    parent = os.getpid()
    child = os.fork()
    if child == 0:
        try:
            processes.ends_with_parent(parent)
            resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
            os.environ.update(place)
            answer = pickle.dumps(outcome(work))
            with os.fdopen(write, "wb") as stream:
                stream.write(answer)
        finally:
            os._exit(0)
    os.close(write)
    said, in_time = all_of(read, LONGEST_PICTURE)
    os.close(read)
    if not in_time:
        os.kill(child, signal.SIGKILL)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    try:
        return pickle.loads(said)
    except (EOFError, pickle.UnpicklingError) as error:
        ended = f"by signal {-status} ({signal.strsignal(-status)})" if status < 0 else f"with status {status}"
        raise NotDrawn(f"the process that draws ended {ended}" if in_time else f"no picture within {LONGEST_PICTURE:g} s") from error


def outcome(work):
    try:
        return (work(),)
    except BaseException as error:  # as SystemExit: the script ends as it would have without this process
        error.add_note(traceback.format_exc())
        return error


def all_of(read, longest):
    """(bytes until the end of a pipe, whether it ended in time [s])."""
    found, until = b"", time.monotonic() + longest
    while select.select([read], [], [], max(0.0, until - time.monotonic()))[0]:
        more = os.read(read, 1 << 16)
        if not more:
            return found, True
        found += more
    return found, False


# ------------------------------------------------------------------------------------------------
# Displays

class Screens:
    """The display that pictures are drawn on: that of the user until it fails, then one Xvfb after another."""

    def __init__(self):
        self.given, self.server, self.authority, self.number, self.failed = True, None, None, "", []

    def place(self):
        """The variables of the environment that name the display; NotDrawn if there is none."""
        if self.given and os.environ.get("DISPLAY"):
            return {}
        if self.server is None:
            self.start()
        return {"DISPLAY": f":{self.number}", "XAUTHORITY": self.authority.name}

    def start(self):
        if len(self.failed) >= TRIES:  # no other picture waits for it
            raise NotDrawn(self.failed[-1])
        if not shutil.which("Xvfb"):
            raise NotDrawn("there is no Xvfb (Debian's xvfb)")
        self.authority = tempfile.NamedTemporaryFile(prefix="authority_")
        self.authority.write(entry_of_authority(os.urandom(16)))
        self.authority.flush()
        read, write = os.pipe()
        words = [shutil.which("Xvfb"), "-displayfd", str(write), *SCREEN, "-auth", self.authority.name]
        self.server = processes.start(words, pass_fds=(write,), stdout=processes.NOTHING, stderr=processes.NOTHING)
        os.close(write)
        said, _ = all_of(read, LONGEST_START)  # it closes the pipe behind the number
        os.close(read)
        self.number = said.decode(errors="replace").strip()
        if not self.number.isdigit():
            self.change()
            self.failed.append("Xvfb did not start")
            raise NotDrawn(self.failed[-1])
        self.failed = []

    def change(self):
        """Leaves the display; the next picture has another one."""
        if self.server is None:
            self.given = self.given and not shutil.which("Xvfb")
            return
        self.server.terminate()
        try:
            self.server.wait(10)
        except subprocess.TimeoutExpired:
            self.server.kill()
            self.server.wait()
        self.server = None
        self.authority.close()


def entry_of_authority(cookie):
    """The bytes of a file of X with one entry: who shows this cookie may use the display."""
    def counted(text):
        return struct.pack(">H", len(text)) + text

    return struct.pack(">H", EVERY_DISPLAY) + counted(b"") + counted(b"") + counted(COOKIE) + counted(cookie)


SCREENS = Screens()
atexit.register(SCREENS.change)
