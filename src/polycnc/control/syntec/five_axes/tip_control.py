"""Tool tip control G43.4 and G43.5 (manual 2.28, 2.29): words name the tip, the linear axes follow the rotary ones."""

from __future__ import annotations

from polycnc.control.syntec.coordinates import length as tool_length
from polycnc.control.syntec.coordinates.turns import (
    FollowingState,
    PostureState,
    TurnState,
    refer_posture,
    refuse_posture,
    renew_work_turn,
)
from polycnc.control.syntec.five_axes import alignment, mechanism
from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.coordinates.tip import TIP_CODES, TipState
from polycnc.control.word_address.states import LengthState, PolarState
from polycnc.control.word_address.transformations import normal_line, tool_center_point
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.language.bulk import declare, declared

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan

#: What does not go with tip control (2.28.3, 2.29.3); G05 P10000 has an alarm of its own.
NOT_WITH_TIP = frozenset(("G12.1", "G31.10", "G31.11", "G41", "G42"))
MINUTE = 60.0


def start(channel: SyntecChannel, words: Words) -> None:
    """G43.4 H [Q] [L1] [I], G43.5 H: from here on positions are those of the tip; nothing moves.

    Q chooses the frame of directions, I the highest speed with which linear axes follow the rotary ones (mm/min, as
    Pr3091); L1 (smoothness, 2.10.3) leaves the path as it is. Other values of L are refused: the format line of the
    manual calls L what its notes call I.
    """
    mechanism.check(channel, words, channel.mode["length"])
    state = PostureState.of(channel)
    frame = words.typed("Q")
    for letter in "QL":
        if words.typed(letter) not in (None, 0, 1):
            raise words.fail("argument", letter)
    if TurnState.of(channel).told_by == "G68.3":
        raise words.fail("tip_on_tool_plane", channel.mode["length"])
    renew_work_turn(channel)
    turns = TurnState.of(channel)
    if PolarState.of(channel).plane is not None:
        raise words.fail("tip_mode", channel.mode["length"])
    # I of G43.5 is a part of the tool's direction.
    fastest = (words.typed("I") or 0.0) if channel.mode["length"] == "G43.4" else 0.0
    if fastest < 0.0:
        raise words.fail("number", "I")
    FollowingState.of(channel).fastest = fastest
    state.in_work = state.in_work if frame is None else bool(frame)
    refuse_posture(channel, turns.angle)
    channel.flush()
    refer_posture(channel, turns.work)
    alignment.leave_table(channel)
    tool_center_point.follow_table(channel, words)


def compensate_length(channel: SyntecChannel, words: Words) -> None:
    """G43, G44 H: tip control ends, the length counts along the tool."""
    end(channel)
    if renew_work_turn(channel):
        refresh_zero(channel)  # a change of the work's turn is not travelled, one of the length is
    tool_length.compensate_length(channel, words)


def cancel(channel: SyntecChannel, words: Words) -> None:
    """G49: ends every kind of length compensation, and normal direction control."""
    normal_line.end(channel)
    end(channel)
    tool_length.cancel_length(channel, words)


def end(channel: SyntecChannel) -> None:
    """The axes are named themselves again; nothing moves.

    A tool that was stood on a plane under tip control stands there still.
    """
    if PolarState.of(channel).plane is not None:
        return
    refer_posture(channel, IDENTITY)
    stands = TipState.of(channel).is_leading(channel) and LengthState.of(channel).direction is not None
    tool_center_point.end_following(channel)
    if stands:
        angles = dict(zip(channel.axes, channel.coordinates.machine, strict=True))
        alignment.stand_on_plane(channel, angles)


def check_company(builder: Builder) -> None:
    """COR-023 for what does not go with tip control while it is on; under G43.5 increments do not either."""
    before, after = builder.before["length"], builder.mode["length"]
    if before not in TIP_CODES or after not in TIP_CODES:
        return
    for row in builder.codes:
        if row.code in NOT_WITH_TIP:
            raise builder.control.fail("tip_mode", address=row.code)
    if before == after == "G43.5" and builder.mode["distance"] == "G91" and _names_axes(builder):
        raise builder.control.fail("tip_mode", address="G91")


def _names_axes(builder: Builder) -> bool:
    """Whether a block has axis words, and no code of its own that takes them."""
    if any(row.axis_words for row in builder.codes):
        return False
    found = (builder.control.axis_of_address(builder.channel, word, builder) for word in builder.slots)
    return any(target is not None for target in found)


def plan_with_direction(builder: Builder, plan: Plan) -> Step | None:
    """G43.5: I, J, K give the direction of the tool at the end of a straight block; rotary words are refused."""
    if builder.mode["length"] != "G43.5":
        return None
    rotary = next((w for w in plan.axis_words if builder.channel.axis_data[w.axis].rotary), None)
    if rotary is not None:
        raise builder.control.fail("tip_rotary_word", address=rotary.address)
    step = tool_center_point.plan_with_direction(builder, plan)
    letters = [letter for letter in "IJK" if builder.has(letter)]
    if step is None:
        return None

    def move(channel: SyntecChannel, values: list[float]) -> None:
        words = Words(plan, values)
        if not any(words.typed(letter) for letter in letters):
            raise words.fail("tip_zero_direction", letters[0])
        step(channel, values)

    return declare(move, declared(step))
