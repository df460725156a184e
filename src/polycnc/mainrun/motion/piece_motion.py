"""The motion of the axes along one piece: where they are and how fast, at any time."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.mainrun.motion.geometry import Line
from polycnc.motion.kernels.columns import PieceRecord
from polycnc.motion.limits import axis_rapids
from polycnc.motion.phases.axis_move import AxisMove, axis_move
from polycnc.motion.phases.speed import (
    FREE,
    NO_WAY_MM,
    Calm,
    calm_after,
    first_part,
    profile_of,
    straight_profile,
)

if TYPE_CHECKING:
    from array import array

    from polycnc.mainrun.motion.follower import Follower
    from polycnc.mainrun.preparation.items import ChannelRates, Piece


#: Of a piece that belongs to no line from rest to rest.
NO_WAYS = (0.0, 0.0)


class Motion(Protocol):
    """What the main run asks of a motion.

    Attributes:
        piece: The piece.
        end: When its end is reached; inf where the axes come to rest before.
        rest: When the axes come to rest before its end; inf where they do not.
        end2: Squared path speed at the end.
    """

    piece: Piece
    end: float
    rest: float
    end2: float

    def machine(self, time: float) -> list[float]:
        """Machine position."""

    def speed(self, time: float) -> float:
        """Path speed."""

    def revise(self, time: float, aim2: float, cap2: float, rates: ChannelRates) -> None:
        """The limits of the speed have changed."""

    def lead(self, follower: Follower) -> None:
        """Say what the axes follow from now on."""

    def done(self, time: float) -> float:
        """How far along the piece the motion is, mm."""

    @property
    def end_position(self) -> list[float]:
        """Machine position at its end."""


class PathMotion:
    """Along the path, all axes together.

    Args:
        piece: The piece.
        record: The planner's numbers of it.
        since: When it begins.
        start2: Squared speed then.
        aim2: Largest squared speed at its end.
        cap2: Largest squared speed on it.
        window: Seconds by which the axes are behind.
        calm: How long a line from rest to rest keeps its speed, and `ahead` the ways behind the piece to where
            the axes shall rest, and to where they rest in any case.
        done: How far along the piece the motion begins, mm.
    """

    def __init__(
        self,
        piece: Piece,
        record: array[Any],
        since: float,
        start2: float,
        aim2: float,
        cap2: float,
        window: float = 0.0,
        calm: Calm = FREE,
        ahead: tuple[float, float] = NO_WAYS,
        done: float = 0.0,
    ) -> None:
        self.piece = piece
        self._window = window
        self._calm, self.ahead = calm, ahead
        self._record = record
        self._axes = len(piece.way.start)
        self._run(since, done, start2, aim2, cap2)

    def _run(self, since: float, done: float, start2: float, aim2: float, cap2: float) -> None:
        aim2 = max(aim2, self.coasting2)
        if self.is_bound and max(self.ahead) > 0.0:
            left, pull = self.length - done, self._record[PieceRecord.PULL]
            brakes = 0.5 * start2 / pull + sqrt(start2) * self._calm.before_down
            stop, rest = self.ahead
            way = left + (stop if left + stop >= brakes else rest)
            profile = first_part(straight_profile(way, start2, 0.0, cap2, pull, self._calm), left)
        else:
            profile = profile_of(
                self._record, done, start2, aim2, cap2, self._axes, self.piece.limits, self._calm
            )
        self._profile, self._since, self._done = profile, since, done
        over = since + profile.seconds
        self.end, self.rest = (over, inf) if profile.arrives else (inf, over)
        self.end2 = profile.end2

    def _after(self, time: float) -> tuple[float, float]:
        over = time >= min(self.end, self.rest)
        way, speed = self._profile.after(inf if over else time - self._since)
        return min(self._done + way, self._record[PieceRecord.LENGTH]), speed

    def machine(self, time: float) -> list[float]:
        """Machine position."""
        return self.piece.at(self._after(time)[0] / self._record[PieceRecord.LENGTH])

    def speed(self, time: float) -> float:
        """Path speed."""
        return self._after(time)[1]

    @property
    def coasting2(self) -> float:
        """Largest squared speed at its end from which the axes rest within the way that is left behind it."""
        pull, left = float(self._record[PieceRecord.PULL]), self.piece.left
        late = max(0.5 * self._window, self._calm.level)
        if late == 0.0 or left <= 0.0:
            return 2.0 * pull * left
        speed = pull * (sqrt(late * late + 2.0 * left / pull) - late)
        return speed * speed

    @property
    def end_position(self) -> list[float]:
        """Machine position at the end of the piece."""
        return self.piece.at(1.0)

    @property
    def length(self) -> float:
        """Of the piece, mm."""
        return float(self._record[PieceRecord.LENGTH])

    def lead(self, follower: Follower) -> None:
        """Say what the axes follow from now on."""
        follower.follow(self._since, self._done, self._profile.phases)

    @property
    def is_bound(self) -> bool:
        """Whether it leads to the end of a line from rest to rest, which keeps the average that it has begun with."""
        return self._calm.level > 0.0

    def done(self, time: float) -> float:
        """How far along the piece the motion is."""
        return self._after(time)[0]

    def after_signal(self, time: float, late: float) -> PathMotion | None:
        """The motion that brakes on the line of this one; None where the axes stand.

        It goes on for `late` seconds, if the signal comes when the axes are where this motion is now.
        """
        way, speed = self._after(time)
        calm = self.calm(time)
        late = max(late, calm.before_down)
        brakes = speed * speed / (2.0 * self._record[PieceRecord.PULL]) + speed * late
        if brakes <= NO_WAY_MM:
            return None
        piece, length = self.piece, self._record[PieceRecord.LENGTH]
        here, per_mm = piece.at(way / length), piece.share / length
        ahead = [a + (b - a) * per_mm * brakes for a, b in zip(piece.way.start, piece.way.end, strict=True)]
        end = [h + a - s for h, a, s in zip(here, ahead, piece.way.start, strict=True)]
        rest = replace(
            piece,
            way=Line(tuple(here), tuple(end)),
            first=0.0,
            share=1.0,
            left=0.0,
            is_coasting=True,
            curve=None,
        )
        record = self._record[:]
        record[PieceRecord.LENGTH] = brakes
        speed2 = speed * speed
        return PathMotion(rest, record, time, speed2, 0.0, speed2, self._window, calm)

    def revise(self, time: float, aim2: float, cap2: float, rates: ChannelRates) -> None:  # noqa: ARG002 - are in cap2
        """The limits of the speed have changed."""
        done, speed = self._after(time)
        self._calm = self.calm(time)
        self._run(time, done, speed * speed, aim2, cap2)

    def calm(self, time: float) -> Calm:
        """How long the speed must be kept at a time before the acceleration changes its sign."""
        return calm_after(self._calm, self._profile.phases, self._since, time)


class AxesMotion:
    """A rapid on which every axis runs alone to its end.

    Args:
        piece: The piece.
        since: When it begins.
        rates: What the operator has set.
        ramp: Seconds over which the motion of the slowest axis is averaged (`motion/kernels/alone.py`).
    """

    def __init__(self, piece: Piece, since: float, rates: ChannelRates, ramp: float = 0.0) -> None:
        self.piece, limits = piece, piece.limits
        self.end2 = 0.0
        ways = [b - a for a, b in zip(piece.way.start, piece.way.end, strict=True)]
        alone = axis_rapids(ways, piece.context, limits, soft=ramp > 0.0)
        tops = zip(limits.top_rapid, limits.rotary, strict=True)
        self._top = tuple(piece.context.rapid_top(top, rotary=bool(turns)) for top, turns in tops)
        self._pull = tuple(own.pull for own in alone)
        self._ramps, self._ramp = tuple(own.ramp for own in alone), ramp
        self._moves = tuple(AxisMove(start, (), since, start) for start in piece.way.start)
        self._calm = tuple(Calm(own.ramp) for own in alone)
        self.revise(since, 0.0, 0.0, rates)

    def machine(self, time: float) -> list[float]:
        """Machine position."""
        return [move.after(time)[0] for move in self._moves]

    @property
    def end_position(self) -> list[float]:
        """Machine position at its end."""
        return self.piece.at(1.0)

    def lead(self, follower: Follower) -> None:
        """Say what the axes follow from now on."""
        moves = zip(self._moves, self._ramps, strict=True)
        follower.follow_alone(self._moves[0].since, [(move.start, move.phases, ramp) for move, ramp in moves])

    def speed(self, time: float) -> float:
        """Speed of the fastest axis."""
        return max(abs(move.after(time)[1]) for move in self._moves)

    def done(self, time: float) -> float:
        """How far along the piece the axis with the longest way is."""
        start, end, length = self.piece.way.start, self.piece.way.end, self.piece.length
        column = max(range(len(start)), key=lambda i: abs(end[i] - start[i]))
        way = end[column] - start[column]
        return length * (self._moves[column].after(time)[0] - start[column]) / way if way else length

    def revise(self, time: float, aim2: float, cap2: float, rates: ChannelRates) -> None:  # noqa: ARG002 - it ends in rest
        """Another override; a speed of 0 brakes every axis."""
        speeds = [rates.axis_speed(self.piece, top) for top in self._top]
        self._calm = tuple(
            calm_after(calm, move.phases, move.since, time)
            for calm, move in zip(self._calm, self._moves, strict=True)
        )
        self._moves = tuple(
            axis_move(*move.after(time), end, speed, pull, time, calm)
            for move, end, speed, pull, calm in zip(
                self._moves, self.piece.way.end, speeds, self._pull, self._calm, strict=True
            )
        )
        ends = zip(self._moves, self._ramps, strict=True)
        over = max(time, *(move.end + ramp - self._ramp for move, ramp in ends))
        self.end, self.rest = (over, inf) if all(speeds) else (inf, over)
