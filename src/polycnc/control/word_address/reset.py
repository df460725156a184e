"""The state after reset: by the RESET key, and at M02 and M30."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.transformations import (
    cylinder,
    hypothetical_axis,
    normal_line,
    polar_interpolation,
)
from polycnc.geometry.frames import IDENTITY

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel

#: What a reset brings back to its state at power-on. Offsets, common variables, shifts of work coordinate systems,
#: the tool, S and the direction of the spindle stay.
CLEARED = (
    "locals", "wcs", "length_offset", "h", "d", "side", "engaged_side", "modal_calls",
    "cycle_data", "intermediate", "interruptions", "armed_tapping", "exact_stop_block", "contour_control",
    "single_cycle", "grinding", "open_line", "shape", "reading_shape", "zone", "stack",
    "mid_point", "tilt", "rotates_work", "scale_factors", "modal_longs", "modal_doubles", "skip_groups",
    "feeds", "feed_mode", "interrupt", "curve", "told_plane",
    "cancelled_overrides", "tapping",
)  # fmt: skip


def reset(channel: Channel) -> None:
    """Modal codes of power-on, compensations and programmed frames off; the axes stay where they are."""
    polar_interpolation.leave_polar(channel)
    cylinder.end_cylinder(channel)
    hypothetical_axis.end(channel)
    normal_line.end(channel)
    memory = channel.memory
    fresh = channel.control.make_memory(channel)
    for name in CLEARED:
        if hasattr(memory, name):
            setattr(memory, name, getattr(fresh, name))
    machine = channel.coordinates.machine
    channel.coordinates.transformation = None
    frames = memory.frames
    frames.scale = frames.mirror = frames.rotation = IDENTITY
    frames.mirrored = {}
    channel.path.clear()
    channel.mode = channel.modes.mode(channel.control.start_codes(channel))
    channel.coordinates.set_programming(frames.product(), frames.shift)
    channel.coordinates.pending = [0.0] * len(channel.axes)
    channel.coordinates.owes = False
    refresh_zero(channel)
    channel.coordinates.arrive_machine(machine)
