"""Lists of tools, which is selected: NEWT, DELT, GETT, GETSELT, GETEXET, GETACTT, TCA, SETMTH, sister tools.

Source: job planning 16.1 (what the functions do); Function Manual Tool Management (arguments, bits of $TC_TP8).
"""

from __future__ import annotations

from polycnc.control.sinumerik.auxiliary import edge_selected, first_location, load_tool
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.tools import master_holder
from polycnc.control.sinumerik.tools.management import magazines
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from polycnc.toolpath.events import ToolSelection

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.memory import Tool
    from polycnc.control.sinumerik.variables.row import Indices, Row

#: `$TC_TP1` is the duplo number, `$TC_TP8` the state with these bits.
DUPLO, STATE = "$TC_TP1", "$TC_TP8"
ACTIVE, ENABLED, DISABLED, WARNED = 1, 2, 4, 16
#: Bit 0 of MD20310: tool management is active in the channel.
_MASK = "$MC_TOOL_MANAGEMENT_MASK"


def is_managed(channel: SinumerikChannel) -> bool:
    """Whether the channel manages its tools: states of tools count then."""
    return bool(channel.memory.data.integer(_MASK) & 1)


def state_of(tool: Tool) -> int:
    """`$TC_TP8`."""
    return int(tool.values.get(STATE, 0.0))


def set_state(tool: Tool, state: int) -> None:
    """`$TC_TP8`."""
    tool.values[STATE] = float(state)


def sisters(channel: SinumerikChannel, name: str) -> list[Tool]:
    """All tools of a name, by their duplo numbers."""
    tools = channel.memory.tools.tools.values()
    return sorted((tool for tool in tools if tool.name.upper() == name.upper()), key=_duplo)


def _duplo(tool: Tool) -> int:
    return int(tool.values.get(DUPLO, 1.0))


def chosen(channel: SinumerikChannel, wanted: float | str) -> Tool:
    """The tool that T means: of several of a name the active one, else the first that is enabled and not disabled.

    Raises:
        AlarmError: 17190 for no such tool; 22069 where tool management has none of them left.
    """
    same = sisters(channel, wanted) if isinstance(wanted, str) else []
    if not same or not is_managed(channel):
        return channel.memory.tools.find(wanted)
    usable = [tool for tool in same if state_of(tool) & ENABLED and not state_of(tool) & DISABLED]
    if not usable:
        raise AlarmError("22069", tool=wanted)
    return next((tool for tool in usable if state_of(tool) & ACTIVE), usable[0])


def create(channel: SinumerikChannel, args: Arguments) -> int:
    """NEWT(name[,duplo]): a new tool with an edge, enabled; gives its T number. 17230 for a duplo number twice."""
    name, taken = str(args[0]), [_duplo(tool) for tool in sisters(channel, str(args[0]))]
    given = args[1] if len(args) > 1 else None
    duplo = 1 + max(taken, default=0) if given is None else int(given)
    if duplo in taken or duplo < 1:
        raise AlarmError("17230", tool=name, duplo=duplo)
    tools = channel.memory.tools
    number = next(free for free in range(1, len(tools.tools) + 2) if free not in tools.tools)
    tool = tools.new_tool(number)
    tool.name, tool.values[DUPLO] = name, float(duplo)
    set_state(tool, ENABLED)
    tools.new_edge(number, 1)
    return number


def number_of(channel: SinumerikChannel, args: Arguments) -> int:
    """GETT(name[,duplo]): T number of a tool, without duplo number of the first of its name; -1 for none."""
    given = args[1] if len(args) > 1 else None
    for tool in sisters(channel, str(args[0])):
        if given is None or _duplo(tool) == given:
            return tool.number
    return -1


def remove(channel: SinumerikChannel, args: Arguments) -> None:
    """DELT(name[,duplo]): take a tool and its edges out of the memory, without a duplo number the first of its name.

    Raises:
        AlarmError: 17190 for no such tool, 17200 for one that is in a holder or a magazine.
    """
    if not 1 <= len(args) <= 2:
        raise AlarmError("14020", text="DELT")
    number = number_of(channel, args)
    if number < 0:
        raise AlarmError("17190", tool=args[0])
    inside = {tool for tool, _ in master_holder.Holders.of(channel).tools.values()}
    if number == channel.memory.tools.active or number in inside or number in magazines.tools_held(channel):
        raise AlarmError("17200", tool=args[0])
    del channel.memory.tools.tools[number]


def _holder(args: Arguments) -> int | None:
    return arguments.whole(args[1]) if len(args) > 1 and args[1] is not None else None


