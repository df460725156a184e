"""What the axes stand for in the main run, and what begins beside them while they do: by the main run's clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from polycnc.deferred.records import dataclass
from polycnc.mainrun.preparation.items import Standing
from polycnc.motion.standing.beside import Awaits, Begins
from polycnc.motion.standing.zero_mark import Mark, Turns

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun.preparation.run_blocks import Delay
    from polycnc.motion.standing.beside import Work
    from polycnc.toolpath import Context


class WorkClock:
    """Work beside the axes on the clock of the main run.

    Args:
        work: The work.
    """

    def __init__(self, work: Work) -> None:
        self.work, self._time = work, 0.0

    def at(self, time: float) -> Work:
        """The work as it is at a time."""
        self.work.left_s = max(self.work.left_s - max(time - self._time, 0.0), 0.0)
        self._time = time
        return self.work


@dataclass(frozen=True, slots=True)
class WorkBegins(Standing):
    """Some work begins beside the axes, which goes to `aim`, from `since` where that is known."""

    clock: WorkClock
    aim: float
    since: float | None

    def wait_s(self, time: float) -> float:
        """The axes do not stand for it."""
        self.clock.at(time).begin(self.aim, self.since)
        return 0.0


@dataclass(frozen=True, slots=True)
class WorkAwaited(Standing):
    """The axes stand until some work beside them is done."""

    clock: WorkClock

    def wait_s(self, time: float) -> float:
        """What is left of it."""
        return self.clock.at(time).left_s


@dataclass(frozen=True, slots=True)
class SpindleTurns(Standing):
    """A spindle goes to another speed from now on, or its angle is lost."""

    turns: Turns

    def wait_s(self, time: float) -> float:
        """The axes do not stand for it."""
        angle, rpm = self.turns.angle, self.turns.rpm
        if rpm is None:
            angle.lose()
        else:
            angle.go_to(rpm, self.turns.ramp_s, time)
        return 0.0


@dataclass(frozen=True, slots=True)
class MarkAwaited(Standing):
    """The axes stand until the spindle comes to where a thread begins; a hold may come in between.

    `lag` gives the seconds by which the axes of the pieces ahead are behind the spindle.
    """

    is_asked_again: ClassVar[bool] = True
    mark: Mark
    lag: Callable[[], float]

    def wait_s(self, time: float) -> float:
        """Seconds until the thread begins; 0 where it can."""
        return self.mark.angle.until_start(self.mark.rpm, self.mark.start_deg, self.lag(), time)


class Delays:
    """Makes items of what rows wait for.

    Args:
        end_in_rest: Called where the axes rest for it.
        lag: As of `MarkAwaited`.
    """

    def __init__(self, end_in_rest: Callable[[], None], lag: Callable[[], float]) -> None:
        self._end_in_rest, self._lag = end_in_rest, lag
        self._works: dict[Work, WorkClock] = {}

    def item(self, delay: Delay, context: Context) -> Standing:
        """What the axes stand for, or what begins beside them."""
        if isinstance(delay, Turns):
            return SpindleTurns("spindle_s", 0.0, context, delay)
        if isinstance(delay, Mark):
            return MarkAwaited("spindle_s", 0.0, context, delay, self._lag)
        if not isinstance(delay, Begins | Awaits):
            return Standing(*delay, context)
        clock = self._works.setdefault(delay.work, WorkClock(delay.work))
        if isinstance(delay, Begins):
            return WorkBegins(delay.work.share, 0.0, context, clock, delay.aim, delay.since)
        if delay.rests:
            self._end_in_rest()
        return WorkAwaited(delay.work.share, 0.0, context, clock)
