"""What a picture of a control shows: the path of the loaded program, and where the tool has been in this run."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING

from polycnc.mainrun import CommandRefused, State
from polycnc.view.bodies import MachineBodies, Pose
from polycnc.view.lines import FEED, RAPID, Lines
from polycnc.view.rows import RowLine

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.reading.forecast import Forecast
    from polycnc.mainrun.reading.snapshot import Snapshot

#: How long the path of a program is calculated at a time, s.
SPELL_S = 0.004
#: The modal codes of rapid traverse.
_RAPID = frozenset({"G0", "G00"})


class Course:
    """The lines of a control, which grow while time passes.

    Args:
        control: The control.

    Attributes:
        bodies: Its machine.
        lines: `path`, the path of the loaded program, and `trail`, where the tool has been since the last start.
    """

    def __init__(self, control: VirtualControl) -> None:
        self._control = control
        self.bodies = MachineBodies(control.machine)
        self.lines = {"path": Lines(), "trail": Lines()}
        self._forecast: Forecast | None = None
        self._program: tuple[str, Sequence[str]] = ("", ())
        self._state = State.READY

    @property
    def pose(self) -> Pose:
        """Where everything stands."""
        control = self._control
        return self.bodies.pose(control.snapshot.channels[1].point, control.machine_position)

    def note(self, snapshot: Snapshot) -> None:
        """The tool is somewhere: the trail leads there."""
        started = snapshot.state is State.RUNNING and self._state in (State.READY, State.ALARM)
        self._state = snapshot.state
        trail, point = self.lines["trail"], snapshot.channels[1].point
        if started:
            trail.clear()
        last = trail.last()
        if last and all(abs(a - b) < 1e-4 for a, b in zip(last, point, strict=True)):
            return
        is_rapid = snapshot.modal.get("motion") in _RAPID or not snapshot.channels[1].runs
        tool = snapshot.tool.name or f"T{snapshot.tool.tool}"
        trail.add(point, snapshot.feed, RAPID if is_rapid else FEED, trail.colour(tool))

    def go_on(self) -> None:
        """Calculate the path of the program a little further; it begins anew where another one is loaded."""
        name = self._control.program
        try:
            program = (name, self._control.program_lines(name) if name else ())
        except CommandRefused:
            program = ("", ())
        if program[0] != self._program[0] or program[1] is not self._program[1]:
            self._program = program
            self._begin()
        if self._forecast is None:
            return
        until = monotonic() + SPELL_S
        while self._forecast.go_on():
            if monotonic() > until:
                return
        self._forecast = None

    def _begin(self) -> None:
        path = self.lines["path"]
        path.clear()
        self._forecast = None
        if not self._program[0]:
            return
        self._forecast = forecast = self._control.forecast()
        forecast.take = RowLine(path, forecast.toolpath, self._control.machine.geometry_indices(1)).add
