"""The state at program start and after reset: by the RESET key, and at M2 and M30 (MD20110, MD20150, MD20152)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, end_of
from polycnc.control.sinumerik import gcodes, tables
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.frames.memory import ISO_MIRROR, ISO_ROTATION, ISO_SCALE, OF_PLANES
from polycnc.control.sinumerik.limits import working_area
from polycnc.control.sinumerik.tools import selection
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.frame import NEUTRAL

with loaded_when_called():
    from polycnc.control.sinumerik.motion import contour_reading
    from polycnc.control.sinumerik.tools.holders import active as carriers

if TYPE_CHECKING:
    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Groups that a bit of MD20110 keeps over a reset.
KEPT_BY_MASK = {4: "plane", 5: "wcs"}


def start_codes(channel: SinumerikChannel, data: MachineData) -> dict[str, str]:
    """Modal state at program start: delivered values, MD20150, and G18 where the channel has no Y axis."""
    codes = {**gcodes.START_CODES, **gcodes.INTERNAL_CODES}
    definition = channel.machine.channel(channel.number)
    if "X" in definition.geometry and not {"Y"} & {*definition.geometry, *definition.virtual}:
        codes["plane"] = "G18"
    if not data.integer("$MC_ORIENTATION_IS_EULER"):
        codes["orientation_angles"] = "ORIRPY"
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


def reset(channel: SinumerikChannel) -> None:
    """Modal functions as at program start, programmed frames and compensations off; the axes stay where they are."""
    contour_reading.abandon(channel)
    memory, machine = channel.memory, channel.coordinates.machine
    channel.mode = channel.modes.mode(start_codes(channel, memory.data) | _kept_codes(channel, memory.data))
    channel.path.clear()
    channel.turning = None
    end_of(channel, Lifetime.RESET)
    channel.mode = channel.mode.with_code(seat.GEOMETRY, seat.geometry_code(channel))
    PathFeed.of(channel).mode = tables.feed_type(channel.mode).mode
    memory.frames.system.update(dict.fromkeys((*OF_PLANES, ISO_MIRROR, ISO_ROTATION, ISO_SCALE), NEUTRAL))
    if not carriers.ActiveCarrier.of(channel).number:  # of CYCLE800; a toolholder has machine data of its own
        carriers.release(channel)
    selection.follow(channel)
    memory.frames.select(gcodes.number_of(channel.mode["wcs"]) - 1)
    frames.apply(channel)
    working_area.refresh(channel)
    channel.context_changed()
    channel.coordinates.arrive_machine(machine)
