"""Where a move leads the machine, for those that limit it: travel of the axes, forbidden zones, working areas.

Limits hold for the way that the tool really takes, not for its end alone: an arc can leave the travel between two ends
that lie in it, and compensation and corners change the way. So moves that pass stages are looked at behind them, by a
guard that the path puts there; where nothing changes moves, the channel asks at once.
"""

from __future__ import annotations

from math import hypot, inf

from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.frames import IDENTITY
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.move_path import MovePath
    from polycnc.channel.moves.path import Run
    from polycnc.geometry.frames import Frame
    from polycnc.machine.model import Axis
    from polycnc.toolpath import Context

#: A limit may be passed by this much, mm or degrees: rounding.
SLACK = 1e-9
#: Chords of a curve may be this far off it where zones are looked for along it, mm.
CHORD_ERROR_MM = 0.01
MOST_PARTS = 720
#: Chords of a straight way on which a transformation makes the axes move along curves.
PARTS_OF_CURVED_LINE = 64


class Wall(NamedTuple):
    """What positions keep to, as rows hold them, mm and degrees: `counts` times their columns is at most `bound`."""

    counts: tuple[float, ...]
    bound: float


class Untold:
    """What is forbidden, of something that does not tell how near it is: everything counts as near."""

    __slots__ = ()

    def walls(self, _channel: Channel, _context: Context) -> Iterable[Wall]:
        """It has none."""
        return ()

    def comes_near(self, _channel: Channel, _start: list[float], _end: list[float], _distance: float) -> bool:
        """Whether a way comes near it."""
        return True


class Travel:
    """The way of one move, in the systems in which something may be limited.

    Args:
        channel: The channel that moves.
        move: The move, as its row will be.
    """

    def __init__(self, channel: Channel, move: Move) -> None:
        self.move = move
        self._channel = channel
        self._context: Context = channel.toolpath.contexts[move.context]
        self._machine: list[list[float]] = []

    @property
    def context(self) -> Context:
        """The state in which the move was programmed."""
        return self._context

    @property
    def machine(self) -> list[list[float]]:
        """Machine positions: start, every point where an axis turns back, end."""
        if not self._machine:
            context = self._context
            curved = context.transformation is not None
            points = self._spread() if curved else self.turns(context.frame)
            self._machine = [self.to_machine(point) for point in points]
        return self._machine

    def turns(self, frame: Frame) -> list[list[float]]:
        """Start, every point where a coordinate of the system that a frame leads to turns back, and end."""
        move = self.move
        if move.center is None:
            return [move.start, move.end]
        way = self._way()
        parts = sorted(part for row in frame.m for part in way.turning_parts(row))
        return [move.start, *(way.at(part) for part in parts), move.end]

    def closely(self) -> list[list[float]]:
        """Machine positions so close to each other that straight lines between them are the way."""
        return [self.to_machine(point) for point in self.positions()]

    def positions(self) -> list[list[float]]:
        """The same in the absolute display."""
        if self.move.center is None and self._context.transformation is None:
            return [self.move.start, self.move.end]
        return self._spread()

    def to_machine(self, position: list[float]) -> list[float]:
        """The machine position of a point of the way."""
        channel = self._channel
        return channel.toolpath.to_machine(position, self._context, channel.coordinates.geometry)

    def _way(self) -> MovePath:
        from polycnc.channel.moves.move_path import MovePath  # straight ways do without it

        return MovePath(self.move, self._channel.coordinates.geometry)

    def _spread(self) -> list[list[float]]:
        way = self._way()
        count = PARTS_OF_CURVED_LINE
        if self.move.center is not None:
            parts = arcs.parts_for_chord_error(max(way.radius, CHORD_ERROR_MM), way.sweep, CHORD_ERROR_MM)
            count = min(parts, MOST_PARTS)
        return [self.move.start, *(way.at(k / count) for k in range(1, count + 1))]


class Reached(Travel):
    """Where a straight move of a tip can lead at most: a box around where it ends.

    Args:
        channel: The channel that moves.
        move: The move.
        by: How far its ends may be led beside, a number for each column.
        ways: How far its axes are at most from where they are at its end.
    """

    def __init__(self, channel: Channel, move: Move, by: Sequence[float], ways: Sequence[float]) -> None:
        super().__init__(channel, move)
        end = self.to_machine(move.end)
        low, high = ([at + side * way for at, way in zip(end, ways, strict=True)] for side in (-1.0, 1.0))
        self._machine, self._by = [end, low, high], by

    def turns(self, frame: Frame) -> list[list[float]]:  # noqa: ARG002 - a line turns back nowhere
        """Points around both ends: no linear map leads what the move may become beyond those of them."""
        found, count = [self.move.start, self.move.end], len(self._by)
        for place in (self.move.start, self.move.end):
            for column, way in enumerate(self._by):
                for step in (-way, way) if way > 0.0 else ():
                    moved = place.copy()
                    moved[column] += count * step
                    found.append(moved)
        return found

    def closely(self) -> list[list[float]]:
        """Corners of the box."""
        return self._machine


