"""Data files of the lathe: offsets as text, as the control reads and punches them (0i-TF Plus III.1.1).

A file is a G10 program between two `%`: wear of number n as `G10 P01`, geometry as `G10 P10001`, second geometry as
`G10 P20001`, work offsets as `G10 L2 P1` and `G10 L20 P1`, the work shift as `G10 P00`. What a file names is
overwritten, everything else stays. A damaged file changes nothing at all.
"""

from __future__ import annotations

from polycnc.control.data_files import DataFileError
from polycnc.control.fanuc.lathe.tools.data_input import BASIC, GEOMETRY, MAX_OFFSET_MM, further_words
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.offsets import MAX_OFFSETS, offset_changed, refresh
from polycnc.control.word_address.tools.data_input import WORK_SYSTEMS
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.fanuc.lathe.memory import TurningMemory
    from polycnc.control.fanuc.lathe.tools.offset_memory import TurningOffset

#: Second geometry offsets are numbered from here.
SECOND = 20_000
STANDARD_SETS = 32
MAX_TIP = 9
#: What can be written, and the control's name for the file.
KINDS: Mapping[str, str] = {
    "offsets": "TOOLOFST.TXT",
    "y-offsets": "TOOLOFST.TXT",
    "second-geometry": "SEC_GEOM.TXT",
    "work": "EXT_WKZ.TXT",
    "work-shift": "WORKSHFT.TXT",
}
_WORD = regex(r"([A-Z])([+-]?(?:\d+\.?\d*|\.\d+))\s*")
#: Two values that differ by less are one: what is left of the way from inches and diameters.
_ROUNDING = 1e-9
_COMMENT = regex(r"\([^)]*\)")


# ---- writing ----------------------------------------------------------------------------------------------------


def write(channel: LatheChannel, kind: str) -> str:
    """The file of a kind of data; `KeyError` for a kind that there is not."""
    lines = _WRITERS[kind](channel)
    return "%\n" + "".join(f"{line} ;\n" for line in lines) + "%\n"


def _offset_lines(channel: LatheChannel) -> Iterator[str]:
    """Wear of all numbers, then geometry; R and Q where nose radius compensation is there (8136#7)."""
    memory: TurningMemory = channel.memory
    nose = not memory.parameters.NCR
    axes = {**{name: name for name in "XZ" if name in channel.axes}, "": "", **_y_and_further(channel)}
    for number in range(1, sets(channel) + 1):
        offset = OffsetMemory.of(channel).at(number)
        yield _line(
            channel, f"P{number:02d}", offset.wear, axes, (offset.radius_wear, offset.tip) if nose else None
        )
    if memory.parameters.NGW:
        return
    for number in range(1, sets(channel) + 1):
        offset = OffsetMemory.of(channel).at(number)
        nose_words = (offset.radius, offset.tip) if nose else None
        yield _line(channel, f"P{GEOMETRY + number}", offset.geometry, axes, nose_words)


def _y_lines(channel: LatheChannel) -> Iterator[str]:
    if "Y" not in channel.axes:
        raise DataFileError(1, "word", word="Y")
    memory: TurningMemory = channel.memory
    for number in range(1, sets(channel) + 1):
        yield _line(channel, f"P{number:02d}", OffsetMemory.of(channel).at(number).wear, {"Y": "Y"}, None)
    if not memory.parameters.NGW:
        for number in range(1, sets(channel) + 1):
            yield _line(
                channel,
                f"P{GEOMETRY + number}",
                OffsetMemory.of(channel).at(number).geometry,
                {"Y": "Y"},
                None,
            )


def _second_lines(channel: LatheChannel) -> Iterator[str]:
    axes = {name: name for name in "XZY" if name in channel.axes}
    for number in range(1, sets(channel) + 1):
        yield _line(channel, f"P{SECOND + number}", OffsetMemory.of(channel).at(number).second, axes, None)


