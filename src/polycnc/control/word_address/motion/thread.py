"""G33 thread cutting on machining centres: a straight move in step with the spindle."""

from __future__ import annotations

from polycnc.control.word_address.motion.path import FEED_MODES, reach
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel


def plan_thread(builder: Builder, plan: Plan) -> Step | None:
    """G33 X Y Z F Q: F is the lead along the longest way, Q the angle at which the thread starts.

    E, where the block has it, is the number of threads per inch.
    """
    builder.take("Q", "E")
    words, control = plan.axis_words, builder.control
    if not words:
        return None
    angle_slot, per_inch_slot = builder.slot("Q"), builder.slot("E")
    per_revolution = FEED_MODES[builder.mode["feed"]] is FeedMode.PER_REVOLUTION

    def cut(channel: WordAddressChannel, values: list[float]) -> None:
        lead = channel.feed if per_revolution else channel.feed * 60.0
        if per_inch_slot is not None:
            lead = INCH_MM / values[per_inch_slot] if values[per_inch_slot] > 0.0 else 0.0
        if not lead > 0.0:
            raise control.fail("no_feed")
        angle = 0.0 if angle_slot is None else values[angle_slot]
        end = reach(channel, words, values)
        position = channel.coordinates.to_position(end)
        if position != channel.coordinates.position:
            channel.curve(Kind.THREAD, position, lead, parameters=(lead, angle % 360.0), programmed=end)

    return cut
