"""G43.4 in a work system that G54.4 turns, with directions that refer to it (Q1, Pr3057 = 1; manual 2.28.3, note 8).

Rotary words say how the axes would stand the tool if the work system were not turned, first axis first; the tool stands
so in the system as it is turned. An axis without a word keeps its program coordinate (2.28.4, second sample). The axes
go to the positions that are nearest to the way of the words. In between they go evenly and the tip goes straight: the
manual does not say how the tool turns there.
"""

from __future__ import annotations

from math import nan

from polycnc.control.syntec.coordinates.turns import PostureState, TurnState
from polycnc.control.syntec.motion.moves import feed_to
from polycnc.control.word_address.motion.path import reach
from polycnc.control.word_address.transformations.tilted_plane import turn_to
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import dot
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan

STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}
#: What the cosine between two directions that are the same may lack of 1.
SAME_DIRECTION = 1e-12


def plan_posture(builder: Builder, plan: Plan) -> Step | None:
    """A straight block with rotary words: its end stands the tool in the work system as they say."""
    words = plan.axis_words
    standing = builder.channel.control.kinematics(builder.channel).axes
    rotary = [word for word in words if builder.channel.axes[word.axis] in standing]
    if not rotary or builder.mode["length"] != "G43.4":
        return None
    motion = builder.mode["motion"]
    if motion not in STRAIGHT or builder.mode["polar"] == "G16":
        raise not_yet(f"G43.4 Q1: {motion}")
    kind = STRAIGHT[motion]

    def move(channel: SyntecChannel, values: list[float]) -> None:
        c, state = channel.coordinates, PostureState.of(channel)
        kinematics = channel.control.kinematics(channel)
        here = dict(zip(channel.axes, c.machine, strict=True))
        before, goal = c.programmed, reach(channel, words, values)
        told = state.told or {name: here[name] for name in kinematics.axes}
        state.told = told.copy()
        for word in rotary:
            name, value = channel.axes[word.axis], goal[word.axis]
            way = value - before[word.axis]
            state.told[name] = told[name] + way if word.incremental else value + c.offsets[word.axis]
        near = {name: here[name] + state.told[name] - told[name] for name in told}
        wanted = TurnState.of(channel).work.direct(*kinematics.tool_on_work(state.told))
        if not turn_to(channel, wanted, near, goal):
            raise channel.control.fail("tilt_unreachable", address=rotary[0].address)
        end = c.to_position(goal)
        channel.straight(kind, end, nan if kind == Kind.RAPID else feed_to(channel, end), goal)

    return move


def wrap_posture(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """Before rotary words have told how the tool stands in the work system, a move needs one that stands in it already.

    Otherwise the rotary axes might have to turn with that move, or not before they are named: the manual does not say.
    """
    if step is None or builder.mode["length"] != "G43.4":
        return step

    def move(channel: SyntecChannel, values: list[float]) -> None:
        before = channel.coordinates.position
        step(channel, values)
        told = PostureState.of(channel).told
        if channel.coordinates.position != before and not told and not _stands_already(channel):
            raise not_yet("G43.4 Q1: G54.4")

    return move


def _stands_already(channel: SyntecChannel) -> bool:
    """Whether the tool points the same way in the work system as it is turned as in the one that is not turned."""
    here = dict(zip(channel.axes, channel.coordinates.machine, strict=True))
    tool = channel.control.kinematics(channel).tool_on_work(here)
    return dot(tool, TurnState.of(channel).work.direct(*tool)) > 1.0 - SAME_DIRECTION


def not_yet(code: str) -> AlarmError:
    """PC0001 for what the manual does not say."""
    return AlarmError("PC0001", hint="hint.not-supported", code=code)
