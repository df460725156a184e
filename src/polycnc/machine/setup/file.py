"""Reads a setup from the values of a case or from a file. What each key may hold is a table of readers."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import partial
from math import isfinite

from polycnc.deferred.paths import suffix_of, text_of
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any, NoReturn, TypeVar
from polycnc.machine.documents import DocumentError, toml_values, yaml_values
from polycnc.machine.errors import SetupError, meant_by
from polycnc.machine.places import Key, toml_place, yaml_place
from polycnc.machine.setup.values import (
    Interrupt,
    Offsets,
    ParameterKey,
    Parameters,
    ProbeEdge,
    Setup,
    Switches,
    Tool,
    Value,
    parameter_key,
)
from polycnc.messages.catalogue import listed
from polycnc.messages.files import read_utf_8, reason_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from polycnc.geometry.surfaces import Surface
    from polycnc.machine.model import Machine

T = TypeVar("T")
K = TypeVar("K")
Where = tuple[Key, ...]
Reader = Callable[[Where, object], Any]
#: No axis of a machine reaches farther, mm or degrees; no whole number of a setup is greater.
FARTHEST, MOST_WHOLE = 1e9, 999_999_999
#: Greatest value of a variable or a parameter: far beyond any length, and its square is a number still.
LARGEST = 1e100
_LAST_SKIP_LEVEL = 9
_LAST_TIP = 9
#: Bits of the widest parameters there are.
_LAST_BIT = 31
#: Names of work offsets on all controls: G54 to G59, G59.1 …, G54.1 P1 (G54 P1), G500, G505 …, and the external one.
_WORK_OFFSET = regex(r"EXT|G5[4-9](\.\d)?( ?P\d+)?|G5\d\d")
#: Operating modes, as the controls name them.
MODES = (
    "memory", "auto", "mdi", "mda", "tape", "dnc", "remote", "edit",
    "jog", "handle", "increment", "reference", "teach",
)  # fmt: skip


class _BadValueError(Exception):
    """A mistake with its key path, before anyone knows the file."""

    def __init__(self, where: Where, message: str, **args: object) -> None:
        super().__init__(message)
        self.where = where
        self.message = message
        self.args_by_name = {"where": ".".join(map(str, where)), **args}


def parse_setup(data: object, *, source: str = "") -> Setup:
    """A setup from the values of a YAML or TOML document.

    Args:
        data: The mapping under `setup`; None for no setup.
        source: What an error names as its place: a file or the id of a case.

    Raises:
        SetupError: A key is unknown or a value makes no sense; the error names the key.
    """
    if data is None:
        return Setup()
    try:
        return _setup((), data)
    except _BadValueError as bad:
        raise SetupError(source, 0, 0, bad.message, **bad.args_by_name) from None


def load_setup(path: str | Path) -> Setup:
    """A setup from a file: TOML where the name ends so, else YAML.

    Raises:
        SetupError: The file cannot be read or is wrong; the error names the line and the key.
    """
    path = text_of(path)
    try:
        text = read_utf_8(path)
    except (OSError, UnicodeError) as error:
        raise SetupError(path, 0, 0, "unreadable", detail=reason_of(error)) from error
    is_toml = suffix_of(path).lower() == ".toml"
    data = _document(path, text, is_toml=is_toml)
    try:
        return Setup() if data is None else _setup((), data)
    except _BadValueError as bad:
        line, column = (toml_place if is_toml else yaml_place)(text, bad.where)
        raise SetupError(path, line, column, bad.message, **bad.args_by_name) from None


def check_axes(setup: Setup, machine: Machine, path: str | Path = "") -> None:
    """Raise `SetupError` where a setup names an axis that the machine does not have.

    Args:
        setup: What has been read.
        machine: The machine of the run.
        path: The file that it was read from; empty where there is none.
    """
    from polycnc.machine.setup.check import foreign_axes

    where = next(foreign_axes(setup, machine), None)
    if where is not None:
        axes = listed(axis.name for axis in machine.axes)
        raise _misfit(path, where, "no-such-axis", machine=machine.id, axes=axes)


def check_bits(setup: Setup, control: str, last: int, path: str | Path = "") -> None:
    """Raise `SetupError` where a setup names a bit that parameters of the control do not have.

    Args:
        setup: What has been read.
        control: Id of the control.
        last: The last bit of its parameters.
        path: The file that it was read from; empty where there is none.
    """
    for key in setup.parameters:
        if key.bit is not None and key.bit > last:
            number = f"{key.id}#{key.bit}" + (f" {key.axis}" if key.axis else "")
            raise _misfit(path, ("parameters", number), "no-such-bit", control=control, last=last)


def _misfit(path: str | Path, where: Where, message: str, **args: object) -> SetupError:
    """The error for what does not fit the machine or the control; with its line where a file is known."""
    line = column = 0
    if path:
        text = read_utf_8(path)
        line, column = (toml_place if suffix_of(path).lower() == ".toml" else yaml_place)(text, where)
    return SetupError(str(path), line, column, message, where=".".join(map(str, where)), **args)


def _document(path: str, text: str, *, is_toml: bool) -> object:
    try:
        return toml_values(text) if is_toml else yaml_values(text)
    except DocumentError as bad:
        raise SetupError(path, bad.line, bad.column, bad.message, **bad.args_by_name) from None


# Readers of single values.


def _bad(where: Where, message: str, value: object, **args: object) -> NoReturn:
    raise _BadValueError(where, message, value="null" if value is None else repr(value)[:40], **args)


def _number(where: Where, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
        _bad(where, "needs-number", value)
    if not -FARTHEST <= value <= FARTHEST:
        _bad(where, "out-of-range", value, detail=f"-{FARTHEST:.0e} … {FARTHEST:.0e}")
    return float(value)


def _whole(where: Where, value: object) -> int:
    if isinstance(value, float) and value.is_integer():
        return int(value)
    if isinstance(value, bool) or not isinstance(value, int):
        _bad(where, "needs-whole-number", value)
    if abs(value) > MOST_WHOLE:
        _bad(where, "out-of-range", value, detail=f"{-MOST_WHOLE} … {MOST_WHOLE}")
    return value


def _flag(where: Where, value: object) -> bool:
    if isinstance(value, bool) or value in (0, 1):
        return bool(value)
    _bad(where, "needs-true-or-false", value)


def _word(where: Where, value: object) -> str:
    if not isinstance(value, str):
        _bad(where, "needs-text", value)
    return value


def _value(where: Where, value: object) -> Value:
    """What a variable, a parameter or a signal may hold."""
    if isinstance(value, list):
        return tuple(_value((*where, number), element) for number, element in enumerate(value))
    if isinstance(value, float) and not isfinite(value):
        _bad(where, "needs-value", value)
    if isinstance(value, int | float) and abs(value) > LARGEST:
        _bad(where, "out-of-range", value, detail=f"-{LARGEST:.0e} … {LARGEST:.0e}")
    if value is None or isinstance(value, bool | int | float | str):
        return value
    _bad(where, "needs-value", value)


def _one_of(*allowed: str) -> Reader:
    def read(where: Where, value: object) -> str:
        if value not in allowed:
            _bad(where, "not-one-of", value, expected=listed(allowed))
        return str(value)

    return read


# Readers of tables and lists.


def _items(where: Where, value: object) -> Iterable[tuple[Key, object]]:
    if not isinstance(value, Mapping):
        _bad(where, "needs-table", value)
    return value.items()


def _map_of(
    read_key: Callable[[Where], K], read: Callable[[Where, object], T], where: Where, value: object
) -> dict[K, T]:
    table: dict[K, T] = {}
    for key, element in _items(where, value):
        own = read_key((*where, key))
        if own in table:
            raise _BadValueError((*where, key), "key-twice", name=key)
        table[own] = read((*where, key), element)
    return table


def _list_of(read: Callable[[Where, object], T], where: Where, value: object) -> tuple[T, ...]:
    if not isinstance(value, list | tuple):
        _bad(where, "needs-list", value)
    return tuple(read((*where, number), element) for number, element in enumerate(value))


def _record(readers: Mapping[str, Reader], where: Where, value: object) -> dict[str, Any]:
    """A table with known keys; an unknown one is a mistake."""
    record = {}
    for key, element in _items(where, value):
        read = readers.get(str(key))
        if read is None:
            meant = meant_by(str(key), readers, TABLES)
            raise _BadValueError((*where, key), "unknown-key", **meant)
        record[str(key)] = read((*where, key), element)
    return record


def _required(record: dict[str, Any], where: Where, *keys: str) -> dict[str, Any]:
    for key in keys:
        if key not in record:
            raise _BadValueError((*where, key), "missing-key")
    return record


# Readers of keys.


def _axis_key(where: Where) -> str:
    return _text_key(where).upper()


def _text_key(where: Where) -> str:
    return str(where[-1]).strip()


def _offset_key(where: Where) -> str:
    key = " ".join(str(where[-1]).upper().split())
    if not _WORK_OFFSET.fullmatch(key):
        raise _BadValueError(where, "no-work-offset")
    return re.sub(r"(?<! )P", " P", key)


def _number_key(where: Where) -> int:
    key = str(where[-1])
    if not _is_number(key):
        _bad(where, "needs-whole-number", key)
    return int(key)


def _tool_key(where: Where) -> int | str:
    key = str(where[-1])
    if not key:
        _bad(where, "needs-text", key)
    return int(key) if _is_number(key) else key


def _is_number(key: str) -> bool:
    return key.isascii() and key.isdigit() and len(key) <= len(str(MOST_WHOLE))


_position = partial(_map_of, _axis_key, _number)
_offsets = partial(_map_of, _offset_key, _position)
_values = partial(_map_of, _text_key, _value)
_OFFSETS: dict[str, Reader] = {
    **dict.fromkeys(("x", "y", "z", "length", "radius"), _number),
    "axes": _position,
}


def _tool_called(where: Where, value: object) -> int | str:
    """A tool's number, or its name."""
    if isinstance(value, str):
        return _tool_key((value.strip(),))
    number = _whole(where, value)
    if number < 0:
        _bad(where, "out-of-range", value, detail="0 …")
    return number


