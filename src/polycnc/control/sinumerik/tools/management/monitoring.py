"""Monitoring of tools by pieces, and their states: $TC_MOP, SETPIECE, RESETMON.

SETPIECE counts down the pieces that the edges of the used tools have left. At the prewarning limit a tool is marked, at
nothing left it is disabled, so that the next T of its name means a sister tool. Times and wear are kept only.
Source: job planning 16.1; Function Manual Tool Management ($TC_TP9 bit 1, $TC_MOP3, 4, 13, $TC_TP8 bits 2 and 4).
"""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.tools.management.lists import DISABLED, WARNED, set_state, state_of
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.memory import Tool
    from polycnc.control.sinumerik.variables.row import Indices, Row

#: `$TC_TP9`: bit 1 monitors the count of pieces.
MODE, BY_COUNT = "$TC_TP9", 2
#: Numbers of `$TC_MOP`: prewarning limit, what is left, what a new tool has; of time, pieces and wear.
LIMIT, LEFT, WHOLE = 3, 4, 13
PARAMETERS = range(1, 16)
#: What RESETMON sets to what: time, pieces, wear.
_RENEWED = {2: 11, LEFT: WHOLE, 6: 15}


def _key(parameter: int, edge: int) -> str:
    return f"$TC_MOP{parameter},{edge}"


def _value(tool: Tool, parameter: int, edge: int) -> float:
    return tool.values.get(_key(parameter, edge), 0.0)


def count(channel: SinumerikChannel, args: Arguments) -> None:
    """SETPIECE(pieces[,holder]): so many pieces are made with the tools used since the last count."""
    if not 1 <= len(args) <= 2 or args[0] is None:
        raise AlarmError("14020", text="SETPIECE")
    pieces, tools = arguments.whole(args[0]), channel.memory.tools
    for number in tools.used | {tools.active}:
        tool = tools.tools.get(number)
        if tool is None or not int(tool.values.get(MODE, 0.0)) & BY_COUNT:
            continue
        for edge in tool.edges:
            tool.values[_key(LEFT, edge)] = max(_value(tool, LEFT, edge) - pieces, 0.0)
        _judge(tool)
    tools.used.clear()


def _judge(tool: Tool) -> None:
    """Mark a tool whose edges have few pieces left, and disable one that has none."""
    state = state_of(tool)
    if any(_value(tool, LEFT, edge) <= _value(tool, LIMIT, edge) for edge in tool.edges):
        state |= WARNED
    if any(_value(tool, LEFT, edge) <= 0.0 for edge in tool.edges):
        state |= DISABLED
    set_state(tool, state)


def renew(channel: SinumerikChannel, args: Arguments) -> None:
    """RESETMON(VAR state, t[, d]): a tool has its whole life again; state 0, -3 no such tool, -4 no such edge."""
    if not 2 <= len(args) <= 4 or None in args[:2]:
        raise AlarmError("14020", text="RESETMON")
    tool = channel.memory.tools.tools.get(arguments.whole(args[1]))
    edge = arguments.whole(args[2]) if len(args) > 2 and args[2] is not None else 0
    if tool is None or (edge and edge not in tool.edges):
        arguments.give_back(args[0], -3 if tool is None else -4)
        return
    for each in [edge] if edge else tool.edges:
        for actual, whole in _RENEWED.items():
            tool.values[_key(actual, each)] = _value(tool, whole, each)
    set_state(tool, state_of(tool) & ~(WARNED | DISABLED))
    arguments.give_back(args[0], 0)


def _parameter(number: int) -> Row:
    """`$TC_MOPn[t,d]`."""
    name = f"$TC_MOP{number}"

    def place(channel: SinumerikChannel, indices: Indices) -> tuple[Tool, int]:
        if len(indices) != 2:
            raise AlarmError("12400", text=name)
        tool = channel.memory.tools.tools.get(indices[0])
        if tool is None:
            raise AlarmError("17190", tool=indices[0])
        if indices[1] not in tool.edges:
            raise AlarmError("17181", tool=tool.number, edge=indices[1])
        return tool, indices[1]

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        tool, edge = place(channel, indices)
        return _value(tool, number, edge)

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        tool, edge = place(channel, indices)
        tool.values[_key(number, edge)] = float(value)

    return Type.REAL, read, write


MONITORING_VARIABLES: dict[str, Row] = {f"$TC_MOP{n}": _parameter(n) for n in PARAMETERS}
PROCEDURES: dict[str, Procedure] = {"SETPIECE": count, "RESETMON": renew}
