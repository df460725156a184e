"""Rows laid out: the planner's records of the pieces that lie ahead, and how fast each may be entered.

Records in front that have been taken stay in the buffer until it is full, so that taking one moves nothing. The kernels
run as they are; from some rows on their machine code, where it is there already, or where so many rows come that
compiling pays. Both give the same numbers.
"""

from __future__ import annotations

from array import array
from math import sqrt
from typing import TYPE_CHECKING, Any

from polycnc.motion.compiled import PLAIN, compiled_kernels, ready
from polycnc.motion.kernels.alone import settle_alone
from polycnc.motion.kernels.columns import Form, Limits, PieceRecord, Rows, new_state, piece_width
from polycnc.motion.kernels.jerk import window_s

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence


#: Rows from which on compiled kernels are used: where they are in the cache, and where they must be compiled first.
READY_ROWS, COMPILE_ROWS = 400, 20_000
ROOM = 256


class PieceBuffer:
    """The pieces that lie ahead of the axes of a channel.

    Args:
        axes: Number of axes.

    Attributes:
        state: What the kernels carry from row to row.
        contexts: Table of contexts.
        limits: The machine, as the kernels take it.
    """

    def __init__(self, axes: int) -> None:
        self.state = new_state(axes)
        self.state.run.free, self.state.run.stop = 1.0, 0.0
        self.contexts = array("d")
        self.limits: Limits
        self._axes = axes
        self._width = piece_width(axes)
        self._records = array("d", bytes(8 * self._width * ROOM))
        self._taken = 0
        self._planned = array("d")
        self._next = 0  # of the planned ones
        self._way = 0.0  # ahead, mm
        self._rests = 0  # pieces ahead at whose start the axes rest
        self._kernels = PLAIN
        self._rows = 0

    def __len__(self) -> int:
        return self.state.run.pieces - self._taken

    def clear(self) -> None:
        """Nothing lies ahead."""
        self.state.run.pieces = self._taken = self._rests = self._next = 0
        self._way = 0.0
        del self._planned[:]

    def free_threads(self, *, free: bool) -> None:
        """Whether rows that come bound threads by the spindle, or a dry run will say how fast they are."""
        self.state.run.free = 2.0 if free else 1.0

    # ---- rows ----------------------------------------------------------------------------------------------

    @property
    def position(self) -> list[float]:
        """Machine position behind everything laid out."""
        return list(self.state.position)

    def stand_at(self, position: Sequence[float]) -> None:
        """The axes stand elsewhere than the rows have led them."""
        self.state.run.stop = 1.0
        self.state.position[:] = array("d", position)

    def move_axis(self, column: int, position: float) -> None:
        """An axis is elsewhere than the rows have led it."""
        self.state.position[column] = position

    def end_in_rest(self) -> None:
        """The axes come to rest behind the last row."""
        self.state.run.stop = 1.0
        settle_alone(self._records, self._axes, self.limits, self.state)

    def lay(
        self, rows: Rows, curves: array[float], number: int, limits: Limits, called: float = -1.0
    ) -> list[int]:
        """Lay a row out; where the records of its pieces begin.

        Args:
            rows: The columns of that row.
            curves: Parameters of curves.
            number: Number of the row.
            limits: The machine, as a transformation shows it.
            called: Number that its pieces get, where the row is a leg of another one.
        """
        self._rows += 1
        called = called if called >= 0.0 else number
        if self._rows in (READY_ROWS, COMPILE_ROWS):
            self._choose_kernels()
        state = self.state
        while not self._kernels.lay(rows, 0, curves, number, self.contexts, limits, self._records, state):
            self._make_room()
        width, records = self._width, self._records
        at = (state.run.pieces - 1) * width
        found: list[int] = []
        while at >= self._taken * width and records[at + PieceRecord.ROW] == number:
            found.append(at)
            records[at + PieceRecord.ROW] = called
            self._way += records[at + PieceRecord.LENGTH]
            at -= width
        found.reverse()
        if found:
            self._rests += records[found[0] + PieceRecord.PAUSE] > 0.0
        return found

    def add(self, records: array[float]) -> None:
        """Pieces that a row does not make: the axes rest before and behind them."""
        self.end_in_rest()
        width, count = self._width, self.state.run.pieces
        while (count + len(records) // width) * width > len(self._records):
            self._make_room()
            count = self.state.run.pieces
        self._records[count * width : count * width + len(records)] = records
        self.state.run.pieces += len(records) // width
        self._way += sum(records[PieceRecord.LENGTH :: width])
        self._rests += records[PieceRecord.PAUSE] > 0.0
        last = len(records) - self._axes
        self.stand_at(records[last:])

    def _make_room(self) -> None:
        """Forget records that have been taken, or let the buffer grow."""
        if self._taken > len(self):
            self._drop_taken()
        else:
            self._records.frombytes(bytes(len(self._records) * 8))

    def _drop_taken(self) -> None:
        count, width = len(self), self._width
        first = self._taken * width
        self._records[: count * width] = self._records[first : first + count * width]
        self.state.run.pieces, self._taken = count, 0

    def _choose_kernels(self) -> None:
        fast = compiled_kernels()
        if fast is not None and (ready() or self._rows >= COMPILE_ROWS):
            self._kernels = fast

    def field(self, at: int, name: int) -> float:
        """A field of the record that begins at a place."""
        return self._records[at + name]

    # ---- pieces --------------------------------------------------------------------------------------------

    def front(self, name: int) -> float:
        """A field of the piece in front."""
        return self._records[self._taken * self._width + name]

    @property
    def is_last_of_row(self) -> bool:
        """Whether the piece behind the one in front belongs to another row, or is not there."""
        if len(self) <= 1:
            return True
        at = self._taken * self._width + PieceRecord.ROW
        return self._records[at + self._width] != self._records[at]

    def take(self) -> array[Any]:
        """Take the piece in front: its record."""
        at = self._taken * self._width
        record = self._records[at : at + self._width]
        self._way -= record[PieceRecord.LENGTH]
        self._rests -= record[PieceRecord.PAUSE] > 0.0
        self._records[at + PieceRecord.FORM] = Form.TIMED  # no bound of a later row reaches it any more
        self._taken += 1
        self._next += self._width
        return record

    def put_in_front(self, records: array[float]) -> None:
        """These pieces come first, from rest; behind them the axes rest as well."""
        width = self._width
        if len(self) == 0:
            self.state.run.stop = 1.0
        else:
            at = self._taken * width
            self._rests += self._records[at + PieceRecord.PAUSE] == 0.0
            self._records[at + PieceRecord.ENTRY2] = 0.0
            window = window_s(self._records[at + PieceRecord.RAMP], self._records[at + PieceRecord.BLEND])
            self._records[at + PieceRecord.PAUSE] = max(self._records[at + PieceRecord.PAUSE], window)
        self._drop_taken()
        self._records[0:0] = records
        self.state.run.pieces += len(records) // width
        for at in range(0, len(records), width):
            self._rests += records[at + PieceRecord.PAUSE] > 0.0
            self._way += records[at + PieceRecord.LENGTH]

    def context_fields(self, number: int, size: int) -> array[float]:
        """What the kernels know of a context."""
        return self.contexts[number * size : (number + 1) * size]

    # ---- speeds --------------------------------------------------------------------------------------------

    def plan(self, entries: Callable[[array[float], int], Iterator[tuple[int, float]]]) -> None:
        """Work out how fast each piece may be entered.

        `entries` is given the records and their width, and yields where a record begins and the largest squared
        speed there. The records themselves stay: what the axes allow is asked again when the overrides change.
        """
        first, end = self._taken * self._width, self.state.run.pieces * self._width
        planned = self._planned = self._records[first:end]
        self._next = 0
        for at, entry2 in entries(planned, self._width):
            planned[at + PieceRecord.ENTRY2] = entry2
        self._kernels.backward(planned, len(self), self._axes, self.limits)

    @property
    def reach2(self) -> float:
        """Largest squared speed at which the next piece may be entered; 0 where none is planned."""
        return self._planned[self._next + PieceRecord.REACH2] if self._next < len(self._planned) else 0.0

    @property
    def early(self) -> float:
        """Seconds by which the next piece may begin before the axes rest: strokes of drilling cycles overlap."""
        return min(self.front(PieceRecord.EARLY), self.front(PieceRecord.PAUSE)) if len(self) else 0.0

    @property
    def reaches(self) -> bool:
        """Whether so much lies behind the piece in front that no row to come can bound it."""
        if not len(self):
            return False
        if self._rests > (self.front(PieceRecord.PAUSE) > 0.0):
            return True
        reach = 0.5 * sqrt(self.state.run.top2) * self.state.run.window
        return self._way - self.front(PieceRecord.LENGTH) >= reach

    @property
    def may_change(self) -> bool:
        """Whether a row to come may still bound the piece in front."""
        return self.state.run.stop == 0.0 and (len(self) <= 1 or not self.reaches)
