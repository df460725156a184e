"""The stages of the path: chamfers and roundings first, then cutter radius compensation.

A stage stands in the channel's path only while it has something to do. Source: Fundamentals (CHF, CHR, RND,
RNDM, G40 to G42, NORM, KONT, G450, G451).
"""

from __future__ import annotations

from dataclasses import replace
from math import nan
from typing import TYPE_CHECKING

from polycnc.compensation.corner import SINUMERIK_CORNERS, CornerStage, CornerViolation, Shape
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.plane import Plane
from polycnc.compensation.policies import (
    SINUMERIK_KONT_G450,
    SINUMERIK_KONT_G451,
    SINUMERIK_NORM_G450,
    SINUMERIK_NORM_G451,
    Policy,
    Violation,
)
from polycnc.control.sinumerik.smooth_stage import SmoothApproach
from polycnc.control.sinumerik.spline_stage import SplineStage
from polycnc.control.sinumerik.tables import PLANES
from polycnc.control.sinumerik.tools import DP_TIP
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.path import PathStage
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.geometry.arcs import Point

POLICIES = {
    ("NORM", "G450"): SINUMERIK_NORM_G450,
    ("NORM", "G451"): SINUMERIK_NORM_G451,
    ("KONT", "G450"): SINUMERIK_KONT_G450,
    ("KONT", "G451"): SINUMERIK_KONT_G451,
}
VIOLATIONS = {
    Violation.ARC_START: "10753",
    Violation.ARC_CANCEL: "10754",
    Violation.NO_AVOIDANCE: "10751",
    Violation.AVOIDANCE_DANGEROUS: "10751",
    Violation.AVOIDANCE_INTERFERES: "10751",
}
CORNER_VIOLATIONS: dict[CornerViolation, str] = {}
SIDES = {"G41": 1, "G42": -1}
#: From the nose centre to the programmed tip along the plane's second and first axis (G18: X and Z), by
#: $TC_DP2.
TIPS = {
    1: (1.0, 1.0),
    2: (1.0, -1.0),
    3: (-1.0, -1.0),
    4: (-1.0, 1.0),
    5: (0.0, 1.0),
    6: (1.0, 0.0),
    7: (0.0, -1.0),
    8: (-1.0, 0.0),
}


class Stages:
    """The chain of one channel in one plane."""

    def __init__(self, channel: Channel, plane: str) -> None:
        self.plane_code = plane
        self.plane = Plane(*PLANES[plane], channel.coordinates.geometry)
        self.cutter = CutterCompensation(self.plane, SINUMERIK_NORM_G450, VIOLATIONS, channel.table)
        self.corner = CornerStage(self.plane, SINUMERIK_CORNERS, CORNER_VIOLATIONS, self.cutter)
        self.approach = SmoothApproach(self.plane, self.corner)
        self.spline = SplineStage(self.approach)
        self.side = 0
        suspend(channel, self)

    @property
    def active(self) -> bool:
        """Whether moves are held back or changed."""
        return any(stage.active for stage in (self.spline, self.approach, self.corner, self.cutter))

    def into_path(self, channel: Channel, *, collects: bool = False) -> None:
        """Put the stages that have something to do in front of the path, and no others.

        While a cycle reads a contour, its moves end in the recorder. `collects`: control points of a spline come.
        """
        chain: tuple[SplineStage | SmoothApproach | CornerStage | CutterCompensation, ...]
        chain = (self.spline, self.approach, self.corner, self.cutter)
        memory: Memory = channel.memory
        rest = memory.recorder or last(channel)
        head = self.spline if collects else next((stage for stage in chain if stage.active), rest)
        _begin_path(channel, head)


def last(channel: Channel) -> PathStage | None:
    """The last stage of the path, where it is more than writing rows (protection zones, probes)."""
    return channel.table if channel.table is not channel.rows else None


def _begin_path(channel: Channel, head: PathStage | None) -> None:
    """The watch for interrupts stands in front of everything, but while a contour is only read."""
    memory: Memory = channel.memory
    watch = memory.watch if memory.recorder is None else None
    if watch is not None:
        watch.after = head or channel.table
    channel.head = watch or head


def clear(channel: Channel) -> None:
    """Take all stages out of the path but those that watch it (reset)."""
    memory: Memory = channel.memory
    memory.stages = None
    _begin_path(channel, last(channel))


