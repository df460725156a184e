"""The stage of the path that turns axes with its direction.

Behind a corner an axis is off its direction. By TLIFT a block of its own turns it there, with optimisation P the path
waits for it; else it turns while the path goes on, over the way that the path makes in the time that the axis takes, at
the latest up to the end of the move.
"""

from __future__ import annotations

from math import degrees, inf

from polycnc.channel.moves import knots, origins
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.control.sinumerik.limits.working_area import WORKING_AREA, Ranges
from polycnc.control.sinumerik.tangential.coupling import SAME_DEG, Coupling, Course, course
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Event
from polycnc.toolpath.kinds import ARC_KINDS, Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.channel.moves.path import PlacedEvent
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Kinds of moves whose direction counts; in others an axis stays, or goes by its own words.
LEADING = frozenset((Kind.RAPID, Kind.FEED, Kind.SPLINE, Kind.THREAD, Kind.TAP, Kind.SKIP, *ARC_KINDS))


@dataclass(frozen=True, slots=True)
class Positioned(Event):
    """A word of a coupled axis: what is put to its offset angle, in order with the moves; no stage behind sees it."""

    column: int
    added: float


class TangentialStage(Stage):
    """Leads the coupled axes. What it changes in a move's end the channel knows too, since it is the same list."""

    rank = Rank.NORMAL

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel
        self.couplings: dict[int, Coupling] = {}

    def event(self, event: PlacedEvent) -> None:
        """Take the words of coupled axes out; pass other events on."""
        own = event.event
        if not isinstance(own, Positioned):
            self.after.event(event)
        elif own.column in self.couplings:
            self.couplings[own.column].added = own.added

    def flush(self) -> None:
        """Nothing is held back here; whoever flushes wants to know where the axes stand."""
        self.after.flush()
        position = self._channel.coordinates.position
        stands = {column: coupling.at for column, coupling in self.couplings.items()}
        if any(position[column] != at for column, at in stands.items()):
            position = position.copy()
            for column, at in stands.items():
                position[column] = at
            self._channel.coordinates.arrive(position)

    def move(self, move: Move) -> None:
        """Turn the coupled axes along a move."""
        move.start = move.start.copy()
        for column, coupling in self.couplings.items():
            move.start[column] = coupling.at
            if move.kind not in LEADING:
                if move.kind is Kind.DWELL:
                    move.end[column] = coupling.at
                coupling.at = move.end[column]
        if move.kind in LEADING:
            self._lead(move)
        else:
            self.after.move(move)

    def _lead(self, move: Move) -> None:
        geometry, frame = self._channel.coordinates.geometry, seat.frame_in_front(self._channel)
        found: list[tuple[Coupling, Course | None, float, float]] = []
        parts = {1.0}
        for coupling in self.couplings.values():
            along = course(move, geometry, coupling.leading, frame)
            coupling.range = self._working_area(coupling.column, move)
            jump = coupling.meet(along.angles[0]) - coupling.at if along is not None else 0.0
            jump = self._turn_first(move, coupling, jump)
            share = self._share(move, coupling, jump)
            found.append((coupling, along, jump, share))
            if share:
                parts.add(share)
            if along is not None:
                parts.update(along.parts[1:])
        divides = knots.is_divisible(move)
        pieces = knots.cut(self._channel, move, sorted(parts)) if divides else [move]
        ends = sorted(parts) if divides else [1.0]
        for coupling, along, jump, share in found:
            place = coupling.at
            for piece, after in zip(pieces, coupling.follow(along, jump, share, ends), strict=True):
                piece.start[coupling.column], piece.end[coupling.column] = place, after
                place = after
        for piece in pieces:
            self.after.move(piece)

    def _working_area(self, column: int, move: Move) -> tuple[float, float]:
        """Where the working area limits an axis, in work coordinates."""
        low, high = -inf, inf
        offsets = self._channel.toolpath.contexts[move.context].offsets
        shift = offsets[column] if offsets else 0.0
        for limit in Ranges.of(self._channel).limits:
            if limit.column == column and limit.alarm == WORKING_AREA:
                low, high = max(low, limit.low - shift), min(high, limit.high - shift)
        return low, high

    def _turn_first(self, move: Move, coupling: Coupling, jump: float) -> float:
        """What is left of a jump behind the turn in front of the move, where there is one."""
        if coupling.lifts and abs(jump) > coupling.lift_deg:
            self._turn(
                move,
                coupling,
                coupling.at + jump,
                self._lift_speed(move, coupling),
                move.context,
                origins.TURN,
            )
            return 0.0
        if coupling.leads_speed and move.kind is not Kind.RAPID and move.turning is None:
            left = min(abs(jump), coupling.tolerance_deg) if coupling.smoothing_mm else 0.0
            if abs(jump) - left > SAME_DEG:
                left = left if jump > 0.0 else -left
                within = knots.knot_context(self._channel, move.context)
                self._turn(
                    move, coupling, coupling.at + jump - left, coupling.velocity, within, origins.INTERNAL
                )
                return left
        return jump

    def _lift_speed(self, move: Move, coupling: Coupling) -> float:
        """How fast TLIFT turns an axis in front of a move, degrees/s."""
        speed = self._speed(move, MovePath(move, self._channel.coordinates.geometry).length)
        if not speed or not coupling.lift_radius:
            return coupling.lift_feed
        return min(degrees(speed / coupling.lift_radius), coupling.velocity)

    def _turn(
        self, move: Move, coupling: Coupling, place: float, feed: float, context: int, origin: int
    ) -> None:
        """The axis turns while the path stands."""
        end = move.start.copy()
        end[coupling.column] = place
        turn = replace(
            move, kind=Kind.FEED, start=move.start, end=end, feed=feed, context=context,
            center=None, turns=0.0, parameters=(), turning=None, origin=origin,
        )  # fmt: skip
        toolpath = self._channel.toolpath
        own = toolpath.contexts[context]
        turn.feed *= own.degree_mm
        pace = replace(own.pace, weights=(), turning=()) if own.pace is not None else None
        if own.feed_mode is not FeedMode.PER_MINUTE or pace != own.pace:
            turn.context = toolpath.context_number(replace(own, feed_mode=FeedMode.PER_MINUTE, pace=pace))
        self.after.move(turn)
        move.start = end.copy()
        coupling.at = place

    def _share(self, move: Move, coupling: Coupling, jump: float) -> float:
        """After which part of a move the axis has made up for a jump; 0 where there is none."""
        if abs(jump) <= SAME_DEG:
            return 0.0
        length = MovePath(move, self._channel.coordinates.geometry).length
        if coupling.leads_speed and coupling.smoothing_mm:
            return min(coupling.smoothing_mm / length, 1.0)
        speed = self._speed(move, length)
        way = coupling.seconds_for(jump) * speed
        return min(way / length, 1.0) if way > 0.0 else 1.0

    def _speed(self, move: Move, length: float) -> float:
        """Programmed path speed of a cut, mm/s; 0 for a move that stays whole."""
        if not knots.is_divisible(move) or not move.feed > 0.0:
            return 0.0
        context = self._channel.toolpath.contexts[move.context]
        if context.feed_mode is FeedMode.INVERSE_TIME:
            return move.feed * length
        if context.feed_mode is FeedMode.PER_REVOLUTION:
            return move.feed * (0.0 if context.surface_speed else context.spindle_rpm / 60.0)
        return move.feed
