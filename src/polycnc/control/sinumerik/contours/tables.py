"""Fields of a program that hold a contour: REAL [n,11] of CONTPRON and [n,6] of CONTDCON (job planning 15.2, 15.3)."""

from __future__ import annotations

from itertools import count

from polycnc.control.sinumerik.block.arguments import whole
from polycnc.control.sinumerik.contours.elements import (
    CLOCKWISE,
    COUNTER_CLOCKWISE,
    RAPID,
    Element,
    Side,
    is_full_circle,
)
from polycnc.control.sinumerik.contours.reliefs import Linked, link
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry import offset
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.names.variables import Array
from polycnc.language.sinumerik.runtime import out_of_range
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

#: Columns of the tables.
LINKED_COLUMNS, CODED_COLUMNS = 11, 6
#: Columns of a table of CONTPRON.
PREDECESSOR, SUCCESSOR, CODE, START, END, MARK, ANGLE, CENTER = 0, 1, 2, 3, 5, 7, 8, 9
#: Value of the tens of the motion code for metric units.
METRIC = 10


def field(value: Any, columns: int, name: str) -> Array:
    """A field that can hold a table; 12360 for any other size, 12330 for another type."""
    if not isinstance(value, Array) or len(value.dims) != 2 or value.dims[1] != columns:
        raise AlarmError("12360", text=name)
    if value.variable.type is not Type.REAL:
        raise AlarmError("12330", text=name)
    return value


def fill(table: Array, rows: dict[int, Sequence[float]]) -> None:
    """Write rows into an emptied table; 10934 for one that the table does not have."""
    count_, columns = table.dims
    if max(rows) >= count_:
        raise AlarmError("10934", text=table.variable.name)
    items = [0.0] * (count_ * columns)
    for number, row in rows.items():
        items[number * columns : number * columns + len(row)] = map(float, row)
    table.items[:] = items


# ---- CONTPRON


def linked_rows(
    approach: Element, contour: Sequence[Element], side: Side, size: int, *, both: bool
) -> tuple[dict[int, Sequence[float]], int]:
    """The rows of a contour with its relief cuts.

    Args:
        approach: From the place before the contour to its first point.
        contour: The contour.
        side: From where it is machined.
        size: Rows that the table has.
        both: Backwards as well, at the end of the table.

    Returns:
        The rows by number, and the number of relief cuts forwards.

    Raises:
        AlarmError: 10934 for a table that is too small.
    """
    slopes = [part for element in contour for part in side.slopes(element)]
    forward = link(slopes, side, 1, count(len(slopes) + 1))
    last = max(row.number for row in forward.rows)
    rows = _rows_of(forward, side)
    rows[0] = _row(forward.rows[-1].number, last, approach, 0, side)
    reliefs_back = 0
    if both:
        backward, back = _backward(approach, slopes, side, size)
        if min(back) <= last + 1:
            raise AlarmError("10934", text="CONTPRON")
        rows |= back
        reliefs_back = backward.reliefs
    if last + 1 < size:  # a table that just holds the contour has no room for their numbers
        rows[last + 1] = [float(forward.reliefs), float(reliefs_back)]
    return rows, forward.reliefs


def _backward(
    approach: Element, slopes: Sequence[Element], side: Side, size: int
) -> tuple[Linked, dict[int, Sequence[float]]]:
    """The contour travelled the other way, in the last rows of the table."""
    turned = [element.turned_round() for element in reversed(slopes)]
    first = size - 1 - len(turned)
    linked = link(turned, side, first, count(first - 1, -1))
    rows = _rows_of(linked, side)
    lowest = min(row.number for row in linked.rows)
    rows[size - 1] = _row(lowest, first, approach.turned_round(), 0, side)
    return linked, rows


def _rows_of(linked: Linked, side: Side) -> dict[int, Sequence[float]]:
    return {row.number: _row(row.before, row.behind, row.element, row.mark, side) for row in linked.rows}


def _row(before: int, behind: int, element: Element, mark: int, side: Side) -> list[float]:
    """The columns of an element; lengths in the unit that its code names."""
    edge, factor = element.edge, unit(element.code)
    lengths = (*edge.start, *edge.end, *(edge.center or (0.0, 0.0)))
    u0, v0, u1, v1, cu, cv = (value / factor for value in lengths)
    return [before, behind, element.code, u0, v0, u1, v1, mark, side.angle(edge), cu, cv]


def unit(code: int) -> float:
    """From lengths of a row to mm, by the tens of its motion code."""
    return 1.0 if code // 10 % 10 else INCH_MM


def element_of(row: Any, name: str) -> Element:
    """The element in `TABLE[row]`, mm; only its code, points and centre count.

    Raises:
        AlarmError: 12360 for a field that is no table of CONTPRON, 17020 for a row that it does not have, 10931 for
            one that holds no line and no arc.
    """
    array, number = row
    table, number = field(array, LINKED_COLUMNS, name), whole(number)
    if not 0 <= number < table.dims[0]:
        out_of_range(table.variable.name, 1, number)
    begin = number * LINKED_COLUMNS
    values = table.items[begin : begin + LINKED_COLUMNS]
    code = int(values[CODE])
    factor = unit(code)
    start, end, center = ((values[k] * factor, values[k + 1] * factor) for k in (START, END, CENTER))
    kind = code % 10
    modes = code - kind
    if kind in (CLOCKWISE, COUNTER_CLOCKWISE):
        if center in (start, end):
            raise AlarmError("10931", text=f"{table.variable.name}[{number}]")
        element = Element(offset.arc(start, end, center, kind == COUNTER_CLOCKWISE), modes)
    else:
        element = Element(offset.line(start, end), modes, kind == RAPID)
    if code != values[CODE] or not 0 <= kind <= COUNTER_CLOCKWISE or start == end:
        raise AlarmError("10931", text=f"{table.variable.name}[{number}]")
    assert not is_full_circle(element.edge)
    return element


# ---- CONTDCON


def coded_rows(
    start: Sequence[float], unit_digit: int, pieces: Sequence[tuple[int, Element, float]]
) -> dict[int, Sequence[float]]:
    """The rows of a coded contour.

    Args:
        start: Where it begins, in the unit of the program.
        unit_digit: Tens of the code of row 0.
        pieces: Of each element its code, itself, and the feed, in the unit of the program.
    """
    rows: dict[int, Sequence[float]] = {0: [unit_digit * 10, *start, 0.0, 0.0, len(pieces)]}
    for number, (code, element, feed) in enumerate(pieces, 1):
        edge, factor = element.edge, INCH_MM if code // 10 % 2 == 0 else 1.0
        lengths = (*edge.end, *(edge.center or (0.0, 0.0)))
        rows[number] = [code, *(value / factor for value in lengths), feed]
    return rows
