"""Threads block by block: G32 with its lead, start angle and rules (0i-TF Plus II.3.1 to 3.3)."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from polycnc.control.fanuc.turning_coordinates import feed_number
from polycnc.control.word_address.path import target
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.codes import Step
    from polycnc.control.word_address.plan import Builder, Plan

MAX_START_ANGLE = 360_000
_CORNER_WORDS = (",C", ",R", ",A", "R", "C", "I", "J", "K")


def plan_thread(builder: Builder, plan: Plan) -> Step | None:
    """G32 (B, C: G33): straight at the lead F, locked to the spindle; Q is the start angle of this block only."""
    return _plan(builder, plan, grows=False)


def plan_growing_thread(builder: Builder, plan: Plan) -> Step | None:
    """G34: as G32, the lead grows by K each revolution."""
    return _plan(builder, plan, grows=True)


def _plan(builder: Builder, plan: Plan, *, grows: bool) -> Step | None:
    control = builder.control
    for address in _CORNER_WORDS:
        taken_as_axis = any(word.address == address for word in plan.axis_words)
        if builder.has(address) and not taken_as_axis and not (grows and address == "K"):
            raise control.fail("corner_thread", address=address)
    builder.take("Q", "K")
    angle = builder.slot("Q")
    if angle is not None and builder.slots["Q"][1] not in ("", "#"):
        raise control.fail("point", address="Q")
    growth_slot = builder.slot("K") if grows else None
    growth_of = builder.length("K") if growth_slot is not None else None
    words = plan.axis_words
    if not words:
        return None

    def cut(channel: Channel, values: list[float]) -> None:
        lead = feed_number(channel)
        if not lead > 0.0:
            raise control.fail("no_feed")
        programmed = target(channel, words, values)
        c = channel.coordinates
        if growth_slot is not None:
            growth = values[growth_slot]
            check_last_lead(channel, programmed, lead, growth_of(growth) if growth_of else growth)
        channel.memory.thread_step = channel.level.current
        degrees = 0.0 if angle is None else start_angle(values[angle])
        thread_move(channel, c.to_position(programmed), lead, degrees, programmed)

    return cut


def start_angle(thousandths: float) -> float:
    """Q in degrees: the sign does not count, more than a turn is one turn (II.3.3)."""
    return float(min(abs(thousandths), MAX_START_ANGLE)) / 1000.0


def thread_move(
    channel: Channel, end: list[float], lead: float, degrees: float, programmed: list[float] | None = None
) -> None:
    """One thread stroke; without way it is nothing."""
    if end == channel.coordinates.position:
        channel.coordinates.arrive(end, programmed)
        return
    channel.curve(Kind.THREAD, end, lead, parameters=(lead, degrees), programmed=programmed)


def check_last_lead(channel: Channel, end: list[float], lead: float, growth: float) -> None:
    """The lead must still be positive at the end: with s the way, `lead² + 2·growth·s` is its square there."""
    way = hypot(*(e - p for e, p in zip(end, channel.coordinates.programmed, strict=True)))
    if lead * lead + 2.0 * growth * way <= 0.0:
        raise channel.control.fail("thread_lead", address="K")
