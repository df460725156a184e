"""Rows of the channel laid out as moves of the queue, each with the pieces of path that the planner makes of it."""

from __future__ import annotations

from array import array
from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.motion.geometry import row_arc, row_line, turn_arc
from polycnc.mainrun.preparation.items import Move
from polycnc.mainrun.preparation.layout import Before, PreparedRow
from polycnc.mainrun.preparation.run_blocks import largest_override
from polycnc.motion.kernels.columns import (
    SHARES,
    ContextRecord,
    Form,
    PieceRecord,
    Rows,
    piece_width,
)
from polycnc.motion.kernels.feeds import faster, growth_of, is_rapid
from polycnc.motion.third_order.laying.rows import goes_by_law
from polycnc.motion.time_constants import Use, use_of
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.kinds import ARC_KINDS, CURVE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.mainrun.preparation.piece_buffer import PieceBuffer
    from polycnc.mainrun.preparation.queue import Queue
    from polycnc.motion.demand import Bounds
    from polycnc.motion.pole import Turn
    from polycnc.motion.standing.waits import Parallel
    from polycnc.motion.time_constants import Uses
    from polycnc.motion.transformed import RealAxes
    from polycnc.toolpath import Toolpath
    from polycnc.toolpath.motion_settings import MotionSettings
    from polycnc.toolpath.table import Chunk

#: Kinds of rows that may be arcs, and those that the spindle leads.
ARC_WAYS = frozenset((*ARC_KINDS, Kind.THREAD))
BOUND_TO_SPINDLE = frozenset((Kind.THREAD, Kind.TAP))
#: Nothing among the moves themselves lets the axes stand.
NO_STOPS = array("B")


