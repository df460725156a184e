"""From a machine file to a `Machine`: bases are laid under, defaults filled in, units converted once.

A file of the user is checked against the schema on the way. The shipped files are not: a test does that, so
that a short program does not wait for it.
"""

from __future__ import annotations

from functools import cache
from math import inf

from polycnc.deferred import paths
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.toml import loads
from polycnc.deferred.typing import TYPE_CHECKING, Literal, TypeVar, cast
from polycnc.machine.builder import BUILDERS, Builder, builder_names
from polycnc.machine.documents import DocumentError, toml_values
from polycnc.machine.errors import MachineFileError
from polycnc.machine.model import (
    Axis,
    Channel,
    Gear,
    GFunction,
    Joint,
    Machine,
    Magazine,
    MFunction,
    Solid,
    Spindle,
)
from polycnc.machine.places import toml_place
from polycnc.machine.plc import PlcAlarm
from polycnc.machine.rules import Rule, signal_name
from polycnc.machine.text import Text
from polycnc.messages.files import read_utf_8, reason_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from polycnc.geometry.frames import Vector
    from polycnc.machine.schema import Mistake
    from polycnc.machine.tables import (
        AlarmData,
        AxisData,
        AxisKind,
        BuilderData,
        ChannelData,
        DefaultsData,
        DynamicsData,
        GFunctionData,
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
        "rapid", "max_feed", "acceleration", "jerk", "in_position_fine", "in_position_coarse",
        "rapid_time_s", "rapid_bell_s", "cutting_time_s", "cutting_bell_s", "after_interpolation_s",
    ]  # fmt: skip

T = TypeVar("T")
BUILTIN = paths.package_path("machine", "builtin")
_PER_MINUTE = 60.0
#: Axis letters that turn (ISO 841); an axis with another letter is linear unless its table says otherwise.
_ROTARY_LETTERS = "ABC"
#: The linear axis that a letter runs parallel to (ISO 841).
_PARALLEL = {"U": "X", "V": "Y", "W": "Z"}
#: Keys that a file replaces as a whole instead of adding to what its base says.
_WHOLE = frozenset(("geometry", "change_at"))
#: Tables of a builder that a machine file adds to; its rules, alarms and messages stay in front of those of the file.
_FUNCTIONS: tuple[Literal["magazine", "m_function", "g_function"], ...] = (
    "magazine",
    "m_function",
    "g_function",
)
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
    return tuple(sorted(map(paths.stem_of, _toml_files(BUILTIN))))


def load_machine(id_or_path: str | Path) -> Machine:
    """A built-in machine by its id, or the machine of a file.

    Raises:
        MachineFileError: There is no such machine, or the file is wrong; the error names the line.
    """
    path = _find(str(id_or_path))
    if paths.parent_of(path) == BUILTIN:
        return _builtin(path)
    from polycnc.machine.check import contradictions, gaps

    text = _read(path)
    data = cast("MachineData", _checked_data(path, text, ()))
    _raise_first(path, text, gaps(data))
    machine = build(paths.stem_of(path), data, _builder_data(path, text, data.get("rules", "")))
    _raise_first(path, text, contradictions(machine))
    return machine


@cache
def _builtin(path: str) -> Machine:
    """A built-in machine, which is read once."""
    data = cast("MachineData", _builtin_data(path))
    return build(paths.stem_of(path), data, _shipped_builder(data.get("rules", "")))


def _find(name: str) -> str:
    if not name.endswith(".toml"):
        builtin = paths.joined(BUILTIN, f"{name}.toml")
        if paths.parent_of(builtin) == BUILTIN and _is_file(builtin):
            return builtin
    if _is_file(name):
        return paths.text_of(name)
    raise MachineFileError(name, 0, 0, "no-such-machine", machine=name)


def _is_file(path: str) -> bool:
    """Whether there is such a file, where nobody may look as well; a name that no file system takes is none."""
    try:
        return paths.is_file(path)
    except OSError:
        return False


