"""What goes on beside the axes: spindles run up, the magazine turns. What needs them waits for what is left.

The plan and the main run ask the same objects: the plan lets the seconds of rows pass that it has planned, the main run
those of its clock.
"""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Protocol, TypeAlias
from polycnc.motion.standing.zero_mark import Mark, Turns

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.machine import Magazine
    from polycnc.motion.standing.zero_mark import SpindleAngle


class Work(Protocol):
    """Something that a machine does beside the motion of its axes.

    Attributes:
        left_s: Seconds until it is done.
        share: The field of `Times` that waiting for it counts for.
    """

    left_s: float
    share: str

    def begin(self, aim: float, since: float | None = None) -> None:
        """It has to come to `aim`, from where it is now or from `since`."""


class Turning:
    """A spindle on its way to a speed.

    Args:
        acceleration: Its acceleration, rpm per second; 0 for at once.

    Attributes:
        rpm: Speed to which it goes, negative counter-clockwise.
        left_s: Seconds until it has it.
    """

    share = "spindle_s"

    def __init__(self, acceleration: float) -> None:
        self._acceleration, self._sense = acceleration, 1.0
        self.rpm, self.left_s = 0.0, 0.0

    @property
    def speed(self) -> float:
        """Its speed now, rpm."""
        return self.rpm - self._sense * self.left_s * self._acceleration

    def begin(self, aim: float, since: float | None = None) -> None:
        """It is told another speed."""
        way = aim - (self.speed if since is None else since)
        self.rpm, self._sense = aim, 1.0 if way >= 0.0 else -1.0
        self.left_s = abs(way) / self._acceleration if self._acceleration > 0.0 else 0.0


class Search:
    """A magazine on its way to a place; a way that it has begun it goes to its end first.

    Args:
        magazine: Whose places it turns.

    Attributes:
        place: To which it turns.
        left_s: Seconds until it stands there.
    """

    share = "tool_change_s"

    def __init__(self, magazine: Magazine) -> None:
        self._magazine = magazine
        self.place, self.left_s = 1, 0.0

    def begin(self, aim: float, since: float | None = None) -> None:
        """Another tool is searched."""
        if since is not None:
            self.place, self.left_s = int(since), 0.0
        self.left_s += self._magazine.turn_s(self.place, int(aim))
        self.place = int(aim)


class Indexing:
    """A spindle on its way to an angle, which takes it some seconds whatever the angle."""

    share = "spindle_s"

    def __init__(self) -> None:
        self.left_s = 0.0

    def begin(self, aim: float, since: float | None = None) -> None:  # noqa: ARG002 - it always takes as long
        """It turns for so many seconds."""
        self.left_s = aim


class Begins(NamedTuple):
    """At a row some work begins, `after_s` seconds later than the row, and at `since` where that is known."""

    row: int
    work: Work
    aim: float
    after_s: float = 0.0
    since: float | None = None


class Awaits(NamedTuple):
    """A row waits for some work; `rests`: the axes rest before it for that reason.

    `share` is the field of `Times` that the wait counts for; empty for that of the work.
    """

    row: int
    work: Work
    context: int
    rests: bool = False
    share: str = ""


#: What begins, changes or is waited for at a row.
Step: TypeAlias = "Begins | Awaits | Turns | Mark"


