"""Hole patterns: codes that position over many points and run the active drilling cycle at each (MELDAS G34 …).

The cycle stands in a block before, with L0 so that it only stores its data; without one the points are positions.
"""

from __future__ import annotations

from math import nan

from polycnc.control.word_address.cycles.drilling import CycleState, drill_here, is_active
from polycnc.cycles.drilling import patterns
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.arcs import Point

MOST_HOLES = 9999


def circle_of_holes(channel: WordAddressChannel, words: Words) -> None:
    """MELDAS G34: X Y centre, I radius, J angle of the first hole, K count (negative: clockwise)."""
    count = _count(words, "K", signed=True)
    radius = abs(_length(words, "I"))
    drill_points(
        channel, patterns.circle(plane_point(channel, words), radius, words.angle("J") or 0.0, count)
    )


def line_of_holes(channel: WordAddressChannel, words: Words) -> None:
    """MELDAS G35: X Y first hole, I pitch, J angle of the line, K count."""
    count = _count(words, "K")
    pitch = _length(words, "I")
    drill_points(channel, patterns.line(plane_point(channel, words), pitch, words.angle("J") or 0.0, count))


def arc_of_holes(channel: WordAddressChannel, words: Words) -> None:
    """MELDAS G36: X Y centre, I radius, J angle of the first hole, P angle from hole to hole, K count."""
    count = _count(words, "K")
    radius = abs(_length(words, "I"))
    start, pitch = words.angle("J") or 0.0, words.angle("P") or 0.0
    if not pitch:
        raise words.fail("pattern_angle", "P")
    drill_points(channel, patterns.arc(plane_point(channel, words), radius, start, pitch, count))


def grid_of_holes(channel: WordAddressChannel, words: Words) -> None:
    """MELDAS G37.1: X Y first hole, I pitch and P count along the first axis, J pitch and K count along the second."""
    columns, rows = _count(words, "P"), _count(words, "K")
    pitches = (_length(words, "I"), _length(words, "J"))
    drill_points(channel, patterns.grid(plane_point(channel, words), pitches, columns, rows))


def _count(words: Words, address: str, *, signed: bool = False) -> int:
    value = words.integer(address)
    if value is None:
        raise words.fail("pattern", address)
    if not 1 <= (abs(value) if signed else value) <= MOST_HOLES:
        raise words.fail("pattern_count", address)
    return value


def _length(words: Words, address: str) -> float:
    value = words.length(address)
    if value is None:
        raise words.fail("pattern", address)
    return value


def plane_point(channel: WordAddressChannel, words: Words) -> Point:
    """The point in the active plane that the axis words name."""
    c = channel.coordinates
    point = c.programmed[:]
    for axis, value, incremental in words.axes():
        point[axis] = point[axis] + value if incremental else value
    u, v, _ = PLANES[channel.mode["plane"]]
    return point[c.geometry[u]], point[c.geometry[v]]


def drill_points(channel: WordAddressChannel, points: Iterable[Point]) -> None:
    """Rapid over each point, and the active cycle there if one is active."""
    c = channel.coordinates
    u, v, _ = PLANES[channel.mode["plane"]]
    drills = is_active(channel) and CycleState.of(channel).data is not None
    for number, point in enumerate(points):
        if number:
            channel.once_more()
        end = c.programmed[:]
        end[c.geometry[u]], end[c.geometry[v]] = point
        channel.straight(Kind.RAPID, c.to_position(end), nan, end)
        if drills:
            drill_here(channel)
