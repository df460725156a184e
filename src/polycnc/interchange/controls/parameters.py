"""Parameters of FANUC and MELDAS as text.

FANUC: `N01320 Q1 A1 P500. A2 P…`: Q1 for parameters, A and the number of the axis in front of the value of an axis;
eight digits for the bits of a number, bit 7 first. Bits of which only some are changed, and all parameters of MELDAS,
are blocks of G10 L50: `N1006 P1 Q3 R0`, P the axis, Q the bit (FANUC macro B reference 10.2).
"""

from __future__ import annotations

import re

from polycnc.control.data_files import DataFileError
from polycnc.control.parameters import known_parameters
from polycnc.control.word_address.macro_b.parameter_input import set_parameter
from polycnc.control.word_address.memory import ParameterTable
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.interchange import numbers
from polycnc.machine.setup.values import ParameterKey
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.family import MacroChannel

_BITS = 8
_BLOCK = regex(r"N\s*(\d+)\s*Q\s*1\s*((?:(?:[ALST]\s*\d+\s*)?P\s*[-+.\d]+\s*)+);?\s*", re.ASCII)
_VALUE = regex(r"(?:([ALST])\s*(\d+)\s*)?P\s*([-+.\d]+)\s*", re.ASCII)
_G10 = regex(r"G10\s*L5[02]\s*;?\s*", re.ASCII)
_G10_BLOCK = regex(r"N\s*(\d+)\s*(?:P\s*(\d+)\s*)?(?:Q\s*([0-7])\s*)?R\s*([-+.\d]+)\s*;?\s*", re.ASCII)
_NUMBER = regex(r"[+-]?(?:\d+\.?\d*|\.\d+)", re.ASCII)
_END = regex(r"(?:G11|M02|M30|%)\s*;?\s*", re.ASCII)


# ---- writing ---------------------------------------------------------------------------------------------------


def write(channel: MacroChannel) -> str:
    """Every parameter that has another value than the setup gave it."""
    changed = ParameterTable.of(channel).changed
    by_number: dict[int, dict[ParameterKey, Any]] = {}
    for key, value in changed.items():
        if isinstance(key.id, int):
            by_number.setdefault(key.id, {})[key] = value
    lines, single = [], []
    for number, values in sorted(by_number.items()):
        masks = _masks(channel, number, values)
        if masks is None:
            single += [_g10_block(channel, key, value) for key, value in values.items()]
        else:
            words = " ".join(_value_words(channel, axis, value) for axis, value in masks.items())
            lines.append(f"N{number:05d} Q1 {words}")
    if single:
        lines += ["G10 L50", *single, "G11"]
    return "".join(f"{line}\n" for line in ("%", *lines, "%"))


def _masks(
    channel: MacroChannel, number: int, values: Mapping[ParameterKey, Any]
) -> dict[str | None, str] | None:
    """The text of a number by axis; None where single bits are to be written."""
    if not channel.control.id.startswith("fanuc"):
        return None
    bits = _bits(channel, number)
    found: dict[str | None, str] = {}
    for key, value in values.items():
        if key.element is not None or not isinstance(value, int | float):
            return None
        if key.bit is None:
            if bits:
                return None
            found[key.axis] = _text(value)
    if found and any(key.bit is not None for key in values):
        return None
    for axis in {key.axis: None for key in values if key.bit is not None}:
        mask = {key.bit: int(value) for key, value in values.items() if key.axis == axis}
        if set(mask) != set(bits):
            return None  # the eight digits would say bits that nobody has changed
        found[axis] = "".join(str(mask.get(bit, 0)) for bit in reversed(range(_BITS)))
    return found


def _bits(channel: Channel, number: int) -> frozenset[int]:
    """The bits that polycnc knows of a number."""
    known = (each.key for each in known_parameters(channel.control))
    return frozenset(key.bit for key in known if key.id == number and key.bit is not None)


def _text(value: float) -> str:
    return str(value) if isinstance(value, int) else numbers.plain(value)


def _value_words(channel: MacroChannel, axis: str | None, value: str) -> str:
    return f"P{value}" if axis is None else f"A{channel.axis_index[axis] + 1} P{value}"


