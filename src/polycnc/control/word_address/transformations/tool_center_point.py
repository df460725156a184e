"""G43.4, G43.5 tool centre point control: words name the tip against the work, the linear axes follow the rotary ones.

The programming system is fixed to the table and turns with it (FANUC 19696#5 = 0): on FANUC and MELDAS it is the work
system as that lies when tip control begins, on SYNTEC with the table at machine zero. Positions in the toolpath are
those of the tip; their context turns them into positions of the axes.
"""

from __future__ import annotations

from array import array
from math import nan
from typing import TYPE_CHECKING

from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.block.words_as_data import targets_as_data
from polycnc.control.word_address.coordinates import on_table, tip
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.systems import (
    ZeroState,
    frame_as_told,
    frame_on_table,
    refresh_zero,
)
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.motion.path import reach
from polycnc.control.word_address.motion.planes import choose_basic_axes
from polycnc.control.word_address.states import LengthState, TiltState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.tilted_plane import nearest_angles
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.vectors import times
from polycnc.language.bulk import Straight, declare
from polycnc.toolpath import Kind
from polycnc.transformation.orientation.records import StandRecord
from polycnc.transformation.orientation.standing import stand

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Frame, Vector

    Leaning = Callable[[WordAddressChannel, Vector, list[float]], Vector]
    #: A straight move to a position, at a feed, that is programmed so.
    Going = Callable[[WordAddressChannel, Kind, list[float], float, list[float]], None]


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: the system that the table takes along from here on is the work system, as that lies now.

    Positions of the table that the block itself names count (FANUC A-79348E, page 19; 15i, B-63783EN-1, 10.4.14).
    """
    follow_table(channel, words, channel.control.kinematics(channel).work_turn(angles_named(channel, words)))


def angles_named(channel: WordAddressChannel, words: Words) -> dict[str, float]:
    """Machine positions of the axes, the rotary ones where a block leads them."""
    c = channel.coordinates
    angles = dict(zip(channel.axes, c.machine, strict=True))
    for axis, value, incremental in words.axes():
        if channel.axis_data[axis].rotary:
            name = channel.axes[axis]
            angles[name] = angles[name] + value if incremental else value + c.offsets[axis]
    return angles


def follow_table(channel: WordAddressChannel, words: Words, begun: Frame = IDENTITY) -> None:
    """From here on positions are those of the tip; without motion in its block nothing moves.

    Args:
        channel: The channel.
        words: Words of the block.
        begun: How the table has turned where the system that it takes along is the work system; not at all at zero.
    """
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

    choose_basic_axes(channel)
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
    tip.TipState.of(channel).begun = begun
    ZeroState.of(channel).length = [0.0] * len(channel.axes)
    refresh_zero(channel)
    arm = times(kinematics.along, -value)
    following = ToolCentrePoint(kinematics, channel.axes, c.geometry, tuple(c.offsets), arm)
    frame, told = frame_on_table(channel, c.offsets), frame_as_told(channel, c.offsets)
    tip.lead(channel, following, frame, c.offsets, told)
    channel.context_changed()


def _check_work_zero(channel: WordAddressChannel) -> None:
    """A fixture offset would turn with the table as the tip does; a workpiece error turns the tool."""
    if OnTable.of(channel).fixture:
        raise channel.control.fail("tip_mode", address="G54.2")
    on_table.begin_posture(channel)


#: What does not go with tool centre point control (macro B reference §12), beside drilling cycles.
NOT_WITH_TIP = frozenset(("G12.1", "G27", "G28", "G29", "G30", "G41", "G42", "G53"))


def check_company(builder: Builder) -> None:
    """Refuse codes of the machine, cycles and radius compensation of a plane; under G43.5 rotary words too.

    A block that ends the control, or begins it, may hold what its other codes allow.
    """
    before, after, cycle = builder.before["length"], builder.mode["length"], builder.mode["cycle"]
    if after in TIP_CODES and cycle != "G80" and not any(row.group == "cycle" for row in builder.codes):
        raise builder.control.fail("tip_company", address=cycle)
    if before not in TIP_CODES or after not in TIP_CODES:
        return
    for row in builder.codes:
        if row.code in NOT_WITH_TIP or (row.group == "cycle" and row.code != "G80"):
            raise builder.control.fail("tip_company", address=row.code)
    if after == before == "G43.5":
        for address in builder.slots:
            target = builder.control.axis_of_address(builder.channel, address, builder)
            if target is not None and builder.channel.axis_data[target[0]].rotary:
                raise builder.control.fail("tip_company", address=address)


def plan_with_tip(builder: Builder, plan: Plan) -> Step | None:
    """G43.5: a straight block names the tip, and with I J K the direction of the tool; None without them."""
    return plan_with_direction(builder, plan) if builder.mode["length"] == "G43.5" else None


def plan_with_direction(
    builder: Builder, plan: Plan, leaning: Leaning | None = None, going: Going | None = None
) -> Step | None:
    """A straight block with I J K for the direction of the tool on the work; None without them.

    What turns and mirrors points does so with it (three-dimensional conversion: 15i, B-63324EN, 14.16; SYNTEC 2.29.1).
    `leaning` gives another direction for that, by the end of the block, to which `going` moves otherwise than the path.
    """
    if builder.mode["motion"] not in ("G0", "G1"):
        return None
    letters = [letter for letter in "IJK" if builder.has(letter) and builder.is_free(letter)]
    if not letters:
        return None
    builder.take(*letters)
    rapid = builder.mode["motion"] == "G0"
    places = tuple(builder.slot(letter) if letter in letters else None for letter in "IJK")
    absolute = not any(word.incremental for word in plan.axis_words)
    polar = builder.mode.codes.get("polar") == "G16"
    # Written alike, their ratio is that of the typed numbers.
    alike = len({builder.slots[letter][1] == "" for letter in letters}) == 1

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        words = Words(plan, values)
        if not rapid and not channel.feed > 0.0:
            raise words.fail("no_feed")
        if polar:
            programmed = channel.control.polar_target(channel, plan, values)
        else:
            programmed = reach(channel, plan.axis_words, values)
        c = channel.coordinates
        end = c.to_position(programmed)
        x, y, z = ((words.typed(letter) if alike else words.part(letter)) or 0.0 for letter in "IJK")
        vector, turned = channel.memory.frames.directions.direct(x, y, z), None
        if leaning is None:
            turned = _stood(channel, (x, y, z), end)
        else:
            vector = leaning(channel, vector, end)
        turned = turned or _turned(channel, vector)
        if not turned:
            raise words.fail("tip_direction", letters[0])
        for axis, angle in turned.items():
            end[axis] = programmed[axis] = angle
            c.pending[axis] = 0.0
        feed = nan if rapid else channel.control.feed_to(channel, end)
        kind = Kind.RAPID if rapid else Kind.FEED
        if going is None:
            channel.straight(kind, end, feed, programmed)
        else:
            going(channel, kind, end, feed, programmed)

    told = targets_as_data(plan.axis_words)
    if told is None or polar or leaning is not None or going is not None or not alike:
        return move
    i, j, k = (-1 if place is None else place for place in places)
    return declare(move, Straight(rapid, told, absolute=absolute, direction=(i, j, k)))


def record_of(channel: WordAddressChannel) -> Sequence[float]:
    """What the kernel must know that stands the tool along a direction, for scanner and interpreter alike.

    It knows of one turn of each axis only, so it decides nothing where the control bounds them.
    """
    from polycnc.transformation.orientation.stood import stand_record

    state = tip.TipState.of(channel)
    bounded = bool(channel.control.rotary_ranges(channel))
    frame = state.frame @ channel.memory.frames.directions
    return stand_record(None if bounded else state.active, frame=frame)


def _stood(channel: WordAddressChannel, vector: Vector, end: list[float]) -> dict[int, float]:
    """Positions of the axes that stand the tool along a programmed vector, by the kernel; none where that cannot say.

    They are programmed positions as well: the frames that words are mapped by turn and shift the basic axes only.
    """
    c, tool, found = channel.coordinates, array("d", record_of(channel)), array("d", end)
    if not stand(tool, array("d", c.position), *vector, found):
        return {}
    return {int(tool[place]): found[int(tool[place])] for place in (StandRecord.OUTER, StandRecord.INNER)}


def _turned(channel: WordAddressChannel, vector: Vector) -> dict[int, float]:
    """The same on machines with other joints or with axes that are bounded; none for what none of them reaches."""
    c, (i, j, k) = channel.coordinates, tip.direction(channel, vector)
    near = dict(zip(channel.axes, c.machine, strict=True))
    angles = nearest_angles(channel, (i, j, k), near) if i or j or k else None
    return {
        channel.axis_index[name]: angle - c.offsets[channel.axis_index[name]]
        for name, angle in (angles or {}).items()
    }


def end_following(channel: WordAddressChannel) -> None:
    """G49 or another length code: the axes are named themselves again; nothing moves."""
    state = tip.TipState.of(channel)
    leads = state.is_leading(channel)
    state.active = state.seated = None
    state.begun = IDENTITY
    if not leads:
        return
    channel.coordinates.transform(None)
    refresh_zero(channel)