def certainly_within(
    channel: Channel,
    move: Move,
    by: Sequence[float] = (),
    comes_near: Callable[[list[float], list[float], float], bool] | None = None,
) -> bool:
    """Whether a straight move of a tip is far from all limits, all along it and as far beside it as its ends may be.

    What this cannot tell, and a limit that is near, is to be looked at along the way.

    Args:
        channel: The channel that moves.
        move: The move.
        by: How far its ends may be led beside, a number for each column.
        comes_near: Whether a way of machine positions comes nearer than a distance to anything forbidden that has no
            walls; None for what the boundary says.
    """
    context, boundary = channel.toolpath.contexts[move.context], channel.boundary
    if context.transformation is None or move.center is not None or context.frame.m != IDENTITY.m:
        return False
    from polycnc.transformation.orientation.linked import ways_behind  # where a transformation acts

    beside = by or (0.0,) * len(channel.axes)
    ways = ways_behind(context.transformation, move.start, move.end, beside)
    if not ways:
        return False
    box = Reached(channel, move, beside, ways)
    end, low, high = box.machine
    for bottom, top, (lowest, highest) in zip(low, high, channel.limits, strict=False):
        if not lowest <= bottom <= top <= highest:
            return False
    try:
        if boundary is not None:
            boundary.check(channel, box)
    except AlarmError:
        return False
    if comes_near is not None:
        return not comes_near(end, end, hypot(*ways))
    return boundary is None or not boundary.comes_near(channel, end, end, hypot(*ways))


class TravelGuard(Stage):
    """Refuses what leads beyond the limits, behind all stages that change moves; the path itself puts it there."""

    rank = Rank.LIMITS

    def __init__(self, channel: Channel) -> None:
        self._channel = channel

    def move(self, move: Move) -> None:
        """Pass a move on; the control's alarm for one that leads beyond a limit, at the block that it belongs to."""
        try:
            check_travel(self._channel, move)
        except AlarmError as alarm:
            alarm.line, alarm.program = move.line, move.program
            raise
        self.after.move(move)

    def run(self, run: Run) -> int:
        """Pass moves on, up to the first that might lead beyond a limit."""
        return self.after.run(run.part(self._within(run)))

    def _within(self, run: Run) -> int:
        """How many straight moves certainly stay within the limits, from the first on."""
        channel, context = self._channel, self._channel.toolpath.contexts[run.context]
        axes, count = len(run.start), len(run.kinds)
        if channel.boundary is None and not channel.limits:
            return count
        if channel.boundary is not None or context.transformation is not None:
            return 0  # these are looked at one by one
        limits, to_machine = channel.limits, channel.toolpath.to_machine
        geometry = channel.coordinates.geometry
        for i in range(count):
            machine = to_machine(run.ends[i * axes : (i + 1) * axes].tolist(), context, geometry)
            if not all(low <= at <= high for at, (low, high) in zip(machine, limits, strict=True)):
                return i
        return count


def limits_of(axes: Sequence[Axis]) -> tuple[tuple[float, float], ...]:
    """Lowest and highest machine position of every axis; nothing where no axis has a limit."""
    limits = tuple((axis.limit_minus, axis.limit_plus) for axis in axes)
    return limits if any(low > -inf or high < inf for low, high in limits) else ()


def walls_between(
    channel: Channel, frame: Frame, shift: tuple[float, ...], ranges: Iterable[tuple[int, float, float]]
) -> Iterator[Wall]:
    """The walls of coordinates that stay between two values each, which are given with their columns.

    They are coordinates of the system that a frame leads to, and a shift behind it.
    """
    geometry, width = channel.coordinates.geometry, len(channel.axes)
    for column, low, high in ranges:
        counts, by = [0.0] * width, shift[column] if shift else 0.0
        if column in geometry:
            axis = geometry.index(column)
            by += frame.t[axis]
            for other, count in zip(geometry, frame.m[axis], strict=True):
                if other >= 0:
                    counts[other] = count
        else:
            counts[column] = 1.0
        if high < inf:
            yield Wall(tuple(counts), high - by)
        if low > -inf:
            yield Wall(tuple(-count for count in counts), by - low)


def machine_walls(
    channel: Channel, context: Context, ranges: Iterable[tuple[int, float, float]]
) -> Iterator[Wall]:
    """Machine positions of a context without a transformation stay between two values each."""
    return walls_between(channel, context.frame, context.offsets, ranges)


def walls_of(channel: Channel, context: Context) -> list[Wall]:
    """The walls of the machine's travel, of the setup and of the program."""
    ranges = [(column, low, high) for column, (low, high) in enumerate(channel.limits)]
    walls = list(machine_walls(channel, context, ranges))
    return walls if channel.boundary is None else [*walls, *channel.boundary.walls(channel, context)]


def check_travel(channel: Channel, move: Move) -> None:
    """The control's alarm for a move that leads beyond what machine, setup or program allow."""
    limits, boundary = channel.limits, channel.boundary
    if move.kind != Kind.DWELL and (limits or boundary is not None) and not certainly_within(channel, move):
        travel = Travel(channel, move)
        if limits:
            for machine in travel.machine[1:]:
                check_point(channel, machine)
        if boundary is not None:
            boundary.check(channel, travel)


def check_straight(channel: Channel, kind: Kind, start: list[float], end: list[float]) -> None:
    """The same for a straight move that no stage changes; most of them are through with their ends."""
    if channel.boundary is None and channel.coordinates.transformation is None:
        check_point(channel, channel.coordinates.to_machine(end))
    else:
        check_travel(channel, Move(kind, start, end, context=channel.context_number()))


def check_point(channel: Channel, machine: list[float]) -> None:
    """The control's alarm for a machine position out of the travel that the machine gives an axis."""
    for i, (low, high) in enumerate(channel.limits):
        if machine[i] < low - SLACK:
            raise channel.control.over_travel(channel.axes[i], -1)
        if machine[i] > high + SLACK:
            raise channel.control.over_travel(channel.axes[i], 1)
