"""Axes that are beside their path because an operator has moved them: where the program has to look first."""

from __future__ import annotations

from polycnc.channel.intervention import NOTHING_BACK
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.mainrun.motion.geometry import Line
from polycnc.mainrun.preparation.items import Block, Move
from polycnc.mainrun.preparation.reapproach import can_begin_elsewhere
from polycnc.motion.frames import real_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.mainrun.axes.channel_axes import ChannelAxes
    from polycnc.mainrun.preparation.items import Item, Piece
    from polycnc.messages import AlarmError

#: Points at which an arc beside its path is held against the limits.
ARC_POINTS = 48


def stops_beside(block: Block | None, axes: ChannelAxes, channel: Channel) -> Callable[[Item], bool]:
    """Says of one item after the other whether the axes stand in front of it: it leads them back, or too far."""
    back = block.takes_back if block is not None else NOTHING_BACK

    def stops(item: Item) -> bool:
        nonlocal back
        if isinstance(item, Block):
            back = item.takes_back
            return axes.is_pending(back.at_once | back.by_move)
        if not isinstance(item, Move):
            return False
        leads_back = item.done == 0.0 and axes.is_pending(back.by_move)
        return leads_back or beyond_limits(item, axes, channel) is not None

    return stops


def beyond_limits(move: Move, axes: ChannelAxes, channel: Channel) -> AlarmError | None:
    """The alarm of a move that would lead the axes, which are beside the path, out of their limits."""
    shares = (1.0,) if isinstance(move.way, Line) else (k / ARC_POINTS for k in range(1, ARC_POINTS + 1))
    for share in shares:
        place = move.way.at(share)
        end = axes.without_hand(real_of(place, move.context, channel.coordinates.geometry))
        for axis, (value, (low, high)) in enumerate(zip(end, channel.limits, strict=False)):
            if not low - NO_WAY <= value <= high + NO_WAY:
                error: AlarmError = channel.control.over_travel(channel.axes[axis], 1 if value > high else -1)
                error.line = move.line
                return error
    return None


def taken_back(
    block: Block | None, piece: Move | Piece, here: Sequence[float], axes: ChannelAxes
) -> list[float] | None:
    """Where the row of a piece begins if it takes back what axes were moved; None where it does not do that."""
    if block is None or not can_begin_elsewhere(piece):
        return None
    back = block.takes_back
    moved = sum(1 << i for i, (a, b) in enumerate(zip(here, piece.way.end, strict=True)) if a != b)
    columns = back.at_once | (back.by_move & moved)
    if not axes.is_pending(columns):
        return None
    return [a + b for a, b in zip(here, axes.take_back(columns), strict=True)]