def selected(channel: SinumerikChannel, args: Arguments) -> None:
    """GETSELT(VAR t[,holder]): the tool that is selected for the next change, else the one in the spindle."""
    arguments.give_back(args[0], master_holder.tools_in(channel, _holder(args))[1])


def loaded(channel: SinumerikChannel, args: Arguments) -> None:
    """GETEXET(VAR t[,holder]): the tool in the spindle as the program sees it, 0 for none."""
    arguments.give_back(args[0], master_holder.tools_in(channel, _holder(args))[0])


def active(channel: SinumerikChannel, args: Arguments) -> None:
    """GETACTT(VAR t, name): the tool of a name whose state is active; -1 for none."""
    found = [tool.number for tool in sisters(channel, str(args[1])) if state_of(tool) & ACTIVE]
    arguments.give_back(args[0], found[0] if found else -1)


def change_to(channel: SinumerikChannel, args: Arguments) -> None:
    """TCA(name[,duplo[,holder]]): select a tool whatever its state is.

    Raises:
        AlarmError: 17190 for no such tool.
    """
    if not args or not isinstance(args[0], str) or len(args) > 3:
        raise AlarmError("14020", text="TCA")
    number = number_of(channel, args[:2])
    if number < 0:
        raise AlarmError("17190", tool=args[0])
    channel.event(ToolSelection(args[0]))
    holder = arguments.whole(args[2]) if len(args) > 2 and args[2] is not None else None
    if holder is not None and master_holder.is_other(channel, holder):
        master_holder.select(channel, holder, number)
        return
    channel.memory.tools.selected = number
    if channel.memory.data.integer("$MC_TOOL_CHANGE_MODE") == 0:
        load_tool(channel)


def set_master(channel: SinumerikChannel, args: Arguments) -> None:
    """SETMTH(n): the master toolholder; SETMTH alone returns to that of the machine data.

    Raises:
        AlarmError: 16761 for a spindle that the channel does not have, where spindles are the holders.
    """
    if len(args) > 1:
        raise AlarmError("14020", text="SETMTH")
    own = master_holder.holder_of_data(channel)
    number = arguments.whole(args[0]) if args and args[0] is not None else own
    if own == 0 and number:
        channel.memory.spindles.get(number)
    before = master_holder.master_of(channel)
    master_holder.Holders.of(channel).master = 0 if number == own else number
    take_over(channel, before)


def take_over(channel: SinumerikChannel, before: int) -> None:
    """Another holder is the master one: its tool acts, with the edge of MD20270, where T has ever named it."""
    held, tools = master_holder.Holders.of(channel).tools, channel.memory.tools
    now = master_holder.master_of(channel)
    if now == before:
        return
    held[before] = (tools.active, tools.selected)
    active, tools.selected = held.get(now, held[before])
    if active != tools.active:
        location = tools.additive
        tools.load(active, channel.memory.data)
        first_location(channel, location)
        edge_selected(channel)


def _exists(channel: SinumerikChannel, indices: Indices) -> bool:
    """`$P_TOOLEXIST[t]`: there is such a tool."""
    return bool(indices) and indices[0] in channel.memory.tools.tools


def _edge_count(channel: SinumerikChannel, indices: Indices) -> int:
    """`$P_TOOLND[t]`: how many edges a tool has, -1 for no such tool."""
    tool = channel.memory.tools.tools.get(indices[0]) if indices else None
    return -1 if tool is None else len(tool.edges)


def _count(channel: SinumerikChannel, _indices: Indices) -> int:
    """`$P_TOOLNT`: how many tools there are."""
    return len(channel.memory.tools.tools)


def _number(channel: SinumerikChannel, indices: Indices) -> int:
    """`$P_TOOLT[i]`: T number of the tool i, from 1; 0 beyond the last one."""
    numbers = sorted(channel.memory.tools.tools)
    place = indices[0] if indices and isinstance(indices[0], int) else 0
    return numbers[place - 1] if 1 <= place <= len(numbers) else 0


LIST_VARIABLES: dict[str, Row] = {
    "$P_TOOLEXIST": (Type.BOOL, _exists, None),
    "$P_TOOLND": (Type.INT, _edge_count, None),
    "$P_TOOLNT": (Type.INT, _count, None),
    "$P_TOOLT": (Type.INT, _number, None),
}
FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], int]] = {"NEWT": create, "GETT": number_of}
PROCEDURES: dict[str, Procedure] = {
    "GETSELT": selected,
    "GETEXET": loaded,
    "GETACTT": active,
    "TCA": change_to,
    "DELT": remove,
    "SETMTH": set_master,
}
