"""Where cycle time goes: which limit held, over which share of the time and of the path.

`causes` (what bounds a motion, and which causes every bound of the planner can be), `account` (listens to a planner),
`kernels/` (bounds of rows and pieces, and which held), `compiled` (them as machine code).
"""

from polycnc.motion.explain.account import TimeAccount
from polycnc.motion.explain.causes import Cause, Part

__all__ = ["Cause", "Part", "TimeAccount"]