def _tools_called(where: Where, value: object) -> dict[int, int | str]:
    """The tool of the first channel, or one for each channel by its number."""
    if isinstance(value, Mapping):
        return _map_of(_number_key, _tool_called, where, value)
    return {1: _tool_called(where, value)}


def _tip(where: Where, value: object) -> int:
    """Where the tip of a turning tool points: 1 to 8, 0 and 9 for its centre."""
    tip = _whole(where, value)
    if not 0 <= tip <= _LAST_TIP:
        _bad(where, "out-of-range", value, detail=f"0 … {_LAST_TIP}")
    return tip


def _offset_set(where: Where, value: object) -> Offsets:
    return Offsets(**_record(_OFFSETS, where, value))


def _tool(where: Where, value: object) -> Tool:
    return Tool(**_record(_TOOL, where, value))


_TOOL: dict[str, Reader] = {
    **_OFFSETS,
    "tip": _tip,
    "type": _whole,
    "name": _word,
    "wear": _offset_set,
    "geom2": _offset_set,
    "edges": partial(_map_of, _number_key, _tool),
}


def _parameters(where: Where, value: object) -> Parameters:
    values: dict[ParameterKey, Value] = {}
    for name, element in _items(where, value):
        try:
            key = parameter_key(name)
        except ValueError:
            raise _BadValueError((*where, name), "bad-parameter") from None
        if key in values:
            raise _BadValueError((*where, name), "parameter-twice")
        if key.bit is not None and key.bit > _LAST_BIT:
            raise _BadValueError((*where, name), "bad-parameter")
        values[key] = _value((*where, name), element)
        if key.bit is not None and values[key] not in (0, 1):
            _bad((*where, name), "out-of-range", element, detail="0, 1")
    return Parameters(values)


