"""Blocks that describe a contour: a contour program of a cycle, the outline of a protection zone.

They run as they are, but the tool stays where it is: their moves end in a recorder, and what they have changed is put
back behind them, or by a reset.
"""

from __future__ import annotations

from math import isnan

from polycnc.channel.moves.path import Recorder
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.motion.last_move import LastMove
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Container

    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Before a contour is read the tool is thought this far away, mm: so the first block always is a move, and an axis
#: that it does not name shows that.
AWAY_MM = 1e6
#: Feed of a contour where none was programmed; no program means one like it.
ANY_FEED = 1e-9


def without_away(value: float) -> float:
    """A value of a contour's point; an axis that the first block does not name stays where the tool stands."""
    return value - AWAY_MM if value > AWAY_MM / 2.0 else value


@dataclass(slots=True, eq=False)
class ContourReading:
    """A contour that is being read, and what it must not change.

    Attributes:
        position: Where the tool stands.
        feed: The feed before; NaN for none.
        last: The last move before.
        modes: The modal functions before, where the contour may not change them.
        recorder: What catches the moves; the first one leads to the first point.
        arcs_need_centre: Under a modal G2 or G3 a block with an end point alone is an error; else it is a straight
            line, as the manual's example of CONTDCON has it (job planning 15.3).
    """

    position: list[float]
    feed: float
    last: LastMove
    modes: object = None
    recorder: Recorder = field(default_factory=Recorder)
    arcs_need_centre: bool = True

    def begin(self, channel: SinumerikChannel, columns: Container[int], by: float = AWAY_MM) -> None:
        """The tool is thought away in these columns (-1 for none), and moves are caught."""
        Readings.of(channel).open.append(self)
        away = [value + by if i in columns else value for i, value in enumerate(self.position)]
        channel.coordinates.arrive(away)
        channel.feed = channel.feed if channel.feed > 0.0 else ANY_FEED
        channel.path.divert(self.recorder)

    def end(self, channel: SinumerikChannel) -> list[Move]:
        """The contour is through, or abandoned: everything is as before. Gives its moves."""
        Readings.of(channel).open.remove(self)
        channel.flush()
        channel.path.resume(self.recorder)
        if self.modes is not None:
            channel.control.restore(channel, self.modes)
            channel.feed = self.feed
        elif isnan(self.feed) and channel.feed == ANY_FEED:
            channel.feed = self.feed
        channel.coordinates.arrive(self.position)
        last = LastMove.of(channel)
        last.start, last.arc = self.last.start, self.last.arc
        return self.recorder.moves


@dataclass(slots=True)
class Readings(State, lifetime=Lifetime.POWER):
    """The contours that are being read, the innermost last."""

    open: list[ContourReading] = field(default_factory=list)


def reading_from_here(
    channel: SinumerikChannel, *, keeps_modes: bool, recorder: Recorder | None = None
) -> ContourReading:
    """A contour is going to be read: what there is before; with `keeps_modes` also the modal functions."""
    from copy import copy

    channel.flush()
    modes = channel.control.save(channel) if keeps_modes else None
    return ContourReading(
        channel.coordinates.position.copy(),
        channel.feed,
        copy(LastMove.of(channel)),
        modes,
        recorder or Recorder(),
    )


def takes_lines_for_arcs(channel: SinumerikChannel) -> bool:
    """Whether an arc without any word of its centre is a straight line now."""
    return any(not reading.arcs_need_centre for reading in Readings.of(channel).open)


def abandon(channel: SinumerikChannel) -> None:
    """A reset: no contour is being read any more."""
    for reading in reversed(Readings.of(channel).open.copy()):
        reading.end(channel)
