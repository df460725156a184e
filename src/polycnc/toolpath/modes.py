"""How a path is meant: what F counts, what becomes of corners, what an exact stop waits for, how axes accelerate.

These are the toolpath's own words. Each control says by a table which of its G codes mean which.
"""

from __future__ import annotations

from enum import StrEnum


class FeedMode(StrEnum):
    """What the feed of a row counts, and the unit of its number in the table."""

    PER_MINUTE = "per minute"
    """A speed along the path, mm/s (degrees/s)."""
    PER_REVOLUTION = "per revolution"
    """The way in one revolution of the spindle, mm."""
    INVERSE_TIME = "inverse time"
    """The part of the block that is done in a second, 1/s."""


class CornerMode(StrEnum):
    """How the path goes through the end of a block."""

    EXACT_STOP = "exact stop"
    """The axes come to rest there."""
    CONTINUOUS = "continuous"
    """Continuous path as the control drives it: some keep to the corner, some round it (`MotionSettings`)."""
    ROUNDED = "rounded"
    """The corner is rounded within a tolerance."""
    ROUNDED_FROM = "rounded from a distance"
    """The corner is rounded within a tolerance, and no earlier than at that distance from it."""


class StopWindow(StrEnum):
    """What an exact stop waits for."""

    FINE = "fine"
    COARSE = "coarse"
    NONE = "none"
    """For nothing but the end of the interpolation."""


class AccelerationMode(StrEnum):
    """How the axes take up speed."""

    CONSTANT = "constant"
    """Full acceleration at once."""
    JERK_LIMITED = "jerk limited"
    REDUCED_AT_SPEED = "reduced at speed"
    """Less acceleration from some velocity on."""
