"""11200#0 RCM = 1: a workpiece error (G54.4) turns the tool without tip control too (FANUC 30i, A-79634E, page 19).

Words name the axes as they would go if the work lay where it should. The rotary axes go to where the tool stands so on
the work as it lies, and the way is straight on the table. Built for machines whose tool does not turn: there the tip
lies under the nose, wherever it is named.
"""

from __future__ import annotations

from math import nan

from polycnc.control.word_address.coordinates import on_table, tip
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.systems import ZeroState, lies, plane_on_table, refresh_zero
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.states import TiltState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.tilted_plane import turn_to
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.word_address.block.plan import AxisWord
    from polycnc.control.word_address.family import WordAddressChannel

STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}


def acts(channel: WordAddressChannel) -> bool:
    """Whether words name the axes of a work that lies elsewhere, and the tool turns with that.

    Tip control and tilted planes turn it by themselves, whatever the parameter says.
    """
    misplaced = ZeroState.of(channel).misplaced is not None and OnTable.of(channel).turns_tool
    return misplaced and TipState.of(channel).active is None and TiltState.of(channel).plane is None


def must_turn(channel: WordAddressChannel, words: Sequence[AxisWord]) -> bool:
    """Whether the rotary axes turn in a block: by its words, or because the tool does not stand on the work yet."""
    state = OnTable.of(channel)
    return not state.stood or any(channel.axes[word.axis] in state.posture for word in words)


def pose(
    channel: WordAddressChannel, words: Sequence[AxisWord], before: list[float], goal: list[float]
) -> tuple[float, ...]:
    """Let the rotary axes of a programmed goal stand the tool on the work as it lies, as words tell it as it should.

    Gives how far words tell each axis beyond that, degrees.
    """
    c, state = channel.coordinates, OnTable.of(channel)
    rotary = [word for word in words if channel.axes[word.axis] in state.posture]
    for word in rotary:
        name = channel.axes[word.axis]
        if word.incremental:
            state.posture[name] += goal[word.axis] - before[word.axis]
        else:
            state.posture[name] = goal[word.axis] + c.offsets[word.axis]
    told = channel.control.kinematics(channel).tool_on_work(state.posture)
    wanted = plane_on_table(channel, c.offsets).direct(*told)
    if not turn_to(channel, wanted, state.posture, goal):
        raise channel.control.fail("tip_direction", address=rotary[0].address if rotary else "G43.4")
    beside = [0.0] * len(channel.axes)
    for name, angle in state.posture.items():
        axis = channel.axis_index[name]
        state.stood[name] = goal[axis] + c.offsets[axis]
        beside[axis] = angle - state.stood[name]
    return tuple(beside)


def go(
    channel: WordAddressChannel,
    how: tuple[Kind, float],
    words: Sequence[AxisWord],
    before: list[float],
    goal: list[float],
) -> None:
    """Straight on the table to a programmed point; `how` is kind and feed.

    PC0001 where the tool itself turns, and in radius compensation.
    """
    if (
        channel.control.kinematics(channel).tool
        or RadiusState.of(channel).side
        or channel.path.head is not None
    ):
        raise not_yet()
    c, state = channel.coordinates, OnTable.of(channel)
    beside = pose(channel, words, before, goal)
    on_table.follow(channel, dict(zip(channel.axes, c.machine, strict=True)) | state.stood)
    _straight_on_table(channel, how, c.to_machine(c.to_position(goal)), beside)
    refresh_zero(channel)
    c.arrive(c.position, goal)


def _straight_on_table(
    channel: WordAddressChannel, how: tuple[Kind, float], machine: list[float], beside: tuple[float, ...]
) -> None:
    """Straight on the table to a place of the axes; displays show it as words do. Behind it nothing leads the axes."""
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
    from polycnc.transformation.seated import Seated

    c, lengths = channel.coordinates, ZeroState.of(channel).length
    zero = [value - length for value, length in zip(c.offsets, lengths, strict=True)]
    x, y, z = (-lengths[axis] for axis in c.geometry)
    active = ToolCentrePoint(
        channel.control.kinematics(channel), channel.axes, c.geometry, tuple(zero), (x, y, z)
    )
    c.transform(Seated(active, lies(channel, c.offsets)), None, (IDENTITY, zero))
    channel.context_changed()
    shown = tip.standing_before(active, active, beside)
    with channel.under(replace(channel.context, shown_by=shown)):
        channel.straight(how[0], c.from_machine(machine), how[1])
        channel.flush()
    c.transform(None)


def not_yet() -> AlarmError:
    """PC0001 for a way that is known and not executed."""
    return AlarmError("PC0001", hint="hint.not-supported", code="G54.4: 11200#0")


#: The feed of a rapid.
RAPID = (Kind.RAPID, nan)
