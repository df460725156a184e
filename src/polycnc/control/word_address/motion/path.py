"""Rapid, line and arc: the motion codes G00 to G03 of the word-address controls.

Each planner looks at the shape of a block once and gives the step that moves. Words are programmed coordinates; the
step turns them into a target of the absolute display and hands the move to the channel.
"""

from __future__ import annotations

from math import nan

from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.block.words_as_data import targets_as_data, word_as_data
from polycnc.control.word_address.motion.arcs import (
    center_by_radius,
    emit_arc,
    emit_stretched,
    is_stretched,
    scales_one_axis,
)
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.planes import PLANES
from polycnc.language.bulk import Arc, Straight, declare
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.numbers import Convert
    from polycnc.control.word_address.block.plan import AxisWord, Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel

    #: The programmed end that the axis words of a block name.
    Reach = Callable[[WordAddressChannel, tuple[AxisWord, ...], list[float]], list[float]]

#: Feed codes of all word-address families to the meaning that the toolpath uses.
FEED_MODES = {
    "G93": FeedMode.INVERSE_TIME,
    "G94": FeedMode.PER_MINUTE,
    "G95": FeedMode.PER_REVOLUTION,
    "G98": FeedMode.PER_MINUTE,
    "G99": FeedMode.PER_REVOLUTION,
}
#: The centre words of the geometry axes.
CENTER_WORDS = "IJK"
_CUTS = frozenset({"G1", "G2", "G3"})


def target(
    channel: WordAddressChannel,
    words: tuple[AxisWord, ...],
    values: list[float],
    start: list[float] | None = None,
) -> list[float]:
    """The programmed end point that axis words name; changed offsets still owe their difference to increments.

    What has no word stays as `start` has it, else as the channel is.
    """
    c = channel.coordinates
    end, owed = (c.programmed if start is None else start)[:], c.pending[:] if c.owes else c.pending
    for word in words:
        value = values[word.slot]
        if word.convert is not None:
            value = word.convert(value)
        axis = word.axis
        if word.incremental:
            end[axis] += value + owed[axis]
        else:
            end[axis] = value
        if c.owes:
            owed[axis] = 0.0  # a second word of the axis gets nothing more
    return end


def pay(channel: WordAddressChannel, words: tuple[AxisWord, ...]) -> None:
    """Axes that a block moves are owed nothing any more."""
    c = channel.coordinates
    if c.owes:
        for word in words:
            c.pending[word.axis] = 0.0


def reach(channel: WordAddressChannel, words: tuple[AxisWord, ...], values: list[float]) -> list[float]:
    """The programmed end point that axis words name, for a block that goes there: what was owed to them is paid."""
    end = target(channel, words, values)
    pay(channel, words)
    return end


def plan_rapid(builder: Builder, plan: Plan) -> Step | None:
    """G00: a rapid move."""
    return _plan_straight(builder, plan, Kind.RAPID)


def plan_line(builder: Builder, plan: Plan) -> Step | None:
    """G01: a straight cut."""
    return _plan_straight(builder, plan, Kind.FEED)


def _plan_straight(builder: Builder, plan: Plan, kind: Kind) -> Step | None:
    words = plan.axis_words
    control = builder.control
    corner = builder.corner()
    if not words:
        return corner
    rapid = kind == Kind.RAPID
    feed_named = builder.has("F")
    polar = builder.mode.codes.get("polar") == "G16"
    absolute = not polar and not any(word.incremental for word in words)
    targets = tuple((word.axis, word.slot, word.convert) for word in words)

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        if rapid:
            feed = channel.feed if feed_named else nan
        else:
            feed = channel.feed
            if not feed > 0.0:
                raise control.fail("no_feed")
        c = channel.coordinates
        if absolute and c.direct and not c.owes:
            end = c.position[:]
            for axis, slot, convert in targets:
                end[axis] = values[slot] if convert is None else convert(values[slot])
            if corner is not None:
                corner(channel, values)
            channel.straight(kind, end, feed)
            return
        programmed = control.polar_target(channel, plan, values) if polar else reach(channel, words, values)
        if corner is not None:
            corner(channel, values)
        channel.straight(kind, c.to_position(programmed), feed, programmed)

    told = targets_as_data(words)
    if told is None or polar or corner is not None:
        return move
    return declare(move, Straight(rapid, told, names_feed=feed_named, absolute=absolute))


def plan_arc_cw(builder: Builder, plan: Plan) -> Step | None:
    """G02: an arc or a helix, clockwise."""
    return plan_arc(builder, plan, ccw=False)


def plan_arc_ccw(builder: Builder, plan: Plan) -> Step | None:
    """G03: an arc or a helix, counter-clockwise."""
    return plan_arc(builder, plan, ccw=True)


