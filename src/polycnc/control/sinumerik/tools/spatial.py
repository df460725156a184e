"""Radius compensation in space: CUT3DC, CUT3DCC, CUT3DCCD, with ISD, ORIC and ORID.

The tool stands beside the path by its radius, square on the path and on itself. An approach is always NORM. CUT3DCC is
told the contour, CUT3DCCD the path of the standard tool's centre: there wear and OFFN alone are the offset. Both take
the tool along itself to the limiting surface, whose normal A4 to C5 tell (`compensation.spatial.limiting_surface`).

Source: job planning 7.5 (CUT3D…, ISD), 7.6 (ORIC, ORID).
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.moves.knots import join
from polycnc.compensation.spatial.rules import (
    ARC_FIRST,
    INTERSECTION_FIRST,
    TURNS_ALONG,
    TURNS_BEFORE,
    Corners,
    Rules,
)
from polycnc.compensation.spatial.stage import SpatialStage
from polycnc.control.sinumerik.tools.edges import DP_CORNER_RADIUS, DP_RADIUS
from polycnc.control.sinumerik.tools.sides import SIDES, Contour
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.kinematics import unit
from polycnc.messages import AlarmError
from polycnc.transformation.chain import Chain
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from polycnc.transformation.seated import Seated

with loaded_when_called():
    from polycnc.compensation.spatial import limiting_surface
    from polycnc.compensation.spatial.limiting_surface import Mill
    from polycnc.control.sinumerik.transformations.posture import Orienting

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.geometry.frames import Vector

#: Functions of group 22 that compensate across a tool that turns.
CODES = frozenset(("CUT3DC", "CUT3DCC", "CUT3DCCD"))
#: The programmed path is that of the standard tool's centre.
BY_CENTRE = "CUT3DCCD"
#: With a limiting surface: mills with a cylinder at their end, or a torus; balls and cones are none.
LIMITED = frozenset(("CUT3DCC", "CUT3DCCD"))
MILLS, REFUSED = range(1, 400), frozenset((111, 155, 156, 157))
#: Types whose corner counts there; a ball is all corner.
TORI, BALL = (121, 131), 110
#: 180 degrees without a corner, and a corner that turns from an inner to an outer one.
RULES = Rules(no_corner="10764", changes="10770", square_start=True, no_room="10751")
#: Angle of a contour below which G451 leads round it on an arc: MD20210 counts from the straight line.
STRAIGHT_DEG = 180.0


@dataclass(frozen=True, slots=True)
class ToolOnWork:
    """How the tool stands in work coordinates under an orientation transformation.

    Attributes:
        point: The transformation.
        seat: The same with its frames; None without any.
    """

    point: ToolCentrePoint
    seat: Seated | None = None

    @classmethod
    def of(cls, transformation: object) -> ToolOnWork | None:
        """Under a transformation; None where that is none of the tool's direction."""
        if isinstance(transformation, ToolCentrePoint):
            return cls(transformation)
        seat = transformation if isinstance(transformation, Seated) else None
        inner = seat.inner if seat is not None else transformation
        inner = inner.links[0] if isinstance(inner, Chain) else inner
        return cls(inner, seat) if isinstance(inner, ToolCentrePoint) else None

    def tool_at(self, position: Sequence[float]) -> Vector:
        """Direction along the tool at a position of the path."""
        basic = position if self.seat is None else self.seat.basic(position)
        names, zero = self.point.axes, self.point.zero
        columns = {axis: names.index(axis) for axis in self.point.kinematics.axes}
        tool = self.point.kinematics.tool_on_work({axis: basic[i] + zero[i] for axis, i in columns.items()})
        return unit(tool if self.seat is None else self.seat.frame.inverse().direct(*tool))


class Floor(NamedTuple):
    """The limiting surface beside a wall (CUT3DCC, CUT3DCCD): whose normal blocks tell, and both mills.

    Attributes:
        surface: Where the normal is told, in the work.
        standard: The mill for which the program was made.
        actual: The one that cuts.
    """

    surface: Orienting
    standard: Mill
    actual: Mill


class CircumferentialStage(SpatialStage):
    """The stage of this control; `floor` is None without a limiting surface."""

    floor: Floor | None = None

    def move(self, move: Move) -> None:
        """Take the next move; 10753 for an arc that would lead to the contour."""
        if move.is_arc and self._starts:
            raise AlarmError("10753")
        super().move(move)

    def _deeper(self, normal: Vector, tool: Vector, tangent: Vector) -> float:
        """What the tool lacks to the limiting surface at the end of a block."""
        floor = self.floor
        if floor is None:
            return 0.0
        found = limiting_surface.across(floor.surface.normal, tangent)
        if found is None:
            return 0.0
        moved = floor.actual.radius - floor.standard.radius
        return -limiting_surface.infeed(floor.standard, floor.actual, moved, normal, tool, found)


