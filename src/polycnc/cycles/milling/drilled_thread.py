"""Drilling a hole and milling its thread with one tool (SINUMERIK CYCLE78)."""

from __future__ import annotations

from polycnc.cycles.milling.stroke import Cavity, arc, cut, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.stroke import MillStroke, Place

#: Distance in front of the depth that is reached up to which the tool returns at rapid, mm.
LIMIT_MM = 1.0
#: Half a turn onto the thread, once round, half a turn off it.
TURNS = 2.0


@dataclass(frozen=True, slots=True)
class DrilledThread(Cavity):
    """A hole and its internal thread; mm, feeds in the unit of the strokes.

    Attributes:
        place: Its axis.
        reference, safe, retract: Levels of the face, the safety plane and the end.
        depth: Level of the bottom.
        strokes: Depths of the drilling strokes below the face.
        stages: Down to which depth below the face each drilling feed counts, from the first to the last.
        path_radius: Of the tool's centre on the thread.
        start: Level from which the thread is milled.
        step: Way along the axis in a turn, with its sign.
        ccw: Sense of rotation.
        feed: On the thread.
    """

    place: Place
    reference: float
    safe: float
    retract: float
    depth: float
    strokes: Sequence[float]
    stages: Sequence[tuple[float, float]]
    path_radius: float
    start: float
    step: float
    ccw: bool
    feed: float


def drill_and_mill(thread: DrilledThread) -> Iterator[MillStroke]:
    """Drill in strokes, clearing the chips at the face, rise to the start, and mill the thread in one turn.

    The tool's thread is as long as the hole's, so once round makes all of it. Half turns from the axis and back to it
    keep the pitch.
    """
    yield rapid(thread.place(0.0, 0.0))
    yield rapid(w=thread.safe)
    above = 0.0
    for below in thread.strokes:
        if above:
            yield rapid(w=thread.reference)
            yield rapid(w=thread.level(max(above - LIMIT_MM, 0.0)))
        yield from _down(thread, above, below)
        above = below
    yield rapid(w=thread.start)
    radius, middle = thread.path_radius, thread.place(0.0, 0.0)
    contact, half = thread.place(radius, 0.0), thread.place(0.5 * radius, 0.0)
    yield arc(thread.feed, contact, half, thread.ccw, thread.start + 0.5 * thread.step)
    yield arc(thread.feed, contact, middle, thread.ccw, thread.start + 1.5 * thread.step)
    yield arc(thread.feed, middle, half, thread.ccw, thread.start + TURNS * thread.step)
    yield rapid(w=thread.retract)


def _down(thread: DrilledThread, above: float, below: float) -> Iterator[MillStroke]:
    """A drilling stroke, from a depth to another, with the feed of each stage that it passes."""
    for limit, feed in thread.stages:
        if limit > above:
            yield cut(feed, w=thread.level(min(limit, below)))
        if limit >= below:
            return
