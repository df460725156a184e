"""The protection levels that hold: of the operator, and of programs in cycle directories (job planning 1.1.10)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.program.names import CYCLE_DIRS

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Without a setting, the machine manufacturer's password is set.
MANUFACTURER = 1
SIGNAL = "access_level"
#: Signals of the key switch by the level that its position gives.
KEY_SWITCH = {7: "DB10.DBX56.4", 6: "DB10.DBX56.5", 5: "DB10.DBX56.6", 4: "DB10.DBX56.7"}
_EXECUTION = dict(
    zip(CYCLE_DIRS, ("$MN_ACCESS_EXEC_CUS", "$MN_ACCESS_EXEC_CMA", "$MN_ACCESS_EXEC_CST"), strict=True)
)


_WRITING = dict(
    zip(CYCLE_DIRS, ("$MN_ACCESS_WRITE_CUS", "$MN_ACCESS_WRITE_CMA", "$MN_ACCESS_WRITE_CST"), strict=True)
)


def operator_level(channel: SinumerikChannel) -> int:
    """The level that the setup gives (`access_level`), else that of the key switch, else the manufacturer's."""
    switches = channel.setup.switches
    given = switches.signals.get(SIGNAL)
    if isinstance(given, (int, float)):
        return int(given)
    return next((level for level, signal in KEY_SWITCH.items() if switches.plc.get(signal)), MANUFACTURER)


def turn_key_switch(channel: Channel, level: int) -> None:
    """The key switch gives programs this level from here on; a password of the setup counts where it is higher."""
    given = channel.setup.switches.signals.get(SIGNAL)
    password = int(given) if isinstance(given, (int, float)) else level
    language = channel.memory.language
    language.access_level = min(level, password)
    language.programs.forget_steps()  # blocks are asked for their rights when they are compiled


def directory_levels(data: MachineData) -> dict[str, int]:
    """The level of programs in each cycle directory (MD11160 to MD11162)."""
    return {directory: data.integer(name) for directory, name in _EXECUTION.items()}


def write_levels(data: MachineData) -> dict[str, int]:
    """The level that writing into each cycle directory needs (MD11165 to MD11167)."""
    return {directory: data.integer(name) for directory, name in _WRITING.items()}
