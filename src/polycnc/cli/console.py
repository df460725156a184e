"""Writing to the terminal: results to standard output, all else to standard error, colours for people."""

from __future__ import annotations

import os
import sys

from polycnc.cli.progress import away, encodable
from polycnc.deferred.contexts import nullcontext, suppress

_COLOURS = {"red": 31, "green": 32, "yellow": 33, "bold": 1}


def say(line: str = "") -> None:
    """A line of the result."""
    with away():
        sys.stdout.write(encodable(line, sys.stdout.encoding) + "\n")


def show(content: str) -> None:
    """A text of several lines, each with its line end, as part of the result."""
    with away():
        sys.stdout.write(encodable(content, sys.stdout.encoding))


def note(line: str) -> None:
    """A line beside the result; nobody is told where standard error takes nothing: a terminal has been closed."""
    with away(), suppress(OSError):
        sys.stderr.write(encodable(line, sys.stderr.encoding) + "\n")


def standard_input() -> bytes:
    """What comes in: nobody is told how long that takes while it is typed."""
    with away() if sys.stdin.buffer.isatty() else nullcontext():
        return sys.stdin.buffer.read()


def fail(line: str, status: int) -> int:
    """Say on standard error why nothing came of it; gives the status back."""
    sys.stdout.flush()
    note(f"polycnc: {line}")
    return status


def coloured(words: str, colour: str) -> str:
    """The words in a colour, where standard output is a terminal and the user has not said NO_COLOR."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" or not sys.stdout.isatty():
        return words
    return f"\x1b[{_COLOURS[colour]}m{words}\x1b[0m"
