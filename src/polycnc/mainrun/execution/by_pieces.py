"""Motion piece by piece: an interpolator runs along the pieces that are prepared, and the axes follow its averages."""

from __future__ import annotations

from math import dist, inf

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.mainrun.motion.follower import Follower
from polycnc.mainrun.motion.law_run import State
from polycnc.mainrun.motion.piece_motion import NO_WAYS, AxesMotion, Motion, PathMotion
from polycnc.motion.kernels.columns import PieceRecord
from polycnc.motion.phases.speed import FREE, Calm

if TYPE_CHECKING:
    from array import array
    from collections.abc import Sequence

    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.preparation.items import ChannelRates, Piece
    from polycnc.mainrun.preparation.preprocessing import Preprocessing

#: Places nearer than this are one, mm.
SAME_MM = 1e-6
#: Squared speed below which the axes stand, (mm/s)².
REST2 = 1e-9
#: By so much the squared speed may differ from what the look-ahead allows where the axes brake along a curve.
LITTLE = 1e-6


class ByPieces:
    """Leads the axes of a channel along pieces.

    Args:
        preprocessing: What is prepared.
        rates: What the operator has set.
        clock: The time.

    Attributes:
        rest_time: When the axes rest behind an interpolator that rests.
    """

    def __init__(self, preprocessing: Preprocessing, rates: ChannelRates, clock: Clock) -> None:
        self._preprocessing, self._rates, self._clock = preprocessing, rates, clock
        self._follower, self._behind = Follower(), 0.0
        self._calm, self.rest_time = FREE, 0.0

    @property
    def window(self) -> float:
        """Seconds by which the axes are behind."""
        return self._follower.window

    def follows(self, motion: Motion | None) -> bool:
        """Whether the axes are behind the interpolator, which leads them."""
        leads = motion is not None and self._clock.time < motion.rest
        return self.window > 0.0 and (leads or self._clock.time < self.rest_time)

    @property
    def speed(self) -> float:
        """Path speed of axes that follow, mm/s."""
        return self._follower.speed(self._clock.time)

    @property
    def machine(self) -> list[float]:
        """Machine position of axes that follow."""
        return self._follower.machine(self._clock.time)

    def begin(
        self, piece: Piece, record: array[Any], x2: float, cap2: float, position: Sequence[float]
    ) -> Motion:
        """The motion along the piece that has just been taken, and its record.

        Args:
            piece: The piece.
            record: Its record.
            x2: Square of the speed at its start; 0 from rest.
            cap2: Largest square of the speed.
            position: Where it starts.
        """
        preprocessing, time = self._preprocessing, self._clock.time
        if x2 == 0.0 and time < self.rest_time:
            self._follower = Follower(self._follower, self.rest_time, position)
        follower = self._follower
        if x2 == 0.0:
            follower.begin(time, record[PieceRecord.RAMP], record[PieceRecord.BLEND])
        follower.enter(piece, record[PieceRecord.LENGTH], self._behind)
        motion: Motion
        if piece.by_axis:
            motion = AxesMotion(piece, time, self._rates, record[PieceRecord.RAMP])
        else:
            motion = PathMotion(
                piece, record, time, x2, preprocessing.reach2, cap2, follower.window,
                *self._steadiness(record, x2),
            )  # fmt: skip
        self.lead(motion)
        return motion

    def begin_by_law(self, *, at_rest: bool) -> None:
        """A law leads the axes themselves: nothing follows."""
        self._behind = 0.0
        if at_rest:
            self._follower.begin(self._clock.time, 0.0, 0.0)

    def on_line(self, motion: Motion) -> State | None:
        """How the axes move along a whole straight row from rest, which is all that they follow; None otherwise."""
        piece = motion.piece
        if not isinstance(motion, PathMotion) or piece.first > 0.0 or piece.share < 1.0 or piece.is_coasting:
            return None
        found = self._follower.along(self._clock.time)
        return None if found is None else State(*found)

    def _steadiness(self, record: array[Any], x2: float) -> tuple[Calm, tuple[float, float]]:
        """Of a piece of a line from rest to rest: how long it keeps its speed, and how far behind it the axes rest."""
        ramp = record[PieceRecord.RAMP]
        if record[PieceRecord.ALONE] == 0.0 or ramp == 0.0:
            return FREE, NO_WAYS
        if x2 == 0.0:
            self._calm = Calm(ramp)
        return self._calm, self._preprocessing.ways_to_rest

    def lead(self, motion: Motion | None) -> None:
        """The axes follow what has just been decided."""
        if motion is None or self.window == 0.0:
            return
        motion.lead(self._follower)
        if self._clock.time < motion.rest < inf:
            self.rest_time = motion.rest + self.window

    def coast(self, motion: PathMotion, late: float) -> Motion | None:
        """A skip signal has come: the axes brake on the line of a move; None where they rest."""
        done = motion.done(self._clock.time)
        coasting = motion.after_signal(self._clock.time, late)
        if coasting is not None:
            self._follower.enter(coasting.piece, coasting.length, done)
            self.lead(coasting)
        return coasting

    def end(self, motion: Motion) -> None:
        """A piece is over."""
        if isinstance(motion, PathMotion):
            self._calm = motion.calm(self._clock.time)

    def leave(self, motion: Motion) -> None:
        """What comes next is another piece."""
        self._behind = motion.piece.length

    def come_to_rest(self) -> None:
        """The interpolator rests."""
        self.rest_time = self._clock.time + self.window

    def exchange(
        self, motion: PathMotion, found: tuple[Piece, array[Any], float], cap2: float
    ) -> PathMotion | None:
        """What lies ahead is laid out again: the motion goes on along another piece of its row.

        Args:
            motion: The motion.
            found: The piece, its record, and how far the axes have come on it.
            cap2: Largest square of the speed on it.

        Returns:
            None where the axes cannot brake any more as the new piece asks, or are where it leads another way: past
            the point from which a corner is bent now.
        """
        (piece, record, here), time, preprocessing = found, self._clock.time, self._preprocessing
        speed, done = motion.speed(time), motion.done(time)
        is_beside = dist(piece.at(here / record[PieceRecord.LENGTH]), motion.machine(time)) > SAME_MM
        if is_beside or preprocessing.queue.passes_corner(piece, record):
            return None
        other = PathMotion(
            piece, record, time, speed * speed, preprocessing.reach2, cap2, self.window, done=here
        )
        if other.end2 > (1.0 + LITTLE) * max(preprocessing.reach2, other.coasting2) + REST2:
            return None
        if self.window > 0.0:
            self._follower.exchange(piece, record[PieceRecord.LENGTH], done - here)
        self.lead(other)
        return other
