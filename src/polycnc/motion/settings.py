"""How a control leads the axes; stated by the controls, therefore kept with the machine."""

from __future__ import annotations

from polycnc.machine.motion_settings import BRISK, DEFAULT, DISTANCE_MODES, DRIVE, EXACT_STOP_MODES, SOFT
from polycnc.machine.motion_settings import MotionSettings as Settings

__all__ = ["BRISK", "DEFAULT", "DISTANCE_MODES", "DRIVE", "EXACT_STOP_MODES", "SOFT", "Settings"]
