"""What a picture of a control shows: the path of the loaded program, and where the tool has been in this run."""

from __future__ import annotations

from time import monotonic

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused, State
from polycnc.toolpath.events import Circle, Pen
from polycnc.view.bodies import MachineBodies, Pose
from polycnc.view.lines import FEED, RAPID, Lines
from polycnc.view.rows import RowLine, draw_circle

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.reading.forecast import Forecast
    from polycnc.mainrun.reading.snapshot import Record, Snapshot

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
        self._pen, self._cut = "", False
        control.listeners.append(self._hear)

    @property
    def pose(self) -> Pose:
        """Where everything stands."""
        control = self._control
        channel = control.snapshot.channels[1]
        return self.bodies.pose(channel.point, control.machine_position, channel.mechanism)

    def _hear(self, record: Record) -> None:
        """A run begins, or the program draws: the trail begins anew, has another colour, or a circle."""
        data, trail = record.data, self.lines["trail"]
        if record.what == "state":
            before, self._state = self._state, State(str(data["state"]))
            if self._state is State.RUNNING and before in (State.READY, State.ALARM):
                trail.clear()
                self._pen = ""
        if record.what != "event":
            return
        if data.get("type") == Pen.type:
            self._pen = str(data["colour"])
        elif data.get("type") == Circle.type:
            snapshot = self._control.snapshot
            self.note(snapshot)
            circle = Circle(float(str(data["radius"])), bool(data["filled"]))
            draw_circle(trail, circle, snapshot.modal.get("plane", "G17"), trail.colour(self._pen))

    def note(self, snapshot: Snapshot) -> None:
        """The tool is somewhere: the trail leads there."""
        trail, point = self.lines["trail"], snapshot.channels[1].point
        now = snapshot.channels[1].runs and snapshot.modal.get("motion") not in _RAPID
        cuts, self._cut = self._cut or now, now
        last = trail.last()
        if last and all(abs(a - b) < 1e-4 for a, b in zip(last, point, strict=True)):
            return
        tool = self._pen or snapshot.tool.name or f"T{snapshot.tool.tool}"
        trail.add(point, snapshot.feed, FEED if cuts else RAPID, trail.colour(tool))

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
