"""G43.4, G43.5 tool centre point control: words name the tip against the work, the linear axes follow the rotary ones.

The programming system is fixed to the table and turns with it (FANUC 19696#5 = 0). Positions in the toolpath are those
of the tip; their context turns them into positions of the axes.
"""

from __future__ import annotations

from array import array
from math import nan
from typing import TYPE_CHECKING

from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.block.words_as_data import targets_as_data
from polycnc.control.word_address.coordinates import tip
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.systems import ZeroState, frame_on_table, refresh_zero
from polycnc.control.word_address.motion.path import reach
from polycnc.control.word_address.tools.length import LengthState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.tilted_plane import TiltState, nearest_angles
from polycnc.language.bulk import Straight, declare
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.orientation.standing import StandRecord, stand
from polycnc.transformation.orientation.stood import stand_record
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: from here on positions are those of the tip. Without motion in its block nothing moves."""
    state = LengthState.of(channel)
    c = channel.coordinates
    kinematics = channel.control.kinematics(channel)
    if not kinematics.axes or not set(kinematics.axes) <= set(channel.axes) or -1 in c.geometry:
        raise words.fail("tip_machine", "G43.4")
    if TiltState.of(channel).plane is not None or RadiusState.of(channel).side:
        raise words.fail("tip_mode", "G43.4")
    _check_work_zero(channel)
    number = words.integer("H") if "H" in words else None
    state.number = state.number if number is None else number
    value = channel.control.length_value(channel, state.number) if state.number else 0.0
    c.transform(None)
    ZeroState.of(channel).length = [0.0] * len(channel.axes)
    refresh_zero(channel)
    following = ToolCentrePoint(kinematics, channel.axes, c.geometry, tuple(c.offsets), (0.0, 0.0, -value))
    tip.lead(channel, following, frame_on_table(channel, c.offsets), c.offsets)
    channel.context_changed()


def _check_work_zero(channel: WordAddressChannel) -> None:
    """PC0001 for a fixture offset, and for a workpiece error unless directions are vectors of the work (G43.5)."""
    state, code = OnTable.of(channel), channel.mode["length"]
    if state.fixture or (state.error and code != "G43.5"):
        raise AlarmError(
            "PC0001", hint="hint.not-supported", code=f"{code}: G54.{'2' if state.fixture else '4'}"
        )


def plan_with_direction(builder: Builder, plan: Plan) -> Step | None:
    """G43.5: a straight block names the tip, and with I J K the direction of the tool; None without them."""
    if builder.mode["length"] != "G43.5" or builder.mode["motion"] not in ("G0", "G1"):
        return None
    letters = [letter for letter in "IJK" if builder.has(letter) and builder.is_free(letter)]
    if not letters:
        return None
    builder.take(*letters)
    rapid = builder.mode["motion"] == "G0"
    places = tuple(builder.slot(letter) if letter in letters else None for letter in "IJK")
    absolute = not any(word.incremental for word in plan.axis_words)

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        words = Words(plan, values)
        if not rapid and not channel.feed > 0.0:
            raise words.fail("no_feed")
        c = channel.coordinates
        end = c.to_position(reach(channel, plan.axis_words, values))
        x, y, z = (words.typed(letter) or 0.0 for letter in "IJK")
        end = _stood(channel, (x, y, z), end) or _turned(channel, (x, y, z), end)
        if not end:
            raise words.fail("tip_direction", letters[0])
        channel.straight(Kind.RAPID if rapid else Kind.FEED, end, nan if rapid else channel.feed)

    told = targets_as_data(plan.axis_words)
    if told is None:
        return move
    i, j, k = (-1 if place is None else place for place in places)
    return declare(move, Straight(rapid, told, absolute=absolute, direction=(i, j, k)))


def record_of(channel: WordAddressChannel) -> Sequence[float]:
    """What the kernel must know that stands the tool along a direction, for scanner and interpreter alike.

    It knows of one turn of each axis only, so it decides nothing where the control bounds them.
    """
    state = tip.TipState.of(channel)
    bounded = bool(channel.control.rotary_ranges(channel))
    return stand_record(None if bounded else state.active, frame=state.frame)


def _stood(channel: WordAddressChannel, vector: Vector, end: list[float]) -> list[float]:
    """The end of a block whose tool stands along a programmed vector, by the kernel; nothing where that cannot say."""
    c, tool, found = channel.coordinates, array("d", record_of(channel)), array("d", end)
    if not stand(tool, array("d", c.position), *vector, found):
        return []
    for place in (StandRecord.OUTER, StandRecord.INNER):
        c.pending[int(tool[place])] = 0.0
    return found.tolist()


def _turned(channel: WordAddressChannel, vector: Vector, end: list[float]) -> list[float]:
    """The same on machines with other joints or with axes that are bounded; nothing for what none of them reaches."""
    c, (i, j, k) = channel.coordinates, tip.direction(channel, vector)
    near = dict(zip(channel.axes, c.machine, strict=True))
    angles = nearest_angles(channel, (i, j, k), near) if i or j or k else None
    if angles is None:
        return []
    for name, angle in angles.items():
        axis = channel.axis_index[name]
        end[axis] = angle - c.offsets[axis]
    return end


def end_following(channel: WordAddressChannel) -> None:
    """G49 or another length code: the axes are named themselves again; nothing moves."""
    state = tip.TipState.of(channel)
    leads = state.is_leading(channel)
    state.active = state.seated = None
    if not leads:
        return
    channel.coordinates.transform(None)
    refresh_zero(channel)


#: Straight blocks that name the direction of the tool.
RULE = Rule(
    "tool direction by a vector", modes={"length": ("G43.5",)}, in_cycles=False, motion=plan_with_direction
)
