"""G43.1 H: the tool length counts along the tool, as the rotary axes of the head turn it.

No manual at hand has the code; what it does is general knowledge of the control (M700V programming manual, tool length
compensation along the tool axis). Words name the tip: at the end of every block it is where they say. In between the
axes go straight, for the tip is not led (that is G43.4). A table turns nothing here.
"""

from __future__ import annotations

from math import nan

from polycnc.control.fanuc.milling import standing_system
from polycnc.control.word_address.motion.path import reach
from polycnc.control.word_address.states import LengthState, TiltState
from polycnc.control.word_address.tools import length
from polycnc.control.word_address.tools.length import ALONG_TOOL
from polycnc.control.word_address.transformations.tool_center_point import angles_named
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.machine.kinematics import Angles

#: Motion in which the head may turn.
STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}
#: What gives coordinates another meaning does not go with it.
NOT_ALONG_TOOL = frozenset(("G68.2", "G53.1", "G12.1", "G7.1"))


def compensate_along_tool(channel: WordAddressChannel, words: Words) -> None:
    """G43.1 H: as G43, along the tool as the head stands it at the end of the block."""
    standing_system.end_following(channel)
    if TiltState.of(channel).plane is not None:
        raise words.fail("tilt_mode", ALONG_TOOL)
    LengthState.of(channel).along = _tool(channel, angles_named(channel, words))
    length.compensate_length(channel, words)


def _tool(channel: WordAddressChannel, angles: Angles) -> tuple[float, float, float]:
    return channel.control.kinematics(channel).tool_on_machine(angles)


def _turning(builder: Builder, plan: Plan) -> list[int]:
    """Columns of the head's axes that a block names."""
    channel = builder.channel
    named = {joint.axis for joint in channel.control.kinematics(channel).tool}
    return [word.axis for word in plan.axis_words if channel.axes[word.axis] in named]


def check_company(builder: Builder) -> None:
    """Refuse what gives coordinates another meaning."""
    if builder.mode["length"] == ALONG_TOOL:
        for row in builder.codes:
            if row.code in NOT_ALONG_TOOL:
                raise builder.control.fail("tool_axis_company", address=row.code)


def plan_turning(builder: Builder, plan: Plan) -> Step | None:
    """A block that turns the head: straight to its words, with the length along the tool as it stands there."""
    turning = _turning(builder, plan)
    if builder.mode["length"] != ALONG_TOOL or not turning:
        return None
    mode, words = builder.mode, plan.axis_words
    for group, allowed in (
        ("motion", STRAIGHT),
        ("cycle", ("G80",)),
        ("compensation", ("G40",)),
        ("polar", ("G15",)),
    ):
        if mode[group] not in allowed:
            raise builder.control.fail("tool_axis_company", address=mode[group])
    kind, names_feed = STRAIGHT[mode["motion"]], builder.has("F")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        feed = channel.feed if names_feed or kind == Kind.FEED else nan
        if kind == Kind.FEED and not feed > 0.0:
            raise channel.control.fail("no_feed")
        c, goal = channel.coordinates, reach(channel, words, values)
        angles = dict(zip(channel.axes, c.machine, strict=True))
        angles.update({channel.axes[axis]: goal[axis] + c.offsets[axis] for axis in turning})
        length.turn_length(channel, _tool(channel, angles))
        channel.straight(kind, c.to_position(goal), feed, goal)

    return move


def turn_behind(builder: Builder, plan: Plan) -> Step | None:
    """Behind G28, G53 and their like the length lies along the tool as the head has come to stand; nothing moves."""
    if not _turning(builder, plan) or not any(row.axis_words for row in builder.codes):
        return None

    def turn(channel: WordAddressChannel, _values: list[float]) -> None:
        if channel.mode["length"] == ALONG_TOOL:
            here = dict(zip(channel.axes, channel.coordinates.machine, strict=True))
            length.turn_length(channel, _tool(channel, here))

    return turn
