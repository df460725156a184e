"""The lines of a program as bytes, a window at a time."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

from polycnc.program.long_text import LongText

if TYPE_CHECKING:
    from collections.abc import Sequence

#: Lines of the first window behind a jump, and of the largest; a window that is used up is followed by a larger one.
FEWEST_LINES, MORE_LINES, MOST_LINES = 64, 4, 16_384


class Window:
    """Some lines of a program, and how far they have been read.

    Attributes:
        text: Their bytes; every line has its line end.
        place: Byte at which the next line begins.
        line: Index of that line in the program.
        lines: The lines of the program that the window is on.
    """

    def __init__(self) -> None:
        self.text = array("B")
        self.place = 0
        self.line = 0
        self.lines: Sequence[str] = ()
        self._size = FEWEST_LINES

    def stand_at(self, lines: Sequence[str], line: int, end: int) -> bool:
        """Let a line be the next one; false where it is not in front of `end`, behind which nothing is read."""
        if lines is not self.lines or not self.line <= line <= self.line + 1 or not self._skip_to(line):
            self._size = (
                min(MORE_LINES * self._size, MOST_LINES)
                if lines is self.lines and line == self.line
                else FEWEST_LINES
            )
            self._read(lines, line, end)
        return self.place < len(self.text)

    def _skip_to(self, line: int) -> bool:
        """Step over the line that the interpreter has taken."""
        if line > self.line:
            self.place = (
                self.text.index(_NEWLINE, self.place) + 1 if self.place < len(self.text) else self.place
            )
            self.line = line
        return self.place < len(self.text)

    def _read(self, lines: Sequence[str], line: int, end: int) -> None:
        self.lines, self.line, self.place = lines, line, 0
        if isinstance(lines, LongText) and end == len(lines):
            self.text = array("B", lines.bytes_from(line) if line < end else b"")
            return
        found = lines[line : min(line + self._size, end)]
        self.text = array("B", ("\n".join(found) + "\n").encode("utf-8", "replace") if found else b"")


_NEWLINE = 10