def _axis_name(where: Where, value: object) -> str:
    return _word(where, value).upper()


def _single_block(where: Where, value: object) -> str:
    if isinstance(value, bool):
        return "SBL1" if value else ""
    return str(_one_of("SBL1", "SBL2", "SBL3")(where, value))


def _skip_level(where: Where, value: object) -> int:
    level = _whole(where, value)
    if not 0 <= level <= _LAST_SKIP_LEVEL:
        _bad(where, "out-of-range", value, detail=f"0 … {_LAST_SKIP_LEVEL}")
    return level


def _block_skip(where: Where, value: object) -> bool | tuple[int, ...]:
    return value if isinstance(value, bool) else _list_of(_skip_level, where, value)


def _mode(where: Where, value: object) -> str:
    return str(_one_of(*MODES)(where, _word(where, value).lower()))


def _channels(where: Where, value: object) -> dict[int, tuple[str, ...]]:
    dealt = _map_of(_number_key, partial(_list_of, _axis_name), where, value)
    if dealt and 1 not in dealt:
        raise _BadValueError((*where, 1), "missing-key")
    return dealt


_PROBE_EDGE: dict[str, Reader] = {"axis": _axis_name, "at": _number, "edge": _one_of("rising", "falling")}
_INTERRUPT: dict[str, Reader] = {"input": _whole, "line": _whole, "at": _position, "program": _word}


