"""Tool data and the active tool as variables: `$TC_DP1[t,d]` …, `$TC_TP2[t]`, `$P_TOOLNO`, `$P_TOOL`.

Writing `$TC_DP…` of a tool or an edge that is not there makes it. Source: job planning 7.1, 7.7.
"""

from __future__ import annotations

from collections.abc import Callable

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import tooth_feed, wheels
from polycnc.control.sinumerik.tools.edges import (
    DIRECTION,
    DIRECTION_PARTS,
    DP_CLEARANCE,
    DP_DIRECTION,
    DP_HOLDER_ANGLE,
    DP_TIP,
    DP_TYPE,
    NORMAL_PARTS,
    PARAMETERS,
    WEAR_PARAMETERS,
)
from polycnc.control.sinumerik.tools.holders import stored as carrier_data
from polycnc.control.sinumerik.tools.holders.active import ActiveCarrier
from polycnc.control.sinumerik.tools.lengths import counts_as_turning
from polycnc.control.sinumerik.tools.memory import FLAT
from polycnc.control.sinumerik.variables.row import Indices, Row
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.control.sinumerik.tools.memory import Tool, Tools


def _numbers(indices: Indices, name: str, count: int) -> list[int]:
    """The numbers in brackets; alarm 12400 for other indices."""
    if len(indices) != count or not all(isinstance(index, (int, float)) for index in indices):
        raise AlarmError("12400", text=name)
    return [int(index) for index in indices]


def _place(channel: SinumerikChannel, indices: Indices, name: str) -> list[int]:
    """Tool and edge in brackets; where D numbers do not depend on the tool, the edge is enough."""
    if channel.memory.tools.is_flat:
        return [FLAT, _numbers(indices[-1:], name, 1)[0]]
    return _numbers(indices, name, 2)


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
    """`$TC_DPn[t,d]`; what is written acts when the edge is selected again. FTOCON keeps the wear to itself (17210)."""
    name = f"$TC_DP{number}"

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = _place(channel, indices, name)
        return _edge(channel, tool, edge).values[number]

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        tool, edge = _place(channel, indices, name)
        if tool < 1:
            raise AlarmError("17190", tool=tool)
        if edge < 1:
            raise AlarmError("17180", edge=edge)
        written = channel.memory.tools.new_edge(tool, edge)
        fine = number in WEAR_PARAMETERS and channel.mode["fine_tool_offset"] == "FTOCON"
        if fine and written is channel.memory.tools.edge:
            raise AlarmError("17210", text=name)
        written.values[number] = float(value)
        wheels.chain_sides(channel.memory.tools.tools[tool], edge, number)
        wheels.check(channel)

    return (Type.INT if number == DP_TYPE else Type.REAL), read, write


def _teeth(channel: SinumerikChannel, indices: Indices) -> float:
    tool, edge = _place(channel, indices, "$TC_DPNT")
    return _edge(channel, tool, edge).teeth