def _toml_files(folder: str) -> list[str]:
    return [paths.joined(folder, name) for name in paths.names_in(folder) if paths.suffix_of(name) == ".toml"]


def _read(path: str) -> str:
    try:
        return read_utf_8(path)
    except (OSError, UnicodeError) as error:
        raise MachineFileError(path, 0, 0, "unreadable", detail=reason_of(error)) from error


@cache
def _builtin_data(path: str) -> Mapping[str, object]:
    """The data of a built-in machine, read once; machines are made of them anew."""
    data: dict[str, object] = loads(paths.read_text(path))
    base = data.pop("base", None)
    return _built_on(_builtin_data(paths.joined(BUILTIN, f"{base}.toml")), data) if base else data


def _checked_data(path: str, text: str, below: tuple[str, ...]) -> dict[str, object]:
    from polycnc.machine.schema import mistakes

    data = _toml(path, text)
    _raise_first(path, text, mistakes(data))
    base = data.pop("base", None)
    if base is None:
        return data
    return _built_on(_base_data(path, text, str(base), (*below, paths.resolved(path))), data)


def _base_data(path: str, text: str, base: str, below: tuple[str, ...]) -> Mapping[str, object]:
    """The data of the machine that a file builds on: a built-in one, or a file beside it."""
    line, column = toml_place(text, ("base",))
    beside = paths.joined(paths.parent_of(path), base)
    if base.endswith(".toml") and _is_file(beside):
        if paths.resolved(beside) in below:
            raise MachineFileError(path, line, column, "base-of-itself", base=base)
        return _checked_data(beside, _read(beside), below)
    if base in builtin_ids():
        return _builtin_data(paths.joined(BUILTIN, f"{base}.toml"))
    raise MachineFileError(path, line, column, "no-such-machine", machine=base)


def _builder_data(path: str, text: str, name: str) -> BuildersData:
    """The tables of the builder that a file names: one that comes with polycnc, or a file beside this one."""
    if not name.endswith(".toml"):
        if name and name not in builder_names():
            line, column = toml_place(text, ("rules",))
            raise MachineFileError(path, line, column, "no-such-builder", builder=name)
        return _shipped_builder(name)
    from polycnc.machine.check import conditions, functions
    from polycnc.machine.schema import BuilderTable, mistakes

    beside = paths.joined(paths.parent_of(path), name)
    data = _toml(beside, _read(beside))
    _raise_first(beside, _read(beside), mistakes(data, BuilderTable))
    tables = cast("BuilderData", data)
    _raise_first(beside, _read(beside), (*conditions(tables), *functions(tables)))
    return BuildersData(name, tables, {"": tables})


@cache
def _shipped_builder(name: str) -> BuildersData:
    if not name:
        return NOTHING
    shared: dict[str, object] = {}
    alarms: dict[str, BuilderData] = {}
    for file in _toml_files(paths.joined(BUILDERS, name)):
        data = _toml(file, paths.read_text(file))
        if "alarm" in data:
            alarms[paths.stem_of(file)] = cast("BuilderData", data)
        else:
            shared |= data
    return BuildersData(name, cast("BuilderData", shared), alarms)


def _toml(path: str, text: str) -> dict[str, object]:
    try:
        return toml_values(text)
    except DocumentError as bad:
        raise MachineFileError(path, bad.line, bad.column, bad.message, **bad.args_by_name) from None


def _raise_first(path: str, text: str, found: Iterable[Mistake]) -> None:
    """Raise the mistake that stands first in the file."""
    placed = [(toml_place(text, where), message, args) for where, message, args in found]
    if placed:
        (line, column), message, args = min(placed, key=lambda mistake: mistake[0])
        raise MachineFileError(path, line, column, message, **args)


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


