"""Moves that were scanned, handed to the stages of the path: many at once where these can take them, else one by one.

A stage that takes runs (`Stage.takes_runs`) gets what the interpreter would give it: a move for each block, and the
end of the block behind it. Blocks without a row (a way of no length, a feed alone, a comment) and blocks that leave a
note end such a run: they are the interpreter's.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.channel.moves.path import Move, Run
from polycnc.language.bulk import layout
from polycnc.toolpath.kinds import CURVE_WIDTH, NO_CURVE, Kind

if TYPE_CHECKING:
    from array import array

    from polycnc.channel.channel import Channel
    from polycnc.language.bulk.layout import Scan

    Table = tuple[array[int], array[int], array[int], array[float], array[float], array[int], array[float]]

#: Moves that are handed over one by one at the most between two tries to hand over many.
MOST_PATIENCE = 64
_KINDS = tuple(Kind)


def leading_moves(first_line: int, at: Scan, columns: layout.Columns) -> int:
    """How many blocks from the first on are a move each, and nothing else."""
    lines = columns.line
    most = min(at.rows, columns.notes[layout.NoteRecord.LINE] - first_line) if at.notes else at.rows
    return next((i for i in range(most) if lines[i] != first_line + i), most)


class StagedRun:
    """The moves of a run on their way through the stages.

    Attributes:
        blocks: Blocks that have ended.
        moved: Moves that the stages have taken, or refused.
    """

    def __init__(self, channel: Channel, columns: Table) -> None:
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
        head, start = channel.path.head, channel.coordinates.position
        if head is None:
            raise ValueError("the path has no stage")
        run = self._run(start)
        patience = next_try = 0
        while self.moved < rows:
            i = self.moved
            if i >= next_try:
                taken = head.run(run.part(self._lines_from(i, rows), i)) if channel.turning is None else 0
                patience = 0 if taken > patience else min(2 * patience + 1, MOST_PATIENCE)
                self.moved = self.blocks = i + taken
                next_try = self.moved + patience
                if taken:
                    continue
            self.moved = i + 1
            head.move(self._move(run, i, first_curve))
            self.blocks = i + 1
            head.block()

    def _run(self, start: list[float]) -> Run:
        """All rows as a run."""
        channel = self._channel
        kinds, _, lines, feeds, ends, curves, _ = self._columns
        program, context = channel.level.program_number, channel.context_number()
        return Run(kinds, lines, feeds, ends, curves, start, program, context)

    def _lines_from(self, first: int, rows: int) -> int:
        """How many moves without a curve stand in a row."""
        curves = self._columns[5]
        return next((i for i in range(first, rows) if curves[i] != NO_CURVE), rows) - first

    def _move(self, run: Run, i: int, first_curve: int) -> Move:
        """One of the moves."""
        *_, curves, parameters = self._columns
        axes = len(run.start)
        start = run.ends[(i - 1) * axes : i * axes].tolist() if i else run.start
        end = run.ends[i * axes : (i + 1) * axes].tolist()
        move = Move(_KINDS[run.kinds[i]], start, end, run.feeds[i], run.program, run.lines[i], run.context)
        move.turning = self._channel.turning
        if curves[i] != NO_CURVE:
            place = (curves[i] - first_curve) * CURVE_WIDTH
            x, y, z, *normal, turns, _ = parameters[place : place + CURVE_WIDTH]
            move.center, move.normal, move.turns = (x, y, z), (normal[0], normal[1], normal[2]), turns
        return move
