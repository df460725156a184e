"""A machine as a complete TOML file with a comment at every key: the starting point for one's own."""

from __future__ import annotations

from functools import cache
from math import isfinite

from polycnc.deferred.paths import package_path
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.text import Text
from polycnc.messages import Catalogue

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from polycnc.machine.model import (
        Axis,
        Channel,
        GFunction,
        Joint,
        Machine,
        Magazine,
        MFunction,
        Solid,
        Spindle,
    )
    from polycnc.machine.plc import PlcAlarm
    from polycnc.machine.rules import Rule

_SECONDS_PER_MINUTE = 60.0
#: Comments of a table stand in one column, no further right than this.
_COMMENT_COLUMN = 48
_Keys = list[tuple[str, object]]
#: Tables that few machines have, and how the header of an example looks.
#: Times of an axis that most machines do not have.
_TIMES = ("rapid_time_s", "rapid_bell_s", "cutting_time_s", "cutting_bell_s", "after_interpolation_s")
_EXAMPLES = {"g_function": '[g_function."100"]', "alarm": "[[alarm]]", "message": "[[message]]"}


@cache
def fields() -> Catalogue:
    """What each key of a machine file means; ids are `table.key`."""
    return Catalogue(package_path("machine", "fields.toml"))


def machine_toml(machine: Machine, lang: str | None = None) -> str:
    """A machine as the text of a machine file, with comments in the language of the user; reading it gives the same."""
    return "\n".join(_lines(machine, lang))


def _lines(machine: Machine, lang: str | None) -> Iterator[str]:
    explained: set[str] = set()
    yield from _comment("head", lang, machine=machine.id)
    yield ""
    for table, header, keys in _tables(machine):
        if header.startswith("#") and table in explained:
            continue
        if table in explained:
            yield header
            yield from (f"{key} = {_toml(value)}" for key, value in keys if value is not None)
        else:
            if header:
                yield from _comment(table, lang)
                yield header
            yield from _explained(table, keys, lang)
            explained.add(table)
        yield ""


def _comment(field: str, lang: str | None, **args: object) -> Iterator[str]:
    return (f"# {line}" for line in fields().text(field, lang, **args).splitlines())


def _explained(table: str, keys: _Keys, lang: str | None) -> Iterator[str]:
    """The keys of a table with a comment each; a key without a value stands as a commented example."""
    lines = []
    for key, value in keys:
        field = f"{table}.{key}" if table else key
        example = f"# {key} = {fields().entry(field).get('example')}"
        shown = example if value is None else f"{key} = {_toml(value)}"
        lines.append((shown, fields().text(field, lang)))
    width = min(max(len(shown) for shown, _ in lines), _COMMENT_COLUMN)
    return (f"{shown:{width}}  # {comment}" for shown, comment in lines)


def _tables(machine: Machine) -> Iterator[tuple[str, str, _Keys]]:
    """Every table: its kind, its header and its keys in file units; None leaves a key out."""
    top: _Keys = [("name", machine.name), ("description", _or_none(machine.description))]
    top.append(("rules", machine.builder.name or None))
    times = ("interpolation_cycle_s", "settle_fine_s", "settle_coarse_s", "block_time_s")
    yield (
        "",
        "",
        [
            *top,
            *((key, getattr(machine, key)) for key in times),
            ("tool_direction", machine.tool_direction),
            ("nose", machine.nose),
            ("control_variant", machine.control_variant or None),
            ("control_options", list(machine.control_options) or None),
        ],
    )
    for channel in machine.channels:
        yield "channel", f"[channel.{channel.number}]", _channel(channel)
    for axis in machine.axes:
        yield "axis", f"[axis.{axis.name}]", _axis(axis)
    for spindle in machine.spindles:
        yield "spindle", f"[spindle.{spindle.number}]", _spindle(spindle)
    yield "magazine", "[magazine]", _magazine(machine.magazine)
    for function in machine.m_functions.values():
        yield "m_function", f"[m_function.{function.code}]", _m_function(function)
    for code, g_function in machine.g_functions.items():
        yield "g_function", f'[g_function."{code[1:]}"]', _g_function(g_function)
    for joint in machine.joints:
        yield "joint", "[[joint]]", _joint(joint)
    for solid in machine.solids:
        yield "solid", "[[solid]]", _solid(solid)
    for rule in machine.rules:
        yield "rule", "[[rule]]", _rule(rule)
    for alarm in machine.alarms:
        kind = "alarm" if alarm.stops else "message"
        yield kind, f"[[{kind}]]", _alarm(alarm)
    for kind, header in _EXAMPLES.items():
        yield kind, f"# {header}", _none_of(kind)


