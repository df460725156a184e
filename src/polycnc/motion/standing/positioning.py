"""Axes that go to a place by themselves, beside the path: when they begin, and what waits until they are there.

The plan follows them as the main run does (`mainrun/axes/commanded.py`): by phases of constant acceleration out of
whatever the axis does, averaged over the same time where its jerk is limited.
"""

from __future__ import annotations

from bisect import bisect_left
from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.limits import channel_axes
from polycnc.motion.standing.beside import Awaits, Begins
from polycnc.toolpath import Kind
from polycnc.toolpath.events import AxesAwaited, AxesPositioned, Deed
from polycnc.toolpath.modes import AccelerationMode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.machine.model import Axis, Machine
    from polycnc.motion.phases.axis_move import AxisMove
    from polycnc.motion.settings import Settings
    from polycnc.motion.standing.beside import Step
    from polycnc.toolpath import Event, Toolpath
    from polycnc.toolpath.motion_settings import MotionSettings
    from polycnc.toolpath.table import Chunk

#: Acceleration of an axis that the machine file gives none.
AT_ONCE = 1e9


def own_ramp_s(axis: Axis, settings: MotionSettings) -> float:
    """Seconds over which motions of an axis by itself are averaged: 0 where its jerk is not limited."""
    limited = settings.acceleration is AccelerationMode.JERK_LIMITED and axis.jerk > 0.0
    return 2.0 * axis.acceleration / axis.jerk if limited else 0.0


class AxisOnItsWay:
    """An axis on its way to a place; satisfies `Work`.

    Args:
        column: Its column.
        axis: What the machine says of it.
        ramp_s: Seconds over which its motion is averaged.
        start: Where it rests before, mm or degrees.
        speed: How fast it goes, mm/s or degrees/s.
        before: The way that it may still be on.

    Attributes:
        column: Its column.
        ramp_s: As above.
        left_s: Seconds until it is there.
        move: Its motion, by seconds from the time at which it begins; None before.
    """

    share = "rapid_s"

    def __init__(
        self,
        column: int,
        axis: Axis,
        ramp_s: float,
        start: float,
        speed: float,
        before: AxisOnItsWay | None,
    ) -> None:
        self.column, self.ramp_s, self.left_s = column, ramp_s, 0.0
        self._axis, self._start, self._speed, self._before = axis, start, speed, before
        self._seconds = 0.0
        self.move: AxisMove | None = None

    def begin(self, aim: float, since: float | None = None) -> None:  # noqa: ARG002 - it is where it is
        """It goes to its place, out of the way that it is on."""
        from polycnc.motion.phases.axis_move import axis_move

        place, velocity, before = self._start, 0.0, self._before
        if before is not None and before.move is not None and before.left_s > 0.0:
            place, velocity = before.move.after(before._seconds - before.left_s)  # noqa: SLF001 - of its own kind
            before.left_s = 0.0
        self._before = None
        speed = min(self._speed, self._axis.rapid or inf)
        self.move = axis_move(place, velocity, aim, speed, self._axis.acceleration or AT_ONCE, 0.0)
        self._seconds = self.left_s = self.move.end + self.ramp_s


class PositionedAxes:
    """Makes steps of what events say of axes that are positioned.

    Args:
        machine: The machine.
        channel: Number of the channel.
        names: Columns of the toolpath.
        settings: How the control leads the axes.
    """

    def __init__(self, machine: Machine, channel: int, names: tuple[str, ...], settings: Settings) -> None:
        self._axes, self._settings = channel_axes(machine, channel, names), settings
        self._ways: dict[int, AxisOnItsWay] = {}

    def steps(self, event: Event, row: int, context: int) -> Iterator[Step]:
        """What an event of a row begins, or waits for: behind all that its row waits for otherwise."""
        if isinstance(event, AxesPositioned):
            for (column, place), start, speed in zip(event.places, event.starts, event.speeds, strict=True):
                axis = self._axes[column]
                if axis is None:
                    continue
                before, ramp_s = self._ways.get(column), own_ramp_s(axis, self._settings)
                way = self._ways[column] = AxisOnItsWay(column, axis, ramp_s, start, speed, before)
                yield Begins(row + 1, way, place)
        elif isinstance(event, AxesAwaited):
            for column in event.columns:
                if column in self._ways:
                    yield Awaits(row + 1, self._ways[column], context)


def rests_of(toolpath: Toolpath, chunk: Chunk) -> set[int]:
    """Rows of a chunk, from 0, before which the axes rest because nothing was prepared beyond."""
    rests, first, end = toolpath.rests, chunk.first, chunk.first + len(chunk)
    return {row - first for row in rests[bisect_left(rests, first) : bisect_left(rests, end)]}


def places_of(toolpath: Toolpath, chunk: Chunk) -> dict[int, dict[int, float]]:
    """Where the path has axes from a row on without leading them there: by row of a chunk, from 0, and column."""
    end = chunk.first + len(chunk)
    places = {row - chunk.first: dict(at) for row, at in toolpath.counts.items() if chunk.first <= row <= end}
    for row, at in placed_by_events(chunk).items():
        places.setdefault(row, {}).update(at)
    return places


def placed_by_events(chunk: Chunk) -> dict[int, dict[int, float]]:
    """The same of what events of the chunk say."""
    if not any(isinstance(event, Deed) and event.places for event in chunk.events):
        return {}
    return {
        row + 1: dict(event.places)
        for row, number in enumerate(chunk.curve)
        if chunk.kind[row] == Kind.EVENT and isinstance(event := chunk.events[number], Deed) and event.places
    }
