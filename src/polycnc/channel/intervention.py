"""What an operator does while a program waits: axes moved by hand, blocks typed in."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple


class TakesBack(NamedTuple):
    """The axes of which a block takes a manual intervention back, as bit masks of channel axes.

    It is taken back in a straight line to the end of a move, where manual absolute was on
    (`mainrun/axes/manual_offset.py`).

    Attributes:
        at_once: In the first line of the block, whether that moves the axis or not: axes named absolutely.
        by_move: In the first line that moves the axis: axes of a cycle.
    """

    at_once: int = 0
    by_move: int = 0


NOTHING_BACK = TakesBack()


class MovedByHand(NamedTuple):
    """What an operator has moved in front of a block that was not prepared yet: the program goes on from there.

    Attributes:
        machine: Where the axes stand since, machine position.
        way: What they were moved.
    """

    machine: tuple[float, ...]
    way: tuple[float, ...]
