"""From path to time: look-ahead speed planning.

`plan(toolpath, machine)` gives the cycle time of a toolpath, by row, by tool and in total; `Planner` does the
same chunk by chunk while the toolpath grows.

    columns     limits (machine and settings as the kernels read them), pace (what a program says beside F), settings
    the path    frames, transformed (the real axes under a transformation; demand: many
                rows at once; reach: how fast an arc gets from end to end), pole (through that of G12.1)
    planning    planner over `kernels/`, compiled or as they are (`compiled`), time_constants (what rapids and cuts run
                by), plan, times
    standing/   tool changes, spindle ramps, dwells, axes that are positioned beside the path
    phases/     one axis, or one piece of the path, from any speed on
    time        explain (which limit held, for how long)
    motion      law (phases of constant jerk over time), averaging (limited jerk: from there to the axes)
    sampling/   where the axes are at even times
    third_order/  limited jerk without averages: a bent path and a law along it (SOFT, look-ahead)
"""

from polycnc.motion.plan import plan
from polycnc.motion.settings import Settings
from polycnc.motion.times import Plan, Times, ToolTimes

__all__ = ["Plan", "Settings", "Times", "ToolTimes", "plan"]
