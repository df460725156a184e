"""Tool data and the active tool as variables: `$TC_DP1[t,d]` …, `$TC_TP2[t]`, `$P_TOOLNO`, `$P_TOOL`.

Writing `$TC_DP…` of a tool or an edge that is not there makes it. Source: job planning 7.1, 7.7.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from polycnc.control.sinumerik.feed import tooth_feed
from polycnc.control.sinumerik.tools.memory import DP_TYPE, PARAMETERS
from polycnc.control.sinumerik.variables.row import Indices, Row
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.memory import Edge, Tool, Tools


def _numbers(indices: Indices, name: str, count: int) -> list[int]:
    """The numbers in brackets; alarm 12400 for other indices."""
    if len(indices) != count or any(isinstance(index, (Axis, str)) for index in indices):
        raise AlarmError("12400", text=name)
    return [int(index) for index in indices]


def _edge(channel: SinumerikChannel, tool: int, number: int) -> Edge:
    """An edge that is there; alarm 17190 or 17181 else."""
    tools: Tools = channel.memory.tools
    if tool not in tools.tools:
        raise AlarmError("17190", tool=tool)
    edge = tools.tools[tool].edges.get(number)
    if edge is None:
        raise AlarmError("17181", tool=tool, edge=number)
    return edge


def _parameter(number: int) -> Row:
    """`$TC_DPn[t,d]`; what is written acts when the edge is selected again."""
    name = f"$TC_DP{number}"

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = _numbers(indices, name, 2)
        return _edge(channel, tool, edge).values[number]

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        tool, edge = _numbers(indices, name, 2)
        if tool < 1:
            raise AlarmError("17190", tool=tool)
        if edge < 1:
            raise AlarmError("17180", edge=edge)
        channel.memory.tools.new_edge(tool, edge).values[number] = float(value)

    return (Type.INT if number == DP_TYPE else Type.REAL), read, write


def _teeth(channel: SinumerikChannel, indices: Indices) -> float:
    tool, edge = _numbers(indices, "$TC_DPNT", 2)
    return _edge(channel, tool, edge).teeth


def _set_teeth(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    tool, edge = _numbers(indices, "$TC_DPNT", 2)
    channel.memory.tools.new_edge(tool, edge).teeth = float(value)
    tooth_feed.follow(channel)


def _additive(kind: str, number: int) -> Row:
    """`$TC_SCPn[t,d]`, `$TC_ECPn[t,d]`: additive offset; acts when DL or D is programmed again."""
    name = f"$TC_{kind}{number}"

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = _numbers(indices, name, 2)
        return _edge(channel, tool, edge).additive.get((kind, number), 0.0)

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        tool, edge = _numbers(indices, name, 2)
        _edge(channel, tool, edge).additive[kind, number] = float(value)

    return Type.REAL, read, write


def _cutting_edge(channel: SinumerikChannel, indices: Indices) -> int:
    tool, edge = _numbers(indices, "$TC_DPCE", 2)
    return _edge(channel, tool, edge).cutting_edge or edge


def _set_cutting_edge(channel: SinumerikChannel, indices: Indices, value: int) -> None:
    tool, edge = _numbers(indices, "$TC_DPCE", 2)
    _edge(channel, tool, edge).cutting_edge = int(value)


def _carrier(number: int) -> Row:
    """`$TC_CARRn[m]`: data of a tool carrier, kept."""
    texts = dict.fromkeys((23, 34, 35, 36), Type.STRING)
    type_ = {21: Type.AXIS, 22: Type.AXIS, **texts}.get(number, Type.REAL)
    name = f"$TC_CARR{number}"
    empty: Any = {Type.AXIS: Axis("X"), Type.STRING: ""}.get(type_, 0.0)

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        return Stored.of(channel).values.get((name, tuple(_numbers(indices, name, 1))), empty)

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        Stored.of(channel).values[name, tuple(_numbers(indices, name, 1))] = value

    return type_, read, write


def _oem(kind: str, number: int) -> Row:
    """`$TC_DPCn[t,d]`, `$TC_TPCn[t]`: data of the machine's builder, kept without any effect."""
    name, count = f"$TC_{kind}{number}", 2 if kind == "DPC" else 1

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        value: float = Stored.of(channel).values.get((name, tuple(_numbers(indices, name, count))), 0.0)
        return value

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        Stored.of(channel).values[name, tuple(_numbers(indices, name, count))] = float(value)

    return Type.REAL, read, write


