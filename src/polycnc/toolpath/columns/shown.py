"""Kernel: the rows of a chunk as the displays show them, column by column; to the bits of `trace.Display`.

A function on arrays that runs as it is and as machine code (`kernels/`).
"""

from __future__ import annotations

from math import nan

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32, Words16
from polycnc.toolpath.digits import STEPS
from polycnc.toolpath.kinds import CURVE_WIDTH, Kind

#: Columns of what is shown. Positions by axis follow: work display, machine display, centres.
TYPE, PROGRAM, UNIT, TOOL, FEED, TURNS, PLACES = 0, 1, 2, 3, 4, 5, 6
#: What a view says of an axis: factors of its displays, offset, whether its display stays within one turn.
WORK, MACHINE, OFFSET, MODULO, WIDTH = 0, 1, 2, 3, 4
#: What it says beside: factors of lengths and feeds, number of the unit, number of the tool.
LENGTH, RATE, INCH, IN_SPINDLE = 0, 1, 2, 3
_ARCS = (int(Kind.CW), int(Kind.CCW), int(Kind.HELIX_CW), int(Kind.HELIX_CCW))
#: Kinds whose curve parameters need no record of their own.
_PLAIN = (*_ARCS, int(Kind.FEED))
_FULL_TURN = 360.0
#: Sums of this and smaller numbers have no decimals.
_NO_DECIMALS = 2.0**52
#: An arc goes along an axis that has no more than this of its normal.
_ALONG = 1e-9


class Rows(NamedTuple):
    """Columns of a chunk."""

    kind: Bytes
    program: Words16
    feed: Floats
    end: Floats
    curve: Ints32
    curves: Floats


class View(NamedTuple):
    """How rows of one context are shown.

    Attributes:
        axes: `WIDTH` numbers for each axis.
        frame: Three rows of a matrix with the shift behind each; nothing where it changes nothing.
        geometry: Columns of X, Y and Z, -1 for a missing one.
        beside: Factors and numbers: `LENGTH` and so on.
    """

    axes: Floats
    frame: Floats
    geometry: Ints
    beside: Floats


def show(
    rows: Rows, view: View, first: int, end: int, arcs: bool, numbers: Floats, others: Ints, found: int
) -> int:
    """Fill in the columns of rows of one context; gives how many rows are noted in `others` then.

    Args:
        rows: Of a chunk.
        view: Of the context.
        first: First row.
        end: The row behind the last one.
        arcs: Whether there is any arc in the chunk: only then there are centres and turns.
        numbers: Columns one behind the other, each as long as the chunk; NaN where a row has none.
        others: Gets rows that have more than these columns say: events, dwells, threads.
        found: How many it has.
    """
    height, count = len(rows.kind), len(view.axes) // WIDTH
    work, machine = PLACES * height, (PLACES + count) * height
    for row in range(first, end):
        kind = rows.kind[row]
        is_event = kind == Kind.EVENT
        numbers[TYPE * height + row] = kind
        numbers[PROGRAM * height + row] = rows.program[row]
        numbers[UNIT * height + row] = nan if is_event else view.beside[INCH]
        numbers[TOOL * height + row] = view.beside[IN_SPINDLE]
        factor = view.beside[LENGTH if kind == Kind.THREAD else RATE]
        numbers[FEED * height + row] = in_steps(rows.feed[row] * factor)
        for axis in range(count):
            value, at = rows.end[row * count + axis], WIDTH * axis
            shown = in_steps(value * view.axes[at + WORK])
            if view.axes[at + MODULO] != 0.0:
                shown = in_steps(shown % _FULL_TURN)
            numbers[work + axis * height + row] = nan if is_event else shown
            shown = in_steps((value + view.axes[at + OFFSET]) * view.axes[at + MACHINE])
            numbers[machine + axis * height + row] = nan if is_event else shown
        if len(view.frame) > 0 and not is_event:
            show_mapped(rows, view, row, numbers, machine)
        if arcs:
            show_arc(rows, view, row, numbers)
        if rows.curve[row] >= 0 and kind not in _PLAIN:
            others[found] = row
            found += 1
    return found


def in_steps(value: float) -> float:
    """A value without rounding noise, and without -0.0."""
    steps = value * STEPS
    if 0.0 <= steps < _NO_DECIMALS:
        steps = (steps + _NO_DECIMALS) - _NO_DECIMALS
    elif -_NO_DECIMALS < steps < 0.0:
        steps = (steps - _NO_DECIMALS) + _NO_DECIMALS
    return steps / STEPS + 0.0


def show_mapped(rows: Rows, view: View, row: int, numbers: Floats, machine: int) -> None:
    """The machine display of geometry axes that a frame maps."""
    height, count, frame = len(rows.kind), len(view.axes) // WIDTH, view.frame
    x = _of(rows.end, row * count, view.geometry[0])
    y = _of(rows.end, row * count, view.geometry[1])
    z = _of(rows.end, row * count, view.geometry[2])
    for k in range(3):
        axis = view.geometry[k]
        if axis >= 0:
            mapped = frame[4 * k] * x + frame[4 * k + 1] * y + frame[4 * k + 2] * z + frame[4 * k + 3]
            at = WIDTH * axis
            shown = in_steps((mapped + view.axes[at + OFFSET]) * view.axes[at + MACHINE])
            numbers[machine + axis * height + row] = shown


def show_arc(rows: Rows, view: View, row: int, numbers: Floats) -> None:
    """Centre and turns of an arc: on the axes of its plane, on all three where it is tilted."""
    height, count, curves = len(rows.kind), len(view.axes) // WIDTH, rows.curves
    center = (PLACES + 2 * count) * height + row
    numbers[TURNS * height + row] = nan
    for axis in range(count):
        numbers[center + axis * height] = nan
    if rows.kind[row] not in _ARCS or rows.curve[row] < 0:
        return
    at, along = CURVE_WIDTH * rows.curve[row], 0
    for k in range(3):
        if abs(curves[at + 3 + k]) > _ALONG:
            along += 1
    for k in range(3):
        axis = view.geometry[k]
        if axis >= 0 and (along > 1 or abs(curves[at + 3 + k]) <= _ALONG):
            shown = in_steps(curves[at + k] * view.axes[WIDTH * axis + WORK])
            numbers[center + axis * height] = shown
    if curves[at + 6] != 0.0:
        numbers[TURNS * height + row] = in_steps(curves[at + 6] + 1.0)


def _of(point: Floats, at: int, column: int) -> float:
    return point[at + column] if column >= 0 else 0.0