def _set_teeth(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    tool, edge = _place(channel, indices, "$TC_DPNT")
    channel.memory.tools.new_edge(tool, edge).teeth = float(value)
    tooth_feed.follow(channel)


def _additive(kind: str, number: int) -> Row:
    """`$TC_SCPn[t,d]`, `$TC_ECPn[t,d]`: additive offset; acts when DL or D is programmed again."""
    name = f"$TC_{kind}{number}"

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = _place(channel, indices, name)
        return _edge(channel, tool, edge).additive.get((kind, number), 0.0)

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        tool, edge = _place(channel, indices, name)
        _edge(channel, tool, edge).additive[kind, number] = float(value)

    return Type.REAL, read, write


def _direction(part: str) -> Row:
    """`$TC_DPV[t,d]`, `$TC_DPV3[t,d]` …: direction of the tool, normal of the edge; 0, as delivered, is none (W1)."""
    name = f"$TC_DP{part}"

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = _place(channel, indices, name)
        return _edge(channel, tool, edge).directions.get(part, 0.0)

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        tool, edge = _place(channel, indices, name)
        _edge(channel, tool, edge).directions[part] = float(value)

    return (Type.INT if part == DIRECTION else Type.REAL), read, write


def _not_executed(name: str) -> Row:
    """A datum of an edge that archives write and that has no effect as delivered; PC0001 for another value than 0."""

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = _place(channel, indices, name)
        _edge(channel, tool, edge)
        return 0.0

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        read(channel, indices)
        if value:
            raise not_supported(name)

    return Type.REAL, read, write


def _cutting_edge(channel: SinumerikChannel, indices: Indices) -> int:
    tool, edge = _place(channel, indices, "$TC_DPCE")
    return _edge(channel, tool, edge).cutting_edge or edge


def _set_cutting_edge(channel: SinumerikChannel, indices: Indices, value: int) -> None:
    tool, edge = _place(channel, indices, "$TC_DPCE")
    _edge(channel, tool, edge).cutting_edge = int(value)


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
        wheels.check(channel)

    return (Type.INT if name in wheels.WHOLE else Type.REAL), read, write


def _active_length(channel: SinumerikChannel, indices: Indices) -> float:
    (number,) = _numbers(indices, "$P_TOOLL", 1)
    edge = channel.memory.tools.edge
    if not 1 <= number <= 3:
        raise AlarmError("17020", text="$P_TOOLL", index=number)
    return edge.length(number - 1, channel.memory.tools.additive) if edge else 0.0


def _active_parameter(channel: SinumerikChannel, indices: Indices) -> float:
    """`$P_AD[n]`: a parameter of the active edge; edge position, direction and angles as CUTMOD turns them."""
    (number,) = _numbers(indices, "$P_AD", 1)
    tools: Tools = channel.memory.tools
    if not 1 <= number <= PARAMETERS:
        raise AlarmError("17020", text="$P_AD", index=number)
    edge, data = tools.edge, tools.cutting_data(channel.mode["plane"])
    if edge is None or data is None:
        return 0.0
    return float(getattr(data, _TURNED[number]) if number in _TURNED else edge.values[number])


def _cut_angle(channel: SinumerikChannel, _indices: Indices) -> float:
    data = channel.memory.tools.cutting_data(channel.mode["plane"])
    return 0.0 if data is None else data.angle_deg


def _cut_is_inverted(channel: SinumerikChannel, _indices: Indices) -> bool:
    """`$P_CUT_INV`: a turning tool is seen from behind, so the spindle must turn the other way."""
    tools: Tools = channel.memory.tools
    data, edge = tools.cutting_data(channel.mode["plane"]), tools.edge
    if data is None or edge is None or not data.is_inverted:
        return False
    return edge.is_turning or (tools.rules is not None and counts_as_turning(edge, tools.rules))


def _of_carrier(attribute: str) -> Callable[[SinumerikChannel, Indices], Any]:
    return lambda channel, _indices: getattr(ActiveCarrier.of(channel), attribute)


def _of_carrier_axis(name: str, attribute: str) -> Callable[[SinumerikChannel, Indices], float]:
    """`$P_TCANG[n]`, `$P_TCDIFF[n]`: a value of axis 1 or 2 of the active toolholder."""

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        (number,) = _numbers(indices, name, 1)
        if number not in (1, 2):
            raise AlarmError("17020", text=name, index=number)
        value: float = getattr(ActiveCarrier.of(channel), attribute)[number - 1]
        return value

    return read


def _of_tools(attribute: str) -> Callable[[SinumerikChannel, Indices], Any]:
    return lambda channel, _indices: getattr(channel.memory.tools, attribute)


#: Parameters of an edge that turn with a toolholder.
_TURNED = {
    DP_TIP: "position",
    DP_HOLDER_ANGLE: "holder_deg",
    DP_DIRECTION: "direction",
    DP_CLEARANCE: "clearance_deg",
}
#: Numbers of additive offsets: 10 * DL + parameter, DL 1 to 6, parameters 3 to 11.
_ADDITIVE = [10 * dl + parameter for dl in range(1, 7) for parameter in range(3, 12)]
TOOL_VARIABLES: dict[str, Row] = {
    **{f"$TC_{kind}{n}": _additive(kind, n) for kind in ("SCP", "ECP") for n in _ADDITIVE},
    **{f"$TC_CARR{n}": carrier_data.row(n) for n in carrier_data.NUMBERS},
    **{f"$TC_{kind}{n}": _oem(kind, n) for kind in ("DPC", "TPC") for n in range(1, 11)},
    **{f"$TC_DP{part}": _direction(part) for part in (DIRECTION, *DIRECTION_PARTS, *NORMAL_PARTS)},
    **{name: _not_executed(name) for name in ("$TC_DPH", "$TC_DPROT")},
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
    "$P_CUTMOD": (Type.INT, _of_carrier("cut_mode"), None),
    "$P_CUTMOD_ANG": (Type.REAL, _cut_angle, None),
    "$P_CUT_INV": (Type.BOOL, _cut_is_inverted, None),
    "$P_TC": (Type.INT, _of_carrier("number"), None),
    "$P_TCANG": (Type.REAL, _of_carrier_axis("$P_TCANG", "positions_deg"), None),
    "$P_TCDIFF": (Type.REAL, _of_carrier_axis("$P_TCDIFF", "rests_deg"), None),
}
#: What the main run shows of the active tool, and what the program reads ahead of it.
IN_MAIN_RUN = {f"$AC_{name}": f"$P_{name}" for name in ("CUTMOD", "CUTMOD_ANG", "CUT_INV")}
