"""Pieces laid out anew: a row that begins elsewhere than its program has led the axes, a piece that was cut."""

from __future__ import annotations

from array import array
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

from polycnc.mainrun.geometry import Line
from polycnc.motion.kernels.alone import settle_alone
from polycnc.motion.kernels.columns import (
    BLOCKS,
    CAP2,
    ENTRY2,
    FORM,
    FREE,
    HAS_FRAME,
    INVERSE_TIME,
    LENGTH,
    LOW2,
    LOW_PULL,
    OFFSETS,
    PER_REVOLUTION,
    PIECES,
    POSITION,
    SPARE_PIECES,
    STATE_BLOCKS,
    STOP,
    TIMED,
    Rows,
    piece_width,
)
from polycnc.motion.kernels.lay import lay
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.mainrun.items import Piece

#: Rows that can begin elsewhere; every other one is run beside its path.
LINES = frozenset((Kind.RAPID, Kind.FEED, Kind.REF))
#: More than the pieces of a line and the room that the planner keeps free.
ROOM = 2 * SPARE_PIECES


def can_begin_elsewhere(piece: Piece) -> bool:
    """Whether the row of a piece is a line whose end counts, not its way."""
    return piece.kind in LINES and isinstance(piece.way, Line) and piece.context.transformation is None


def line_anew(
    piece: Piece, start: Sequence[float], fields: array[float], limits: array[float]
) -> tuple[array[float], list[Piece]]:
    """The rest of a row as a line from another start, machine coordinates: records of the planner, and pieces.

    Args:
        piece: A piece of the row.
        start: Where the axes stand.
        fields: What the planner knows of its context.
        limits: The machine, as the planner's kernels take it.
    """
    n = len(start)
    width, own = piece_width(n), fields[:]
    own[HAS_FRAME] = own[PER_REVOLUTION] = own[INVERSE_TIME] = 0.0
    own[OFFSETS : OFFSETS + n] = array("d", bytes(8 * n))
    state = array("d", bytes(8 * (STATE_BLOCKS + BLOCKS * n)))
    state[STOP] = state[FREE] = 1.0
    state[LOW2] = state[LOW_PULL] = inf
    first = STATE_BLOCKS + POSITION * n
    state[first : first + n] = array("d", start)
    end = array("d", piece.way.end)
    records = array("d", bytes(8 * width * ROOM))
    rows = Rows([piece.kind], [0], [piece.asked if piece.asked < inf else 0.0], end, [-1], [], [], [], [])
    lay(rows, 0, array("d"), piece.row, own, limits, records, state)
    settle_alone(records, n, limits, state)
    del records[int(state[PIECES]) * width :]
    way = Line(tuple(start), tuple(end))
    total = sum(records[LENGTH::width])
    pieces, done = [], 0.0
    for at in range(0, len(records), width):
        share = records[at + LENGTH] / total
        pieces.append(
            replace(
                piece, way=way, length=records[at + LENGTH], first=done, share=share, left=0.0,
                entry2=records[at + ENTRY2], cap2=records[at + CAP2], by_axis=records[at + FORM] == TIMED,
            )
        )  # fmt: skip
        done += share
    return records, pieces


def parts_of(piece: Piece, lengths: list[tuple[float, int]], records: Sequence[float]) -> Iterator[Piece]:
    """A piece as its records say now: bounds, and the parts that it was cut into."""
    if len(lengths) == 1:
        piece.entry2, piece.cap2 = (records[lengths[0][1] + field] for field in (ENTRY2, CAP2))
        yield piece
        return
    first = piece.first
    for k, (length, at) in enumerate(lengths):
        is_last = k == len(lengths) - 1
        share = piece.first + piece.share - first if is_last else piece.share * length / piece.length
        yield replace(
            piece, first=first, share=share, length=length, entry2=records[at + ENTRY2], cap2=records[at + CAP2],
            left=piece.left if is_last else 0.0,
        )  # fmt: skip
        first += share
