"""From the characters of a file to its lines."""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import NoReturn
from polycnc.program.errors import ProgramFileError

MAX_LINE = 65_536
"""Characters of the longest line that is taken for a block; the controls themselves end at 256 to 512."""

TAPE_CONTROLS = "\0\x11\x12\x13\x14\x1a\x7f"
"""Blank tape, start and stop codes of readers and punches, the DOS end of file, rubout: none is text."""

_TAPE_LINE_END = regex("\r\n|\n\r\r|\n|\r")


def split_lines(text: str, path: str = "") -> list[str]:
    """Split at CR, LF, CR LF and LF CR CR, each being one line end.

    A blank line stays a line, so that numbers are those of an editor; nothing behind the last line end is no
    line.

    Raises:
        ProgramFileError: A line is longer than `MAX_LINE`.
    """
    if "\r" not in text:
        lines = text.split("\n")
    elif "\n\r\r" in text:
        lines = _TAPE_LINE_END.split(text)
    else:
        lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if not lines[-1]:
        lines.pop()
    if len(text) > MAX_LINE and _may_be_too_long(text):
        for number, line in enumerate(lines, 1):
            if len(line) > MAX_LINE:
                refuse_long_line(path, number)
    return lines


def _may_be_too_long(text: str) -> bool:
    """Whether two line feeds are too far apart: so many characters are looked at in one go, not line by line."""
    place = 0
    while place + MAX_LINE < len(text):
        found = text.rfind("\n", place, place + MAX_LINE + 1)
        if found < 0:
            return True
        place = found + 1
    return False


def refuse_long_line(path: str, line: int) -> NoReturn:
    """A line is longer than `MAX_LINE`."""
    raise ProgramFileError("program.line-too-long", path, line=line, limit=MAX_LINE)
