"""From a machine file to a `Machine`: bases are laid under, defaults filled in, units converted once.

A file of the user is checked against the schema on the way. The shipped files are not: a test does that, so
that a short program does not wait for it.
"""

from __future__ import annotations

import tomllib
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeVar, cast

from polycnc.machine.errors import MachineFileError
from polycnc.machine.model import (
    Axis,
    Channel,
    Gear,
    Joint,
    Machine,
    Magazine,
    MFunction,
    Solid,
    Spindle,
    Text,
)
from polycnc.machine.places import toml_error_place, toml_place
from polycnc.machine.rules import Rule
from polycnc.messages.files import read_utf_8, reason_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from polycnc.geometry.frames import Vector
    from polycnc.machine.schema import Mistake
    from polycnc.machine.tables import (
        AxisData,
        AxisKind,
        ChannelData,
        DefaultsData,
        DynamicsData,
        JointData,
        MachineData,
        MagazineData,
        MFunctionData,
        RuleData,
        SolidData,
        SpindleData,
        TextData,
    )

    DynamicsKey = Literal[
        "rapid", "max_feed", "acceleration", "jerk", "in_position_fine", "in_position_coarse"
    ]

T = TypeVar("T")
BUILTIN = Path(__file__).with_name("builtin")
_PER_MINUTE = 60.0
#: Axis letters that turn (ISO 841); an axis with another letter is linear unless its table says otherwise.
_ROTARY_LETTERS = "ABC"
#: The linear axis that a letter runs parallel to (ISO 841).
_PARALLEL = {"U": "X", "V": "Y", "W": "Z"}
#: Keys that a file replaces as a whole instead of adding to what its base says.
_WHOLE = frozenset(("geometry", "change_at"))
#: What a machine is called is its own.
_NOT_INHERITED = frozenset(("name", "description"))
#: What an axis can do that neither its table nor `[defaults]` tells, in file units.
_WINDOWS: DynamicsData = {"in_position_fine": 0.01, "in_position_coarse": 0.04}
_DYNAMICS: dict[AxisKind, DynamicsData] = {
    "linear": {"rapid": 24000, "max_feed": 15000, "acceleration": 3000, "jerk": 50000, **_WINDOWS},
    "rotary": {"rapid": 7200, "max_feed": 7200, "acceleration": 400, "jerk": 8000, **_WINDOWS},
}
#: How many reference points an axis has; those that its table does not tell lie on the last that it tells.
_REFERENCE_POINTS = 4
_UNIT = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
_ORIGIN = (0.0, 0.0, 0.0)
_TOOL_AXIS = (0.0, 0.0, 1.0)


def builtin_ids() -> tuple[str, ...]:
    """Ids of the machines that come with polycnc, sorted."""
    return tuple(sorted(path.stem for path in BUILTIN.glob("*.toml")))


def load_machine(id_or_path: str | Path) -> Machine:
    """A built-in machine by its id, or the machine of a file.

    Raises:
        MachineFileError: There is no such machine, or the file is wrong; the error names the line.
    """
    path = _find(str(id_or_path))
    if path.parent == BUILTIN:
        return build(path.stem, cast("MachineData", _builtin_data(path)))
    from polycnc.machine.check import contradictions, gaps

    text = _read(path)
    data = cast("MachineData", _checked_data(path, text, ()))
    _raise_first(path, text, gaps(data))
    machine = build(path.stem, data)
    _raise_first(path, text, contradictions(machine))
    return machine


def _find(name: str) -> Path:
    if not name.endswith(".toml"):
        builtin = BUILTIN / f"{name}.toml"
        if builtin.parent == BUILTIN and builtin.is_file():
            return builtin
    if Path(name).is_file():
        return Path(name)
    raise MachineFileError(name, 0, 0, "no-such-machine", machine=name)


def _read(path: Path) -> str:
    try:
        return read_utf_8(path)
    except (OSError, UnicodeError) as error:
        raise MachineFileError(str(path), 0, 0, "unreadable", detail=reason_of(error)) from error


def _builtin_data(path: Path) -> dict[str, object]:
    data: dict[str, object] = tomllib.loads(path.read_text(encoding="utf-8"))
    base = data.pop("base", None)
    return _built_on(_builtin_data(BUILTIN / f"{base}.toml"), data) if base else data


