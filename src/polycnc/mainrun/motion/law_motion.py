"""The motion along a row of a run that a law leads."""

from __future__ import annotations

from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.motion.law_run import NEAR_MM

if TYPE_CHECKING:
    from polycnc.mainrun.motion.follower import Follower
    from polycnc.mainrun.motion.law_run import LawRun
    from polycnc.mainrun.preparation.items import ChannelRates, Piece


class LawMotion:
    """One row of a run; see `piece_motion.Motion`.

    Args:
        piece: The row.
        run: The run.
        begin: The way at which it begins, and `end`: at which it ends.
    """

    def __init__(self, piece: Piece, run: LawRun, begin: float, end: float) -> None:
        self.piece, self._run = piece, run
        self._begin, self._end_way = begin, end
        self.end = self.rest = inf
        self.end2 = 0.0
        self.follow()

    def follow(self) -> None:
        """The law is another one."""
        law, run = self._run.law, self._run
        if run.end_way < self._end_way - NEAR_MM:
            self.end, self.rest, self.end2 = inf, run.end_time, 0.0
        elif run.end_way <= self._end_way + NEAR_MM:
            self.end, self.rest, self.end2 = run.end_time, inf, 0.0
        else:
            self.end, self.rest = law.when(self._end_way), inf
            self.end2 = law.speed(self.end) ** 2

    def machine(self, time: float) -> list[float]:
        """Machine position."""
        return self._run.place(self._run.law.at(time))

    def speed(self, time: float) -> float:
        """Path speed."""
        return 0.0 if time >= self._run.end_time else self._run.law.speed(time)

    def done(self, time: float) -> float:
        """How far along the row the motion is, mm."""
        return min(max(self._run.law.at(time), self._begin), self._end_way) - self._begin

    @property
    def end_position(self) -> list[float]:
        """Machine position at the end of the row: the programmed one where the run ends."""
        if self._run.is_closed and self._end_way >= self._run.known_way - NEAR_MM:
            return self.piece.at(1.0)
        return self._run.place(self._end_way)

    def lead(self, follower: Follower) -> None:
        """Nothing follows behind."""

    def revise(self, time: float, aim2: float, cap2: float, rates: ChannelRates) -> None:  # noqa: ARG002 - the run knows
        """The limits of the speed have changed."""
        self.follow()