class RowLayer:
    """Lays rows out.

    Args:
        toolpath: Whose rows they are.
        queue: Takes the moves.
        buffer: Takes their pieces.

    Attributes:
        real: What leads the axes of the machine; set by `use`.
        facing: Column of the axis that turning diameters are measured along; -1 without one.
        context: What holds in the row laid last.
        skips: A skip move has been laid since this was last reset.
    """

    def __init__(self, toolpath: Toolpath, queue: Queue, buffer: PieceBuffer) -> None:
        self._toolpath, self._queue, self._buffer = toolpath, queue, buffer
        self._axes = len(toolpath.axes)
        self._settings: MotionSettings
        self.real: RealAxes
        self._uses: Uses
        self.facing = -1
        self.context = Context()
        self.skips = self._by_law = self._has_laws = False

    def use(self, real: RealAxes, settings: MotionSettings, uses: Uses) -> None:
        """Say what leads the axes, and how the control does it."""
        self.real, self._settings, self._uses = real, settings, uses
        limits = self._buffer.limits = real.limits(None)
        self.facing = limits.geometry[0]

    def use_of(self, kind: int, context: Context) -> Use:
        """What a row of a kind runs by."""
        return use_of(kind, context, self._uses)

    def lay(self, chunk: Chunk, row: int, bounds: Bounds) -> None:
        """Lay a move out; one through the pole of a transformation in legs, the rotary axis turning between them."""
        n, number = self._axes, chunk.first + row
        self.context = self._toolpath.contexts[chunk.context[row]]
        if row in bounds.enters:
            self._buffer.end_in_rest()
            self._buffer.stand_at(bounds.enters[row])
        own, shares = slice(row, row + 1), slice(row * SHARES, (row + 1) * SHARES)
        if row not in bounds.legs:
            rows = Rows(
                chunk.kind[own], chunk.context[own], bounds.paced(chunk.feed[own], own),
                chunk.end[row * n : (row + 1) * n], chunk.curve[own], NO_STOPS,
                *(column[shares] for column in bounds.shares),
            )  # fmt: skip
            self._lay_row(chunk, row, rows, chunk.curves, number)
            return
        legs, feed = bounds.legs[row], bounds.paced(chunk.feed[own], own)[0]
        for k, leg in enumerate(legs):
            called = number + (k + 1) / (len(legs) + 1)
            if leg.turn is not None:
                self._turn(leg.turn, chunk, row, called - 0.5 / (len(legs) + 1))
            self._lay_row(chunk, row, leg.at_feed(feed), leg.curves, called)
            self._buffer.end_in_rest()

    def go_on_beside(
        self, beside: list[Parallel], chunk: Chunk, row: int, bounds: Bounds
    ) -> tuple[list[Parallel], bool]:
        """Behind a row, the functions beside blocks that go on, and whether one outlasts a block that ends there."""
        number = chunk.first + row
        open_yet = [entry for entry in beside if entry.last > number]
        ended = [entry for entry in beside if entry.last <= number]
        return open_yet, any(self._least_seconds(entry, chunk, bounds) < entry.seconds for entry in ended)

    def _least_seconds(self, entry: Parallel, chunk: Chunk, bounds: Bounds) -> float:
        """The least time of the block of a function."""
        seconds, first = None, chunk.first
        if self._has_laws:
            from polycnc.motion.third_order.laying.least import ChunkRows

            feed, shares = bounds.paced(chunk.feed), bounds.shares
            rows = Rows(chunk.kind, chunk.context, feed, chunk.end, chunk.curve, NO_STOPS, *shares)
            told = self._toolpath.contexts, self._buffer.tables, self.real, self._uses
            block = ChunkRows(rows, chunk.curves, first, bounds.enters, *told)
            seconds = block.least_seconds(entry.row + 1 - first, entry.last - first, self._axes)
        return self._buffer.least_seconds(entry.row) if seconds is None else seconds

    def _turn(self, turn: Turn, chunk: Chunk, row: int, called: float) -> None:
        """The rotary axis turns at the pole."""
        context, kind = self._toolpath.contexts[chunk.context[row]], chunk.kind[row]
        records = self.real.turn(turn, context, kind, called, 0)
        before, rests = Before.of(self._buffer.state), self._buffer.note_rest()
        limits = self.real.limits(context)
        prepared = PreparedRow(
            None, array("d"), 0, called, limits, 0.0, context, False, rests, before, records
        )
        self._buffer.lay(prepared, self._queue.layout)
        way = turn_arc(turn, records, self._axes)
        program, line, rapid = (
            self._toolpath.programs[chunk.program[row]],
            chunk.line[row],
            kind == Kind.RAPID,
        )
        total = sum(records[PieceRecord.LENGTH :: piece_width(self._axes)])
        self._queue.items.append(
            Move(
                way, called, kind, context, program, line, rapid, False, False, 0.0, False, False, False, 1.0,
                inf, limits, ((1.0, inf),), total, prepared,
            )
        )  # fmt: skip

    def _lay_row(self, chunk: Chunk, row: int, rows: Rows, curves: array[float], called: float) -> None:
        """Lay a row or a leg of it out as pieces."""
        n, buffer, kind = self._axes, self._buffer, chunk.kind[row]
        context = self._toolpath.contexts[chunk.context[row]]
        use = self.use_of(kind, context)
        start, limits = tuple(buffer.position), self.real.limits(context, use)
        record = chunk.context[row] * (ContextRecord.OFFSETS + n)
        per_revolution = buffer.contexts[record + ContextRecord.PER_REVOLUTION] != 0.0
        by_law = goes_by_law(kind, record, buffer.contexts, limits)
        if by_law is not self._by_law:  # the axes rest where a law begins to lead, or ends
            buffer.end_in_rest()
        self._by_law, self._has_laws = by_law, self._has_laws or by_law
        before, rests = Before.of(buffer.state), buffer.note_rest()
        prepared = PreparedRow(
            rows,
            curves[:],
            chunk.first + row,
            called,
            limits,
            rows.feed[0],
            context,
            per_revolution,
            rests,
            before,
            use=use,
            led=buffer.limits if use is not buffer.use else None,
        )
        found = buffer.lay(prepared, self._queue.layout)
        if not found:
            return
        self.skips = self.skips or kind == Kind.SKIP
        form = buffer.field(found[0], PieceRecord.FORM)
        # The first piece may be bent by the corner before it, also that of a straight thread.
        is_arc = kind in ARC_WAYS and buffer.field(found[-1], PieceRecord.FORM) != Form.STRAIGHT
        way = row_arc(start, buffer.state, limits) if is_arc else row_line(start, buffer.state)
        self._queue.items.append(
            Move(
                way,
                called,
                kind,
                context,
                self._toolpath.programs[chunk.program[row]],
                chunk.line[row],
                is_rapid(buffer.state),
                kind in BOUND_TO_SPINDLE,
                per_revolution,
                chunk.curves[chunk.curve[row] * CURVE_WIDTH]
                if kind == Kind.SKIP and chunk.curve[row] >= 0
                else 0.0,
                form == Form.TIMED,
                kind == Kind.TAP and self._settings.taps_overridden,
                kind == Kind.TAP and self._settings.taps_held,
                faster(chunk.curves, buffer.state),
                largest_override(chunk, row),
                limits,
                self._asks(found),
                sum(buffer.field(at, PieceRecord.LENGTH) for at in found),
                prepared,
                grows=growth_of(chunk.curves, buffer.state) != 0.0,
            )
        )

    def _asks(self, found: Sequence[int]) -> tuple[tuple[float, float], ...]:
        """Speeds that the program asks for in the row laid last, by shares of its way; `found` are its pieces."""
        field, done = self._buffer.field, 0.0
        total, asks = sum(field(at, PieceRecord.LENGTH) for at in found), list[tuple[float, float]]()
        for at in found:
            done += field(at, PieceRecord.LENGTH) / total
            speed = field(at, PieceRecord.ASKED) or inf
            if asks and asks[-1][1] == speed:
                asks.pop()
            asks.append((done, speed))
        return tuple(asks)
