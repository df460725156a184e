"""What bounds a motion: the causes, and which of them every bound of the planner is.

`BOUNDS` is the one table of both: whatever the planner reads stands in it, with the causes that it can be.
"""

from __future__ import annotations

from enum import StrEnum

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping


class Cause(StrEnum):
    """What bounds the motion, in the order of their numbers in kernels (`kernels/held.py`)."""

    FEED = "feed"
    PATH_FEED = "path-feed"
    """The control's highest cutting feed along the path."""
    AXIS_FEED = "axis-feed"
    """The control's highest cutting feed of an axis, where it is below that of the machine."""
    AXES = "axes"
    PROGRAM_AXIS = "program-axis"
    """A highest velocity of an axis that the program names (VELOLIM, FL)."""
    OVERLAID = "overlaid"
    """What a motion over an axis leaves of its velocity."""
    FOLLOWING = "following"
    """The speed at which linear axes follow rotary ones under tip control."""
    BLOCK_TIME = "block-time"
    CORNERS = "corners"
    CORNER_STEP = "corner-step"
    """A parameter for the change of an axis's speed at corners."""
    LINE_PULL = "line-pull"
    """A parameter for the acceleration of an axis from one line to the next."""
    ARC_PULL = "arc-pull"
    """A parameter for the acceleration on arcs."""
    CURVATURE = "curvature"
    """The acceleration of an axis across the path."""
    ACCELERATION = "acceleration"
    SPINDLE_PULL = "spindle-pull"
    """The acceleration of the spindle that a tap follows."""
    JERK = "jerk"
    """The jerk of an axis that goes faster."""
    CORNER_JERK = "corner-jerk"
    """The jerk of an axis at corners and on curves."""
    SETTLING = "settling"
    """The averages by which the jerk has its limit come to rest."""
    TIME_CONSTANT = "time-constant"
    STANDSTILL = "standstill"
    """The axes brake for a standstill."""
    RAPID = "rapid"


class Part(NamedTuple):
    """Seconds and millimetres for which one cause held."""

    seconds: float
    way: float


_NONE: tuple[Cause, ...] = ()
#: By what the planner reads, the causes that it can be as a bound of the speed; none where it bounds none and says only
#: how rows are led or measured.
BOUNDS: Mapping[str, tuple[Cause, ...]] = {
    "Rows.kind": _NONE,
    "Rows.context": _NONE,
    "Rows.feed": (Cause.FEED,),
    "Rows.end": _NONE,
    "Rows.curve": _NONE,
    "Rows.stops": (Cause.STANDSTILL,),
    "Rows.share": _NONE,
    "Rows.top": (Cause.AXES, Cause.PROGRAM_AXIS, Cause.OVERLAID, Cause.FOLLOWING, Cause.CURVATURE),
    "Rows.ease": (Cause.ACCELERATION, Cause.JERK),
    "PathLimits.rapid_stops": (Cause.STANDSTILL,),
    "PathLimits.path_feed": (Cause.PATH_FEED,),
    "PathLimits.arc_pull": (Cause.ARC_PULL,),
    "PathLimits.arc_least": _NONE,
    "PathLimits.bend_least": _NONE,
    "PathLimits.block_s": (Cause.BLOCK_TIME,),
    "PathLimits.feed_along_arc": _NONE,
    "PathLimits.arc_by_radius": _NONE,
    "Limits.top_rapid": (Cause.RAPID,),
    "Limits.top_feed": (Cause.AXES, Cause.AXIS_FEED),
    "Limits.acceleration": (Cause.ACCELERATION, Cause.CURVATURE),
    "Limits.jump": (Cause.CORNERS,),
    "Limits.step": (Cause.CORNER_STEP,),
    "Limits.arc": (Cause.ARC_PULL,),
    "Limits.bend": (Cause.LINE_PULL,),
    "Limits.rotary": _NONE,
    "Limits.jerk": (Cause.JERK, Cause.CORNER_JERK),
    "Limits.geometry": _NONE,
    "Limits.path": _NONE,
    "Limits.linkage": (Cause.AXES, Cause.CURVATURE),
    "ContextRecord.PER_REVOLUTION": _NONE,
    "ContextRecord.INVERSE_TIME": _NONE,
    "ContextRecord.RPM": (Cause.FEED,),
    "ContextRecord.SURFACE_MM_S": (Cause.FEED,),
    "ContextRecord.RPM_LIMIT": (Cause.FEED,),
    "ContextRecord.SPINDLE_REV_S2": (Cause.SPINDLE_PULL,),
    "ContextRecord.EXACT_STOP": (Cause.STANDSTILL,),
    "ContextRecord.TOLERANCE": (Cause.CORNERS,),
    "ContextRecord.ROTARY_WEIGHT": _NONE,
    "ContextRecord.STATION": (Cause.STANDSTILL,),
    "ContextRecord.HAS_FRAME": _NONE,
    "ContextRecord.MIRROR": _NONE,
    "ContextRecord.RAPID_BY_AXIS": (Cause.STANDSTILL,),
    "ContextRecord.RAMP_S": (Cause.JERK, Cause.CORNER_JERK, Cause.SETTLING),
    "ContextRecord.BLEND_S": (Cause.JERK, Cause.CORNER_JERK, Cause.SETTLING),
    "ContextRecord.DRIVE_SPEED": (Cause.ACCELERATION,),
    "ContextRecord.DRIVE_REDUCTION": (Cause.ACCELERATION,),
    "ContextRecord.RAPID_SPEED": (Cause.RAPID,),
    "ContextRecord.OVERLAP": _NONE,
    "ContextRecord.RAPID_OVERLAP": _NONE,
    "ContextRecord.LAG_S": (Cause.TIME_CONSTANT,),
    "ContextRecord.LAG_FROM": _NONE,
    "ContextRecord.RAPID_SHARE": (Cause.RAPID,),
    "ContextRecord.ROUNDING": (Cause.CORNERS,),
    "ContextRecord.TURN_TOLERANCE": (Cause.CORNERS,),
    "ContextRecord.TURN_DISTANCE": (Cause.CORNERS,),
    "ContextRecord.SWING": (Cause.CORNERS,),
    "ContextRecord.LED": _NONE,
    "ContextRecord.AHEAD": _NONE,
    "ContextRecord.BEHIND_S": (Cause.TIME_CONSTANT,),
    "ContextRecord.TURN_SPEED": (Cause.PATH_FEED,),
    "ContextRecord.TURN_WEIGHT": _NONE,
    "ContextRecord.BY_WAY": _NONE,
    "ContextRecord.CHORDS": _NONE,
    "ContextRecord.SPEED_LEFT": (Cause.PROGRAM_AXIS,),
    "ContextRecord.FRAME": _NONE,
    "ContextRecord.OFFSETS": _NONE,
    "Pace.feed": (Cause.FEED,),
    "Pace.rapid": (Cause.RAPID,),
    "Pace.edge": (Cause.FEED,),
    "Pace.weights": _NONE,
    "Pace.turning": _NONE,
    "Pace.top": (Cause.PROGRAM_AXIS,),
    "Pace.reach": (Cause.AXES,),
    "Pace.following": (Cause.FOLLOWING,),
    "Pace.velocity": (Cause.PROGRAM_AXIS,),
    "Pace.acceleration": (Cause.ACCELERATION, Cause.CURVATURE),
    "Pace.jerk": (Cause.JERK, Cause.CORNER_JERK),
    "Pace.left": (Cause.OVERLAID,),
    "Pace.left_pull": (Cause.ACCELERATION, Cause.CURVATURE),
}
