"""Gantry axes: pairs that are coupled from power-on, of which a program knows the leading axis alone.

MD37100 tells the pair in its units digit, and in its tens digit whether an axis leads (0) or follows (1). Source: job
planning, glossary (gantry axis, synchronised axis); Function Manual G1 (MD37100).
"""

from __future__ import annotations

from polycnc.channel.moves.path import Rank, Stage
from polycnc.control.sinumerik.couplings.links import Couplings, Kind, Link, put
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.laws import Ratio

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.family import SinumerikChannel

_TYPE = "$MA_GANTRY_AXIS_TYPE"
FOLLOWS = 1


def close(channel: SinumerikChannel) -> None:
    """Power-on: the following axes go with their leading ones from where they stand; frames are not yet applied.

    Raises:
        AlarmError: 10651 for a following axis without a leading one, or a pair with two of these.
    """
    data = MachineData.of(channel)
    kinds = {column: data.integer(_TYPE, name) for column, name in enumerate(channel.axes)}
    for column, kind in kinds.items():
        role, pair = divmod(kind, 10)
        if role != FOLLOWS:
            continue
        leading = [other for other, of in kinds.items() if of == pair]
        if not pair or len(leading) != 1:
            raise AlarmError("10651", axis=channel.axes[column])
        origin = channel.coordinates.machine[leading[0]]
        put(channel, column, [Link(Kind.GANTRY, Ratio(leading[0], 1.0, origin))])
    if any(kind // 10 == FOLLOWS for kind in kinds.values()):
        channel.path.put(GantryStage(channel))


def moved_together(channel: SinumerikChannel, column: int) -> tuple[int, ...]:
    """An axis and those that go with it, also by hand: the pair, whichever of its axes is named."""
    links = Couplings.of(channel).links
    pairs = {
        following: link.law.leading
        for following, of in links.items()
        for link in of
        if link.kind is Kind.GANTRY
    }
    leading = pairs.get(column, column)
    return leading, *(following for following, other in pairs.items() if other == leading)


class GantryStage(Stage):
    """Refuses words of following axes: the program does not know them.

    Args:
        channel: The channel whose moves come by.
    """

    rank = Rank.GANTRY
    lasts = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel

    def move(self, move: Move) -> None:
        """Pass a move on; PC0018 for one of a following axis by itself."""
        for column, links in Couplings.of(self._channel).links.items():
            pair = [link for link in links if link.kind is Kind.GANTRY]
            if pair and abs(move.end[column] - move.start[column]) > NO_WAY:
                axes = self._channel.axes
                raise AlarmError("PC0018", axis=axes[column], leading=axes[pair[0].law.leading])
        self.after.move(move)
