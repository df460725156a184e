"""How a control leads the axes; stated by the controls, therefore kept with the machine."""

from __future__ import annotations

from polycnc.toolpath.motion_settings import DEFAULT
from polycnc.toolpath.motion_settings import MotionSettings as Settings

__all__ = ["DEFAULT", "Settings"]
