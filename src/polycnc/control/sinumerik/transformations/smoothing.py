"""How far smoothing may leave the programmed way: OSD and OST of the orientation (7.6), the compressors (4.4, 6.6).

None of them makes blocks of its own: the rows stay those of the program, and the planner goes through their ends as
fast as the tolerances allow. A compressor also leads cuts of short blocks beside their ends, by a part of its
tolerance, so that the path is smoother (`channel/moves/fairing.py`); rounding has the rest. OSC turns the tool evenly
along its block, as it turns without smoothing.
"""

from __future__ import annotations

from math import sqrt

from polycnc.control.sinumerik.feed.tolerances import Smoothing, axis_tolerance, contour_tolerance
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.transformations.words import BY_PATH, CONES
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import dot
from polycnc.machine.kinematics import unit
from polycnc.toolpath.context import Fairing
from polycnc.toolpath.modes import CornerMode

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.block.draft import Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.machine.kinematics import Kinematics
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

#: Setting data that the tolerances of a context are made of.
DATA = frozenset(
    ("$SC_COMPRESS_CONTUR_TOL", "$SC_COMPRESS_ORI_TOL", "$SC_ORI_SMOOTH_DIST", "$SC_ORI_SMOOTH_TOL")
)
#: Modal groups that they depend on.
GROUPS = frozenset(("compressor", "orientation_smoothing", "orientation_motion"))
#: Functions of group 51 whose ways of the direction no compressor takes (6.6).
NOT_COMPRESSED = frozenset((*CONES, *BY_PATH, "ORICURVE"))
#: Units of MD20482 by which setting data, not MD33100 of the axes, bound the contour and the orientation.
BY_CONTOUR, BY_ORIENTATION = (1, 3), (2, 3)


#: How many ends before and behind one tell a compressor where the path goes: COMPCURV makes it smoother than COMPON,
#: whose velocity alone is continuous, COMPCAD takes the most blocks together.
REACH = {"COMPON": 4, "COMPCURV": 8, "COMPCAD": 16}


#: A rotary axis that may not leave its way at all may by so much, degrees.
LEAST_SWING = 1e-4


class Turn(NamedTuple):
    """How the rotary axes may leave their way where two blocks meet; zero for no bound of that kind."""

    tolerance_deg: float = 0.0
    distance_mm: float = 0.0


def is_compressed(mode: Mode) -> bool:
    """Whether the compressor takes the blocks of a modal state: linear ones under continuous path."""
    return mode["compressor"] != "COMPOF" and mode["motion"] == "G1" and mode["path"] != "G60"


def corner_mode(mode: Mode, otherwise: CornerMode) -> CornerMode:
    """How the ends of blocks are passed: the compressor rounds what continuous path alone would not."""
    return CornerMode.ROUNDED if otherwise is CornerMode.CONTINUOUS and is_compressed(mode) else otherwise


def contour(channel: SinumerikChannel, mode: Mode, otherwise: float) -> float:
    """Tolerance of the contour, mm: that of the compressor where it is wider than the one of rounding."""
    if not is_compressed(mode) or mode["path"] == "G641":
        return otherwise
    return max(otherwise, _own_contour(channel))


def _own_contour(channel: SinumerikChannel) -> float:
    """CTOL, or what the compressor's data allow, mm."""
    data = channel.memory.data
    own = contour_tolerance(channel)
    if not own and data.integer("$MC_COMPRESSOR_MODE") % 10 in BY_CONTOUR:
        own = data.number("$SC_COMPRESS_CONTUR_TOL")
    return own or _of_axes(channel, (i for i in channel.coordinates.geometry if i >= 0))


def fairing(channel: SinumerikChannel, mode: Mode) -> Fairing | None:
    """How the compressor leads cuts of blocks up to MD20170 (4.4, 6.6); under GEOAX it does not."""
    if not is_compressed(mode):
        return None
    made, geometry = channel.coordinates.transformation, tuple(channel.coordinates.geometry)
    own = channel.machine.geometry_indices(channel.number) if made is None else made.geometry
    point = None if made is None else seat.centre_point(channel)
    if geometry != tuple(own) or (point is not None and mode["orientation_motion"] in NOT_COMPRESSED):
        return None
    turns = _turns(channel) if made is None else _orientation(channel, point)
    longest = channel.memory.data.number("$MC_COMPRESS_BLOCK_PATH_LIMIT")
    tolerance, reach = _own_contour(channel), REACH[mode["compressor"]]
    return Fairing(tolerance, reach, longest, turns) if tolerance > 0.0 < longest else None


