"""G10 of the lathe: work offsets, work shift, tool offsets."""

from __future__ import annotations

from polycnc.control.fanuc.lathe.coordinates import limits
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory, y_offset_axis
from polycnc.control.fanuc.lathe.tools.offsets import MAX_OFFSETS, offset_changed, refresh
from polycnc.control.word_address.macro_b import parameter_input
from polycnc.control.word_address.tools.data_input import (
    TOOL_LIFE,
    WORK_SYSTEMS,
    life_not_counted,
    refuse_words,
)
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words

#: Geometry offsets are numbered from here in G10 and in offset files (III.8.2); G10 of the axes 4 and 5 is printed
#: with another base (II.5.1.8), which no other number uses.
GEOMETRY, PRINTED_GEOMETRY = 10_000, 1000
#: Largest offset of the delivered offset range (5042).
MAX_OFFSET_MM = 9999.999
#: Axes whose offsets have words of their own names.
BASIC = frozenset("XYZ")
#: 4th and 5th axis offsets: word and the parameter with the axis' number (II.5.1.5).
FURTHER_AXES = {"E": LatheParameters.axis_of_offset_4, "F": LatheParameters.axis_of_offset_5}


def input_data(channel: LatheChannel, words: Words) -> None:
    """G10 L2, L20 work offsets, L50, L52 parameters; without L by P: 0 work shift, 1 … wear, 10001 … geometry."""
    kind = words.integer("L") if "L" in words else None
    number = words.integer("P") if "P" in words else None
    if kind in parameter_input.LEVELS:
        parameter_input.begin(channel)
        return
    if kind == TOOL_LIFE:
        raise life_not_counted()
    if number is None or number < 0:
        raise words.fail("g10_number", "P" if "P" in words else "G10")
    if kind == 2:
        if number >= len(WORK_SYSTEMS):
            raise words.fail("g10_number", "P")
        _set_work_offset(channel, words, channel.memory.work_offset(WORK_SYSTEMS[number]))
    elif kind == 20:
        if not 1 <= number <= channel.control.EXTENDED_WORK_SYSTEMS:
            raise words.fail("g10_number", "P")
        _set_work_offset(channel, words, channel.memory.work_offset(f"G54.1 P{number}"))
    elif kind is not None:
        raise words.fail("g10_number", "L")
    elif number == 0:
        _set_work_offset(channel, words, OffsetMemory.of(channel).work_shift)
    else:
        _set_tool_offset(channel, words, number)


def plan_parameter_block(builder: Builder, plan: Plan) -> Step | None:
    """A block between G10 L52 and G11: `N number [P axis] [Q bit] R value`, and nothing else (PS0231)."""
    if builder.before["data_input"] != "G10" or any(row.code == "G11" for row in builder.codes):
        return None
    if builder.codes or builder.m_codes:
        raise builder.control.fail("parameter_words", address=builder.order[0])
    if not builder.slots:
        raise builder.control.fail("parameter_words", address="N")
    write = parameter_input.plan_parameter_block(builder, plan)

    def act(channel: LatheChannel, values: list[float]) -> None:
        if write is not None:
            write(channel, values)
        limits.renew_zones(channel)

    return act


def _set_work_offset(channel: LatheChannel, words: Words, offset: list[float]) -> None:
    refuse_words(words, "RCQEF".translate(str.maketrans("", "", "".join(channel.axes))))
    for axis, value, incremental in words.axes():
        offset[axis] = offset[axis] + value if incremental else value
    refresh(channel)


def _set_tool_offset(channel: LatheChannel, words: Words, number: int) -> None:
    memory = channel.memory
    base = next((base for base in (GEOMETRY, PRINTED_GEOMETRY) if number > base), 0)
    is_geometry, number = base > 0, number - base
    if not 1 <= number <= MAX_OFFSETS or (is_geometry and memory.parameters.NGW):
        raise words.fail("g10_number", "P")
    offset = OffsetMemory.of(channel).at(number)
    values = offset.geometry if is_geometry else offset.wear
    radius_word = words.length("R")
    by_increment = words.length("C")
    _set_axis_offsets(channel, words, values)
    field = "radius" if is_geometry else "radius_wear"
    if radius_word is not None:
        setattr(offset, field, radius_word)
    if by_increment is not None:
        setattr(offset, field, getattr(offset, field) + by_increment)
    tip = words.integer("Q")
    if tip is not None:
        if not 0 <= tip <= 9:
            raise words.fail("g10_value", "Q")
        offset.tip = tip
    offset_changed(channel)


def _set_axis_offsets(channel: LatheChannel, words: Words, values: dict[str, float]) -> None:
    """The offsets along the axes of a block: X, Z, Y by their words, the 4th and 5th axis by E and F."""
    further = further_words(channel)
    for axis, value, incremental in words.axes():
        name = channel.axes[axis]
        if name == "C":
            continue  # C is the increment of the nose radius, also where the machine has an axis of that name
        if abs(value) > MAX_OFFSET_MM:
            raise words.fail("g10_value", words.plan.axis_words[0].address)
        if name not in BASIC and further.get(name) != name:
            raise words.fail("g10_format", name)
        if name not in BASIC and not _is_in_use(channel, name):
            continue
        if channel.memory.parameters.ORC and channel.control.is_diameter(channel, axis):
            value *= 2.0  # ORC: the word of a diameter axis is a radius value
        values[name] = values.get(name, 0.0) + value if incremental else value
    for address in FURTHER_AXES:
        amount = words.length(address)
        if amount is None:
            continue
        if address not in further:
            raise words.fail("g10_format", address)
        if _is_in_use(channel, further[address]):
            values[further[address]] = amount


def further_words(channel: LatheChannel) -> dict[str, str]:
    """The words of the 4th and 5th axis offsets and the axes that 5044 and 5045 name.

    They are E and F; by 11403#2 OFN the axis' own name, if that is A or B (III.1.1.3).
    """
    parameters = channel.memory.parameters
    found: dict[str, str] = {}
    for address, parameter in FURTHER_AXES.items():
        number = parameters.value(parameter)
        if 1 <= number <= len(channel.axes):
            name = channel.axes[number - 1]
            found[name if parameters.OFN and name in ("A", "B") else address] = name
    return found


def _is_in_use(channel: LatheChannel, name: str) -> bool:
    """Whether a 4th or 5th axis offset acts: the 5th by 11400#1 NO5, and none on the axis of the Y offset."""
    memory = channel.memory
    axis = channel.axis_index[name]
    if axis == memory.parameters.axis_of_offset_5 - 1 and not memory.parameters.NO5:
        return False
    has_y_offset = memory.parameters.YOF and axis == y_offset_axis(channel)
    return not has_y_offset
