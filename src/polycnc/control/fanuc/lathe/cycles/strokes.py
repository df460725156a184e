"""Strokes of plane cycles become moves of the channel."""

from __future__ import annotations

from math import nan

from polycnc.compensation.cutter import CutterCompensation
from polycnc.control.fanuc.lathe.coordinates.systems import plane_axes
from polycnc.control.fanuc.lathe.motion.threads import (
    OFF_THREAD,
    ON_CYCLE_THREAD,
    RETRACT,
    lock,
    retract_speed,
    thread_move,
)
from polycnc.control.fanuc.lathe.tools.offsets import nose_radius, nose_tip
from polycnc.control.word_address.tools.radius import (
    RadiusState,
    active_compensation,
    side_on_display,
    suspended,
)
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.planes import PLANES
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.cycles.turning.stroke import PlaneStroke


#: Moves that lead off a thread in a cycle: retract and return.
WAYS_OFF = 2
#: Strokes of a cycle that count as one block for the block limit.
STROKES_OF_A_BLOCK = 4


def emit(channel: LatheChannel, strokes: Iterable[PlaneStroke], *, lead: float = 0.0) -> None:
    """Make the strokes, at the feed in force; threads at a lead (mm)."""
    first, second = plane_axes(channel)
    c = channel.coordinates
    way_off = 0
    for number, stroke in enumerate(strokes):
        if number % STROKES_OF_A_BLOCK == STROKES_OF_A_BLOCK - 1:
            channel.once_more()
        end = c.position[:]
        end[first], end[second] = stroke.end
        if stroke.kind is Kind.RAPID:
            speed = _lead_off(channel, way_off)
            way_off = max(way_off - 1, 0)
            channel.straight(Kind.RAPID, end, speed or nan)
            continue
        if stroke.kind is Kind.THREAD:
            thread_move(channel, end, (lead, stroke.start_angle_deg), kind=ON_CYCLE_THREAD)
            way_off = WAYS_OFF
            continue
        feed = channel.feed
        if not feed > 0.0:
            raise channel.control.fail("no_feed")
        if stroke.center is None:
            channel.straight(Kind.FEED, end, feed)
        else:
            _arc(channel, stroke, end, feed)
    lock(channel, "")


def _lead_off(channel: LatheChannel, ways: int) -> float:
    """Lock the next rapid as the first or last of the ways off a thread, or free it; its speed, 0 for rapid traverse.

    Feed hold waits for the return to the start, by 5109#3 TFH for the retract only (II.4.1.2).
    """
    if ways == WAYS_OFF:
        lock(channel, RETRACT)
        return retract_speed(channel)
    lock(channel, OFF_THREAD if ways and not channel.memory.parameters.TFH else "")
    return 0.0


def _arc(channel: LatheChannel, stroke: PlaneStroke, end: list[float], feed: float) -> None:
    u, v, w = PLANES[channel.mode["plane"]]
    third = channel.coordinates.geometry[w]
    center = [0.0, 0.0, 0.0]
    center[w] = channel.coordinates.position[third] if third >= 0 else 0.0
    if stroke.center is not None:
        center[u], center[v] = stroke.center
    normal = (float(w == 0), float(w == 1), float(w == 2))
    channel.curve(stroke.kind, end, feed, center=(center[0], center[1], center[2]), normal=normal)


def uncompensated_cycle(channel: LatheChannel, strokes: Iterable[PlaneStroke], *, lead: float = 0.0) -> None:
    """G92, G74, G75, G76: nose radius compensation does not act in them (II.4.1.4, 4.2.5 to 4.2.7)."""
    with suspended(channel):
        emit(channel, strokes, lead=lead)


def compensated_cycle(channel: LatheChannel, strokes: Sequence[PlaneStroke]) -> None:
    """G90, G94 within nose radius compensation: as if the four strokes were written as G00 and G01 (II.4.1.4).

    The vector is zero at the start and at the end; the nose stays on the side of the material's outside, whatever
    G41 or G42 say.
    """
    stage = active_compensation(channel)
    if stage is None or not RadiusState.of(channel).side:
        emit(channel, strokes)
        return
    leave_compensation(channel)
    cut = offset.line(strokes[0].end, strokes[1].end)
    way = (strokes[2].end[0] - strokes[1].end[0], strokes[2].end[1] - strokes[1].end[1])
    left = cut.departing[0] * way[1] - cut.departing[1] * way[0] > 0.0
    stage.engage(1 if left else -1, nose_radius(channel), nose_tip(channel))
    emit(channel, strokes[:-1])
    stage.cancel()
    emit(channel, strokes[-1:])
    enter_compensation(channel)


def is_compensated(channel: LatheChannel) -> bool:
    """Whether nose radius compensation is at work."""
    return active_compensation(channel) is not None and bool(RadiusState.of(channel).side)


def leave_compensation(channel: LatheChannel) -> None:
    """The tool stands on the programmed point and compensation is off, until `enter_compensation`."""
    stage = active_compensation(channel)
    if stage is not None:
        stage.drop_vector()
        stage.discard()


def enter_compensation(channel: LatheChannel) -> None:
    """The next move starts compensation up again."""
    stage = channel.path.find(CutterCompensation)
    if stage is not None:
        stage.engage(side_on_display(channel), nose_radius(channel), nose_tip(channel))
