"""Machining centres of FANUC and MELDAS: data as programs between `%`, as these controls punch them.

Tool offsets `G10 G90 L10 P1 R…` (L10 and L11 geometry and wear of the length, L12 and L13 those of the radius), work
offsets `G10 G90 L2 P1 X… Y… Z…`, `G10 G90 L20 P1 …` and, on a rotary table, `G10 G90 L21 P1 …` and `#26010=…` (FANUC
macro B reference 10.2), variables `#500=…`, vacant ones `#500=#0`, their names `SETVN 500[…]`. Reading one is running
it.
"""

from __future__ import annotations

from polycnc.control.word_address.coordinates import on_table
from polycnc.control.word_address.memory import ToolOffsets
from polycnc.control.word_address.tools.data_input import WORK_SYSTEMS
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.interchange import numbers
from polycnc.interchange.controls import parameters
from polycnc.interchange.controls.kinds import TAPE, Kind, Texts, Writer
from polycnc.interchange.numbers import Unit

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel

#: L numbers of the fields of an offset, in the order in which they are written.
_FIELDS = {10: "length", 11: "length_wear", 12: "radius", 13: "radius_wear"}
#: Work offsets with numbers, and the L by which G10 sets them.
_FURTHER = {"G54.1 P": 20, "G54.2 P": 21}


def tape(lines: Iterable[str]) -> str:
    """Blocks between `%`, with M02 behind them."""
    return "".join(f"{line}\n" for line in ("%", *lines, "M02", "%"))


def unit_of(channel: MacroChannel) -> Unit:
    """The unit in which the control reads at power-on."""
    inch = channel.memory.is_inch
    return Unit(INCH_MM if inch else 1.0, 4 if inch else 3)


def tool_offsets(channel: MacroChannel) -> str:
    """Every offset number that is in use."""
    return tape(offset_blocks(channel, unit_of(channel)))


def offset_blocks(channel: WordAddressChannel, unit: Unit) -> Iterator[str]:
    """Four blocks for every offset number that is in use."""
    for number, offset in sorted(ToolOffsets.of(channel).numbers.items()):
        for level, field in _FIELDS.items():
            yield f"G10 G90 L{level} P{number} R{unit.text(getattr(offset, field))}"


def work_offsets(channel: MacroChannel) -> str:
    """The external offset, the six standard systems, further ones that are in use, and those of a rotary table."""
    kept, unit, lines = channel.memory.work_offsets, unit_of(channel), []
    for number, name in enumerate(WORK_SYSTEMS):
        if name in kept:
            lines.append(f"G10 G90 L2 P{number} {axis_words(channel, unit, kept[name])}")
    for prefix, level in _FURTHER.items():
        further = {int(name.removeprefix(prefix)): name for name in kept if name.startswith(prefix)}
        for number, name in sorted(further.items()):
            lines.append(f"G10 G90 L{level} P{number} {axis_words(channel, unit, kept[name])}")
    return tape([*lines, *_workpiece_errors(channel, unit)])


def _workpiece_errors(channel: MacroChannel, unit: Unit) -> Iterator[str]:
    """The values of G54.4, as the variables that they are."""
    angle = Unit(1.0, unit.decimals)
    for number, values in sorted(on_table.WorkpieceErrors.of(channel).by_number.items()):
        for i, value in enumerate(values):
            told = (unit if i < on_table.LINEAR.stop else angle).text(value)
            yield f"#{on_table.FIRST_VARIABLE + on_table.VARIABLES * number + i}={told}"


def axis_words(channel: WordAddressChannel, unit: Unit, values: list[float]) -> str:
    """A word for every axis."""
    angle = Unit(1.0, unit.decimals)
    axes = zip(channel.axes, channel.axis_data, values, strict=True)
    return " ".join(axis + (angle if data.rotary else unit).text(value) for axis, data, value in axes)


def variables(channel: MacroChannel) -> str:
    """The variables that outlive the power, vacant ones too, then their names."""
    memory = channel.memory
    lines = [
        f"#{number}={'#0' if value is None else numbers.expression(value)}"
        for number, value in sorted(memory.kept.items())
    ]
    return tape([*lines, *(f"SETVN {number}[{name}]" for name, number in memory.names.items())])


def _texts(files: Mapping[str, str]) -> Texts:
    writers: dict[str, Writer] = {
        "parameters": parameters.write,
        "offsets": tool_offsets,
        "work": work_offsets,
        "variables": variables,
    }
    kinds = {name: Kind(files[name], writer) for name, writer in writers.items()}
    return Texts(kinds, TAPE, files["programs"], readers=(parameters.read,))


FANUC = _texts(
    {
        "programs": "ALL-PROG.TXT",
        "offsets": "TOOLOFST.TXT",
        "work": "EXT_WKZ.TXT",
        "variables": "MACRO.TXT",
        "parameters": "CNC-PARA.TXT",
    }
)
MELDAS = _texts(
    {
        "programs": "ALL.PRG",
        "offsets": "TOOL.OFS",
        "work": "WORK.OFS",
        "variables": "COMMON.VAR",
        "parameters": "ALL.PRM",
    }
)