def _turns(channel: SinumerikChannel) -> tuple[tuple[int, float], ...]:
    """What ATOL or MD33100 allows each rotary axis, degrees."""
    rotary = (column for column, axis in enumerate(channel.axis_data) if axis.rotary)
    return tuple((column, axis_tolerance(channel, column)) for column in rotary)


def _orientation(channel: SinumerikChannel, point: ToolCentrePoint | None) -> tuple[tuple[int, float], ...]:
    """What each axis that turns the tool may leave its way by, so that its direction stays within the tolerance."""
    if point is None:
        return ()
    columns = [point.axes.index(axis) for axis in point.kinematics.axes]
    allowed = _direction_tolerance(channel)
    if allowed is None:
        return tuple((column, axis_tolerance(channel, column)) for column in columns)
    return tuple((column, allowed / together(point.kinematics)) for column in columns)


def swing(channel: SinumerikChannel, mode: Mode) -> float:
    """What the compressor allows every rotary axis that no transformation leads, degrees; 0 where it is not on."""
    if not is_compressed(mode) or mode["path"] == "G641" or channel.coordinates.transformation is not None:
        return 0.0
    turns = _turns(channel)
    return max(min(degrees for _, degrees in turns), LEAST_SWING) if turns else 0.0


def select(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """COMPON, COMPCURV, COMPCAD, COMPOF."""
    follow(channel)


def follow(channel: SinumerikChannel) -> None:
    """The modal state has changed: while a compressor is on, its stage holds cuts back."""
    if channel.mode["compressor"] != "COMPOF":
        from polycnc.control.sinumerik.feed.compressor import Compressor  # where one is on

        if channel.path.find(Compressor) is None:
            channel.path.put(Compressor(channel))


def turn(channel: SinumerikChannel, mode: Mode) -> Turn:
    """What group 34 and the compressor allow the rotary axes of the transformation that acts."""
    if mode["path"] == "G60":
        return Turn()
    point = seat.centre_point(channel)
    if point is None:
        return Turn()
    data, code = channel.memory.data, mode["orientation_smoothing"]
    given = Smoothing.of(channel).tolerance.get("OTOL", 0.0)
    if code == "OSD":
        return Turn(distance_mm=data.number("$SC_ORI_SMOOTH_DIST"))
    if code == "OST":
        return Turn(given if given > 0.0 else data.number("$SC_ORI_SMOOTH_TOL"))  # of each axis (7.6)
    if not is_compressed(mode) or mode["orientation_motion"] in NOT_COMPRESSED:
        return Turn()
    return Turn(min((degrees for _, degrees in _orientation(channel, point)), default=0.0))


def _direction_tolerance(channel: SinumerikChannel) -> float | None:
    """What the compressor lets the tool's direction leave its way by, degrees; None where each axis has its own."""
    given = Smoothing.of(channel).tolerance.get("OTOL", 0.0)
    if given > 0.0:
        return given
    data = channel.memory.data
    own = data.integer("$MC_COMPRESSOR_MODE") % 10 in BY_ORIENTATION
    return data.number("$SC_COMPRESS_ORI_TOL") if own else None


def together(kinematics: Kinematics) -> float:
    """How far the tool's direction is turned at most, as a part of what each rotary axis turns by.

    Two axes, square to each other, turn it by the root of two: turns by little add up as vectors along the axes do.
    """
    joints = [unit(joint.direction) for joint in (*kinematics.tool, *kinematics.work)]
    if len(joints) != 2:
        return float(len(joints))
    return sqrt(2.0 + 2.0 * abs(dot(*joints)))


def _of_axes(channel: SinumerikChannel, columns: Iterable[int]) -> float:
    """MD33100 of some axes, the smallest one."""
    data = channel.memory.data
    return min(data.number("$MA_COMPRESS_POS_TOL", channel.axes[column]) for column in columns)
