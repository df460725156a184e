"""Threads and taps of a block: G33, G34, G35, G331, G332, G63 (Fundamentals)."""

from __future__ import annotations

from math import nan, sqrt

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.feed import thread_ramps
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.motion.moves import checked_feed, goal_of, special
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Message
from polycnc.toolpath.modes import AccelerationMode, FeedMode

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.toolpath import Context

#: More than this part of what an axis may do is more for certain.
SURELY = 1.000001


def lead_of(draft: Draft) -> Any:
    """The thread lead that I, J, K give: of the axis with the longest way; 16720 for none or zero."""
    factor = length_factor(draft.mode)
    leads = [(i, draft.take(letter)) for i, letter in enumerate("IJK")]
    given = [(i, position) for i, position in leads if position is not None]

    def lead(channel: SinumerikChannel, values: Values, end: list[float]) -> float:
        coordinates = channel.coordinates
        ways = [
            (
                abs(end[column] - coordinates.position[column])
                if (column := coordinates.geometry[i]) >= 0
                else 0.0,
                p,
            )
            for i, p in given
        ]
        value = number(values, max(ways)[1]) * factor if ways else 0.0
        if value == 0.0:
            raise AlarmError("16720")
        return value

    return lead


def thread(draft: Draft) -> Step | None:
    """G33: thread with constant lead; SD42000 (SF) is the start angle. G34, G35: F changes the lead per revolution."""
    lead = lead_of(draft)
    change = draft.take("F") if draft.mode["motion"] in ("G34", "G35") else None
    sign, factor = -1.0 if draft.mode["motion"] == "G35" else 1.0, length_factor(draft.mode)
    goal = goal_of(draft)
    if goal is None:
        return None

    def run(channel: SinumerikChannel, values: Values) -> None:
        end = goal(channel, values)
        angle = channel.memory.data.number(thread_ramps.START_ANGLE)
        own, growth = lead(channel, values, end), 0.0
        if change is not None:
            growth = sign * number(values, change) * factor
            refuse_growth(channel, end, own, growth)
        cut(channel, end, own, angle, growth)

    return run


def cut(channel: SinumerikChannel, end: list[float], lead: float, angle: float, growth: float = 0.0) -> None:
    """A stroke of a thread: lead and its growth each revolution, mm, start angle, degrees.

    One that takes up its speed or brakes over a way (SD42010) has constant acceleration all along: no jerk limit.
    22280, a message, says that such a way asks for more acceleration than an axis has.
    """
    ways = thread_ramps.ways(channel)
    if ways == (0.0, 0.0):
        special(channel, Kind.THREAD, end, nan, [lead, angle, growth])
        return
    context = channel.context
    if context.spindle_direction and not context.surface_speed:
        note_short_ramps(channel, context, end, (lead, growth), ways)
    with channel.under(replace(context, acceleration=AccelerationMode.CONSTANT)):
        special(channel, Kind.THREAD, end, nan, [lead, angle, growth, *ways])


def note_short_ramps(
    channel: SinumerikChannel,
    context: Context,
    end: list[float],
    thread: tuple[float, float],
    ramps: tuple[float, float],
) -> None:
    """Say (22280) that an axis must accelerate by more than it may on one of the ways of a thread."""
    (lead, growth), ways = thread, ways_to(channel, end)
    longest, turns = max(ways), context.spindle_rpm / tables.MINUTE
    for ramp, place in zip(ramps, (ramps[0], longest - ramps[1]), strict=True):
        if not 0.0 < ramp <= longest:
            continue
        pull = 0.5 * turns * turns * (lead * lead + 2.0 * growth * place) / ramp
        for axis, way in zip(channel.axis_data, ways, strict=True):
            least = ramp * pull * way / (longest * axis.acceleration)
            if least > SURELY * ramp:
                values = {"axis": axis.name, "number": f"{ramp:g}", "text": f"{least:.3f}"}
                channel.event(Message(channel.control.catalogue.text("22280", **values)))
                break


def refuse_growth(channel: SinumerikChannel, end: list[float], lead: float, growth: float) -> None:
    """Refuse a change of the lead at which the axes would stop, or could not follow.

    The alarms are those of the diagnostics manual (general knowledge here). What the axes can do is looked at where
    the spindle's speed is known; it counts without an override.

    Raises:
        AlarmError: 10605 where the lead comes down to nothing within the block; 10604 where an axis would exceed its
            velocity at the end, or its acceleration.
    """
    ways = ways_to(channel, end)
    longest = max(ways)
    last2 = lead * lead + 2.0 * growth * longest
    if last2 <= 0.0:
        raise AlarmError("10605")
    context = channel.context
    if context.surface_speed or not context.spindle_direction or growth <= 0.0 or longest <= NO_WAY:
        return
    turns = context.spindle_rpm / tables.MINUTE
    for axis, way in zip(channel.axis_data, ways, strict=True):
        share = turns * way / longest
        too_fast = share * sqrt(last2) > SURELY * axis.max_feed
        if too_fast or share * turns * growth > SURELY * axis.acceleration:
            raise AlarmError("10604", axis=axis.name)


def ways_to(channel: SinumerikChannel, end: list[float]) -> list[float]:
    """How far each axis goes to an end."""
    return [abs(e - p) for e, p in zip(end, channel.coordinates.position, strict=True)]


def tap(draft: Draft) -> Step | None:
    """G331 in and G332 out: rigid tapping; a negative lead is a left-hand thread."""
    lead = lead_of(draft)
    goal = goal_of(draft)
    if goal is None:
        return None

    def run(channel: SinumerikChannel, values: Values) -> None:
        end = goal(channel, values)
        special(channel, Kind.TAP, end, nan, [lead(channel, values, end)])

    return run


def tap_with_chuck(draft: Draft) -> Step | None:
    """G63: one tapping block with compensating chuck; the lead is the feed per revolution."""
    goal = goal_of(draft)
    if goal is None:
        return None

    def run(channel: SinumerikChannel, values: Values) -> None:
        feed = checked_feed(channel.feed)
        memory = channel.memory
        speed = memory.spindles.get().speed
        lead = (
            feed
            if PathFeed.of(channel).mode is FeedMode.PER_REVOLUTION
            else feed * tables.MINUTE / speed
            if speed
            else 0.0
        )
        special(channel, Kind.TAP, goal(channel, values), feed, [lead])

    return run
