"""The blocks of the main run: those of the program, and the intermediate ones that it makes of them.

A rounding that the control puts between two rows (`CornerMode.ROUNDED`) is a block here, but no row: the rows keep
their corner, and the axes round it. It begins where the corner is, and the next block with it.
"""

from __future__ import annotations

from itertools import islice, pairwise, takewhile
from math import hypot

from polycnc.channel.interpolator import BlockKind
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.preparation.items import Block, BlockEnd, Move
from polycnc.toolpath.context import PROGRAMMED, SHORTENED
from polycnc.toolpath.modes import CornerMode

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from polycnc.mainrun.motion.geometry import Segment
    from polycnc.mainrun.preparation.items import Item, Row

#: A share of a way over which its direction is taken.
_NEAR = 1e-6
#: Unit vectors that differ by less are one direction: there is no corner, nor where the path turns back.
_SAME_DIRECTION = 1e-6


class BlockParts:
    """Counts the blocks of one channel as they begin.

    Args:
        geometry: Columns of X, Y, Z, -1 for a missing one.

    Attributes:
        number: How many blocks have begun.
        kind: What the block in execution is.
        passed: Way of the rows in front of the one in execution that make one motion with it, mm.
    """

    def __init__(self, geometry: Sequence[int]) -> None:
        self._axes = [column for column in geometry if column >= 0]
        self.number = 0
        self.kind = BlockKind()
        self.passed = 0.0
        self._move: Move | None = None
        self._own: Move | None = None
        self._modal: Mapping[str, str] = {}
        self._is_counted = self._is_cut = False

    def block(self, ahead: Iterable[Item]) -> Iterator[bool]:
        """A block of the program begins.

        Args:
            ahead: What comes next.

        Yields:
            For each block that begins, while it is the one in execution: whether it is the program's own.
        """
        own = takewhile(lambda item: not isinstance(item, Block) or item.is_silent, ahead)
        following = next((item for item in own if isinstance(item, Move)), None)
        rounds = following is not None and self._rounds(following)
        if rounds:
            self._begin(BlockKind(rounding=self._modal))
            yield False
        self._begin(BlockKind(following.context.origin if following is not None else PROGRAMMED))
        self._own, self._is_counted, self._is_cut = following, True, rounds
        yield True

    def row(self, move: Move, modal: Mapping[str, str]) -> Iterator[bool]:
        """A row begins, where codes are active; gives false for each block that begins with it."""
        before, counted = self._move, self._is_counted
        if before is move:
            return
        goes_on = before is not None and before.context.knot and not counted
        self.passed = self.passed + before.total if before is not None and goes_on else 0.0
        rounds = not counted and self._rounds(move)
        rounded_by = self._modal
        self._move, self._modal, self._is_counted = move, modal, False
        self._own = move
        origin, was = move.context.origin, before.context.origin if before is not None else PROGRAMMED
        goes_on = before is None or goes_on or max(origin, was) <= SHORTENED
        if counted or (goes_on and not rounds):
            self.kind = BlockKind(origin)
            return
        if rounds:
            self._begin(BlockKind(rounding=rounded_by))
            yield False
        self._begin(BlockKind(origin))
        self._is_cut = rounds
        yield False

    def coming(self, row: Row, ahead: Iterable[Item]) -> float:
        """Way of the rows behind the one in execution that make one motion with it, mm; `ahead` comes."""
        way, goes_on = 0.0, row.context.knot
        for item in ahead:
            if not goes_on or isinstance(item, BlockEnd):
                break
            if isinstance(item, Move) and item is not row and item is not self._move:
                way, goes_on = way + item.total, item.context.knot
        return way

    def _begin(self, kind: BlockKind) -> None:
        self.number, self.kind, self._is_cut = self.number + 1, kind, False

    def split(self, ahead: Iterable[Item]) -> tuple[bool, bool]:
        """Whether the block in execution is not as programmed, and whether the one behind it is not; `ahead` comes."""
        if self.kind.rounding is not None:
            return True, True
        move = self._own
        if move is None:
            return False, False
        rows = [move, *islice((row for row in ahead if isinstance(row, Move) and row is not move), 2)]
        rounded = [self._is_rounded(one, two) for one, two in pairwise(rows)]
        goes_on = any(rounded) or any(row.context.origin != PROGRAMMED for row in rows[1:2])
        return self._is_cut or any(rounded[:1]) or self.kind.origin != PROGRAMMED, goes_on

    def _rounds(self, move: Move) -> bool:
        """Whether a rounding lies between the last row and another one."""
        before = self._move
        return before is not None and before is not move and self._is_rounded(before, move)

    def _is_rounded(self, one: Move, two: Move) -> bool:
        context = one.context
        from_distance = context.corner_mode is CornerMode.ROUNDED_FROM and context.tolerance_mm > 0.0
        rests = two.prepared is None or two.prepared.rests
        if rests or context.knot or not (from_distance or context.corner_mode is CornerMode.ROUNDED):
            return False
        out, into = direction(one.way, 1.0, self._axes), direction(two.way, 0.0, self._axes)
        pairs = tuple(zip(out, into, strict=True))
        goes_on = all(abs(a - b) <= _SAME_DIRECTION for a, b in pairs)
        turns_back = all(abs(a + b) <= _SAME_DIRECTION for a, b in pairs)
        return any(out) and any(into) and not goes_on and not turns_back


def direction(way: Segment, share: float, axes: Sequence[int]) -> list[float]:
    """Unit vector of a way at its start (0) or its end (1), on some axes; all zero where none of them moves."""
    first, last = (0.0, _NEAR) if share == 0.0 else (1.0 - _NEAR, 1.0)
    start, end = way.at(first), way.at(last)
    along = [end[axis] - start[axis] for axis in axes]
    length = hypot(*along)
    return [value / length for value in along] if length else along
