"""Rows laid out: the planner's records of the pieces that lie ahead, and how fast each may be entered.

Records in front that have been taken stay in the buffer until it is full, so that taking one moves nothing.
"""

from __future__ import annotations

from array import array
from itertools import pairwise
from math import sqrt

from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar
from polycnc.mainrun.preparation.layout import Before
from polycnc.motion.compiled import kernels
from polycnc.motion.frames import with_axis
from polycnc.motion.kernels.columns import MAIN_RUN, TAP, Form, Limits, PieceRecord, new_state, piece_width
from polycnc.motion.kernels.jerk import window_s
from polycnc.motion.limits import ContextTables
from polycnc.motion.standing.waits import least_seconds
from polycnc.motion.standing.zero_mark import lag_s
from polycnc.motion.time_constants import Use

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.mainrun.preparation.layout import Layout, PreparedRow
    from polycnc.toolpath import Context
    from polycnc.transformation.contract import Geometry


ROOM = 256


class PieceBuffer:
    """The pieces that lie ahead of the axes of a channel.

    Args:
        axes: Number of axes.

    Attributes:
        state: What the kernels carry from row to row.
        tables: Tables of contexts.
        limits: The machine in the last row, as the kernels take it; `use` is what that runs by.
    """

    UNFOLLOWED: ClassVar[frozenset[str]] = frozenset({"_kernels"})

    def __init__(self, axes: int) -> None:
        self.state = new_state(axes)
        self.state.run.free, self.state.run.stop = MAIN_RUN, 0.0
        self._rested = False  # before the next row, for what is none
        self._is_open = False  # the axes rest there because nothing more is prepared
        self.tables = ContextTables(0.0)
        self.limits: Limits
        self.use = Use.CUT
        self._axes = axes
        self._width = piece_width(axes)
        self._records = array("d", bytes(8 * self._width * ROOM))
        self._taken = 0
        self._planned = array("d")
        self._next = 0  # of the planned ones
        self._way = 0.0  # ahead, mm
        self._rests = 0  # pieces ahead at whose start the axes rest
        self._kernels = kernels()

    def __len__(self) -> int:
        return self.state.run.pieces - self._taken

    def clear(self) -> None:
        """Nothing lies ahead."""
        self.state.run.pieces = self._taken = self._rests = self._next = 0
        self._way = 0.0
        del self._planned[:]

    # ---- rows ----------------------------------------------------------------------------------------------

    @property
    def position(self) -> list[float]:
        """Machine position behind everything laid out."""
        return list(self.state.position)

    def stand_at(self, position: Sequence[float]) -> None:
        """The axes stand elsewhere than the rows have led them."""
        self.state.run.stop, self._rested, self._is_open = 1.0, True, False
        self.state.position[:] = array("d", position)

    def move_axis(self, column: int, place: float, context: Context, geometry: Geometry) -> None:
        """A real axis is elsewhere than the rows have led it; `context` is that of the last one."""
        for i, value in enumerate(with_axis(self.position, context, geometry, column, place)):
            self.state.position[i] = value

    def end_in_rest(self) -> None:
        """The axes come to rest behind the last row, and nothing begins before they do."""
        self.state.run.stop, self._rested, self._is_open = 1.0, True, False
        self.state.run.overlap = self.state.run.rapid_overlap = 0.0
        self._kernels.settle(self._records, self._axes, self.limits, self.state)

    def end_here(self) -> None:
        """The axes come to rest behind the last row, because nothing more is prepared."""
        is_open = not self._rested
        self.end_in_rest()
        self._is_open = is_open

    def reopen(self) -> bool:
        """More is going to be prepared, before which nothing else asks for a rest; whether that is so."""
        is_open, self._is_open = self._is_open and self._rested, False
        self._rested = self._rested and not is_open
        return is_open

    def least_seconds(self, row: int) -> float:
        """The least time of the pieces ahead that belong to a row or to one behind it."""
        piece = self.state.run.pieces
        while piece > self._taken and self._row_of(piece - 1) >= row:
            piece -= 1
        return least_seconds(self._records, piece, self.state.run.pieces, self._width)

    def note_rest(self) -> bool:
        """Whether the axes rest before the next row for what is none, such as an auxiliary function; asked once."""
        rested, self._rested = self._rested, False
        return rested

    def lay(self, prepared: PreparedRow, layout: Layout) -> list[int]:
        """Lay a row out for overrides; where the records of its pieces begin."""
        if prepared.records is not None:
            self._add(prepared.records)
            return []
        rows, number, called, state = prepared.rows_for(layout), prepared.number, prepared.called, self.state
        if prepared.led is not None:  # the axes rest where the use changes
            self._kernels.settle(self._records, self._axes, prepared.led, state)
            state.run.stop = 1.0
        self.limits, self.use = prepared.limits, prepared.use
        contexts = self.tables.of(prepared.use)
        state.run.override = prepared.factor(layout)
        # What a tap may do at an override, others decide (`Rates`).
        state.run.free = 1.0 if rows.kind[0] == TAP and layout.free <= 0.0 else layout.free
        while not self._kernels.lay(
            rows, 0, prepared.curves, number, contexts, prepared.limits, self._records, state
        ):
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

    def lay_again(
        self, rows: Sequence[PreparedRow], layout: Layout, way: float | None = None
    ) -> tuple[array[Any], float] | None:
        """Lay out rows again that make up the end of what is prepared.

        Args:
            rows: The rows, in order.
            layout: For these overrides.
            way: How far the axes have come on the first one, mm; None where none of its pieces has been taken.

        Returns:
            Of the piece on which the axes are: its record, taken, and how far they have come on it.
        """
        state, width, rested = self.state, self._width, self._rested
        first, called = self._taken, rows[0].called
        while way is not None and first > 0 and self._row_of(first - 1) == called:
            first -= 1
        while way is None and self._row_of(first) != called:
            first += 1
        taken, self._taken = self._taken, 0
        for at in range(0, taken * width, width):
            self._records[at + PieceRecord.FORM] = Form.CURVED  # its bounds reach ahead, and it is never cut
        rows[0].before.restore(state)
        state.run.is_bent = 1.0
        if way is None:
            state.run.stop, state.run.alone = 1.0, 0.0
        state.run.pieces = first
        for k, prepared in enumerate(rows):
            if k and prepared.rests:
                self.end_in_rest()
            state.position[:] = prepared.before.vectors[0]
            self.lay(prepared, layout)
        if rested:
            self.end_in_rest()
        self._rested, self._taken = rested, taken if way is None else first
        record, done = None, way or 0.0
        while way is not None:
            at = self._taken * width
            length = self._records[at + PieceRecord.LENGTH]
            self._taken += 1
            if done < length or self._taken == state.run.pieces or self._row_of(self._taken) != called:
                record = self._records[at : at + width]
                break
            done -= length
        for at in range(0, self._taken * width, width):
            self._records[at + PieceRecord.FORM] = Form.TIMED
        ahead = range(self._taken * width, state.run.pieces * width, width)
        self._way = sum(self._records[at + PieceRecord.LENGTH] for at in ahead)
        self._rests = sum(self._records[at + PieceRecord.PAUSE] > 0.0 for at in ahead)
        return None if record is None else (record, done)

    def noted(self) -> Callable[[], None]:
        """What brings all pieces back as they are now."""
        end = self.state.run.pieces * self._width
        records, before, limits = self._records[:end], Before.of(self.state), (self._taken, self._rests)
        way, rested = self._way, self._rested

        def back() -> None:
            self._records[: len(records)] = records
            before.restore(self.state)
            (self._taken, self._rests), self._way, self._rested = limits, way, rested

        return back

    @property
    def last_length(self) -> float:
        """Length of the piece that has been taken last, mm."""
        return self._records[(self._taken - 1) * self._width + PieceRecord.LENGTH] if self._taken else 0.0

    def goes_on(self, row: float) -> bool:
        """Whether the piece in front belongs to a row."""
        return len(self) > 0 and self._row_of(self._taken) == row

    @property
    def rests_around(self) -> bool:
        """Whether the axes rest before the piece in front, and behind its row."""
        width, at, end = self._width, self._taken * self._width, self.state.run.pieces * self._width
        row, rests = self._records[at + PieceRecord.ROW], self._records[at + PieceRecord.PAUSE] > 0.0
        while at < end and self._records[at + PieceRecord.ROW] == row:
            at += width
        return rests and (at >= end or self._records[at + PieceRecord.PAUSE] > 0.0)

    def rows_from_rest(self) -> set[float]:
        """The rows ahead before which the axes rest."""
        found: set[float] = set()
        for piece in range(self._taken, self.state.run.pieces):
            if self._records[piece * self._width + PieceRecord.PAUSE] > 0.0:
                found.add(self._row_of(piece))
        return found

    def _row_of(self, piece: int) -> float:
        return self._records[piece * self._width + PieceRecord.ROW]

    def _add(self, records: array[float]) -> None:
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

    def field(self, at: int, name: int) -> float:
        """A field of the record that begins at a place."""
        return self._records[at + name]

    # ---- pieces --------------------------------------------------------------------------------------------

    def front(self, name: int) -> float:
        """A field of the piece in front."""
        return self._records[self._taken * self._width + name]

    @property
    def lag(self) -> float:
        """Seconds by which the axes are behind a spindle that the piece in front follows, up to speed."""
        return lag_s(self._records, self._taken * self._width) if len(self) else 0.0

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

    @property
    def contexts(self) -> array[float]:
        """What the kernels know of the contexts of cuts and rapids."""
        return self.tables.plain

    def context_fields(self, number: int, size: int, use: Use) -> array[float]:
        """What the kernels know of a context in rows of a use."""
        return self.tables.of(use)[number * size : (number + 1) * size]

    # ---- speeds --------------------------------------------------------------------------------------------

    def plan(self, entries: Callable[[array[float], int], Iterator[tuple[int, float, Limits]]]) -> None:
        """Work out how fast each piece may be entered.

        `entries` is given the records and their width, and yields where a record begins, the largest squared speed
        there and the limits by which it is laid. The records themselves stay: what the axes allow is asked again when
        the overrides change.
        """
        first, end = self._taken * self._width, self.state.run.pieces * self._width
        planned = self._planned = self._records[first:end]
        self._next = 0
        if not planned:
            return
        runs: list[tuple[int, Limits]] = []
        for at, entry2, limits in entries(planned, self._width):
            planned[at + PieceRecord.ENTRY2] = entry2
            if not runs or limits is not runs[-1][1]:
                runs.append((at, limits))
        if len(runs) == 1:
            self._kernels.backward(planned, len(self), self._axes, runs[0][1])
            return
        runs.append((len(planned), runs[-1][1]))
        for (begin, limits), (behind, _) in pairwise(runs):  # the axes rest in between
            run = planned[begin:behind]
            self._kernels.backward(run, len(run) // self._width, self._axes, limits)
            planned[begin:behind] = run

    @property
    def reach2(self) -> float:
        """Largest squared speed at which the next piece may be entered; 0 where none is planned."""
        return self._planned[self._next + PieceRecord.REACH2] if self._next < len(self._planned) else 0.0

    def rests_behind(self, row: float) -> bool:
        """Whether the axes shall rest behind a row, pieces of which are in front or have just been taken."""
        width, first = self._width, self._taken * self._width
        for k in range(len(self)):
            if self._records[first + k * width + PieceRecord.ROW] != row:
                at = self._next + k * width
                return at >= len(self._planned) or self._planned[at + PieceRecord.ENTRY2] == 0.0
        return True

    @property
    def ways_to_rest(self) -> tuple[float, float]:
        """Way of the pieces ahead up to where the axes shall rest, and up to where they rest in any case, mm."""
        width, way, stop = self._width, 0.0, -1.0
        for k, at in enumerate(range(self._taken * width, self.state.run.pieces * width, width)):
            planned = self._next + k * width
            if (
                stop < 0.0
                and planned < len(self._planned)
                and self._planned[planned + PieceRecord.ENTRY2] == 0.0
            ):
                stop = way
            if self._records[at + PieceRecord.PAUSE] > 0.0:
                break
            way += self._records[at + PieceRecord.LENGTH]
        return (way if stop < 0.0 else stop), way

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
        run = self.state.run
        reach = 0.5 * (sqrt(run.top2) * run.window if run.window else run.length)
        if run.chord:  # what bounds the joint before it has not been spread
            reach += self._records[(run.pieces - 1) * self._width + PieceRecord.LENGTH]
        return not self.is_open and self._way - self.front(PieceRecord.LENGTH) >= reach

    @property
    def is_open(self) -> bool:
        """Whether the piece in front belongs to a line from rest that rows to come may still go on with."""
        run = self.state.run
        return run.alone == 2.0 and run.pieces - run.straight_pieces <= self._taken

    @property
    def may_change(self) -> bool:
        """Whether a row to come may still bound the piece in front."""
        return self.is_open or (self.state.run.stop == 0.0 and (len(self) <= 1 or not self.reaches))