def _checked_data(path: Path, text: str, below: tuple[Path, ...]) -> dict[str, object]:
    from polycnc.machine.schema import mistakes

    try:
        data: dict[str, object] = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        detail, (line, column) = toml_error_place(str(error), text)
        raise MachineFileError(str(path), line, column, "not-toml", detail=detail) from error
    _raise_first(path, text, mistakes(data))
    base = data.pop("base", None)
    if base is None:
        return data
    return _built_on(_base_data(path, text, str(base), (*below, path.resolve())), data)


def _base_data(path: Path, text: str, base: str, below: tuple[Path, ...]) -> dict[str, object]:
    """The data of the machine that a file builds on: a built-in one, or a file beside it."""
    line, column = toml_place(text, ("base",))
    beside = path.parent / base
    if base.endswith(".toml") and beside.is_file():
        if beside.resolve() in below:
            raise MachineFileError(str(path), line, column, "base-of-itself", base=base)
        return _checked_data(beside, _read(beside), below)
    if base in builtin_ids():
        return _builtin_data(BUILTIN / f"{base}.toml")
    raise MachineFileError(str(path), line, column, "no-such-machine", machine=base)


def _raise_first(path: Path, text: str, found: Iterable[Mistake]) -> None:
    """Raise the mistake that stands first in the file."""
    placed = [(toml_place(text, where), message, args) for where, message, args in found]
    if placed:
        (line, column), message, args = min(placed, key=lambda mistake: mistake[0])
        raise MachineFileError(str(path), line, column, message, **args)


def _built_on(base: Mapping[str, object], data: Mapping[str, object]) -> dict[str, object]:
    return _laid_over({key: value for key, value in base.items() if key not in _NOT_INHERITED}, data)


def _laid_over(base: Mapping[str, object], data: Mapping[str, object]) -> dict[str, object]:
    """What `data` says, else what `base` says; lists and the keys of `_WHOLE` are replaced."""
    merged = dict(base)
    for key, value in data.items():
        below = merged.get(key)
        if isinstance(value, dict) and isinstance(below, dict) and key not in _WHOLE:
            value = _laid_over(below, value)
        merged[key] = value
    return merged


def build(machine_id: str, data: MachineData) -> Machine:
    """A machine from the values of a file, complete with defaults, in internal units."""
    spindles = tuple(_spindle(number, table) for number, table in _numbered(data.get("spindle", {})))
    channels = tuple(
        _channel(number, table, spindles) for number, table in _numbered(data.get("channel", {}))
    )
    names = tuple(dict.fromkeys(name for channel in channels for name in channel.axes))
    tables = data.get("axis", {})
    axes = tuple(_axis(name, tables.get(name, {}), data.get("defaults", {}), names) for name in names)
    return Machine(
        id=machine_id,
        name=_text(data.get("name", machine_id)),
        description=_text(data.get("description", "")),
        axes=axes,
        channels=channels,
        spindles=spindles,
        magazine=_magazine(data.get("magazine", {})),
        m_functions={code: _m_function(code, table) for code, table in _numbered(data.get("m_function", {}))},
        joints=_joints(data.get("joint", ()), channels, {axis.name: axis.rotary for axis in axes}),
        solids=tuple(_solid(table) for table in data.get("solid", ())),
        interpolation_cycle_s=float(data.get("interpolation_cycle_s", 0.004)),
        settle_fine_s=float(data.get("settle_fine_s", 0.0)),
        settle_coarse_s=float(data.get("settle_coarse_s", 0.0)),
        rules=tuple(rule_of(table) for table in data.get("rule", ())),
    )


def rule_of(table: RuleData) -> Rule:
    """A rule from its table."""
    return Rule(table["when"], table["output"], float(table.get("after_s", 0.0)), table.get("latch", ""))


def _numbered(tables: Mapping[str, T]) -> list[tuple[int, T]]:
    """Tables whose names are numbers, in order."""
    return sorted(((int(number), table) for number, table in tables.items()), key=lambda item: item[0])


def _text(value: TextData) -> Text:
    return Text(value) if isinstance(value, str) else Text(value["en"], value.get("zh-TW", ""))


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = (*map(float, values), 0.0)[:3]
    return (x, y, z)


