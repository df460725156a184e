"""Technology cycles in the main run: a line in each interpolation cycle, lines of axes until they stand (10.5).

ICYCOF runs all lines that follow in one cycle, and waits for no axis.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.language.sinumerik.actions.code import Acting
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.actions.code import Cycle

#: Lines that run in one interpolation cycle at most under ICYCOF: more is a loop without end.
MOST_LINES = 10_000


class Runs(Acting, Protocol):
    """What runs the lines.

    Attributes:
        channel: The channel.
        started: Columns of axes that a line has started.
        at_once: ICYCOF holds.
    """

    channel: SinumerikChannel
    started: set[int]
    at_once: bool

    def finish(self) -> None:
        """The effects of a line are through: its axes start."""

    def axis_moves(self, column: int) -> bool:
        """Whether a commanded axis is under way."""


@dataclass(slots=True, eq=False)
class RunningCycle:
    """A technology cycle that runs.

    Attributes:
        cycle: Its lines.
        own: Values of its parameters.
        at: The line that comes next.
        at_once: ICYCOF: all lines in one interpolation cycle.
        waits_for: Columns of axes that the last line has started.
    """

    cycle: Cycle
    own: list[Any]
    at: int = 0
    at_once: bool = False
    waits_for: set[int] = field(default_factory=set)

    def step(self, acting: Runs) -> bool:
        """Run the line that comes next; whether the cycle is over."""
        self.waits_for = {column for column in self.waits_for if acting.axis_moves(column)}
        if self.waits_for:
            return False
        for _ in range(MOST_LINES):
            over, counts = self._line(acting)
            if over:
                return True
            if counts and not self.at_once:
                return False
        raise AlarmError("PC0002", hint="hint.block-limit")

    def _line(self, acting: Runs) -> tuple[bool, bool]:
        """Run a line; whether it was the end, and whether it takes an interpolation cycle."""
        line = self.cycle.lines[self.at]
        channel, own = acting.channel, self.own
        if line.kind == "end":
            return True, False
        goes = line.condition is None or bool(line.condition(channel, line.frozen, own, acting))
        if line.kind == "if":
            self.at = self.at + 1 if goes else line.target
        elif line.kind == "jump":
            self.at = line.target if goes else self.at + 1
        else:
            self.at += 1
            acting.started.clear()
            acting.at_once = self.at_once
            assert line.effect is not None
            line.effect(channel, line.frozen, own, acting)
            acting.finish()
            self.at_once = acting.at_once
            if not self.at_once:
                self.waits_for = {column for column in acting.started if acting.axis_moves(column)}
        ends = self.cycle.lines[self.at].kind == "end" and not self.waits_for
        return ends, True