def plan_arc(builder: Builder, plan: Plan, *, ccw: bool, reached: Reach | None = None) -> Step | None:
    """An arc, helix or full circle in the active plane.

    Centre words are increments from the start. With R the arc is up to 180 degrees, with a negative R longer. R wins
    over centre words. Neither: what the control has for it. `reached` gives the end
    that the axis words name, where `reach` does not.
    """
    control = builder.control
    words = plan.axis_words
    u, v, _ = plane = PLANES[builder.mode["plane"]]
    told = read_center(builder)
    corner = builder.corner()
    if told is None:
        return control.plan_arc_without_center(builder, plan) if words else corner
    polar = builder.mode.codes.get("polar") == "G16"
    center_words = told.tell

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        feed = channel.feed
        if not feed > 0.0:
            raise control.fail("no_feed")
        c = channel.coordinates
        geometry = c.geometry
        if geometry[u] < 0 or geometry[v] < 0:
            raise control.fail("plane")
        if polar:
            programmed = control.polar_target(channel, plan, values)
        elif reached is not None:
            programmed = reached(channel, words, values)
        else:
            programmed = reach(channel, words, values) if words else c.programmed[:]
        begin = (c.programmed[geometry[u]], c.programmed[geometry[v]])
        end = (programmed[geometry[u]], programmed[geometry[v]])
        told_by = center_words(values)
        center, ends_beside = find_center(channel, begin, end, told_by, ccw)
        if corner is not None:
            corner(channel, values)
        if center is None:
            channel.straight(Kind.FEED, c.to_position(programmed), feed, programmed)
        elif ends_beside or is_stretched(c.programming, plane):
            if control.SCALES_NAMED_AXES and scales_one_axis(c.programming, plane):
                raise control.fail("arc_end")
            emit_stretched(channel, programmed, plane, told_by, ccw=ccw, feed=feed)
        else:
            emit_arc(channel, programmed, center, plane, ccw=ccw, feed=feed)

    targets = targets_as_data(words)
    if targets is None or polar or corner is not None or reached is not None:
        return move
    first, second = (word_as_data(*word) for word in told.center)
    return declare(
        move, Arc(ccw, plane, targets, (first, second), word_as_data(*told.radius), line_without_way=True)
    )


def find_center(
    channel: WordAddressChannel, begin: arcs.Point, end: arcs.Point, told_by: float | arcs.Point, ccw: bool
) -> tuple[arcs.Point | None, bool]:
    """The centre, None for an arc by R that is a line; and whether the end lies beside the circle about it."""
    control = channel.control
    if isinstance(told_by, float):
        return center_by_radius(channel, begin, end, told_by, ccw), False
    if told_by == (0.0, 0.0) and not control.center_may_be_start(channel):
        raise control.fail("radius_zero")
    center = (begin[0] + told_by[0], begin[1] + told_by[1])
    control.check_arc(channel, begin, end, center)
    return center, abs(arcs.radius_mismatch(begin, end, center)) > control.spiral_tolerance(channel)


@dataclass(frozen=True, slots=True)
class CenterWords:
    """What tells an arc in a block: slots of the words and what turns their values into lengths.

    Attributes:
        radius: R; no slot without it.
        center: The way from the start to the centre along both axes of the plane.
    """

    radius: tuple[int | None, Convert | None]
    center: tuple[tuple[int | None, Convert | None], tuple[int | None, Convert | None]]

    def tell(self, values: list[float]) -> float | arcs.Point:
        """The radius, or the way from the start to the centre."""
        if self.radius[0] is not None:
            return _length_of(self.radius, values)
        return _length_of(self.center[0], values), _length_of(self.center[1], values)


def _length_of(word: tuple[int | None, Convert | None], values: list[float]) -> float:
    slot, convert = word
    if slot is None:
        return 0.0
    return convert(values[slot]) if convert else float(values[slot])


def read_center(builder: Builder) -> CenterWords | None:
    """Take the words that tell an arc in a block; None where there are none."""
    u, v, w = PLANES[builder.mode["plane"]]
    letters = [CENTER_WORDS[axis] for axis in (u, v, w) if builder.has(CENTER_WORDS[axis])]
    builder.take("R", *letters)
    radius = builder.slot("R")
    if CENTER_WORDS[w] in letters and radius is None:
        raise builder.control.fail("center_off_plane", address=CENTER_WORDS[w])
    if radius is None and not letters:
        return None
    first, second = (
        (builder.slot(letter), builder.length(letter) if builder.has(letter) else None)
        for letter in (CENTER_WORDS[u], CENTER_WORDS[v])
    )
    return CenterWords((radius, None if radius is None else builder.length("R")), (first, second))


def _require_feed(builder: Builder, plan: Plan) -> Step | None:
    """Under G93 every cutting block needs its own F."""
    motion = builder.mode["motion"]
    if builder.mode["feed"] == "G93" and motion in _CUTS and plan.axis_words and not builder.has("F"):
        raise builder.control.fail("inverse_time_feed", address=motion)
    return None


#: What G93 asks of blocks.
INVERSE_TIME_RULE = Rule("inverse time feed", modes={"feed": ("G93",)}, motion=_require_feed)
