"""SYNTEC: data as macro programs: variables, registers by G10 L1000, user parameters by SETPR, offsets by G10.

Source: SYNTEC macro language (variables, SETPR), programming manual 2.14 (G10). Parameters by which the control
acts no program writes; the setup has them.
"""

from __future__ import annotations

from polycnc.control.syntec.coordinates.systems import WORK_SYSTEMS
from polycnc.control.syntec.macros.machine_parameters import WrittenParameters
from polycnc.control.syntec.macros.variables import USER, GlobalState, SpaceState
from polycnc.control.syntec.units import decimals
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.interchange import numbers
from polycnc.interchange.controls.kinds import FILES, Kind, Texts
from polycnc.interchange.controls.mills import axis_words, offset_blocks
from polycnc.interchange.numbers import Unit

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.language.syntec.values import Value


def _macro(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in ("%@MACRO", *(f"{line};" for line in lines), "M30;"))


def _number(value: Value) -> str:
    return str(value) if isinstance(value, int) else numbers.plain(float(str(value)), 1)


def _variables(channel: SyntecChannel) -> str:
    state = GlobalState.of(channel)
    lines = [f"@{number} := {_number(value)}" for number, value in sorted(state.values.items())]
    lines += [
        f"#{USER[offset]} := {_number(value)}"
        for offset, value in sorted(SpaceState.of(channel).user.items())
    ]
    lines += [f"G10 L1000 P{number} R{value}" for number, value in sorted(state.registers.items())]
    return _macro(lines)


def _parameters(channel: SyntecChannel) -> str:
    written = WrittenParameters.of(channel).values
    return _macro(f"SETPR({number}, {value})" for number, value in sorted(written.items()))


def _unit_of(channel: SyntecChannel) -> Unit:
    memory = channel.memory
    return Unit(INCH_MM if memory.is_inch else 1.0, decimals(memory.parameters, inch=memory.is_inch))


def _tool_offsets(channel: SyntecChannel) -> str:
    return _macro(offset_blocks(channel, _unit_of(channel)))


def _work_offsets(channel: SyntecChannel) -> str:
    kept, unit = channel.memory.work_offsets, _unit_of(channel)
    return _macro(
        f"G10 G90 L2 P{number} {axis_words(channel, unit, kept[name])}"
        for number, name in enumerate((EXTERNAL, *WORK_SYSTEMS))
        if name in kept
    )


TEXTS = Texts(
    {
        "parameters": Kind("PARAM.NC", _parameters),
        "offsets": Kind("TOOLS.NC", _tool_offsets),
        "work": Kind("WORK.NC", _work_offsets),
        "variables": Kind("GLOBALS.NC", _variables),
    },
    FILES,
)