def _g10_block(channel: MacroChannel, key: ParameterKey, value: Any) -> str:
    axis = "" if key.axis is None else f" P{channel.axis_index[key.axis] + 1}"
    bit = "" if key.bit is None else f" Q{key.bit}"
    return f"N{key.id}{axis}{bit} R{_text(value)}"


# ---- reading ---------------------------------------------------------------------------------------------------


class _Assignment(NamedTuple):
    line: int
    key: ParameterKey
    value: int | float


def read(channel: Channel, content: str) -> list[str] | None:
    """Take a file of parameters over.

    Returns:
        What has been left out of it: parameters that polycnc does not know, and bits of them that are 1 (a 0 is what
        such a bit is without the file). None where it is no such file.

    Raises:
        DataFileError: It is one, and wrong; nothing has been changed.
    """
    lines = [(n, line.strip().upper()) for n, line in enumerate(content.splitlines(), 1) if line.strip()]
    if len(lines) < 2 or not (_BLOCK.match(lines[1][1]) or _G10.match(lines[1][1])):
        return [] if content.split() == ["%", "%"] else None
    if not lines[0][1].startswith("%"):
        raise DataFileError(lines[0][0], "no-start")
    if not lines[-1][1].startswith("%"):
        raise DataFileError(lines[-1][0], "no-end")
    assignments = list(_assignments(channel, lines[1:-1]))
    unknown: dict[str, None] = {}
    for each in assignments:
        if _is_known(channel, each.key):
            set_parameter(channel, each.key, each.value)
        elif not _bits(channel, int(each.key.id)):
            unknown[str(each.key.id)] = None
        elif each.value:
            unknown[f"{each.key.id}#{each.key.bit}"] = None
    control = channel.control.id
    return [text("parameters.unknown", control=control, number=listed(sorted(unknown)))] if unknown else []


def _assignments(channel: Channel, lines: list[tuple[int, str]]) -> Iterator[_Assignment]:
    in_g10 = False
    for number, line in lines:
        if _END.fullmatch(line):
            in_g10 = in_g10 and not line.startswith("G11")
        elif _G10.fullmatch(line):
            in_g10 = True
        elif in_g10:
            yield _of_g10(channel, number, line)
        else:
            block = _BLOCK.fullmatch(line)
            if block is None:
                raise DataFileError(number, "no-word", found=line[:20])
            yield from _of_block(channel, number, int(block[1]), block[2])


def _of_g10(channel: Channel, line: int, block: str) -> _Assignment:
    match = _G10_BLOCK.fullmatch(block)
    if match is None:
        raise DataFileError(line, "no-word", found=block[:20])
    bit = None if match[3] is None else int(match[3])
    axis = None if match[2] is None else _axis(channel, line, f"P{match[2]}", int(match[2]))
    return _Assignment(line, ParameterKey(int(match[1]), bit, None, axis), _value(line, match[4]))


def _of_block(channel: Channel, line: int, number: int, words: str) -> Iterator[_Assignment]:
    bits = _bits(channel, number)
    for kind, place, written in _VALUE.findall(words):
        axis = _axis(channel, line, f"A{place}", int(place)) if kind == "A" else None
        if not bits:
            yield _Assignment(line, ParameterKey(number, None, None, axis), _value(line, written))
            continue
        if len(written) != _BITS or written.strip("01"):
            raise DataFileError(line, "value", word=f"P{written}")
        for bit in range(_BITS):
            yield _Assignment(line, ParameterKey(number, bit, None, axis), int(written[_BITS - 1 - bit]))


def _is_known(channel: Channel, key: ParameterKey) -> bool:
    """Whether polycnc knows a number, and the bit of it where it knows bits of that number."""
    number = int(key.id)
    bits = _bits(channel, number)
    if bits and key.bit is not None:
        return key.bit in bits
    return any(number in known.ids for known in known_parameters(channel.control))


def _axis(channel: Channel, line: int, word: str, number: int) -> str:
    if not 1 <= number <= len(channel.axes):
        raise DataFileError(line, "value", word=word)
    return channel.axes[number - 1]


def _value(line: int, written: str) -> int | float:
    if not _NUMBER.fullmatch(written):
        raise DataFileError(line, "no-word", found=written)
    return float(written) if "." in written else int(written)
