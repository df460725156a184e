"""The state after reset: by the RESET key, and at M2 and M30 (MD20110, MD20150)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik import frames, gcodes, limits, protection, stages, tables
from polycnc.control.sinumerik.memory import Polar
from polycnc.language.sinumerik.nc_frame import NEUTRAL

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.memory import Memory


def reset(channel: Channel, codes: dict[str, str]) -> None:
    """Modal functions as given, programmed frames and compensations off; the axes stay where they are.

    Args:
        channel: The channel.
        codes: The function of every G group.
    """
    memory: Memory = channel.memory
    protection.leave(channel)
    machine = channel.coordinates.machine
    channel.mode = channel.modes.mode(codes)
    memory.previous = memory.recorder = None
    stages.clear(channel)
    memory.polar = Polar()
    memory.sections.clear()
    memory.open_corners.clear()
    memory.percent.clear()
    memory.language.modal_call = None
    memory.feed_mode = tables.FEED_TYPES[channel.mode["feed"]].mode
    memory.frames.programmable = NEUTRAL
    memory.frames.select(gcodes.number_of(channel.mode["zero_offset"]) - 1)
    frames.apply(channel)
    limits.refresh(channel)
    channel.context_changed()
    channel.coordinates.arrive_machine(machine)
