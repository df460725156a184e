"""From path to time: look-ahead speed planning.

`plan(toolpath, machine)` gives the cycle time of a toolpath, by row, by tool and in total; `Planner` does the
same chunk by chunk while the toolpath grows.
"""

from polycnc.motion.plan import Plan, Times, ToolTimes, plan
from polycnc.motion.settings import Settings

__all__ = ["Plan", "Settings", "Times", "ToolTimes", "plan"]
