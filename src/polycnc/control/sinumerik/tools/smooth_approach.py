"""Smooth approach and retraction: G147, G247, G347 and G148, G248, G348 (Fundamentals, SAR).

A contour is reached and left along a straight line, a quarter or a half circle that touches it:

    P0 --in the plane, at the height of P0--> P1 --down--> P2 --FAD--> P3 --line or arc--> P4, start of the contour

P2 lies DISCL above the machining plane. With G341 the way P2 to P3 goes down to the plane and P3 to P4 lies in it;
with G340 P3 is P2, and P3 to P4 is a slope or a helix. A retraction is the same backwards.

Up to P2 the speed of the block before holds (rapid under G0), from there on the block's own F. FAD is the speed of
P2 to P3, with G340 that of P3 to P4.

DISR is the distance of the tool's edge from the contour for lines, and the radius of the tool centre's path for arcs.
What is handed on is the contour P3 to P4 of the programmed side; radius compensation moves it as any other contour.
As its direction is that of the contour's first move, an approach waits for that move.
"""

from __future__ import annotations

from math import isnan, nan

from polycnc.channel.moves.path import Move
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block.positions import number, target
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion import circles, moves
from polycnc.control.sinumerik.motion.last_move import LastMove
from polycnc.control.sinumerik.tables import MINUTE, length_factor
from polycnc.control.sinumerik.tools import sides, stages
from polycnc.control.sinumerik.tools.smooth_stage import (
    LINES,
    Approach,
    Clearance,
    Shape,
    height_of,
    with_value,
)
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel

#: What FAD calls the types of feeds that it may have of its own.
_FEED_TYPES = {FeedMode.PER_MINUTE: "PM", FeedMode.PER_REVOLUTION: "PR"}


@dataclass(slots=True)
class Words:
    """The words of a block, worked out.

    Attributes:
        distance: Place of DISR.
        clearance: Place of DISCL and whether it is absolute, or None.
        infeed: Place of FAD and the feed type that it names (PM, PR, or empty for that of the block), or None.
    """

    distance: int | None
    clearance: tuple[int, bool] | None
    infeed: tuple[int, str] | None

    @classmethod
    def take(cls, draft: Draft) -> Words:
        """Take DISR, DISCL and FAD."""
        distance = draft.take("DISR")
        height = draft.take_shape("DISCL", "AC")
        infeed = draft.take_shape("FAD", "PM", "PR")
        clearance = (height[0], height[1].modifier == "AC") if height is not None else None
        return cls(distance, clearance, (infeed[0], infeed[1].modifier) if infeed is not None else None)

    def shape(self, draft: Draft, channel: SinumerikChannel, values: Values, compensation: int) -> Shape:
        """The line or arc; alarm 10742 without DISR or with one that is not positive.

        Its side is open under G143, and under G140 without compensation.
        """
        if self.distance is None:
            raise AlarmError("10742")
        size = number(values, self.distance) * length_factor(draft.mode)
        if size <= 0.0:
            raise AlarmError("10742")
        side = {"G141": 1, "G142": -1, "G140": compensation}.get(draft.mode["smooth_approach_side"], 0)
        radius = stages.radius(channel)
        code, in_plane = draft.codes["block_motion"], draft.mode["smooth_approach_path"] == "G341"
        if code in LINES:
            size += radius if compensation and radius > 0.0 else 0.0
            return Shape(code, size, side or 1, in_plane)
        shape = Shape(code, size, 0, in_plane, radius * compensation)
        return shape.sided(side) if side else shape

    def height(self, draft: Draft, values: Values) -> Clearance:
        """DISCL in mm; None without one."""
        if self.clearance is None:
            return None
        return number(values, self.clearance[0]) * length_factor(draft.mode), self.clearance[1]

    def infeed_speed(self, draft: Draft, channel: SinumerikChannel, values: Values) -> float:
        """FAD in the unit of the block's feed; NaN without one. PR and PM meet at the speed of the master spindle.

        Raises:
            AlarmError: 10860 where that stands still.
        """
        if self.infeed is None:
            return nan
        place, told = self.infeed
        feed = tables.feed_type(draft.mode)
        value, mode = number(values, place), feed.mode
        if told in ("", _FEED_TYPES.get(mode, "")):
            return value * moves.feed_factor(draft)
        speed = channel.memory.spindles.get().speed
        if not speed > 0.0:
            raise AlarmError("10860")
        inch = INCH_MM if draft.mode["unit"] == "G700" else 1.0
        if told == "PM" and mode is FeedMode.PER_REVOLUTION and not feed.surface_speed:
            return value / speed * inch
        if told == "PR" and mode is FeedMode.PER_MINUTE:
            return value * speed * inch / MINUTE
        raise not_supported(f"FAD={told}")  # beside G93, G96 and feeds of a tooth


# ---- the two kinds of blocks


