"""Arguments of scripts: a bad one gets one sentence on stderr and exit status 2."""
import argparse
import math
import sys
from pathlib import Path


class Parser(argparse.ArgumentParser):
    """A parser that says what is wrong in one sentence, without the usage before it."""

    def error(self, message):
        print(f"{self.prog}: {message}", file=sys.stderr)
        sys.exit(2)


def count(text):
    """A whole number of one or more."""
    try:
        number = int(text)
    except ValueError:
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no count: expected is 1 or more")
    return number


def positive(text):
    """A finite number above zero."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is no positive number")
    return number


def folder_to_write(text):
    """A folder that is there or can be made: no part of its path is a file."""
    path = Path(text)
    for part in (path, *path.parents):
        if part.exists() and not part.is_dir():
            raise argparse.ArgumentTypeError(f"{part} is a file: expected is a folder")
    return path


def folder_of_programs(text):
    """A folder that is there."""
    if not Path(text).is_dir():
        raise argparse.ArgumentTypeError(f"{text} is no folder: expected is the folder of the programs")
    return Path(text)