def _none_of(kind: str) -> _Keys:
    """The keys of a table that a machine has none of: a commented example, where it is not explained already."""
    shown = (key.partition(".")[2] for key in fields() if key.startswith(f"{kind}."))
    return [(key, None) for key in shown]


def _channel(channel: Channel) -> _Keys:
    return [
        ("axes", channel.axes),
        ("names", channel.names if channel.names != channel.axes else None),
        ("geometry", channel.geometry),
        ("virtual", channel.virtual or None),
        ("spindles", channel.spindles),
    ]


def _axis(axis: Axis) -> _Keys:
    return [
        ("kind", "rotary" if axis.rotary else "linear"),
        ("modulo", axis.modulo if axis.rotary else None),
        ("diameter", axis.diameter or None),
        ("parallel_to", axis.parallel_to or None),
        ("aliases", axis.aliases or None),
        ("machine_name", axis.machine_name),
        ("limit_minus", axis.limit_minus if isfinite(axis.limit_minus) else None),
        ("limit_plus", axis.limit_plus if isfinite(axis.limit_plus) else None),
        ("rapid", axis.rapid * _SECONDS_PER_MINUTE),
        ("max_feed", axis.max_feed * _SECONDS_PER_MINUTE),
        ("acceleration", axis.acceleration),
        ("jerk", axis.jerk),
        *((key, getattr(axis, key) or None) for key in _TIMES),
        ("reference_points", axis.reference_points),
        ("in_position_fine", axis.in_position_fine),
        ("in_position_coarse", axis.in_position_coarse),
    ]


def _spindle(spindle: Spindle) -> _Keys:
    gears = [{"min_rpm": gear.min_rpm, "max_rpm": gear.max_rpm} for gear in spindle.gears]
    return [
        ("name", spindle.name),
        ("min_rpm", spindle.min_rpm),
        ("max_rpm", spindle.max_rpm),
        ("acceleration", spindle.acceleration_rpm_s),
        ("orient_s", spindle.orient_s),
        ("carries", spindle.carries),
        ("axis", spindle.axis or None),
        ("gears", gears or None),
        ("speed_wait", spindle.speed_wait),
    ]


def _magazine(magazine: Magazine) -> _Keys:
    return [
        ("kind", magazine.kind),
        ("places", magazine.places),
        ("change_time_s", magazine.change_time_s),
        ("place_time_s", magazine.place_time_s),
        ("pockets", magazine.pockets),
        ("turns", magazine.turns),
        ("change_at", magazine.change_at or "anywhere"),
        ("retracts", magazine.retracts),
    ]


def _m_function(function: MFunction) -> _Keys:
    when: _Keys = [("name", function.name), ("seconds", function.seconds), ("timing", function.timing)]
    return [*when, *_words(function), ("does", function.does or None)]


def _g_function(function: GFunction) -> _Keys:
    return [("name", function.name), ("seconds", function.seconds), *_words(function)]


def _words(function: MFunction | GFunction) -> _Keys:
    return [("takes", function.takes), ("calls", function.calls or None)]


def _joint(joint: Joint) -> _Keys:
    place: _Keys = [("direction", joint.direction), ("offset", joint.offset)]
    return [("axis", joint.axis), ("carries", joint.carries), *place]


def _solid(solid: Solid) -> _Keys:
    return [
        ("name", solid.name),
        ("role", solid.role),
        ("shape", solid.shape),
        ("position", solid.position),
        ("size", solid.size[:2] if solid.shape == "cylinder" else solid.size),
        ("direction", solid.direction if solid.shape == "cylinder" else None),
        ("moves_with", solid.moves_with),
    ]


def _rule(rule: Rule) -> _Keys:
    after = rule.after_s or None
    return [("when", rule.when), ("output", rule.output), ("after_s", after), ("latch", rule.latch or None)]


def _alarm(alarm: PlcAlarm) -> _Keys:
    texts: _Keys = [(key, _or_none(getattr(alarm, key))) for key in ("text", "cause", "remedy")]
    return [("code", alarm.code), ("when", alarm.when), *texts]


def _or_none(text: Text) -> Text | None:
    return text if text.en else None


def _toml(value: object) -> str:
    """A value as TOML writes it."""
    if isinstance(value, Text):
        return _toml({"en": value.en, "zh-TW": value.zh_tw}) if value.zh_tw else _toml(value.en)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value).removesuffix(".0") if abs(value) < 1e15 else repr(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, dict):
        return _table(value)
    if isinstance(value, tuple | list):
        return _list(value)
    return str(value)


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04X}" for c in escaped) + '"'


def _table(values: Mapping[str, object]) -> str:
    return "{ " + ", ".join(f"{key} = {_toml(value)}" for key, value in values.items()) + " }"


def _list(values: Iterable[object]) -> str:
    return "[" + ", ".join(map(_toml, values)) + "]"
