"""What the kernel reads, the lines of a program as bytes, a window at a time; and room for what it writes."""

from __future__ import annotations

from array import array

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.layout import Columns, NoteRecord
from polycnc.program.long_text import LongText
from polycnc.program.pages import CONTROLS
from polycnc.toolpath.kinds import CURVE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.language.bulk.layout import Scan

#: Lines of the first window behind a jump, and of the largest; a window that is used up is followed by a larger one.
FEWEST_LINES, MORE_LINES, MOST_LINES = 64, 4, 16_384
#: The interpreter takes so many lines at the most before a window is read anew.
MOST_SKIPPED = 64
#: What stands in front of a block, where it is marked for block skip.
_MARK = regex(r"[ \t]*(N[ \t]*\d+)?[ \t]*/\d?")
#: Room for rows, and for notes and curves, at first; what has been filled becomes so much larger. Room for rows does
#: when so many times as many have come: its memory is touched whole, and costs a short program more than its blocks.
FIRST_ROWS, FIRST_OTHERS, MORE_ROOM = 4096, 64, 4


class Window:
    """Some lines of a program, and how far they have been read.

    Attributes:
        text: Their bytes among others; every line has its line end.
        place: Byte at which the next line begins; `end` is the byte behind the last one.
        line: Index of that line in the program.
        lines: The lines of the program that the window is on.
    """

    def __init__(self) -> None:
        self.text = b""
        self.place = self.end = 0
        self.line = 0
        self.lines: Sequence[str] = ()
        self._size = FEWEST_LINES
        self._folds = False

    def stand_at(self, lines: Sequence[str], line: int, end: int) -> bool:
        """Let a line be the next one; false where it is not in front of `end`, behind which nothing is read."""
        if lines is not self.lines:
            self._folds = False
        ahead = line - self.line
        if lines is not self.lines or not 0 <= ahead <= MOST_SKIPPED or not self._skip_to(line):
            self._size = (
                min(MORE_LINES * self._size, MOST_LINES)
                if lines is self.lines and line == self.line
                else FEWEST_LINES
            )
            self._read(lines, line, end)
        return self.place < self.end

    def _skip_to(self, line: int) -> bool:
        """Step over the lines that the interpreter has taken."""
        while self.line < line and self.place < self.end:
            self.place = self.text.index(b"\n", self.place) + 1
            self.line += 1
        self.line = line
        return self.place < self.end

    def fold(self) -> bool:
        """Let small letters be capital ones from now on, where that line has some: the kernel reads no others."""
        line = self.text[self.place : self.text.find(b"\n", self.place)]
        if self._folds or not line or line == line.upper():
            return False
        self._folds = True
        self.text = self.text.upper()
        return True

    def next_line(self) -> str:
        """That line as text, without a mark of block skip; empty behind the last one that has been read."""
        if self.place == self.end:
            return ""
        text = self.text[self.place : self.text.index(b"\n", self.place)]
        line = text.translate(None, CONTROLS).decode("utf-8")
        mark = _MARK.match(line) if "/" in line else None
        return line if mark is None else line[mark.end() :]

    def _read(self, lines: Sequence[str], line: int, end: int) -> None:
        self.lines, self.line = lines, line
        self.text, self.place, self.end = b"", 0, 0
        if isinstance(lines, LongText) and end == len(lines):
            if line < end:
                self.text, self.place, self.end = lines.text_from(line)
        elif found := lines[line : min(line + self._size, end)]:
            self.text = ("\n".join(found) + "\n").encode("utf-8", "replace")
            self.end = len(self.text)
        if self._folds:
            self.text = self.text.upper()


@unchanging
class Room:
    """Columns that the kernel writes.

    Args:
        axes: Number of the channel's axes.
        most: So many rows may come of one call of the kernel.

    Attributes:
        columns: The columns.
        table: Those of the toolpath: kind, program, line, feed, end, curve, parameters of curves.
        views: The same as bytes.
        rows: There is room for so many; `notes` and `curves` likewise.
    """

    def __init__(self, axes: int, most: int) -> None:
        self._axes, self._most, self._came = axes, most, 0
        self.rows = min(FIRST_ROWS, most)
        self.notes = self.curves = min(FIRST_OTHERS, most)
        self._of_rows, self._of_curves, self._of_notes = (
            self._for_rows(),
            self._for_curves(),
            self._for_notes(),
        )
        self._join()

    def make_fit(self, at: Scan) -> None:
        """Let what the last scan has filled become larger."""
        self._came += at.rows
        if self._came >= MORE_ROOM * self.rows and self.rows < self._most:
            self.rows = self._more(self.rows)
            self._of_rows = self._for_rows()
            self._join()
        if at.curves >= self.curves:
            self.curves = self._more(self.curves)
            self._of_curves = self._for_curves()
            self._join()
        if at.notes >= self.notes:
            self.notes = self._more(self.notes)
            self._of_notes = self._for_notes()
            self._join()

    def _more(self, room: int) -> int:
        return min(MORE_ROOM * room, self._most)

    def _join(self) -> None:
        self.table = (*self._of_rows, self._of_curves)
        self.columns = Columns(*self.table, *self._of_notes)
        self.views = [memoryview(column).cast("B") for column in self.table]

    def _for_rows(self) -> tuple[array[int], array[int], array[int], array[float], array[float], array[int]]:
        rows = self.rows
        return (
            array("B", (0,)) * rows, array("H", (0,)) * rows, array("I", (0,)) * rows,
            array("d", (0.0,)) * rows, array("d", (0.0,)) * (rows * self._axes), array("i", (0,)) * rows,
        )  # fmt: skip

    def _for_curves(self) -> array[float]:
        return array("d", (0.0,)) * (self.curves * CURVE_WIDTH)

    def _for_notes(self) -> tuple[array[int], array[float]]:
        said = array("d", (0.0,)) * (self.notes * (self._axes + 1))
        return array("q", (0,)) * (self.notes * NoteRecord.SIZE), said
