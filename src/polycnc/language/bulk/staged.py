"""Moves that were scanned, handed to the stages of the path one by one: radius compensation looks at every one.

A stage that takes runs (`Stage.takes_runs`) gets what the interpreter would give it: a move for each block, and the
end of the block behind it. Blocks without a row (a way of no length, a feed alone, a comment) and blocks that leave a
note end such a run: they are the interpreter's.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.channel.moves.path import Move
from polycnc.language.bulk import layout
from polycnc.toolpath.kinds import Kind
from polycnc.toolpath.table import CURVE_WIDTH, NO_CURVE

if TYPE_CHECKING:
    from array import array

    from polycnc.channel.channel import Channel
    from polycnc.kernels.layout import Ints
    from polycnc.language.bulk.layout import Scan

    Columns = tuple[array[int], array[int], array[float], array[float], array[int], array[float]]

#: Blocks that are scanned for stages at a time: what is scanned behind the end of a run is scanned again.
MOST_BLOCKS = 128
_KINDS = tuple(Kind)


def leading_moves(first_line: int, at: Scan, columns: Columns, notes: Ints) -> int:
    """How many blocks from the first on are a move each, and nothing else."""
    lines = columns[1]
    most = min(at.rows, notes[layout.NoteRecord.LINE] - first_line) if at.notes else at.rows
    return next((i for i in range(most) if lines[i] != first_line + i), most)


class StagedRun:
    """The moves of a run on their way through the stages.

    Attributes:
        blocks: Blocks that have ended.
        moved: Moves that the stages have taken, or refused.
    """

    def __init__(self, channel: Channel, columns: Columns) -> None:
        self._channel = channel
        self._columns = columns
        self.blocks = self.moved = 0

    def lead(self, rows: int, first_curve: int) -> None:
        """Hand over the moves of so many rows; raises the alarm that a stage finds in one.

        Args:
            rows: How many.
            first_curve: Number that the first arc of the run has in its row.
        """
        channel = self._channel
        kinds, lines, feeds, ends, curves, parameters = self._columns
        head, start = channel.path.head, channel.coordinates.position
        if head is None:
            raise ValueError("the path has no stage")
        program, context, axes = channel.level.program_number, channel.context_number(), len(start)
        for i in range(rows):
            end = ends[i * axes : (i + 1) * axes].tolist()
            move = Move(_KINDS[kinds[i]], start, end, feeds[i], program, lines[i], context)
            move.turning = channel.turning
            if curves[i] != NO_CURVE:
                place = (curves[i] - first_curve) * CURVE_WIDTH
                x, y, z, *normal, turns, _ = parameters[place : place + CURVE_WIDTH]
                move.center, move.normal, move.turns = (x, y, z), (normal[0], normal[1], normal[2]), turns
            self.moved = i + 1
            head.move(move)
            self.blocks = i + 1
            head.block()
            start = end
