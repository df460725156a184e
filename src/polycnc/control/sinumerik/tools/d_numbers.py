"""D numbers that are free of the tool: CHKDNO, GETDNO, SETDNO, GETACTTD, DZERO, and additive offsets DL.

Source: job planning 7.2 (DL), 7.7 (D numbers).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.memory import Tool, Tools

INVALID = 32001


def _tool(channel: SinumerikChannel, number: int) -> Tool | None:
    tools: Tools = channel.memory.tools
    return tools.tools.get(number)


def get_number(channel: SinumerikChannel, args: Arguments) -> int:
    """GETDNO(t, ce): D number of an edge; 0 if there is none, above 32000 after DZERO."""
    tool = _tool(channel, args[0])
    for number, edge in tool.edges.items() if tool else ():
        if (edge.cutting_edge or number) == args[1]:
            return number if edge.is_valid else INVALID
    return 0


def set_number(channel: SinumerikChannel, args: Arguments) -> int:
    """SETDNO(t, ce, d): give an edge another D number; 0 if there is no such edge or the tool has the number."""
    tool, edge, number = args
    if number <= 0:
        raise AlarmError("14020", text="SETDNO")
    found = _tool(channel, tool)
    old = next((d for d, e in found.edges.items() if (e.cutting_edge or d) == edge), 0) if found else 0
    if not found or not old or (number != old and number in found.edges):
        return 0
    moved = found.edges.pop(old)
    moved.cutting_edge, moved.is_valid = moved.cutting_edge or old, True
    found.edges[number] = moved
    return 1


def check_numbers(channel: SinumerikChannel, args: Arguments) -> bool:
    """CHKDNO([t1 [, t2 [, d]]]): whether D numbers are unique, of all tools or of two."""
    tools: Tools = channel.memory.tools
    given = [arg for arg in args if arg is not None]
    chosen = [tools.tools[t] for t in given[:2] if t in tools.tools] if given else list(tools.tools.values())
    if given and len(chosen) < len(given[:2]):
        return False
    if len(given) == 1:
        others = [tool for tool in tools.tools.values() if tool.number != given[0]]
        return all(number not in other.edges for number in chosen[0].edges for other in others)
    wanted = given[2] if len(given) > 2 else None
    numbers = [d for tool in chosen for d in tool.edges if wanted in (None, d)]
    return len(numbers) == len(set(numbers))


def tool_of_number(channel: SinumerikChannel, args: Arguments) -> int:
    """GETACTTD(VAR t, d): the tool of a D number; 0 found, -1 no such tool, -2 several (the first is told)."""
    tools: Tools = channel.memory.tools
    found = [number for number, tool in sorted(tools.tools.items()) if args[1] in tool.edges]
    args[0].value = found[0] if found else 0
    return -1 if not found else -2 if len(found) > 1 else 0


def invalidate(channel: SinumerikChannel, _args: Arguments) -> None:
    """DZERO: all D numbers are invalid until SETDNO."""
    tools: Tools = channel.memory.tools
    for tool in tools.tools.values():
        for edge in tool.edges.values():
            edge.is_valid = False


def delete_additive(channel: SinumerikChannel, args: Arguments) -> None:
    """DELDL(t, d), DELDL(t), DELDL: take additive offsets away; those of the active tool stay."""
    tools: Tools = channel.memory.tools
    wanted_tool, wanted_edge = (*args, None, None)[:2]
    for tool in tools.tools.values():
        for number, edge in tool.edges.items():
            chosen = wanted_tool in (None, tool.number) and wanted_edge in (None, number)
            if chosen and edge is not tools.edge:
                edge.additive.clear()
