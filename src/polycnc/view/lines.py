"""A line through space as a typed buffer, which grows: what goes to a graphics card as it is.

A point is five numbers of four bytes (`float32`, in the byte order of the host): X, Y, Z in mm, the feed with which the
line comes to it in mm/min, and what it is: `RAPID`, `FEED` or `GAP` (no line leads there) and eight times the number of
its tool's colour. A million points are 20 MB.
"""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

#: Numbers of a point, and the bytes of each.
WIDTH, BYTES = 5, 4
RAPID, FEED, GAP = 0, 1, 2
#: What a kind leaves room for: kind + KINDS * colour.
KINDS = 8
#: Points of a line at most; where more come, the oldest half goes.
MOST = 4_000_000


class Lines:
    """A line that grows.

    Args:
        most: Points that it holds at most; where more come, the older half goes.

    Attributes:
        era: Grows when points that were there have gone or changed: whoever has a copy has to begin anew.
        tools: The tools by their colours' numbers.
    """

    def __init__(self, most: int = MOST) -> None:
        self.era = 0
        self.tools: list[str] = []
        self._numbers: dict[str, int] = {}
        self._points = array("f")
        self._most = most

    def __len__(self) -> int:
        """How many points there are."""
        return len(self._points) // WIDTH

    def colour(self, tool: str) -> int:
        """The number of a tool's colour; a new tool has the next one."""
        number = self._numbers.get(tool)
        if number is None:
            number = self._numbers[tool] = len(self.tools)
            self.tools.append(tool)
        return number

    def add(self, point: Sequence[float], feed: float, kind: int, colour: int) -> None:
        """Add a point: X, Y, Z in mm, and the line that leads to it."""
        self._points.extend((*point, feed, kind + KINDS * colour))
        self._shorten()

    def extend(
        self, columns: Sequence[Sequence[float] | None], feeds: Iterable[float], what: Iterable[int]
    ) -> None:
        """Add many points by columns.

        Args:
            columns: X, Y, Z, as long as each other; None for an axis that is not there.
            feeds: Feed of each point.
            what: Kind and colour of each point, in one number as the buffer has it.
        """
        fourth, fifth = array("f", feeds), array("f", what)
        block = array("f", bytes(WIDTH * BYTES * len(fifth)))
        for place, column in enumerate(columns):
            if column is not None:
                block[place::WIDTH] = array("f", column)
        block[3::WIDTH], block[4::WIDTH] = fourth, fifth
        self._points.extend(block)
        self._shorten()

    def _shorten(self) -> None:
        if len(self) > self._most:
            del self._points[: len(self) // 2 * WIDTH]
            self.era += 1

    def clear(self) -> None:
        """Nothing is there any more; tools keep their colours."""
        del self._points[:]
        self.era += 1

    def last(self) -> tuple[float, ...]:
        """X, Y, Z of the last point; empty where there is none."""
        return tuple(self._points[-WIDTH : 3 - WIDTH])

    def part(self, first: int, count: int) -> bytes:
        """The bytes of some points from one on; fewer where there are no more."""
        return self._points[first * WIDTH : (first + count) * WIDTH].tobytes()
