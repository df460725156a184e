"""From machine positions of the main run to what the control's displays show."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.layout import axis_layout
from polycnc.mainrun.reading.snapshot import Positions
from polycnc.motion.frames import path_of, real_of, work_of
from polycnc.toolpath.trace import Display

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.machine.model import Machine
    from polycnc.toolpath import Context, Toolpath


class MainRunDisplay:
    """Shows positions of a channel's axes.

    Args:
        toolpath: The channel's toolpath.
        machine: The machine.
        number: Number of the channel.
    """

    def __init__(self, toolpath: Toolpath, machine: Machine, number: int) -> None:
        layout = axis_layout(machine, number)
        self.axes = toolpath.axes
        self.geometry = layout.geometry
        self._display = Display(toolpath, layout)

    def positions(
        self, machine: Sequence[float], end: Sequence[float], real: Sequence[float], context: Context
    ) -> Positions:
        """All displays.

        Args:
            machine: Where on the path the axes are commanded to be.
            end: Where the move in execution ends.
            real: Where the axes of the machine are.
            context: What holds now.
        """
        display = self._display
        position, target = self.work_of(machine, context), self.work_of(end, context)
        work, goal = display.work(position, context), display.work(target, context)
        factors = display.scale(context)
        left = {axis: goal[axis] - value for axis, value in work.items()}
        if context.shown_by is None:
            ways = zip(context.names or self.axes, position, target, factors.work, strict=True)
            left = {axis: (b - a) * f for axis, a, b, f in ways if axis}
        shown = [value * f for value, f in zip(real, factors.machine, strict=True)]
        return Positions(
            work=work,
            machine=display.machine(position, context),
            to_go={axis: round(value, 7) + 0.0 for axis, value in left.items()},
            real={axis: round(value, 7) + 0.0 for axis, value in zip(self.axes, shown, strict=True)},
        )

    def work_of(self, machine: Sequence[float], context: Context) -> list[float]:
        """The position of the absolute display at a position of the path, internal units."""
        return work_of(machine, context, self.geometry)

    def real(self, on_path: Sequence[float], context: Context) -> list[float]:
        """The real axes at a position of the path."""
        return real_of(on_path, context, self.geometry)

    def on_path(self, real: Sequence[float], context: Context) -> list[float]:
        """The position of the path at which the real axes are."""
        return path_of(real, context, self.geometry)

    def machine_factor(self, axis: int, context: Context) -> float:
        """Units of the machine display in an internal one."""
        return self._display.scale(context).machine[axis]
