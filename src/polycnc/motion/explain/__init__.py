"""Where cycle time goes: which limit held, over which share of the time and of the path.

`causes` (what bounds a motion, and the speed that is asked for), `account` (what held on every piece), `columns` (the
same of many pieces at once).
"""

from polycnc.motion.explain.account import TimeAccount
from polycnc.motion.explain.causes import Cause, Part

__all__ = ["Cause", "Part", "TimeAccount"]
