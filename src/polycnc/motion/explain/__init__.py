"""Where cycle time goes: `account` (which limit held, piece by piece), `columns` (the same of many pieces at once)."""

from polycnc.motion.explain.account import Cause, Part, TimeAccount

__all__ = ["Cause", "Part", "TimeAccount"]