def _work_lines(channel: LatheChannel) -> Iterator[str]:
    memory: TurningMemory = channel.memory
    axes = {name: name for name in channel.axes}
    extended = ((f"L20 P{p}", f"G54.1 P{p}") for p in range(1, channel.control.EXTENDED_WORK_SYSTEMS + 1))
    systems = [(f"L2 P{p}", name) for p, name in enumerate(WORK_SYSTEMS)]
    for words, name in (*systems, *extended):
        values = dict(zip(channel.axes, memory.work_offset(name), strict=True))
        yield _line(channel, words, values, axes, None, work=True)


def _shift_lines(channel: LatheChannel) -> Iterator[str]:
    values = dict(zip(channel.axes, OffsetMemory.of(channel).work_shift, strict=True))
    yield _line(channel, "P00", values, {name: name for name in channel.axes}, None, work=True)


_WRITERS: Mapping[str, Callable[[LatheChannel], Iterator[str]]] = {
    "offsets": _offset_lines,
    "y-offsets": _y_lines,
    "second-geometry": _second_lines,
    "work": _work_lines,
    "work-shift": _shift_lines,
}


def sets(channel: LatheChannel) -> int:
    """Number of offset sets (5024; 0: the standard 32, or as many as are in use)."""
    number = channel.memory.parameters.offset_sets
    return number if number > 0 else max(STANDARD_SETS, *OffsetMemory.of(channel).numbers, 0)


def _y_and_further(channel: LatheChannel) -> dict[str, str]:
    words = {"Y": "Y"} if "Y" in channel.axes else {}
    return {**words, **{word: axis for word, axis in further_words(channel).items() if axis not in words}}


def _line(
    channel: LatheChannel,
    start: str,
    values: Mapping[str, float],
    axes: Mapping[str, str],
    nose: tuple[float, int] | None,
    *,
    work: bool = False,
) -> str:
    """A block; the words of the nose stand where `axes` has an empty one."""
    words: list[str] = ["G10", start]
    for address, axis in axes.items():
        if address:
            words.append(address + _number(channel, shown(channel, axis, values.get(axis, 0.0), work=work)))
        elif nose is not None:
            words += [f"R{_number(channel, channel.memory.to_program_unit(nose[0]))}", f"Q{nose[1]}"]
    return " ".join(words)


def _number(channel: LatheChannel, value: float) -> str:
    """With the decimals of the display; with as many as it needs where a program has written a finer value."""
    decimals = 4 if channel.memory.is_inch else 3
    rounded = f"{value + 0.0:.{decimals}f}"
    return rounded if abs(float(rounded) - value) < _ROUNDING else f"{value + 0.0:.12f}".rstrip("0")


def shown(channel: LatheChannel, axis: str, value: float, *, work: bool = False) -> float:
    """A tool offset (or work offset) as the control shows it: diameter where it is one, in the input unit."""
    index = channel.axis_index.get(axis)
    if index is not None and channel.axis_data[index].rotary:
        return value
    diameter = index is not None and has_diameter(channel, index, work=work)
    return float(channel.memory.to_program_unit(value * (2.0 if diameter else 1.0)))


def taken(channel: LatheChannel, axis: str, value: float, *, work: bool = False) -> float:
    """What is shown as the control keeps it: mm, X as radius."""
    index = channel.axis_index.get(axis)
    if index is None or channel.axis_data[index].rotary:
        return value
    length = channel.memory.from_program_unit(value)
    return float(length / 2.0 if has_diameter(channel, index, work=work) else length)


def has_diameter(channel: LatheChannel, axis: int, *, work: bool = False) -> bool:
    """Whether offsets of an axis are diameters (1006#3 DIA); 5004#1 ORC makes tool offsets radius values."""
    radii = not work and channel.memory.parameters.ORC
    return not radii and bool(channel.control.is_diameter(channel, axis))


