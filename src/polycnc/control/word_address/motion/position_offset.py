"""G45 to G48, moves lengthened or shortened by an offset, and G60, positioning from one direction."""

from __future__ import annotations

from math import copysign, nan

from polycnc.control.word_address.coordinates.frames import scale_of
from polycnc.control.word_address.motion.arcs import center_by_radius, emit_arc
from polycnc.control.word_address.motion.path import CENTER_WORDS, reach
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.plan import AxisWord
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MillingChannel

#: How often each code adds the offset, in the direction of the move.
TIMES = {"G45": 1.0, "G46": -1.0, "G47": 2.0, "G48": -2.0}
ARCS = ("G2", "G3")
MOTIONS = ("G0", "G1", *ARCS)
CENTER_LETTERS = "IJKR"


def offset_move(channel: MillingChannel, words: Words) -> None:
    """G45 to G48: the move of each named axis grows or shrinks along its own direction; only in this block.

    A scale does not act on the offset (0i-MB manual, scaling).
    """
    state = RadiusState.of(channel)
    c = channel.coordinates
    code = next(key for key in words.plan.order if key in TIMES)
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_g45", code)
    motion = channel.mode["motion"]
    if motion not in MOTIONS:
        raise words.fail("address", code)
    number = words.integer("D") if "D" in words else None
    state.number = state.number if number is None else number
    amount = TIMES[code] * channel.control.offset_amount(channel, state.number)
    end = reach(channel, words.plan.axis_words, words.values)
    for word in words.plan.axis_words:
        way = end[word.axis] - c.programmed[word.axis]
        end[word.axis] += amount / scale_of(channel, word.axis) * _direction(words, word, way)
    if motion in ARCS:
        _offset_arc(channel, words, end, amount)
        return
    if centre := next((letter for letter in CENTER_LETTERS if letter in words), ""):
        raise words.fail("address", centre)
    rapid = motion == "G0"
    if not rapid and not channel.feed > 0.0:
        raise words.fail("no_feed")
    kind = Kind.RAPID if rapid else Kind.FEED
    channel.straight(kind, c.to_position(end), nan if rapid else channel.feed, end)


def _offset_arc(channel: MillingChannel, words: Words, end: list[float], amount: float) -> None:
    """A quarter or three quarters of a circle: its radius grows by the offset, as the way of each axis does."""
    control, c = channel.control, channel.coordinates
    if not channel.feed > 0.0:
        raise words.fail("no_feed")
    ccw = channel.mode["motion"] == "G3"
    plane = PLANES[channel.mode["plane"]]
    columns = [c.geometry[axis] for axis in plane[:2]]
    amount /= scale_of(channel, columns[0])
    begin, goal = ((point[columns[0]], point[columns[1]]) for point in (c.programmed, end))
    radius = words.length("R")
    if radius is not None:
        center = center_by_radius(channel, begin, goal, copysign(abs(radius) + amount, radius), ccw)
        if center is None:
            raise words.fail("radius_zero", "R")
    else:
        way = [words.length(CENTER_WORDS[axis]) or 0.0 for axis in plane[:2]]
        if not any(way):
            raise words.fail("no_center", channel.mode["motion"])
        longer = [part + copysign(1.0, part) * amount if part else 0.0 for part in way]
        center = (begin[0] + longer[0], begin[1] + longer[1])
        control.check_arc(channel, begin, goal, center)
    emit_arc(channel, end, center, plane, ccw=ccw, feed=channel.feed)


def _direction(words: Words, word: AxisWord, way: float) -> float:
    """1 or -1; an increment of -0 points backwards."""
    return copysign(1.0, words.values[word.slot] if word.incremental else way)


def position_one_way(channel: MillingChannel, words: Words) -> None:
    """G60: rapid past the target by each axis's overrun, then on to it always from the same side.

    The side is the machine's: no mirror, scale or rotation of the program acts on the overrun (0i-MB manual, G60).
    """
    c = channel.coordinates
    end = reach(channel, words.plan.axis_words, words.values)
    target, start = c.to_position(end), c.position
    named = {word.axis for word in words.plan.axis_words}
    via = list(target)
    for axis, (before, behind) in enumerate(zip(start, target, strict=True)):
        if axis in named or before != behind:
            via[axis] -= channel.control.overrun(channel, axis)
    channel.straight(Kind.RAPID, via, nan, c.to_programmed(via))
    channel.straight(Kind.RAPID, target, nan, end)
