"""Several spindles or toolholders: T and M6 with an extension, and which of them is the master one.

D chooses edges of the tool in the master holder. Holders are the spindles, or have numbers of their own where MD20124
names the master one. Source: job planning 16.1 (SETMTH); Function Manual Tool Management, W1 (general knowledge).
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Number of the master toolholder; 0 where the master spindle is the holder.
_MASTER = "$MC_TOOL_MANAGEMENT_TOOLHOLDER"


@dataclass(slots=True)
class Holders(State, lifetime=Lifetime.RESET):
    """The master holder, and what is in the others.

    Attributes:
        master: What SETMTH has named; 0 for the holder of the machine data.
        tools: By holder that T has named: T numbers in it and selected for it.
    """

    master: int = 0
    tools: dict[int, tuple[int, int]] = lasting(Lifetime.POWER, factory=dict)


def holder_of_data(channel: Channel) -> int:
    """The master holder of the machine data; 0 where the master spindle is it."""
    return MachineData.of(channel).integer(_MASTER)


def master_of(channel: SinumerikChannel) -> int:
    """The holder whose tool D chooses edges of."""
    return Holders.of(channel).master or holder_of_data(channel) or channel.memory.spindles.master


def is_other(channel: SinumerikChannel, number: int | None) -> bool:
    """Whether an extension names a holder beside the master one."""
    return number is not None and number != master_of(channel)


def select(channel: SinumerikChannel, holder: int, tool: int) -> None:
    """T of another holder: the tool is selected for it, and loaded where MD22550 says that T does so."""
    tools = Holders.of(channel).tools
    tools[holder] = (tools.get(holder, (0, 0))[0], tool)
    if channel.memory.data.integer("$MC_TOOL_CHANGE_MODE") == 0:
        load(channel, holder)


def load(channel: SinumerikChannel, holder: int) -> None:
    """M6 of another holder: the tool that is selected for it comes into it; the offsets of the master one stay."""
    tools = Holders.of(channel).tools
    if holder in tools:
        selected = tools[holder][1]
        tools[holder] = (selected, selected)
        channel.memory.tools.used.add(selected)


def tools_in(channel: SinumerikChannel, holder: int | None) -> tuple[int, int]:
    """T numbers in a holder, None for the master one, and selected for it."""
    tools = channel.memory.tools
    if holder is None or not is_other(channel, holder):
        return tools.active, tools.selected
    return Holders.of(channel).tools.get(holder, (0, 0))
