"""A page of a file: some thousand whole lines, of which hardly any is ever asked for by itself."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.program.text import TAPE_CONTROLS

if TYPE_CHECKING:
    from collections.abc import Iterator

CONTROLS = TAPE_CONTROLS.encode("ascii")
#: From a line whose place is known to one that is so near it goes line end by line end.
_NEAR = 16
#: Lines that are looked up one by one before the page is split into all of them; a far one counts as many.
_FEW, _FAR = 128, 16


class Page:
    """Whole lines of a file.

    Args:
        text: The lines in UTF-8, every one with its line feed. Control codes of tapes are still in it.
        count: How many lines there are.
    """

    def __init__(self, text: bytes, count: int) -> None:
        self.text = text
        self._count = count
        self._lines: list[str] | None = None
        self._few = _FEW
        self._known = 0, 0  # a line, and the byte at which it begins

    def line(self, line: int) -> str:
        """One of the lines."""
        if self._lines is None and self._few > 0:
            self._few -= 1
            place = self._place(line)
            return _read(self.text[place : self.text.index(b"\n", place)])
        return self._all()[line]

    def lines(self, first: int, end: int) -> Iterator[str]:
        """The lines from one on to before another one; he who asks need not take them all."""
        while first < end and self._lines is None and self._few > 0:
            yield self.line(first)
            first += 1
        if first < end:
            yield from self._all()[first:end]

    def places_of(self, first: int, end: int) -> tuple[int, int]:
        """Where the same lines begin and end in the text; all behind the first one where there are fewer."""
        return self._place(first), self._place(min(end, self._count))

    def _all(self) -> list[str]:
        if self._lines is None:
            self._lines = _read(self.text).split("\n")[:-1]
        return self._lines

    def _place(self, line: int) -> int:
        """The byte at which a line begins, that behind the last one for the line that would come next."""
        text, ends = self.text, ((0, 0), self._known, (self._count, len(self.text)))
        number, place = min(ends, key=lambda known: abs(known[0] - line))
        if abs(number - line) > _NEAR:
            self._few -= _FAR
            number, place = self._in_front_of(line)
        while number < line:
            place = text.index(b"\n", place) + 1
            number += 1
        while number > line:
            place = text.rfind(b"\n", 0, place - 1) + 1
            number -= 1
        self._known = line, place
        return place

    def _in_front_of(self, line: int) -> tuple[int, int]:
        """A byte in front of a line, and in which line it stands: not far away."""
        number, place, end = 0, 0, len(self.text)
        while line - number > _NEAR:
            middle = (place + end) // 2
            passed = number + self.text.count(b"\n", place, middle)
            if passed < line:
                number, place = passed, middle
            else:
                end = middle
        return number, place


def _read(text: bytes) -> str:
    """Text without the control codes of tapes."""
    return text.translate(None, CONTROLS).decode("utf-8")


def ended(page: bytes) -> bytes:
    """A page whose last line has its line end; nothing behind the last one is no line, nor are codes of tapes."""
    if page.endswith(b"\n"):
        return page
    page = page.translate(None, CONTROLS)
    return page if not page or page.endswith(b"\n") else page + b"\n"