class Beside:
    """Follows work beside the axes and the spindles' angles through the rows of a plan, in order.

    Args:
        lag_of: Gives for a row of a thread the seconds by which its axes are behind its spindle up to speed; None where
            the row is not planned yet.
        before: Called with a row before anything of it is looked at: what it stands for otherwise is told to `stand`.

    Attributes:
        on_begin: Called with what has begun; before pieces of rows behind it are final.
        hidden_s: Seconds of such work that nothing had to wait for, by the field of `Times`.
    """

    def __init__(self, lag_of: Callable[[int], float | None], before: Callable[[int], None]) -> None:
        self._before, self._standing = before, dict[int, float]()
        self._coming: list[Step] = []
        self._works: dict[Work, float] = {}
        self._angles: set[SpindleAngle] = set()
        self._lag_of, self._time = lag_of, 0.0
        self._row, self._waited = 0, 0.0
        self.on_begin: Callable[[Begins], None] | None = None
        self.hidden_s: dict[str, float] = {}

    def note(self, step: Step) -> None:
        """A step of a row."""
        self._coming.append(step)
        place = len(self._coming) - 1
        while place and self._coming[place - 1].row > step.row:  # threads of a chunk come behind all else
            self._coming[place] = self._coming[place - 1]
            place -= 1
        self._coming[place] = step

    def settle(
        self,
        row: int,
        seconds: Callable[[int, int], float],
        wait: Callable[[int, str, int, float], None],
    ) -> None:
        """All rows before one are planned.

        Args:
            row: The row.
            seconds: Gives the seconds of rows from one to before another one.
            wait: Called with row, share, context and seconds where a row up to `row` waits.
        """
        done = 0
        for step in self._coming:
            lag = self._lag_of(step.row) if isinstance(step, Mark) and step.row <= row else 0.0
            if step.row > row or lag is None:
                break
            done += 1
            self._before(step.row)
            self._let_pass(step.row, seconds)
            self._let_stand(None, self._standing.pop(step.row, 0.0))
            if isinstance(step, Begins):
                step.work.begin(step.aim, step.since)
                self._works[step.work] = self._waited + step.after_s
                if self.on_begin is not None:
                    self.on_begin(step)
            elif isinstance(step, Turns):
                self._turn(step)
            elif isinstance(step, Mark):
                waits = self._until_start(step, lag)
                if waits > 0.0:
                    self._stand(step, "spindle_s", waits, wait)
            elif step.work.left_s > 0.0:
                self._stand(step, step.share or step.work.share, step.work.left_s, wait)
        del self._coming[:done]
        self._let_pass(row, seconds)

    def _stand(
        self, step: Awaits | Mark, share: str, waits: float, wait: Callable[[int, str, int, float], None]
    ) -> None:
        """A row waits; other work goes on meanwhile."""
        wait(step.row, share, step.context, waits)
        self._let_stand(step.work if isinstance(step, Awaits) else None, waits)

    def stand(self, row: int, seconds: float) -> None:
        """The axes stand before a row for something else, before it waits for what is followed here."""
        self._standing[row] = self._standing.get(row, 0.0) + seconds

    def _let_stand(self, awaited: Work | None, waits: float) -> None:
        for work in self._works:
            self._hide(work, min(waits, work.left_s) if work is not awaited else 0.0)
            work.left_s = max(work.left_s - waits, 0.0)
            self._works[work] += waits
        self._waited += waits

    def _turn(self, step: Turns) -> None:
        """A spindle goes to another speed, or its angle is lost."""
        if step.rpm is None:
            step.angle.lose()
            self._angles.discard(step.angle)
        elif step.angle in self._angles:
            step.angle.go_to(step.rpm, step.ramp_s, self._time + self._waited + step.after_s)

    def _until_start(self, step: Mark, lag: float) -> float:
        """Seconds that a thread waits."""
        if not self._angles:
            self._time = 0.0  # from here on it counts
        self._angles.add(step.angle)
        return step.angle.until_start(step.rpm, step.start_deg, lag, self._time + self._waited + step.after_s)

    def _let_pass(self, row: int, seconds: Callable[[int, int], float]) -> None:
        """Let the rows before one pass; what has gone on in the first of them already does not count again."""
        if row <= self._row:
            return
        if self._angles:
            self._time += seconds(self._row, row)
        if any(work.left_s > 0.0 for work in self._works):
            passed = seconds(self._row, row)
            for work, before in self._works.items():
                ran = min(max(passed - before, 0.0), work.left_s)
                self._hide(work, ran)
                work.left_s -= ran
                self._works[work] = 0.0
        else:
            self._works.clear()
        self._row, self._waited = row, 0.0
        for done in [other for other in self._standing if other < row]:
            del self._standing[done]

    def _hide(self, work: Work, seconds: float) -> None:
        self.hidden_s[work.share] = self.hidden_s.get(work.share, 0.0) + seconds
