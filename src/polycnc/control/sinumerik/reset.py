"""The state at program start and after reset: by the RESET key, and at M2 and M30 (MD20110, MD20150, MD20152)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, end_of
from polycnc.control.sinumerik import gcodes, tables
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.frames import memory as frames
from polycnc.control.sinumerik.limits import protection, working_area
from polycnc.language.sinumerik.names.frame import NEUTRAL

if TYPE_CHECKING:
    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.memory import Memory

#: Groups that a bit of MD20110 keeps over a reset.
KEPT_BY_MASK = {4: "plane", 5: "wcs"}
KEEPS_EDGE = 6


def start_codes(channel: SinumerikChannel, data: MachineData) -> dict[str, str]:
    """Modal state at program start: delivered values, MD20150, and G18 where the channel has no Y axis."""
    codes = {**gcodes.START_CODES, **gcodes.INTERNAL_CODES}
    definition = channel.machine.channel(channel.number)
    if "X" in definition.geometry and not {"Y"} & {*definition.geometry, *definition.virtual}:
        codes["plane"] = "G18"
    return codes | {group.name: code for group in gcodes.GROUPS if (code := _reset_value(group, data))}


def start_code(group: gcodes.Group, data: MachineData) -> str:
    """The function of a modal group at program start: MD20150, or the delivered one."""
    return _reset_value(group, data) or group.start


def _reset_value(group: gcodes.Group, data: MachineData) -> str:
    """The function of a modal group that MD20150 names; empty where it is not set."""
    if group.is_modal and data.is_set("$MC_GCODE_RESET_VALUES", group.number - 1):
        number = data.integer("$MC_GCODE_RESET_VALUES", group.number - 1)
        if 1 <= number <= len(group.words):
            return group.words[number - 1]
    return ""


def _kept_codes(channel: SinumerikChannel, data: MachineData) -> dict[str, str]:
    """Modal functions that a reset leaves as they are; without bit 0 of MD20110 the other bits count for nothing."""
    mask = data.integer("$MC_RESET_MODE_MASK")
    if not mask & 1:
        return {}
    kept = {name for bit, name in KEPT_BY_MASK.items() if mask >> bit & 1}
    kept.update(
        group.name
        for group in gcodes.GROUPS
        if group.is_modal and data.integer("$MC_GCODE_RESET_MODE", group.number - 1)
    )
    return {name: channel.mode[name] for name in kept}


def _reset_edge(channel: SinumerikChannel, data: MachineData) -> None:
    """The tool stays in the spindle; bit 6 of MD20110 keeps its offsets, else MD20130 says which hold."""
    tools = channel.memory.tools
    if data.integer("$MC_RESET_MODE_MASK") & (1 | 1 << KEEPS_EDGE) == 1:
        edge, tool = data.integer("$MC_CUTTING_EDGE_RESET_VALUE"), tools.tools.get(tools.active)
        tools.select_edge(edge if tool is not None and edge in tool.edges else 0)
    tools.assign_lengths(channel.mode["plane"], data)


def stop_spindles(memory: Memory) -> None:
    """Spindles stop, but for those that MD35040 keeps turning."""
    for number, spindle in memory.spindles.all.items():
        if not memory.data.integer("$MA_SPIND_ACTIVE_AFTER_RESET", f"S{number}"):
            spindle.direction = 0


def reset(channel: SinumerikChannel) -> None:
    """Modal functions as at program start, programmed frames and compensations off; the axes stay where they are."""
    memory = channel.memory
    protection.leave(channel)
    machine = channel.coordinates.machine
    channel.mode = channel.modes.mode(start_codes(channel, memory.data) | _kept_codes(channel, memory.data))
    stop_spindles(memory)
    _reset_edge(channel, memory.data)
    channel.path.clear()
    end_of(channel, Lifetime.RESET)
    memory.language.modal_call = None
    PathFeed.of(channel).mode = tables.feed_type(channel.mode).mode
    memory.frames.programmable = NEUTRAL
    memory.frames.select(gcodes.number_of(channel.mode["wcs"]) - 1)
    frames.apply(channel)
    working_area.refresh(channel)
    channel.context_changed()
    channel.coordinates.arrive_machine(machine)
