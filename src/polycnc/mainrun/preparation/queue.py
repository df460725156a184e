"""What is prepared as a queue: its pieces are taken one by one, and laid out again for other overrides."""

from __future__ import annotations

from itertools import islice
from math import inf, sqrt

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.mainrun.motion.geometry import is_spiral, piece_cubic
from polycnc.mainrun.preparation.items import Block, BlockEnd, Move, Piece
from polycnc.mainrun.preparation.layout import Layout
from polycnc.motion.kernels.columns import SPLINE, TO_CORNER, PieceRecord

if TYPE_CHECKING:
    from array import array
    from collections import deque
    from collections.abc import Callable, Sequence

    from polycnc.mainrun.motion.geometry import Cubic
    from polycnc.mainrun.preparation.items import ChannelRates, Item
    from polycnc.mainrun.preparation.piece_buffer import PieceBuffer


class Queue:
    """What is prepared, and the piece that has been taken last.

    Args:
        items: What is prepared.
        buffer: The pieces of its moves.

    Attributes:
        layout: What its rows are laid out for.
        lay_back: Undoes what `lay_again` has done last.
    """

    def __init__(self, items: deque[Item], buffer: PieceBuffer) -> None:
        self.items, self._buffer = items, buffer
        self.layout = Layout()
        self._front: Move | None = None
        self._rounds = self._nears_corner = False
        self._parted: Move | None = None
        self.lay_back: Callable[[], None] = _nothing

    def pop_piece(self) -> tuple[Piece, array[Any]]:
        """Take the piece in front, and its record; its move leaves the queue with its last one."""
        move, buffer = self.items[0], self._buffer
        assert isinstance(move, Move)
        is_last = buffer.is_last_of_row
        record = buffer.take()
        if is_last:
            self.items.popleft()
        self._front = move
        return self._piece(move, record, is_last=is_last), record

    def pop_row(self) -> Piece:
        """Take the move in front with all its pieces, as one: a law leads along it, and no record does."""
        move, is_last = self.items.popleft(), False
        assert isinstance(move, Move)
        while not is_last:
            is_last = self._buffer.is_last_of_row
            self._buffer.take()
        self._front, move.done = move, 1.0
        return self._whole(move)

    @property
    def front_row(self) -> Piece:
        """The move from which a piece has been taken last, whole."""
        assert self._front is not None
        return self._whole(self._front)

    def _whole(self, move: Move) -> Piece:
        return Piece(
            move.way, move.row, move.kind, move.context, move.program, move.line, move.rapid, move.fixed,
            move.per_revolution, 0.0, move.by_axis, move.overridden, move.held, move.faster, move.largest_override,
            move.limits, move.total, 0.0, 1.0, inf, move.asked(0.5),
        )  # fmt: skip

    def drop_moves(self) -> None:
        """Take away the moves in front, up to what is no motion."""
        while self.items and isinstance(self.items[0], Move):
            self.pop_piece()

    @property
    def knows_hold(self) -> bool:
        """Whether feed hold stops in front of the next block: behind a tap it does, unless that block knows none."""
        contexts = (item.context for item in self.items if not isinstance(item, Block | BlockEnd))
        return next((context.feed_hold for context in contexts), True)

    def _piece(self, move: Move, record: array[Any], *, is_last: bool) -> Piece:
        """The piece of a move that a record tells."""
        share = 1.0 - move.done if is_last else record[PieceRecord.LENGTH] / move.total
        piece = Piece(
            move.way, move.row, move.kind, move.context, move.program, move.line, move.rapid, move.fixed,
            move.per_revolution, move.left if is_last else 0.0, move.by_axis, move.overridden, move.held,
            move.faster, move.largest_override, move.limits, record[PieceRecord.LENGTH], move.done, share,
            record[PieceRecord.CAP2], self.asked(move, record[PieceRecord.CAP2], record[PieceRecord.ASKED]),
            curve=self._curve(move, record), rise=risen(record, 0),
        )  # fmt: skip
        move.done += share
        return piece

    def asked(self, move: Move, cap2: float, asked: float) -> float:
        """Speed that the program asks for on a piece of a move, by CAP2 and ASKED of its record."""
        if move.grows and self.layout.free <= 1.0 and move.prepared is not None:
            return sqrt(cap2) / move.prepared.factor(self.layout)
        return asked or inf

    def _curve(self, move: Move, record: array[Any]) -> Cubic | None:
        """The curve of a piece; None if it is a part of the way of its row.

        A corner is not rounded if, when the axes come near it, they shall come to rest there.
        """
        zone = record[PieceRecord.ZONE]
        if zone == TO_CORNER and not self._nears_corner:
            self._rounds = not self._buffer.rests_behind(move.row)
        elif zone == 0.0:
            self._rounds = False
        self._nears_corner = zone == TO_CORNER
        is_curve = is_spiral(move.way) or move.kind == SPLINE or move.context.chords
        if self._rounds or (is_curve and zone == 0.0):
            return piece_cubic(record, len(move.way.start))
        return None

    def passes_corner(self, piece: Piece, record: array[Any]) -> bool:
        """Whether the axes would pass a corner that is not rounded, because they are near it already."""
        is_sharp = record[PieceRecord.ZONE] == TO_CORNER and piece.curve is None
        return is_sharp and not self._buffer.rests_behind(piece.row)

    def keep_to_corner(self) -> None:
        """The axes rest at the corner that they have come to: it is not rounded."""
        self._rounds = self._nears_corner = False

    def suits(self, rates: ChannelRates, *, at_rest: bool) -> bool:
        """Whether what is prepared is laid out for what the operator has set."""
        layout = layout_for(rates, self.layout)
        return layout == self.layout or (not at_rest and self.layout.covers(layout))

    def lay_again(
        self, rates: ChannelRates, row: float | None = None, way: float = 0.0, *, at_rest: bool = False
    ) -> tuple[Piece, array[Any], float] | None:
        """Lay what is prepared out for what the operator has set.

        Args:
            rates: Overrides.
            row: The row in execution, where the axes may still change how they run it.
            way: How far they have come since the beginning of the piece that has been taken last, mm.
            at_rest: The axes stand in front of what is prepared.

        Returns:
            The piece that takes the place of the one in execution, its record, and how far the axes have come on it.
        """
        before, buffer_back = (self.layout, list(self.items)), self._buffer.noted()
        front_done = self._front.done if self._front is not None else 0.0

        def back() -> None:
            buffer_back()
            self.layout, items = before
            self.items.clear()
            self.items.extend(items)
            if self._front is not None:
                self._front.done = front_done

        self.lay_back = back
        self.layout = layout_for(rates, self.layout)
        front = self._front if row is not None else None
        if front is not None and front.prepared is not None and front.row == row:
            whole = front.total * front.done if self._row_is_prepared(front) else front.total
            done = whole - self._buffer.last_length + way
            moves = [front, *(item for item in self.items if isinstance(item, Move) and item is not front)]
        else:
            front, done = None, 0.0
            moves = self._from_rest(at_rest=at_rest)
        rows = [move.prepared for move in moves if move.prepared is not None]
        if not rows or len(rows) < len(moves):
            return None
        found = self._buffer.lay_again(rows, self.layout, None if front is None else done)
        if found is None or front is None:
            return None
        record, on_piece = found
        is_prepared, is_last = self._row_is_prepared(front), not self._buffer.goes_on(front.row)
        if is_last and is_prepared:
            self.items.popleft()
        elif not is_last and not is_prepared:
            self.items.appendleft(front)
        front.done = max(done - on_piece, 0.0) / front.total
        return self._piece(front, record, is_last=is_last), record, on_piece

    def lay_alone(self, rates: ChannelRates) -> bool:
        """The straight row in front is a run of its own, from rest to rest: lay it out so; whether it was not.

        Where a law rests, as at a turn back, is known only when it is found; averages may pass such a corner.
        """
        if self._buffer.rests_around:
            return False
        moves = list(islice((item for item in self.items if isinstance(item, Move)), 2))
        for move in moves:  # and what comes behind it
            if move.prepared is not None:
                self._parted = None if move is moves[0] or move.prepared.rests else move
                move.prepared = replace(move.prepared, rests=True)
        self.lay_again(rates, at_rest=True)
        return True

    def join_rows(self, *, rests: bool = False) -> None:
        """Nothing asks for a rest behind the row that `lay_alone` has laid, or something does all the same."""
        if self._parted is not None and self._parted.prepared is not None:
            self._parted.prepared = replace(self._parted.prepared, rests=rests)

    def _row_is_prepared(self, move: Move) -> bool:
        """Whether pieces of a row are still to come."""
        return bool(self.items) and self.items[0] is move

    def _from_rest(self, *, at_rest: bool) -> list[Move]:
        """The moves that are prepared from the first one on before which the axes rest."""
        moves = [item for item in self.items if isinstance(item, Move)]
        if at_rest and moves and moves[0].done == 0.0:
            return moves
        begins = self._buffer.rows_from_rest()
        return next(
            (moves[k:] for k, move in enumerate(moves) if move.row in begins and move.done == 0.0), []
        )


def risen(records: Sequence[float], at: int) -> float:
    """By which factor what bounds x in a piece is larger at its end than at its start."""
    rise = records[at + PieceRecord.RISE]
    return 1.0 + rise * records[at + PieceRecord.LENGTH] / records[at + PieceRecord.CAP2] if rise else 1.0


def layout_for(rates: ChannelRates, before: Layout) -> Layout:
    """The layout for what the operator has set; at an override of 0 nothing moves, and it stays as it was."""
    if rates.influence.addend > 0.0:  # no factor of the feed says how fast that is
        return Layout(before.feed, before.spindle, 1.0)
    if rates.dry_run is not None:
        return Layout(before.feed, before.spindle, 2.0 if rates.dry_run.with_spindle else 1.0)
    return Layout(rates.feed or before.feed, rates.spindle or before.spindle)


def _nothing() -> None:
    """Nothing has been laid out again."""