def stage_of(channel: SinumerikChannel) -> CircumferentialStage | None:
    """The stage, while it compensates."""
    return channel.path.find(CircumferentialStage)


def select_side(channel: SinumerikChannel) -> None:
    """G41, G42 with CUT3DC …: the next move leads square onto the one behind it.

    Raises:
        AlarmError: 10765 without an orientation transformation, 10774 for a tool that cannot do it.
    """
    posture = ToolOnWork.of(channel.coordinates.transformation)
    if posture is None:
        raise AlarmError("10765")
    _check_tool(channel)
    side, size = SIDES[channel.mode["compensation"]], radius(channel)
    stage = stage_of(channel)
    if stage is not None:
        stage.change(side, size)
    else:
        channel.flush()
        stage = channel.path.put(
            CircumferentialStage(
                channel.coordinates.geometry,
                posture,
                size,
                side,
                _corners(channel),
                _rules(channel),
                partial(join, channel),
            )
        )
    stage.depth = Contour.of(channel).depth_mm
    stage.floor = _floor(channel)


def _check_tool(channel: SinumerikChannel) -> None:
    edge: Edge | None = channel.memory.tools.edge
    if edge is None or channel.mode["tool_offset"] not in LIMITED:
        return
    if edge.type not in MILLS or edge.type in REFUSED:
        raise AlarmError("10774", type=edge.type)


def _floor(channel: SinumerikChannel) -> Floor | None:
    """What CUT3DCC and CUT3DCCD know of the limiting surface; 10774 for a corner that is none (7.5.7).

    The contour of CUT3DCC is that of a cylinder with the radius of the tool, the path of CUT3DCCD that of the standard
    tool with its corner.
    """
    tools, code = channel.memory.tools, channel.mode["tool_offset"]
    edge: Edge | None = tools.edge
    if edge is None or code not in LIMITED:
        return None
    standard, size = edge.values[DP_RADIUS], tools.radius + Contour.of(channel).allowance_mm
    corners = (0.0, 0.0)
    if edge.type in TORI:
        corners = edge.values[DP_CORNER_RADIUS], edge.total(DP_CORNER_RADIUS)
    elif edge.type == BALL:
        corners = standard, size
    if min(corners) < 0.0 or size <= 0.0:
        raise AlarmError("10774", type=edge.type)
    of_program = Mill(standard, corners[0] if code == BY_CENTRE else 0.0)
    return Floor(Orienting.of(channel), of_program, Mill(size, corners[1]))


def leave(channel: SinumerikChannel) -> None:
    """G40: the last block ends square on itself, the next move leads back."""
    if stage_of(channel) is not None:
        channel.flush()
        channel.path.take(CircumferentialStage)


def follow(channel: SinumerikChannel) -> None:
    """Another radius, depth, way round corners or frame while the compensation is active."""
    stage, posture = stage_of(channel), ToolOnWork.of(channel.coordinates.transformation)
    if stage is None:
        return
    stage.posture = posture or stage.posture
    if stage.radius != radius(channel):
        stage.change(stage.side, radius(channel))
    stage.depth, stage.floor = Contour.of(channel).depth_mm, _floor(channel)
    stage.corners, stage.rules = _corners(channel), _rules(channel)


def radius(channel: SinumerikChannel) -> float:
    """Distance from the programmed path: the radius with OFFN, with CUT3DCCD its wear with OFFN."""
    tools, allowance = channel.memory.tools, Contour.of(channel).allowance_mm
    size: float = tools.radius + allowance
    if channel.mode["tool_offset"] == BY_CENTRE and tools.edge is not None:
        size -= tools.edge.values[DP_RADIUS]
    return size


def _corners(channel: SinumerikChannel) -> Corners:
    """G450: arcs; G451: intersections, and arcs where the corner is sharper than MD20210 says."""
    if channel.mode["corner"] == "G450":
        return Corners(ARC_FIRST)
    limit = channel.memory.data.number("$MC_CUTCOM_CORNER_LIMIT")
    return Corners(INTERSECTION_FIRST, STRAIGHT_DEG - limit)


def _rules(channel: SinumerikChannel) -> Rules:
    turns = TURNS_ALONG if channel.mode["corner_orientation"] == "ORIC" else TURNS_BEFORE
    return replace(RULES, turns=turns)
