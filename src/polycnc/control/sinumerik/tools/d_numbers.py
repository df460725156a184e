"""D numbers that are free of the tool: CHKDNO, GETDNO, SETDNO, GETACTTD, DZERO, and additive offsets DL.

Source: job planning 7.2 (DL), 7.7 (D numbers).
"""

from __future__ import annotations

from itertools import combinations

from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.tools.memory import FLAT
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.variables import Reference
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.memory import Tool, Tools

#: D number of an edge that DZERO has marked; status for what is no D number.
INVALID, NO_NUMBER = 32001, -5


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
    """CHKDNO([t1 [, t2 [, d]]]): whether D numbers are unique; variables that are given get those that are not.

    Without tools all are compared, with one that one with all others, and without d, or where it is 0, all numbers.
    Edges that DZERO has marked do not count.
    """
    tools: Tools = channel.memory.tools
    places = [*args, None, None, None][:3]
    first, second, number = (place.value if isinstance(place, Reference) else place for place in places)
    if any(tool is not None and tool not in tools.tools for tool in (first, second)):
        return False
    for one, other in combinations(sorted(tools.tools), 2):
        if any(wanted is not None and wanted not in (one, other) for wanted in (first, second)):
            continue
        both = _valid(tools.tools[one]) & _valid(tools.tools[other])
        found = min((d for d in both if number in (None, 0, d)), default=None)
        if found is not None:
            pair = (other, one) if other == first or one == second else (one, other)
            for place, value in zip(places, (*pair, found), strict=True):
                if isinstance(place, Reference):
                    place.value = value
            return False
    return True


def _valid(tool: Tool) -> set[int]:
    return {number for number, edge in tool.edges.items() if edge.is_valid}


def tool_of_number(channel: SinumerikChannel, args: Arguments) -> int:
    """GETACTTD(VAR t, d): the tool of a D number; 0 found, -1 no such tool, -2 several (the first is told).

    -5: no D number. Where D numbers do not depend on the tool it is always 1.
    """
    tools: Tools = channel.memory.tools
    if tools.is_flat:
        args[0].value = FLAT
        return FLAT
    if args[1] < 1:
        args[0].value = 0
        return NO_NUMBER
    found = [number for number, tool in sorted(tools.tools.items()) if args[1] in _valid(tool)]
    args[0].value = found[0] if found else 0
    return -1 if not found else -2 if len(found) > 1 else 0


def invalidate(channel: SinumerikChannel, _args: Arguments) -> None:
    """DZERO: all D numbers are invalid until SETDNO."""
    tools: Tools = channel.memory.tools
    for tool in tools.tools.values():
        for edge in tool.edges.values():
            edge.is_valid = False


def delete_additive(channel: SinumerikChannel, args: Arguments) -> int:
    """DELDL(t, d), DELDL(t), DELDL: take additive offsets away; 0, or -1 where those of the active edge stay."""
    tools: Tools = channel.memory.tools
    wanted_tool, wanted_edge = (*args, None, None)[:2]
    edges = [
        edge
        for tool in tools.tools.values()
        for number, edge in tool.edges.items()
        if wanted_tool in (None, tool.number) and wanted_edge in (None, number)
    ]
    for edge in edges:
        if edge is not tools.edge:
            edge.additive.clear()
    return -1 if not edges or any(edge is tools.edge for edge in edges) else 0


def without_status(function: Callable[[SinumerikChannel, Arguments], int]) -> Procedure:
    """A function of this module as a procedure."""

    def procedure(channel: SinumerikChannel, args: Arguments) -> None:
        function(channel, args)

    return procedure