def _probe_edge(where: Where, value: object) -> ProbeEdge:
    record = _required(_record(_PROBE_EDGE, where, value), where, "axis", "at")
    return ProbeEdge(record["axis"], record["at"], record.get("edge", "rising") == "rising")


def _seconds(where: Where, value: object) -> float:
    seconds = _number(where, value)
    if seconds < 0.0:
        _bad(where, "out-of-range", value, detail="0 …")
    return seconds


_SURFACE: dict[str, Reader] = {
    "shape": _one_of("plane", "sphere", "cylinder"),
    "at": _position,
    "direction": _position,
    "radius": _number,
    "inside": _flag,
    "tip": _number,
}

#: What a surface of each shape needs beside its place.
_NEEDED = {"plane": ("direction",), "sphere": ("radius",), "cylinder": ("direction", "radius")}


def _surface(where: Where, value: object) -> Surface:
    record = _required(_record(_SURFACE, where, value), where, "shape", "at")
    needed = _NEEDED[str(record.pop("shape"))]
    _required(record, where, *needed)
    for key in ("direction", "radius", "inside"):
        if key in record and key not in needed and not (key == "inside" and "radius" in needed):
            raise _BadValueError((*where, key), "unknown-key")
    for key in ("at", "direction"):
        given: dict[str, float] = record.get(key, {})
        unknown = next((axis for axis in given if axis not in "XYZ"), None)
        if unknown is not None:
            _bad((*where, key, unknown), "not-one-of", unknown, expected="X, Y, Z")
        record[key] = tuple(given.get(axis, 0.0) for axis in "XYZ")
    if "direction" in needed and not any(record["direction"]):
        _bad((*where, "direction"), "out-of-range", value, detail="X, Y, Z")
    if "radius" in needed and not record["radius"] > 0.0:
        _bad((*where, "radius"), "out-of-range", record["radius"], detail="> 0")
    from polycnc.geometry.surfaces import Surface

    return Surface(**record)


def _interrupt(where: Where, value: object) -> Interrupt:
    return Interrupt(**_required(_record(_INTERRUPT, where, value), where, "input", "line", "at"))


_SWITCHES: dict[str, Reader] = {
    "single_block": _single_block,
    "optional_stop": _flag,
    "block_skip": _block_skip,
    "mode": _mode,
    "skip_signal_at": _position,
    "skip_signal_after": _seconds,
    "skip_surfaces": partial(_list_of, _surface),
    "measure_signal_at": _position,
    "probe": partial(_map_of, _number_key, partial(_list_of, _probe_edge)),
    "interrupts": partial(_list_of, _interrupt),
    "signals_at": partial(_map_of, _text_key, _position),
    "plc": _values,
    "thread_chamfer": _flag,
}


def _switches(where: Where, value: object) -> Switches:
    """The known switches; every other key is a signal of that name."""
    known = {}
    signals = {}
    for key, element in _items(where, value):
        read = _SWITCHES.get(str(key))
        if read is not None:
            known[str(key)] = read((*where, key), element)
        else:
            signals[str(key)] = _value((*where, key), element)
    return Switches(**known, signals=signals)


_SETUP: dict[str, Reader] = {
    "machine": _word,
    "start": _position,
    "work_offsets": _offsets,
    "tools": partial(_map_of, _tool_key, _tool),
    "spindle_tool": _tools_called,
    "variables": _values,
    "parameters": _parameters,
    "channels": _channels,
    "switches": _switches,
}
#: All tables with known keys by their places.
TABLES: dict[str, dict[str, Reader]] = {
    "": _SETUP,
    "tools.TOOL": _TOOL,
    "tools.TOOL.wear": _OFFSETS,
    "tools.TOOL.geom2": _OFFSETS,
    "tools.TOOL.edges.NUMBER": _TOOL,
    "switches": _SWITCHES,
    "switches.skip_surfaces": _SURFACE,
    "switches.probe.NUMBER": _PROBE_EDGE,
    "switches.interrupts": _INTERRUPT,
}


def _setup(where: Where, value: object) -> Setup:
    return Setup(**_record(_SETUP, where, value))