# ---- reading ----------------------------------------------------------------------------------------------------


@dataclass(slots=True)
class _Entry:
    """A block that has been read: what it writes into, and its values by address, as shown."""

    line: int
    level: int | None
    number: int
    words: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Taken:
    """What a file has written: how many blocks, into which offset numbers and work coordinate systems."""

    blocks: int
    numbers: frozenset[int]
    systems: frozenset[str]


def read(channel: LatheChannel, content: str) -> Taken:
    """Take a file over.

    Raises:
        DataFileError: The file is damaged; nothing has been changed.
    """
    entries = [_entry(channel, line, block) for line, block in _blocks(content)]
    for entry in entries:
        _check(channel, entry)
    for entry in entries:
        _take_over(channel, entry)
    refresh(channel)
    offset_changed(channel)
    tools = (entry.number % GEOMETRY for entry in entries if entry.level is None and entry.number)
    systems = (_system(entry) for entry in entries if entry.level is not None)
    return Taken(len(entries), frozenset(tools), frozenset(systems))


def _blocks(content: str) -> Iterator[tuple[int, str]]:
    """The blocks between the first and the last `%`, with their lines."""
    lines = content.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    filled = [(number, line.strip()) for number, line in enumerate(lines, 1) if line.strip()]
    if not filled or not filled[0][1].startswith("%"):
        raise DataFileError(filled[0][0] if filled else 1, "no-start")
    if len(filled) < 2 or filled[-1][1] != "%":
        raise DataFileError(filled[-1][0], "no-end")
    for number, line in filled[1:-1]:
        block = _COMMENT.sub("", line).removesuffix(";").strip().upper()
        if "%" in block:
            raise DataFileError(number, "no-word", found=line)
        if block:
            yield number, block


def _entry(channel: LatheChannel, line: int, block: str) -> _Entry:
    words: dict[str, float] = {}
    rest = _WORD.sub("", block)
    if rest:
        raise DataFileError(line, "no-word", found=rest[:20])
    for match in _WORD.finditer(block):
        address, number = match.groups()
        if address in words:
            raise DataFileError(line, "word-twice", word=address)
        words[address] = float(number) if "." in number or address in "GLPQ" else _increments(channel, number)
    if words.pop("G", None) != 10.0:
        raise DataFileError(line, "no-g10")
    if "P" not in words:
        raise DataFileError(line, "no-number")
    for address in "LPQ":
        if not words.get(address, 0.0).is_integer() or words.get(address, 0.0) < 0.0:
            raise DataFileError(line, "value", word=f"{address}{words[address]:g}")
    level = words.pop("L", None)
    return _Entry(line, None if level is None else int(level), int(words.pop("P")), words)


def _increments(channel: LatheChannel, number: str) -> float:
    return int(number) / (10_000.0 if channel.memory.is_inch else 1000.0)


def _check(channel: LatheChannel, entry: _Entry) -> None:
    allowed = _addresses(channel, entry)
    if allowed is None:
        prefix = "" if entry.level is None else f"L{entry.level} "
        raise DataFileError(entry.line, "number", number=f"{prefix}P{entry.number}")
    for address, value in entry.words.items():
        if address not in allowed:
            raise DataFileError(entry.line, "word", word=address)
        largest = MAX_TIP if address == "Q" else MAX_OFFSET_MM
        if abs(value) > largest:
            raise DataFileError(entry.line, "value", word=f"{address}{value:g}")


def _addresses(channel: LatheChannel, entry: _Entry) -> set[str] | None:
    """The words that a block may have; None where there is no such number."""
    if entry.level == 2:
        return set(channel.axes) if entry.number < len(WORK_SYSTEMS) else None
    if entry.level == 20:
        return set(channel.axes) if 1 <= entry.number <= channel.control.EXTENDED_WORK_SYSTEMS else None
    if entry.level is None and entry.number == 0:
        return set(channel.axes)
    group, number = divmod(entry.number, GEOMETRY)
    if entry.level is not None or not 1 <= number <= MAX_OFFSETS or group > SECOND // GEOMETRY:
        return None
    axes = BASIC & set(channel.axes)
    if group * GEOMETRY == SECOND:
        return set(axes)
    if group and channel.memory.parameters.NGW:
        return None
    return {*axes, *further_words(channel), "R", "Q"}


