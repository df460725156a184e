"""The axes of a channel in the main run, for conditions and variables that ask where they are now."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.interpolator import Interpolator
    from polycnc.mainrun.execution.channel_run import ChannelRun


class Executed:
    """Where the axes are now.

    Args:
        run: The channel in the main run.
    """

    __slots__ = ("_run",)

    def __init__(self, run: ChannelRun) -> None:
        self._run = run

    @property
    def machine(self) -> list[float]:
        """Machine position, mm (radius) and degrees."""
        seen = self._run.interpolator.seen
        return self._run.machine_position if seen is None else seen

    @property
    def work(self) -> list[float]:
        """Position in the work coordinate system that holds in the block in execution."""
        return self._run.work_position

    @property
    def clocked(self) -> Interpolator:
        """What executes the channel's rows in time."""
        return self._run.interpolator