def _tool(channel: SinumerikChannel, indices: Indices, name: str) -> Tool:
    (number,) = _numbers(indices, name, 1)
    tools: Tools = channel.memory.tools
    if number not in tools.tools:
        raise AlarmError("17190", tool=number)
    return tools.tools[number]


def _name(channel: SinumerikChannel, indices: Indices) -> str:
    return _tool(channel, indices, "$TC_TP2").name


def _set_name(channel: SinumerikChannel, indices: Indices, value: str) -> None:
    (number,) = _numbers(indices, "$TC_TP2", 1)
    channel.memory.tools.new_tool(number).name = value


def _tool_value(name: str) -> Row:
    """A datum of the tool that is kept and has no effect of its own."""

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        return _tool(channel, indices, name).values.get(name, 0.0)

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        (number,) = _numbers(indices, name, 1)
        channel.memory.tools.new_tool(number).values[name] = float(value)

    return Type.REAL, read, write


def _active_length(channel: SinumerikChannel, indices: Indices) -> float:
    (number,) = _numbers(indices, "$P_TOOLL", 1)
    edge = channel.memory.tools.edge
    if not 1 <= number <= 3:
        raise AlarmError("17020", text="$P_TOOLL", index=number)
    return float(edge.lengths[number - 1]) if edge else 0.0


def _active_parameter(channel: SinumerikChannel, indices: Indices) -> float:
    (number,) = _numbers(indices, "$P_AD", 1)
    edge = channel.memory.tools.edge
    if not 1 <= number <= PARAMETERS:
        raise AlarmError("17020", text="$P_AD", index=number)
    return float(edge.values[number]) if edge else 0.0


def _of_tools(attribute: str) -> Callable[[SinumerikChannel, Indices], Any]:
    return lambda channel, _indices: getattr(channel.memory.tools, attribute)


#: Numbers of additive offsets: 10 * DL + parameter, DL 1 to 6, parameters 3 to 11.
_ADDITIVE = [10 * dl + parameter for dl in range(1, 7) for parameter in range(3, 12)]
TOOL_VARIABLES: dict[str, Row] = {
    **{f"$TC_{kind}{n}": _additive(kind, n) for kind in ("SCP", "ECP") for n in _ADDITIVE},
    **{f"$TC_CARR{n}": _carrier(n) for n in range(1, 66)},
    **{f"$TC_{kind}{n}": _oem(kind, n) for kind in ("DPC", "TPC") for n in range(1, 11)},
    "$TC_DPCE": (Type.INT, _cutting_edge, _set_cutting_edge),
    **{f"$TC_DP{n}": _parameter(n) for n in range(1, PARAMETERS + 1)},
    **{f"$TC_TP{n}": _tool_value(f"$TC_TP{n}") for n in (1, 3, 4, 5, 6, 7, 8, 9, 10, 11)},
    "$TC_DPNT": (Type.REAL, _teeth, _set_teeth),
    **{f"$TC_TPG{n}": _tool_value(f"$TC_TPG{n}") for n in range(1, 10)},
    "$TC_TP2": (Type.STRING, _name, _set_name),
    "$P_TOOLNO": (Type.INT, _of_tools("active"), None),
    "$P_TOOLP": (Type.INT, _of_tools("selected"), None),
    "$P_TOOL": (Type.INT, _of_tools("edge_number"), None),
    "$P_TOOLR": (Type.REAL, _of_tools("radius"), None),
    "$P_TOOLL": (Type.REAL, _active_length, None),
    "$P_AD": (Type.REAL, _active_parameter, None),
}