def _system(entry: _Entry) -> str:
    """The work coordinate system of a block with L2 or L20."""
    return WORK_SYSTEMS[entry.number] if entry.level == 2 else f"G54.1 P{entry.number}"


def _take_over(channel: LatheChannel, entry: _Entry) -> None:
    memory: TurningMemory = channel.memory
    if entry.level is not None:
        for address, value in entry.words.items():
            length = taken(channel, address, value, work=True)
            memory.work_offset(_system(entry))[channel.axis_index[address]] = length
        return
    if entry.number == 0:
        for address, value in entry.words.items():
            shift = OffsetMemory.of(channel).work_shift
            shift[channel.axis_index[address]] = taken(channel, address, value, work=True)
        return
    group, number = divmod(entry.number, GEOMETRY)
    offset = OffsetMemory.of(channel).at(number)
    values = (offset.wear, offset.geometry, offset.second)[group]
    further = further_words(channel)
    for address, value in entry.words.items():
        if address == "Q":
            offset.tip = int(value)
        elif address == "R":
            _set_radius(offset, channel.memory.from_program_unit(value), wear=not group)
        else:
            axis = further.get(address, address)
            values[axis] = taken(channel, axis, value)


def _set_radius(offset: TurningOffset, value: float, *, wear: bool) -> None:
    if wear:
        offset.radius_wear = value
    else:
        offset.radius = value


# ---- setups -----------------------------------------------------------------------------------------------------


def as_setup(channel: LatheChannel, taken: Taken) -> dict[str, dict[Any, Any]]:
    """What a file has written, as a setup writes it: mm, X as diameter."""
    memory: TurningMemory = channel.memory
    tools = {
        number: _tool_of_setup(channel, OffsetMemory.of(channel).at(number))
        for number in sorted(taken.numbers)
    }
    systems = {
        name: _axes_of_setup(
            channel, dict(zip(channel.axes, memory.work_offset(name), strict=True)), work=True
        )
        for name in sorted(taken.systems)
    }
    found: dict[str, dict[Any, Any]] = {"tools": tools, "work_offsets": systems}
    return {key: values for key, values in found.items() if values}


def _tool_of_setup(channel: LatheChannel, offset: TurningOffset) -> dict[str, Any]:
    common = channel.memory.parameters.NGW
    main = offset.wear if common else offset.geometry
    radius = offset.radius_wear if common else offset.radius
    found = {**_offsets_of_setup(channel, main), "radius": radius, "tip": offset.tip}
    if not common:
        found["wear"] = {**_offsets_of_setup(channel, offset.wear), "radius": offset.radius_wear}
    if offset.second:
        found["geom2"] = _offsets_of_setup(channel, offset.second)
    return found


def _offsets_of_setup(channel: LatheChannel, values: Mapping[str, float]) -> dict[str, Any]:
    """Offsets along X, Y, Z, and those along further axes by their names."""
    found: dict[str, Any] = {}
    for axis, value in _axes_of_setup(channel, values).items():
        if axis in BASIC:
            found[axis.lower()] = value
        else:
            found.setdefault("axes", {})[axis] = value
    return found


def _axes_of_setup(
    channel: LatheChannel, values: Mapping[str, float], *, work: bool = False
) -> dict[str, float]:
    diameters = {name: has_diameter(channel, i, work=work) for name, i in channel.axis_index.items()}
    return {axis: round(value * (2.0 if diameters.get(axis) else 1.0), 9) for axis, value in values.items()}
