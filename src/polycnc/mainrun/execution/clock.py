"""Simulated time, which all channels of a control share."""

from __future__ import annotations


class Clock:
    """The time since power-on.

    It goes from event to event; commands find it at a whole number of interpolation cycles.

    Args:
        cycle_s: Interpolation cycle.

    Attributes:
        time: Now, s.
        cycles: Interpolation cycles that commands have let pass.
    """

    __slots__ = ("cycle_s", "cycles", "time")

    def __init__(self, cycle_s: float) -> None:
        self.cycle_s = cycle_s
        self.time = 0.0
        self.cycles = 0
