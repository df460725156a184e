"""Relief cuts of a contour, and the links between the rows of its table (job planning 15.2).

A contour is followed at the height from which it is machined. Where it falls, a relief cut begins; where it rises
again, that is passed. The element that rises past the height from which it fell is cut there in two, and its rest
becomes a row of its own. A contour that ends before it has risen again is closed by an element straight up to its
greatest height. Column 7 marks the turning points: where it falls the row at which it rises again, where it rises the
row at which it falls next, negative, or END for the last time.
"""

from __future__ import annotations

from polycnc.control.sinumerik.contours.elements import SAME_MM, Element
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.control.sinumerik.contours.elements import Side

#: Column 7: no further relief cut.
END = -1111


@dataclass(slots=True, eq=False)
class Row:
    """An element of a contour in its row of the table.

    Attributes:
        number: Row of the table.
        element: Line or arc.
        mark: Column 7.
        before: Row of the predecessor, 0 for none.
        behind: Row of the successor, 0 for none.
    """

    number: int
    element: Element
    mark: int = 0
    before: int = 0
    behind: int = 0


@dataclass(frozen=True, slots=True)
class Linked:
    """A contour with its relief cuts: its rows in the order of travel, and how many relief cuts it has."""

    rows: list[Row]
    reliefs: int


def link(elements: Sequence[Element], side: Side, first: int, further: Iterator[int]) -> Linked:
    """Give the elements of a contour their rows, find its relief cuts, and link the rows.

    Args:
        elements: The contour, each element rising, falling or level (`Side.slopes`).
        side: From where it is machined.
        first: Row of the first element; the others follow.
        further: Rows for elements that come into being here.
    """
    rows = [Row(first + k, element) for k, element in enumerate(elements)]
    _close(rows, side, further)
    reliefs = _mark(rows, side, further)
    for k, row in enumerate(rows):
        row.before = rows[k - 1].number if k else 0
        row.behind = rows[k + 1].number if k + 1 < len(rows) else 0
    return Linked(rows, reliefs)


def _rise(row: Row, side: Side) -> float:
    """How far an element rises; 0 for a level one."""
    edge = row.element.edge
    rise = side.height(edge.end) - side.height(edge.start)
    return rise if abs(rise) > SAME_MM else 0.0


def _close(rows: list[Row], side: Side, further: Iterator[int]) -> None:
    """A contour that does not rise any more behind a fall gets an element that does."""
    slopes = [rise for row in rows if (rise := _rise(row, side))]
    if slopes and slopes[-1] < 0.0:
        last = rows[-1].element
        top = max(side.height(row.element.edge.start) for row in rows)
        end = last.edge.end
        wall = offset.line(end, side.raised(end, top))
        rows.append(Row(next(further), Element(wall, last.modes // 10 % 10 * 10)))


def _mark(rows: list[Row], side: Side, further: Iterator[int]) -> int:
    """Mark the turning points and cut what rises past the beginning of a relief cut. Gives the number of reliefs."""
    reliefs, k = 0, 0
    low: Row | None = None
    high: Row | None = None
    falls: bool | None = None
    level: float | None = None
    while k < len(rows):
        row = rows[k]
        rise = _rise(row, side)
        edge = row.element.edge
        if rise < 0.0 and falls is not True:
            falls, high, level = True, row, side.height(edge.start)
            reliefs += 1
            if low is not None:
                low.mark = -row.number
        elif rise > 0.0 and falls is not False:
            falls, low = False, row
            row.mark = END
            if high is not None:
                high.mark = row.number
        if rise > 0.0 and level is not None and side.height(edge.end) > level - SAME_MM:
            if side.height(edge.end) > level + SAME_MM and side.height(edge.start) < level - SAME_MM:
                at = side.at_height(edge, level)
                rows.insert(k + 1, Row(next(further), row.element.between(at, edge.end)))
                row.element = row.element.between(edge.start, at)
            level = None
        k += 1
    if not reliefs:
        for row in rows:
            row.mark = 0
        rows[0].mark = END
    return reliefs