class BuildersData(NamedTuple):
    """The tables of a builder as files give them: its name, what all controls share, alarms by the control's id."""

    name: str
    shared: BuilderData
    alarms: Mapping[str, BuilderData]


NOTHING = BuildersData("", {}, {})


def build(machine_id: str, data: MachineData, builder: BuildersData = NOTHING) -> Machine:
    """A machine from the values of a file, complete with defaults, in internal units."""
    data = cast("MachineData", {**data, **_functions(builder.shared, data)})
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
        block_time_s=float(data.get("block_time_s", 0.0)),
        tool_direction=_vector(data.get("tool_direction", _TOOL_AXIS)),
        nose=_vector(data.get("nose", _ORIGIN)),
        control_variant=data.get("control_variant", ""),
        control_options=tuple(data.get("control_options", ())),
        rules=tuple(_rule(table) for table in data.get("rule", ())),
        alarms=_alarms(data),
        g_functions={
            signal_name(f"G{code}"): _g_function(signal_name(f"G{code}"), table)
            for code, table in data.get("g_function", {}).items()
        },
        builder=Builder(
            builder.name,
            tuple(_rule(table) for table in builder.shared.get("rule", ())),
            {control: _alarms(tables) for control, tables in builder.alarms.items()},
        ),
    )


def _functions(builder: BuilderData, data: MachineData) -> dict[str, object]:
    """The tables of `_FUNCTIONS`: what the file says, else what its builder says."""
    return {key: _laid_over(builder.get(key, {}), data.get(key, {})) for key in _FUNCTIONS}


def _alarms(tables: BuilderData) -> tuple[PlcAlarm, ...]:
    stopping = (_alarm(table, stops=True) for table in tables.get("alarm", ()))
    return (*stopping, *(_alarm(table, stops=False) for table in tables.get("message", ())))


def _alarm(table: AlarmData, *, stops: bool) -> PlcAlarm:
    return PlcAlarm(
        table["code"],
        table["when"],
        stops,
        text=_text(table.get("text", "")),
        cause=_text(table.get("cause", "")),
        remedy=_text(table.get("remedy", "")),
    )


def _rule(table: RuleData) -> Rule:
    """A rule from its table."""
    return Rule(
        table["when"], signal_name(table["output"]), float(table.get("after_s", 0.0)), table.get("latch", "")
    )


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
        return float(table.get(key, values.get(key, 0.0)))

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
        rapid_time_s=value("rapid_time_s"),
        rapid_bell_s=value("rapid_bell_s"),
        cutting_time_s=value("cutting_time_s"),
        cutting_bell_s=value("cutting_bell_s"),
        after_interpolation_s=value("after_interpolation_s"),
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
        speed_wait=table.get("speed_wait", "block"),
    )


def _magazine(table: MagazineData) -> Magazine:
    at = table.get("change_at", "anywhere")
    return Magazine(
        kind=table.get("kind", "magazine"),
        places=table.get("places", 24),
        change_time_s=float(table.get("change_time_s", 4.0)),
        change_at={} if at == "anywhere" else {name: tuple(points) for name, points in at.items()},
        retracts=table.get("retracts", False),
        place_time_s=float(table.get("place_time_s", 0.0)),
        pockets=table.get("pockets", "random"),
        turns=table.get("turns", "shortest"),
    )


def _m_function(code: int, table: MFunctionData) -> MFunction:
    name = _text(table.get("name", f"M{code}"))
    seconds, takes = float(table.get("seconds", 0)), table.get("takes")
    return MFunction(
        code,
        name,
        seconds,
        table.get("timing", "with"),
        takes=None if takes is None else tuple(takes),
        calls=table.get("calls", ""),
        does=table.get("does", ""),
    )


def _g_function(code: str, table: GFunctionData) -> GFunction:
    name, takes = _text(table.get("name", code)), table.get("takes")
    words = None if takes is None else tuple(takes)
    return GFunction(code, name, float(table.get("seconds", 0)), words, table.get("calls", ""))


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
