"""Arguments of scripts: a bad one gets one sentence on stderr and exit status 2, and nothing else."""
import argparse
import difflib
import math
import os
import sys
import tempfile
from pathlib import Path

LONGEST = 1e6        # [s] that a script waits for a program
MOST_THREADS = 1024  # that a program takes


class Parser(argparse.ArgumentParser):
    """A parser that says what is wrong in one sentence, without the usage before it."""

    def error(self, message):
        refuse(message, self.prog)


def refuse(said, name=None):
    """Ends the script because an argument is wrong."""
    print(f"{name or Path(sys.argv[0]).name}: {' '.join(str(said).split())}", file=sys.stderr)
    sys.exit(2)


def near(name, known):
    return difflib.get_close_matches(name, sorted(known))


def unknown(what, name, known):
    """The sentence that there is no such name, with those that are near, or all."""
    found = near(name, known)
    there = f"did you mean {' or '.join(found)}?" if found else f"there are: {', '.join(sorted(known)) or 'none'}"
    return f"no {what} is called '{name}'; {there}"


# ------------------------------------------------------------------------------------------------
# Numbers

def number(text):
    """NaN where a text is no number."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def whole(text):
    """None where a text is no whole number."""
    try:
        return int(text)
    except ValueError:
        return None


def count(text):
    """A whole number of one or more."""
    found = whole(text)
    if found is None or found < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no count: expected is 1 or more")
    return found


def counts(text):
    """[1, 2, ...] of "1,2,..."; each once, in rising order."""
    return sorted({count(part) for part in text.split(",")})


def threads(text):
    found = count(text)
    if found > MOST_THREADS:
        raise argparse.ArgumentTypeError(f"'{text}' is too many threads: expected are {MOST_THREADS} at most")
    return found


def seed(text):
    """A whole number of zero or more."""
    found = whole(text)
    if found is None or found < 0:
        raise argparse.ArgumentTypeError(f"'{text}' is no seed: expected is a whole number of 0 or more")
    return found


def finite(text):
    found = number(text)
    if not math.isfinite(found):
        raise argparse.ArgumentTypeError(f"'{text}' is no finite number")
    return found


def positive(text):
    """A finite number above zero."""
    found = number(text)
    if not 0 < found < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is no positive number")
    return found


def positives(text):
    """[1.0, 1.5, ...] of "1,1.5,..."."""
    return [positive(part) for part in text.split(",")]


def seconds(text):
    """A positive time that a script can wait."""
    found = positive(text)
    if found > LONGEST:
        raise argparse.ArgumentTypeError(f"'{text}' is too long: expected are {LONGEST:g} s at most")
    return found


def setting(text):
    """(key, value) of KEY=VALUE."""
    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise argparse.ArgumentTypeError(f"'{text}' is no KEY=VALUE")
    return key, value


# ------------------------------------------------------------------------------------------------
# Files and folders

def is_file(path):
    try:
        return Path(path).is_file()
    except (OSError, ValueError):  # no name of a file
        return False


def is_folder(path):
    try:
        return Path(path).is_dir()
    except (OSError, ValueError):
        return False


def file_to_read(text):
    if not is_file(text):
        raise argparse.ArgumentTypeError(f"{text} is no file")
    return Path(text)


def folder_to_read(text):
    if not is_folder(text):
        raise argparse.ArgumentTypeError(f"{text} is no folder")
    return Path(text)


def folder_to_write(text):
    """A folder that is there or can be made: no part of its path is a file."""
    path = Path(text)
    for part in (path, *path.parents):
        try:
            if part.exists() and not part.is_dir():
                raise argparse.ArgumentTypeError(f"{part} is a file: expected is a folder")
        except (OSError, ValueError) as error:
            raise argparse.ArgumentTypeError(f"{text} is no name of a folder") from error
    return path


def file_to_write(text):
    """A file that can be written: it is no folder, and its folder is there or can be made."""
    if not text or is_folder(text):
        raise argparse.ArgumentTypeError(f"'{text}' is a folder: expected is a file")
    folder_to_write(Path(text).parent)
    return Path(text)


def folder_of_programs(text):
    """A folder that is there."""
    if not is_folder(text):
        raise argparse.ArgumentTypeError(f"{text} is no folder: expected is the folder of the programs")
    return Path(text)


def need_programs(folder, names):
    """Refuses a folder in which one of these programs is missing."""
    for path in sorted({Path(folder) / name for name in names}):
        if not is_file(path) or not os.access(path, os.X_OK):
            refuse(f"{path} is not built")


def need_writable(folder):
    """Makes a folder, and refuses one in which no file can be made."""
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        refuse(f"{folder} cannot be written: {error.strerror}")
