"""Numbers of the M functions that the control itself knows (Fundamentals, M functions)."""

from __future__ import annotations

STOP, OPTIONAL_STOP = 0, 1
PROGRAM_ENDS = frozenset({2, 30, 17})
DIRECTIONS = {3: 1, 4: -1, 5: 0}
ORIENT, AXIS_MODE = 19, 70
#: Automatic choice of the gear stage, and stages 1 to 5.
GEARS = range(40, 46)
AFTER_MOTION = frozenset({STOP, OPTIONAL_STOP, *PROGRAM_ENDS})
#: M functions that no program can stand for.
NEVER_CALL = frozenset({*AFTER_MOTION, *DIRECTIONS, AXIS_MODE, *GEARS})
