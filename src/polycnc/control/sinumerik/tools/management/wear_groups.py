"""Wear groups: places of a magazine whose tools are used together, SETTA and SETTIA.

`$TC_MPP5` tells the group of a place, `$TC_MAP9` the group of a magazine that is in use. Only tools whose state is
active are chosen by T where their magazine has groups. Source: job planning 16.1; Function Manual Tool Management.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.tools.management.lists import ACTIVE, DISABLED, set_state, state_of
from polycnc.control.sinumerik.tools.management.magazines import TOOL, values_of
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.memory import Tool

#: Group of a place, group of a magazine that is in use.
GROUP, IN_USE = "$TC_MPP5", "$TC_MAP9"
#: Results: done, no such magazine, no such group.
DONE, NO_MAGAZINE, NO_GROUP = 0, -1, -2


def _tools(channel: SinumerikChannel, name: str, args: Arguments) -> tuple[int, int, list[Tool]] | int:
    """Magazine, group and tools of the group by their places; a result where there is none."""
    if not 3 <= len(args) <= 4 or None in args[:3]:
        raise AlarmError("14020", text=name)
    magazine, group = map(arguments.whole, args[1:3])
    groups = {place: int(of) for place, of in values_of(channel, GROUP).items() if place[0] == magazine}
    if not groups:
        return NO_MAGAZINE
    held, tools = values_of(channel, TOOL), channel.memory.tools.tools
    if group not in groups.values():
        return NO_GROUP
    numbers = [int(held.get(place, 0)) for place, of in sorted(groups.items()) if of == group]
    return magazine, group, [tools[number] for number in numbers if number in tools]


def put_in_use(channel: SinumerikChannel, args: Arguments) -> None:
    """SETTA(VAR state, magazine, group[, subgroup]): a wear group is used: of each name one tool becomes active.

    The first that is not disabled, by places. State 0, -1 no such magazine or none with groups, -2 no such group.
    """
    found = _tools(channel, "SETTA", args)
    if isinstance(found, int):
        arguments.give_back(args[0], found)
        return
    magazine, group, tools = found
    active = {tool.name for tool in tools if state_of(tool) & ACTIVE}
    for tool in tools:
        if tool.name not in active and not state_of(tool) & DISABLED:
            set_state(tool, state_of(tool) | ACTIVE)
            active.add(tool.name)
    Stored.of(channel).values[IN_USE, (magazine,)] = group
    arguments.give_back(args[0], DONE)


def put_out_of_use(channel: SinumerikChannel, args: Arguments) -> None:
    """SETTIA(VAR state, magazine, group): no tool of a wear group is active any more; state as SETTA has it."""
    found = _tools(channel, "SETTIA", args)
    if isinstance(found, int):
        arguments.give_back(args[0], found)
        return
    magazine, group, tools = found
    for tool in tools:
        set_state(tool, state_of(tool) & ~ACTIVE)
    values = Stored.of(channel).values
    if values.get((IN_USE, (magazine,))) == group:
        values[IN_USE, (magazine,)] = 0
    arguments.give_back(args[0], DONE)


PROCEDURES: dict[str, Procedure] = {"SETTA": put_in_use, "SETTIA": put_out_of_use}
