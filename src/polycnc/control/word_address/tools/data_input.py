"""G10 programmable data input on machining centres (FANUC macro B reference §10.2)."""

from __future__ import annotations

from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.macro_b import parameter_input
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.control.word_address.tools.length import renew_length
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel

WORK_SYSTEMS = (EXTERNAL, "G54", "G55", "G56", "G57", "G58", "G59")
#: L number of a tool offset to the field of the offset memory that it sets.
TOOL_FIELDS = {1: "length_wear", 10: "length", 11: "length_wear", 12: "radius", 13: "radius_wear"}
#: L number of groups of tools with their lives, which nothing here counts.
TOOL_LIFE = 3
#: Largest offset value, mm or inch (Hartford manual 3.3.2).
LARGEST_OFFSET = {False: 999.999, True: 99.999}


def input_data(channel: MacroChannel, words: Words) -> None:
    """G10 L2, L20 work offsets; L10 to L13 tool offsets; G90 sets, G91 adds."""
    kind = words.integer("L")
    number = words.integer("P")
    if kind in parameter_input.LEVELS:
        parameter_input.begin(channel)
        return
    if kind == TOOL_LIFE:
        raise life_not_counted()
    if kind is not None and kind not in TOOL_FIELDS and kind not in (2, 20):
        raise words.fail("g10_format", "L")
    if number is None:
        raise words.fail("g10_number", "G10")
    if kind == 2:
        if not 0 <= number < len(WORK_SYSTEMS):
            raise words.fail("g10_number", "P")
        _set_work_offset(channel, words, WORK_SYSTEMS[number])
    elif kind == 20:
        if not 1 <= number <= channel.control.EXTENDED_WORK_SYSTEMS:
            raise words.fail("g10_number", "P")
        _set_work_offset(channel, words, f"G54.1 P{number}")
    else:
        _set_tool_offset(channel, words, number, TOOL_FIELDS[10 if kind is None else kind])


def life_not_counted() -> AlarmError:
    """G10 L3 registers tools by their life: known, but not executed."""
    return AlarmError("PC0001", hint="hint.not-supported", address="L", code="G10 L3")


def refuse_words(words: Words, letters: str, mistake: str = "g10_format") -> None:
    """Words that belong to another kind of data."""
    found = next((letter for letter in letters if letter in words), "")
    if found:
        raise words.fail(mistake, found)


def refuse_axes(words: Words, mistake: str = "g10_format") -> None:
    """Axis words, where the data are those of no axis."""
    if words.plan.axis_words:
        raise words.fail(mistake, words.plan.axis_words[0].address)


def _set_work_offset(channel: MacroChannel, words: Words, name: str) -> None:
    refuse_words(words, "R")
    offset = channel.memory.work_offset(name)
    for axis, value, incremental in words.axes():
        offset[axis] = offset[axis] + value if incremental else value
    refresh_zero(channel)


def _set_tool_offset(channel: MacroChannel, words: Words, number: int, field: str) -> None:
    refuse_axes(words)
    value = words.length("R")
    if value is None or number < 1:
        raise words.fail("g10_number" if value is not None else "g10_format", "P")
    tool = channel.memory.offset_number(number)
    if channel.mode["distance"] == "G91":
        value += getattr(tool, field)
    if abs(channel.memory.to_program_unit(value)) > LARGEST_OFFSET[words.plan.inch] + 1e-6:
        raise words.fail("g10_value", "R")
    setattr(tool, field, value)
    renew_length(channel)
