"""What bounds a motion, and the speed that a program asks for."""

from __future__ import annotations

from enum import StrEnum
from math import inf
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import HELIX_KINDS
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.motion.planner import Planner
    from polycnc.toolpath import Context

#: Part by which speeds that count as one may differ.
SAME = 1e-6
#: Part by which the squared speed on a piece of a curve may change that counts as steady.
EVEN = 0.05


class Cause(StrEnum):
    """What bounds the motion."""

    FEED = "feed"
    AXES = "axes"
    CORNERS = "corners"
    ACCELERATION = "acceleration"
    JERK = "jerk"
    TIME_CONSTANT = "time-constant"
    CORNER_STEP = "corner-step"
    """A parameter for the change of an axis's speed at corners."""
    ARC_PULL = "arc-pull"
    """A parameter for the acceleration on arcs."""


class Part(NamedTuple):
    """Seconds and millimetres for which one cause held."""

    seconds: float
    way: float


def asked_speed(kind: int, feed: float, context: Context, planner: Planner) -> float:
    """Path speed that a row of a kind asks for, mm/s; 0 where that changes along it, or F counts a part of it."""
    if kind == Kind.RAPID:
        return context.rapid_speed or inf
    if is_uneven(kind, context) or context.feed_mode is FeedMode.INVERSE_TIME:
        return 0.0
    asked = feed * planner.rpm(context, 0.0) / 60.0 if context.feed_mode is FeedMode.PER_REVOLUTION else feed
    asked *= context.pace.feed if context.pace is not None else 1.0
    return asked if asked > 0.0 else inf


def is_uneven(kind: int, context: Context) -> bool:
    """Whether the speed that is asked for changes along a row, or F counts a part of it."""
    pace = context.pace
    return bool(
        context.surface_speed or (pace is not None and (pace.weights or pace.turning)) or kind in HELIX_KINDS
    )