def approach(draft: Draft) -> Step | None:
    """G147, G247, G347: approach; P4 is the block's own point in the plane, or that of the next move."""
    words = Words.take(draft)
    terms = draft.take_axes()
    columns = moves.plane_columns(draft)
    third = columns[2]
    names_point = any(term.column in columns[:2] for term in terms)
    names_depth = any(term.column == third for term in terms)
    tells_feed = any(word.address == "F" for word in draft.block.words)
    draft.steps.append(_remember_feed)

    def run(channel: SinumerikChannel, values: Values) -> None:
        if stages.approach(channel).active:
            raise AlarmError("10743")
        start = channel.coordinates.position
        end = target(channel, terms, values)
        compensation = sides.SIDES.get(draft.mode["compensation"], 0)
        shape = words.shape(draft, channel, values, compensation)
        clearance = words.height(draft, values)
        if third >= 0 and (names_point or names_depth):
            height_of(clearance, start[third], end[third])
        is_rapid = draft.mode["motion"] == "G0"
        before = _feed_before(channel)
        place = _place(channel, Kind.RAPID if is_rapid else Kind.FEED, nan if is_rapid else before)
        feed = moves.checked_feed(channel.feed)
        touch = end if names_point else None
        deep = end[third] if names_depth else nan
        infeed = words.infeed_speed(draft, channel, values)
        if isnan(infeed):
            infeed = feed if tells_feed else nan
        elif not shape.in_plane:
            feed = infeed
        waiting = Approach(shape, place, start, touch, clearance, deep, feed, infeed)
        LastMove.of(channel).start = None
        channel.coordinates.arrive(end)
        stages.approach(channel).waiting = waiting

    return run


# ---- retraction


def retract(draft: Draft) -> Step | None:
    """G148, G248, G348: retraction; G40 in its block ends compensation behind the line or arc."""
    words = Words.take(draft)
    terms = draft.take_axes()
    columns = moves.plane_columns(draft)
    axes = PLANES[draft.mode["plane"]]
    names_point = any(term.column in columns[:2] for term in terms)
    draft.steps.append(_remember_feed)

    def run(channel: SinumerikChannel, values: Values) -> None:
        stages.refuse_open_change(channel, draft.codes["block_motion"])
        cutter = stages.active_cutter(channel)
        compensation = cutter.side if cutter is not None else 0
        direction = circles.last_direction(channel, columns, axes)
        shape = words.shape(draft, channel, values, compensation)
        start = channel.coordinates.position
        end = target(channel, terms, values)
        u, v, third = columns
        touch = (start[u], start[v])
        if shape.side == 0 and not names_point:
            raise AlarmError("10747")
        shape = shape.towards((end[u], end[v]), touch, direction)
        old = _feed_before(channel)
        far = shape.far_end(touch, direction)
        clearance = words.height(draft, values)
        height = height_of(clearance, end[third], start[third]) if third >= 0 else 0.0
        point = start.copy()
        point[u], point[v] = far
        if third >= 0 and not shape.in_plane:
            point[third] = height
        center = shape.center(touch, direction)
        infeed = words.infeed_speed(draft, channel, values)
        feed = moves.checked_feed(old if shape.in_plane or isnan(infeed) else infeed)
        with channel.under(replace(channel.context, origin=shape.origin)):
            if center is None:
                moves.line(channel, Kind.FEED, point, feed)
            else:
                circles.arc(channel, columns, axes, point, center, feed, shape.ccw)
        if draft.codes.get("compensation") == "G40":
            stages.leave_contour(channel)
            channel.context_changed()
        _away(channel, draft, third, point, end if names_point else None, height, end, infeed)

    return run


def _away(
    channel: SinumerikChannel,
    draft: Draft,
    third: int,
    point: list[float],
    goal: list[float] | None,
    height: float,
    end: list[float],
    infeed: float,
) -> None:
    """From the end of the line or arc up to the height of P0, and to P0 in the plane."""
    is_rapid = draft.mode["motion"] == "G0"
    kind, feed = (Kind.RAPID, nan) if is_rapid else (Kind.FEED, moves.checked_feed(channel.feed))
    if third >= 0:
        slow = (kind, feed) if isnan(infeed) else (Kind.FEED, infeed)
        moves.line(channel, slow[0], with_value(point, third, height), slow[1])
        moves.line(channel, kind, with_value(point, third, end[third]), feed)
    if goal is not None:
        moves.line(channel, kind, goal, feed)


# ---- helpers


@dataclass(slots=True)
class BeforeBlock(State, lifetime=Lifetime.BLOCK):
    """What held before the words of the running block."""

    feed: float = nan


def _feed_before(channel: SinumerikChannel) -> float:
    before = BeforeBlock.of(channel).feed
    return channel.feed if isnan(before) else before


def _remember_feed(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """The feed before the block's own F: it holds for the part of the way that belongs to the block before."""
    BeforeBlock.of(channel).feed = channel.feed


def _place(channel: SinumerikChannel, kind: Kind, feed: float) -> Move:
    position = channel.coordinates.position
    number_ = channel.level.program_number
    return Move(kind, position, position, feed, number_, channel.line, channel.context_number())
