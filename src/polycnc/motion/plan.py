"""A look-ahead plan of a whole toolpath."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.settings import DEFAULT, Settings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.machine import Machine
    from polycnc.motion.times import Plan
    from polycnc.toolpath import Toolpath


def plan(
    toolpath: Toolpath,
    machine: Machine,
    *,
    channel: int = 1,
    start: Sequence[float] = (),
    tool: int | str = 0,
    settings: Settings = DEFAULT,
) -> Plan:
    """Plan the speeds of a whole toolpath and say how long it takes.

    Args:
        toolpath: Its rows must all be held.
        machine: Limits of axes and spindles, times of tool changes and auxiliary functions.
        channel: Number of the channel that made the toolpath.
        start: Machine position of every column before the first row; all zero where it is left out.
        tool: Number or name of the tool in the spindle before the first row; 0 for none.
        settings: How the control leads the axes.
    """
    from polycnc.motion.planner import Planner

    planner = Planner(toolpath, machine, channel=channel, start=start, tool=tool, settings=settings)
    return planner.finish()