def _axis(name: str, table: AxisData, defaults: DefaultsData, names: tuple[str, ...]) -> Axis:
    kind: AxisKind = table.get("kind") or ("rotary" if name[0] in _ROTARY_LETTERS else "linear")
    values: DynamicsData = {**_DYNAMICS[kind], **defaults.get(kind, {})}

    def value(key: DynamicsKey) -> float:
        return float(table.get(key, values[key]))

    points = [float(point) for point in table.get("reference_points", (0.0,))]
    points += points[-1:] * (_REFERENCE_POINTS - len(points))
    parallel = _PARALLEL.get(name, "") if kind == "linear" else ""
    return Axis(
        name=name,
        rotary=kind == "rotary",
        modulo=table.get("modulo", kind == "rotary"),
        diameter=table.get("diameter", False),
        parallel_to=table.get("parallel_to", parallel if parallel in names else ""),
        aliases=tuple(table.get("aliases", ())),
        machine_name=table.get("machine_name", name if name[-1].isdigit() else f"{name}1"),
        limit_minus=float(table.get("limit_minus", -inf)),
        limit_plus=float(table.get("limit_plus", inf)),
        rapid=value("rapid") / _PER_MINUTE,
        max_feed=value("max_feed") / _PER_MINUTE,
        acceleration=value("acceleration"),
        jerk=value("jerk"),
        reference_points=cast("tuple[float, float, float, float]", tuple(points)),
        in_position_fine=value("in_position_fine"),
        in_position_coarse=value("in_position_coarse"),
    )


def _channel(number: int, table: ChannelData, spindles: tuple[Spindle, ...]) -> Channel:
    axes = tuple(table.get("axes", ()))
    names = tuple(table.get("names", axes))
    virtual = tuple(table.get("virtual", ()))
    by_name = dict(zip(names, axes, strict=False))
    geometry = table.get("geometry", {letter: by_name[letter] for letter in _UNIT if letter in by_name})
    numbers = tuple(table.get("spindles", (spindle.number for spindle in spindles)))
    return Channel(number, axes, names, dict(geometry), virtual, numbers)


def _spindle(number: int, table: SpindleData) -> Spindle:
    return Spindle(
        number=number,
        name=table.get("name", f"S{number}"),
        min_rpm=float(table.get("min_rpm", 0)),
        max_rpm=float(table.get("max_rpm", 12000)),
        acceleration_rpm_s=float(table.get("acceleration", 4000)),
        orient_s=float(table.get("orient_s", 0.5)),
        carries=table.get("carries", "tool"),
        axis=table.get("axis", ""),
        gears=tuple(Gear(float(gear["min_rpm"]), float(gear["max_rpm"])) for gear in table.get("gears", ())),
    )


def _magazine(table: MagazineData) -> Magazine:
    return Magazine(
        kind=table.get("kind", "magazine"),
        places=table.get("places", 24),
        change_time_s=float(table.get("change_time_s", 4.0)),
        change_at={name: tuple(points) for name, points in table.get("change_at", {}).items()},
    )


def _m_function(code: int, table: MFunctionData) -> MFunction:
    name = _text(table.get("name", f"M{code}"))
    return MFunction(code, name, float(table.get("seconds", 0)), table.get("timing", "with"))


def _joints(
    tables: Iterable[JointData], channels: tuple[Channel, ...], rotary: Mapping[str, bool]
) -> tuple[Joint, ...]:
    """The chain of the file; geometry axes that it does not mention move the tool, nearest to the base."""
    told = [
        Joint(
            table["axis"],
            rotary[table["axis"]],
            table["carries"],
            _vector(table["direction"]),
            _vector(table.get("offset", _ORIGIN)),
        )
        for table in tables
    ]
    mentioned = {joint.axis for joint in told}
    geometry = {axis: letter for channel in channels for letter, axis in channel.geometry.items()}
    untold = [
        Joint(axis, False, "tool", _UNIT[letter], _ORIGIN)
        for axis, letter in geometry.items()
        if axis not in mentioned and axis in rotary
    ]
    return (*untold, *told)


def _solid(table: SolidData) -> Solid:
    return Solid(
        name=_text(table["name"]),
        role=table["role"],
        shape=table["shape"],
        position=_vector(table["position"]),
        size=_vector(table["size"]),
        direction=_vector(table.get("direction", _TOOL_AXIS)),
        moves_with=table["moves_with"],
    )
