"""An exercise under way: which checks are passed, which faults have come, and the result sheet."""

from __future__ import annotations

from datetime import UTC, datetime

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text
from polycnc.panel.screens.pages import in_language
from polycnc.panel.teaching.exercise import holds
from polycnc.panel.teaching.faults import inject

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.reading.snapshot import Record
    from polycnc.panel.screens.screen import Screen
    from polycnc.panel.teaching.exercise import Exercise


@dataclass(frozen=True, slots=True)
class Result:
    """A check on the sheet: what was to be done, and when it was done, simulated s; None where it was not."""

    text: str
    at_s: float | None


class Lesson:
    """An exercise that somebody works on.

    Args:
        exercise: The exercise.
        control: The control.
        screen: Its screen.
        clock: The time of day.

    Attributes:
        exercise: The exercise.
        began: When it began.
        refused: How often the control has refused something.
        alarms: Numbers of the alarms that came, in order.
    """

    def __init__(
        self,
        exercise: Exercise,
        control: VirtualControl,
        screen: Screen,
        clock: Callable[[], datetime] = lambda: datetime.now(UTC).astimezone(),
    ) -> None:
        self.exercise, self._control, self._screen = exercise, control, screen
        self.began = clock()
        self.refused = 0
        self.alarms: list[str] = []
        self._passed: list[float] = []
        self._come: set[int] = set()
        control.listeners.append(self._hear)

    def _hear(self, record: Record) -> None:
        code = record.data.get("code")
        if record.what == "event" and record.data.get("type") == "alarm" and code is not None:
            self.alarms.append(str(code))

    @property
    def is_done(self) -> bool:
        """Whether every check is passed."""
        return len(self._passed) == len(self.exercise.checks)

    def follow(self) -> None:
        """Look at the control: called while time passes, and behind every key."""
        control, screen = self._control, self._screen
        for place, each in enumerate(self.exercise.faults):
            if place not in self._come and holds(each.when, control, screen):
                self._come.add(place)
                inject(control, each.fault)
        known = {alarm.code for alarm in control.alarms}
        self.alarms += sorted(known - set(self.alarms))
        while not self.is_done and self.exercise.checks[len(self._passed)].holds(control, screen):
            self._passed.append(control.time)

    def results(self, lang: str) -> tuple[Result, ...]:
        """Every check with the time at which it was passed."""
        times = [*self._passed, *(None for _ in self.exercise.checks)]
        return tuple(
            Result(in_language(check.text, lang), at_s)
            for check, at_s in zip(self.exercise.checks, times, strict=False)
        )

    def sheet(self, lang: str) -> str:
        """The result sheet as Markdown."""
        results = self.results(lang)
        done = sum(each.at_s is not None for each in results)
        lines = [
            f"# {in_language(self.exercise.title, lang)}",
            "",
            in_language(self.exercise.text, lang),
            "",
            f"- {text('lesson.exercise', lang)}: {self.exercise.id} ({self.exercise.control})",
            f"- {text('lesson.began', lang)}: {self.began:%Y-%m-%d %H:%M:%S}",
            f"- {text('lesson.passed', lang)}: {done} / {len(results)}",
            f"- {text('lesson.alarms', lang)}: {', '.join(self.alarms) or '-'}",
            f"- {text('lesson.refused', lang)}: {self.refused}",
            "",
            *(
                f"{i}. [{'x' if each.at_s is not None else ' '}] {each.text}"
                + (f" ({each.at_s:.1f} s)" if each.at_s is not None else "")
                for i, each in enumerate(results, 1)
            ),
        ]
        return "\n".join(lines) + "\n"
