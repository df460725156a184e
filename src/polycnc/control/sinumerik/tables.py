"""Small tables that several modules of the control read."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath.modes import AccelerationMode, CornerMode, FeedMode, StopWindow

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode

TURN = 360.0
MINUTE = 60.0
MM_PER_M = 1000.0
M_PER_FOOT = 0.3048


class FeedType(NamedTuple):
    """How F is meant under a function of group 15.

    Attributes:
        mode: The toolpath's feed mode.
        factor: From F to internal units (mm/s, mm/rev, 1/s); 0 where F is a time and its inverse counts.
        surface_speed: S is a cutting speed.
    """

    mode: FeedMode
    factor: float
    surface_speed: bool = False


#: What an exact stop waits for; G603: the end of the interpolation.
STOP_WINDOWS = {"G601": StopWindow.FINE, "G602": StopWindow.COARSE, "G603": StopWindow.NONE}
#: What becomes of corners under the functions of group 10.
CORNER_MODES = {
    "G60": CornerMode.EXACT_STOP,
    "G64": CornerMode.CONTINUOUS,
    "G641": CornerMode.ROUNDED_FROM,
    "G642": CornerMode.ROUNDED,
    "G643": CornerMode.ROUNDED,
    "G644": CornerMode.ROUNDED,
    "G645": CornerMode.ROUNDED,
}
#: How the axes take up speed under the functions of group 21.
ACCELERATION_MODES = {
    "BRISK": AccelerationMode.CONSTANT,
    "SOFT": AccelerationMode.JERK_LIMITED,
    "DRIVE": AccelerationMode.REDUCED_AT_SPEED,
}
_PER_MINUTE = FeedType(FeedMode.PER_MINUTE, 1.0 / MINUTE)
_PER_REVOLUTION = FeedType(FeedMode.PER_REVOLUTION, 1.0)
FEED_TYPES = {
    "G93": FeedType(FeedMode.INVERSE_TIME, 1.0 / MINUTE),
    "G94": _PER_MINUTE,
    "G95": _PER_REVOLUTION,
    "G96": FeedType(FeedMode.PER_REVOLUTION, 1.0, surface_speed=True),
    "G97": _PER_REVOLUTION,
    "G931": FeedType(FeedMode.INVERSE_TIME, 1.0),
    "G961": FeedType(FeedMode.PER_MINUTE, 1.0 / MINUTE, surface_speed=True),
    "G971": _PER_MINUTE,
    "G942": _PER_MINUTE,
    "G952": _PER_REVOLUTION,
    "G973": _PER_REVOLUTION,
}
#: They keep the linear or revolutional feed that held before: with cutting speed, and with the speed that this gave.
KEEP_FEED = frozenset(("G962", "G972"))
#: S is a cutting speed.
SURFACE_SPEEDS = frozenset(("G96", "G961", "G962"))
#: They choose the linear or revolutional feed and keep how S was meant before.
KEEP_SPEED = frozenset(("G942", "G952"))


def length_factor(mode: Mode) -> float:
    """From a programmed length to mm."""
    return INCH_MM if mode["unit"] in ("G70", "G700") else 1.0


def data_factor(mode: Mode) -> float:
    """From a length in data, such as a tool offset, as programs write and read it, to mm: inches under G700 alone."""
    return INCH_MM if mode["unit"] == "G700" else 1.0


def metres_of_cutting_speed(mode: Mode) -> float:
    """From a programmed cutting speed or peripheral speed to metres: feet under G700."""
    return M_PER_FOOT if mode["unit"] == "G700" else 1.0


def axis_feed_factor(mode: Mode, *, rotary: bool) -> float:
    """From a programmed feed of a positioning axis to mm/s or degrees/s: inches under G700, degrees never."""
    return (INCH_MM if mode["unit"] == "G700" and not rotary else 1.0) / MINUTE


def feed_type(mode: Mode) -> FeedType:
    """How F is meant in a modal state."""
    code = mode["feed"]
    if code in KEEP_FEED:
        return FEED_TYPES[mode["feed_kept"]]._replace(surface_speed=code == "G962")
    if code in KEEP_SPEED:
        return FEED_TYPES[code]._replace(surface_speed=mode["speed_kept"] in SURFACE_SPEEDS)
    return FEED_TYPES[code]


#: Path functions of group 1 that make splines.
SPLINES = ("ASPLINE", "BSPLINE", "CSPLINE")
#: Courses of the feed (group 37), FPO for a block, and the feed types under which FLIN and FCUB act.
CONSTANT, LINEAR, CUBIC, POLYNOMIAL = "FNORM", "FLIN", "FCUB", "FPO"
PROFILED = frozenset(("G93", "G94"))
#: Ways back to the contour (group 2): on lines, on quarters and on halves of a circle.
LINES, QUARTERS, HALVES = ("REPOSL", "REPOSA"), ("REPOSQ", "REPOSQA"), ("REPOSH", "REPOSHA")
REPOSITIONING = (*LINES, *QUARTERS, *HALVES)
#: Smooth approach and retraction (group 2).
APPROACHES, RETRACTIONS = ("G147", "G247", "G347"), ("G148", "G248", "G348")
#: Names that the cycles define for all programs (CYCLE832).
CYCLE_SYMBOLS = {
    "_OFF": 0,
    "_FINISH": 1,
    "_SEMIFIN": 2,
    "_ROUGH": 3,
    "_PRECISION": 4,
    "_ORI_FINISH": 11,
    "_ORI_SEMIFIN": 12,
    "_ORI_ROUGH": 13,
    "_ORI_PRECISION": 14,
    "_TOP_SURFACE_SMOOTH_OFF": 1_000_000,
    "_TOP_SURFACE_SMOOTH_ON": 2_000_000,
}
