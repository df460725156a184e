"""Circles as one block: G12/G13 circle cutting and G02.1/G03.1 spirals (MELDAS)."""

from __future__ import annotations

from polycnc.control.word_address.coordinates.frames import scale_of
from polycnc.control.word_address.motion.arcs import emit_arc
from polycnc.control.word_address.motion.path import CENTER_WORDS, reach
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.arcs import Point


def cut_circle_cw(channel: WordAddressChannel, words: Words) -> None:
    """G12 I D: from its centre onto a circle of radius I - D, once round clockwise, and back to the centre."""
    _cut_circle(channel, words, ccw=False)


def cut_circle_ccw(channel: WordAddressChannel, words: Words) -> None:
    """G13 I D: the same, counter-clockwise."""
    _cut_circle(channel, words, ccw=True)


def _cut_circle(channel: WordAddressChannel, words: Words, *, ccw: bool) -> None:
    """A half circle out to the first axis, the full circle, a half circle back: tangential on and off."""
    state = RadiusState.of(channel)
    control, c = channel.control, channel.coordinates
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_cycle", "G12")
    number = words.integer("D")
    state.number = state.number if number is None else number
    plane = PLANES[channel.mode["plane"]]
    u, v = c.geometry[plane[0]], c.geometry[plane[1]]
    tool = control.radius_value(channel, state.number) / scale_of(channel, u)
    radius = abs(words.length("I") or 0.0) - tool
    if not radius > 0.0:
        raise words.fail("circle_radius", "I")
    feed = channel.feed
    if not feed > 0.0:
        raise words.fail("no_feed")
    middle: Point = (c.programmed[u], c.programmed[v])
    halfway: Point = (middle[0] + radius / 2.0, middle[1])
    inside, outside = c.programmed[:], c.programmed[:]
    outside[u] += radius
    for end, center in ((outside, halfway), (outside, middle), (inside, halfway)):
        emit_arc(channel, end[:], center, plane, ccw=ccw, feed=feed)


def spiral_cw(channel: WordAddressChannel, words: Words) -> None:
    """G02.1 X Y Z I J P: spiral about the centre, clockwise, with P full turns beyond the first part."""
    _spiral(channel, words, ccw=False)


def spiral_ccw(channel: WordAddressChannel, words: Words) -> None:
    """G03.1: the same, counter-clockwise."""
    _spiral(channel, words, ccw=True)


def _spiral(channel: WordAddressChannel, words: Words, *, ccw: bool) -> None:
    c = channel.coordinates
    plane = PLANES[channel.mode["plane"]]
    if not channel.feed > 0.0:
        raise words.fail("no_feed")
    letters = [CENTER_WORDS[axis] for axis in plane[:2]]
    if not any(letter in words for letter in letters):
        raise words.fail("no_center")
    u, v = c.geometry[plane[0]], c.geometry[plane[1]]
    shift = [words.length(letter) or 0.0 for letter in letters]
    center: Point = (c.programmed[u] + shift[0], c.programmed[v] + shift[1])
    turns = words.integer("P") or 0
    end = reach(channel, words.plan.axis_words, words.values)
    emit_arc(channel, end, center, plane, ccw=ccw, feed=channel.feed, turns=float(turns))
