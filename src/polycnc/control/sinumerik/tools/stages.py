"""The stages of the plane: splines, smooth approach, chamfers and roundings, cutter radius compensation.

A stage stands in the channel's path only while it has something to do: what commands it puts it there, and behind
every block `Path.relax` takes out those that are through. Source: Fundamentals (CHF, CHR, RND,
RNDM, G40 to G42, NORM, KONT, G450, G451).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import nan
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.compensation.corner import CornerPolicy, CornerStage, CornerViolation, Shape
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.plane import Plane
from polycnc.compensation.policy import Approach, Policy, Violation
from polycnc.compensation.tips import tip_direction
from polycnc.control.sinumerik.motion.spline_stage import SplineStage
from polycnc.control.sinumerik.tools.memory import DP_TIP
from polycnc.control.sinumerik.tools.smooth_stage import SmoothApproach
from polycnc.geometry.offset import Joint, Outer
from polycnc.geometry.planes import PLANES
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: MD20250 = 5 blocks without motion are bridged, by compensation and between the two moves of a corner.
BRIDGED_BLOCKS = 5
_G450 = Policy(outer=Outer(0.0, Joint.ARC), read_blocks=BRIDGED_BLOCKS + 2, avoids=True)
#: MD20210 = 100 degrees.
_G451 = replace(_G450, outer=Outer(100.0, Joint.ARC, extend_as_circles=True))
POLICIES = {
    ("NORM", "G450"): _G450,
    ("NORM", "G451"): _G451,
    ("KONT", "G450"): replace(_G450, approach=Approach.TANGENT),
    ("KONT", "G451"): replace(_G451, approach=Approach.TANGENT),
}
#: Too large a size is reduced.
CORNERS = CornerPolicy(idle_blocks=BRIDGED_BLOCKS, shrinks=True)
VIOLATIONS = {
    Violation.ARC_START: "10753",
    Violation.ARC_CANCEL: "10754",
    Violation.NO_AVOIDANCE: "10751",
    Violation.AVOIDANCE_DANGEROUS: "10751",
    Violation.AVOIDANCE_INTERFERES: "10751",
}
CORNER_VIOLATIONS: dict[CornerViolation, str] = {}
SIDES = {"G41": 1, "G42": -1}
#: Stages that work in one plane.
PlaneStage = SplineStage | SmoothApproach | CornerStage | CutterCompensation
OF_PLANE: tuple[type[PlaneStage], ...] = (SplineStage, SmoothApproach, CornerStage, CutterCompensation)


@dataclass(slots=True)
class Contour(State, lifetime=Lifetime.POWER):
    """What words say of the compensated contour.

    Attributes:
        allowance_mm: OFFN.
        disc: DISC, 0 to 100.
    """

    allowance_mm: float = 0.0
    disc: float = 0.0


def cutter(channel: SinumerikChannel) -> CutterCompensation:
    """The stage of cutter radius compensation, in the path."""
    change_plane(channel)
    stage = channel.path.find(CutterCompensation)
    if stage is None:
        stage = channel.path.put(CutterCompensation(plane(channel), _G450, VIOLATIONS))
        suspend(channel)
    return stage


def active_cutter(channel: SinumerikChannel) -> CutterCompensation | None:
    """The stage that compensates; None while none does."""
    stage = channel.path.find(CutterCompensation)
    return stage if stage is not None and stage.active else None


def corner(channel: SinumerikChannel) -> CornerStage:
    """The stage of chamfers and roundings, in the path."""
    change_plane(channel)
    stage = channel.path.find(CornerStage)
    return stage or channel.path.put(CornerStage(plane(channel), CORNERS, CORNER_VIOLATIONS))


def approach(channel: SinumerikChannel) -> SmoothApproach:
    """The stage that holds a smooth approach back, in the path."""
    change_plane(channel)
    return channel.path.find(SmoothApproach) or channel.path.put(SmoothApproach(plane(channel)))


def spline(channel: SinumerikChannel) -> SplineStage:
    """The stage that collects control points, in the path."""
    change_plane(channel)
    return channel.path.find(SplineStage) or channel.path.put(SplineStage(plane(channel)))


def plane(channel: SinumerikChannel) -> Plane:
    """The active plane."""
    return Plane(*PLANES[channel.mode["plane"]], channel.coordinates.geometry)


def change_plane(channel: SinumerikChannel) -> None:
    """G17 to G19: stages of another plane end what they hold; alarm 10757 while compensation is active."""
    first = PLANES[channel.mode["plane"]][0]
    found = [stage for kind in OF_PLANE if (stage := channel.path.find(kind)) and stage.plane.u != first]
    if not found:
        return
    if active_cutter(channel) is not None:
        raise AlarmError("10757")
    if any(stage.active for stage in found):
        channel.flush()
    channel.path.take(*OF_PLANE)


def insert(channel: SinumerikChannel, shape: Shape, size: float, feed: float = nan) -> None:
    """CHF, CHR, RND: a chamfer or rounding after the move of this block; alarm 16500 for a negative size."""
    if size < 0.0:
        raise AlarmError("16500")
    if size > 0.0:
        corner(channel).insert(shape, size, feed)


def round_all(channel: SinumerikChannel, radius: float, feed: float = nan) -> None:
    """RNDM: round every corner from now on; 0 ends it."""
    if radius < 0.0:
        raise AlarmError("16500")
    corner(channel).round_all(radius, feed)


# ---- cutter radius compensation


def policy(channel: SinumerikChannel) -> Policy:
    """The rules that hold now: approach, corner, and the limits of the machine data."""
    mode, data = channel.mode, channel.memory.data
    rules = POLICIES[mode["approach"], mode["corner"]]
    outer = replace(rules.outer, disc_percent=Contour.of(channel).disc)
    if mode["corner"] == "G451":
        outer = replace(outer, intersection_limit_deg=data.number("$MC_CUTCOM_CORNER_LIMIT"))
    idle = data.integer("$MC_CUTCOM_MAXNUM_DUMMY_BLOCKS")
    return replace(rules, outer=outer, read_blocks=idle + 2)


def select_side(channel: SinumerikChannel) -> None:
    """G41, G42: the contour begins with the next move; alarm 10750 without a tool edge."""
    memory = channel.memory
    if memory.tools.edge is None:
        raise AlarmError("10750")
    stage = cutter(channel)
    stage.policy = policy(channel)
    stage.engage(SIDES[channel.mode["compensation"]], radius(channel), tip(channel))


def leave_contour(channel: SinumerikChannel) -> None:
    """G40: the next move leads back to the programmed path."""
    stage = active_cutter(channel)
    if stage is not None:
        stage.cancel()


def changed_radius(channel: SinumerikChannel) -> None:
    """Another edge, TOFFR or OFFN while compensation is active."""
    stage = active_cutter(channel)
    if stage is not None and channel.mode["compensation"] != "G40":
        stage.change_radius(radius(channel), tip(channel))


def changed_rules(channel: SinumerikChannel) -> None:
    """NORM, KONT, G450, G451 while compensation is active."""
    stage = active_cutter(channel)
    if stage is not None:
        stage.policy = policy(channel)


def suspend(channel: SinumerikChannel) -> None:
    """CUTCONON, CUTCONOF: blocks keep the vector of the last one, or are compensated themselves again."""
    stage = channel.path.find(CutterCompensation)
    if stage is not None:
        stage.suspended = channel.mode["constant_side"] == "CUTCONON"


def radius(channel: SinumerikChannel) -> float:
    """Distance of the tool centre from the contour, mm."""
    return channel.memory.tools.radius + Contour.of(channel).allowance_mm


def tip(channel: SinumerikChannel) -> Point:
    """From the nose centre to the programmed tip in units of the radius; zero for milling tools."""
    memory = channel.memory
    edge = memory.tools.edge
    if edge is None or not edge.is_turning:
        return (0.0, 0.0)
    return tip_direction(int(edge.values[DP_TIP]))
