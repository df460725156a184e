"""The state after reset: by the RESET key, and at M02 and M30."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, end_of
from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.transformations import (
    cylinder,
    hypothetical_axis,
    normal_line,
    polar_interpolation,
)
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.word_address.family import WordAddressChannel


def reset(channel: WordAddressChannel) -> None:
    """Modal codes of power-on, compensations and programmed frames off; the axes stay where they are."""
    polar_interpolation.leave_polar(channel)
    cylinder.end_cylinder(channel)
    hypothetical_axis.end(channel)
    normal_line.end(channel)
    memory = channel.memory
    end_of(channel, Lifetime.RESET, memory.kept_at_reset)
    memory.forget_locals()
    machine = channel.coordinates.machine
    channel.coordinates.transformation = channel.coordinates.naming = None
    frames = memory.frames
    channel.path.clear()
    control = channel.control
    kept = {group: code for group, code in channel.mode.codes.items() if group in control.KEPT_AT_RESET}
    channel.mode = channel.modes.mode(control.start_codes(channel) | kept)
    channel.coordinates.set_programming(frames.product(), frames.shift)
    channel.coordinates.pending = [0.0] * len(channel.axes)
    channel.coordinates.owes = False
    refresh_zero(channel)
    channel.coordinates.arrive_machine(machine)