def stages(channel: Channel) -> Stages:
    """The stages for the active plane."""
    memory: Memory = channel.memory
    plane = channel.mode["plane"]
    if memory.stages is None or memory.stages.plane_code != plane:
        if memory.stages is not None and memory.stages.active:
            channel.flush()
        memory.stages = Stages(channel, plane)
    return memory.stages


def relax(channel: Channel) -> None:
    """Take stages that have nothing more to do out of the path."""
    memory: Memory = channel.memory
    if memory.stages is not None:
        memory.stages.into_path(channel)
    else:
        _begin_path(channel, memory.recorder or last(channel))


def change_plane(channel: Channel) -> None:
    """G17 to G19; alarm 10757 while compensation is active."""
    memory: Memory = channel.memory
    if memory.stages is not None and memory.stages.plane_code != channel.mode["plane"]:
        if memory.stages.cutter.active:
            raise AlarmError("10757")
        stages(channel)


def insert(channel: Channel, shape: Shape, size: float, feed: float = nan) -> None:
    """CHF, CHR, RND: a chamfer or rounding after the move of this block; alarm 16500 for a negative size."""
    if size < 0.0:
        raise AlarmError("16500")
    if size > 0.0:
        chain = stages(channel)
        chain.corner.insert(shape, size, feed)
        chain.into_path(channel)


def round_all(channel: Channel, radius: float, feed: float = nan) -> None:
    """RNDM: round every corner from now on; 0 ends it."""
    if radius < 0.0:
        raise AlarmError("16500")
    chain = stages(channel)
    chain.corner.round_all(radius, feed)
    chain.into_path(channel)


# ---- cutter radius compensation


def policy(channel: Channel) -> Policy:
    """The rules that hold now: approach, corner, and the limits of the machine data."""
    memory: Memory = channel.memory
    mode = channel.mode
    rules = POLICIES[mode["approach"], mode["corner"]]
    outer = replace(rules.outer, disc_percent=memory.disc)
    if mode["corner"] == "G451":
        outer = replace(outer, intersection_limit_deg=memory.data.number("$MC_CUTCOM_CORNER_LIMIT"))
    idle = memory.data.integer("$MC_CUTCOM_MAXNUM_DUMMY_BLOCKS")
    return replace(rules, outer=outer, read_blocks=idle + 2)


def select_side(channel: Channel) -> None:
    """G41, G42: the contour begins with the next move; alarm 10750 without a tool edge."""
    memory: Memory = channel.memory
    if memory.tools.edge is None:
        raise AlarmError("10750")
    chain = stages(channel)
    side = SIDES[channel.mode["side"]]
    chain.side = side
    chain.cutter.policy = policy(channel)
    chain.cutter.engage(side, radius(memory), tip(channel))
    chain.into_path(channel)


def leave_contour(channel: Channel) -> None:
    """G40: the next move leads back to the programmed path."""
    memory: Memory = channel.memory
    if memory.stages is not None and memory.stages.cutter.active:
        memory.stages.cutter.cancel()


def changed_radius(channel: Channel) -> None:
    """Another edge, TOFFR or OFFN while compensation is active."""
    memory: Memory = channel.memory
    if memory.stages is not None and memory.stages.cutter.active and channel.mode["side"] != "G40":
        memory.stages.cutter.change_radius(radius(memory), tip(channel))


def changed_rules(channel: Channel) -> None:
    """NORM, KONT, G450, G451 while compensation is active."""
    memory: Memory = channel.memory
    if memory.stages is not None and memory.stages.cutter.active:
        memory.stages.cutter.policy = policy(channel)


def suspend(channel: Channel, chain: Stages | None) -> None:
    """CUTCONON, CUTCONOF: blocks keep the vector of the last one, or are compensated themselves again."""
    if chain is not None:
        chain.cutter.suspended = channel.mode["constant_side"] == "CUTCONON"


def radius(memory: Memory) -> float:
    """Distance of the tool centre from the contour, mm."""
    return memory.tools.radius + memory.allowance_mm


def tip(channel: Channel) -> Point:
    """From the nose centre to the programmed tip in units of the radius; zero for milling tools."""
    memory: Memory = channel.memory
    edge = memory.tools.edge
    if edge is None or not edge.is_turning:
        return (0.0, 0.0)
    second, first = TIPS.get(int(edge.values[DP_TIP]), (0.0, 0.0))
    return (first, second)
