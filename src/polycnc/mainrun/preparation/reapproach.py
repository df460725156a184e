"""A row that begins elsewhere than its program has led the axes: laid out again as a line from rest to rest."""

from __future__ import annotations

from array import array
from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.motion.geometry import Line
from polycnc.mainrun.preparation.items import Move, Piece
from polycnc.motion.kernels.chords import settle
from polycnc.motion.kernels.columns import (
    SPARE_PIECES,
    ContextRecord,
    Form,
    Limits,
    PieceRecord,
    Rows,
    new_state,
    piece_width,
)
from polycnc.motion.kernels.lay import lay
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence


#: Rows that can begin elsewhere; every other one is run beside its path.
LINES = frozenset((Kind.RAPID, Kind.FEED, Kind.REF))
#: More than the pieces of a line and the room that the planner keeps free.
ROOM = 2 * SPARE_PIECES


def can_begin_elsewhere(piece: Move | Piece) -> bool:
    """Whether a row is a line whose end counts, not its way."""
    return piece.kind in LINES and isinstance(piece.way, Line) and piece.context.transformation is None


def line_from(
    move: Move | Piece, start: Sequence[float], fields: array[float], limits: Limits
) -> tuple[array[float], list[Move]]:
    """The rest of a row as a line from another start, machine coordinates: records of the planner, and the move if any.

    Args:
        move: The row, or a piece of it.
        start: Where the axes stand.
        fields: What the planner knows of its context.
        limits: The machine, as the planner's kernels take it.
    """
    n = len(start)
    width, own = piece_width(n), fields[:]
    own[ContextRecord.HAS_FRAME] = own[ContextRecord.PER_REVOLUTION] = own[ContextRecord.INVERSE_TIME] = 0.0
    own[ContextRecord.OFFSETS : ContextRecord.OFFSETS + n] = array("d", bytes(8 * n))
    own[ContextRecord.LED] = 0.0
    state = new_state(n, start)
    state.run.free = 1.0
    end = array("d", move.way.end)
    asked = move.asked if isinstance(move, Piece) else move.asked(1.0)
    records = array("d", bytes(8 * width * ROOM))
    rows = Rows([move.kind], [0], [asked if asked < inf else 0.0], end, [-1], [], [], [], [])
    lay(rows, 0, array("d"), int(move.row), own, limits, records, state)
    settle(records, n, limits, state)
    del records[state.run.pieces * width :]
    for at in range(0, len(records), width):
        records[at + PieceRecord.ASKED] = rows.feed[0]
    if not records:
        return records, []
    move_from_here = Move(
        Line(tuple(start), tuple(end)), move.row, move.kind, move.context, move.program, move.line,
        move.rapid, move.fixed, move.per_revolution, 0.0, records[PieceRecord.FORM] == Form.TIMED,
        move.overridden, move.held, move.faster, move.largest_override, limits, ((1.0, asked),),
        sum(records[PieceRecord.LENGTH::width]),
    )  # fmt: skip
    return records, [move_from_here]
