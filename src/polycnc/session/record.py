"""A result as plain values: what another process, a file or a notebook gets of a run."""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.messages import Alarm
    from polycnc.motion.times import ToolTimes
    from polycnc.toolpath import trace


@dataclass(frozen=True)
class RunRecord:
    """What a run gave, without the control that ran it. `pickle` makes one of a `Result`; the names are the same.

    Attributes:
        control: Id of the control.
        machine: Id of the machine.
        program: Name of the main program.
        alarms: In order, with their texts.
        rows: Moves and events in order, as the trace shows them.
        final: `work` and `machine` display at the end of the program.
        variables: Those that are listed and not vacant.
        stops: Where the run halted in single block mode.
        time: Cycle time in seconds; None where the run was not timed.
        tools: The tools with their times.
        repeats: As `Result.repeats`.
    """

    control: str
    machine: str
    program: str
    alarms: list[Alarm]
    rows: list[trace.Record]
    final: dict[str, dict[str, float]]
    variables: Mapping[str, Any]
    stops: list[str]
    time: float | None = None
    tools: tuple[ToolTimes, ...] = ()
    repeats: int = 0
    ok: bool = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "ok", not self.alarms)
