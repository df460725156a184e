"""How far an axis is beside the path of its program because an operator has moved it while the program waited.

On controls that do not lead the axes back (`MotionSettings.returns_to_path`) the program goes on from where they are.
With manual absolute on, the coordinates count what was moved by hand, and the control takes it back axis by axis: a
straight line to a programmed end goes there from where the axes are; increments and arcs are run beside the path. With
manual absolute off, the coordinates do not know of it, and everything that follows is shifted.
"""

from __future__ import annotations

from math import inf


class ManualOffset:
    """What lies between the path and an axis, mm or degrees; nothing after power-on.

    Attributes:
        pending: Moved with manual absolute on; absolute words take it back.
        shift: Moved with manual absolute off; it stays until the axis has returned to its reference point, or power-on.
        due: When it changes by itself: never.
    """

    __slots__ = ("pending", "shift")

    due = inf

    def __init__(self) -> None:
        self.pending = 0.0
        self.shift = 0.0

    def at(self, _time: float) -> float:
        """Its share of the setpoint."""
        return self.pending + self.shift

    def arrive(self, time: float) -> None:
        """It never moves by itself."""
