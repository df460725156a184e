"""G37 automatic tool length measurement: to the sensor, and the difference into the length offset."""

from __future__ import annotations

from math import copysign, nan

from polycnc.control.word_address.states import LengthState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MillingChannel


def measure_length(channel: MillingChannel, words: Words) -> None:
    """G37 Z: rapid to the deceleration point, on at the measuring feed to the signal.

    How far the signal lies from the programmed position is added to the active length offset.
    """
    state = LengthState.of(channel)
    c, control = channel.coordinates, channel.control
    if "H" in words:
        raise words.fail("measure_h", "H")
    if not state.number:
        raise words.fail("measure_no_offset", "G37")
    named = words.axes()
    if len(named) != 1 or named[0][0] != c.geometry[2]:
        raise words.fail("measure_axis", "G37")
    axis, value, incremental = named[0]
    before, window, feed = control.measuring(channel, words)
    programmed = c.programmed[:]
    programmed[axis] = programmed[axis] + value if incremental else value
    goal = c.to_position(programmed)[axis]
    towards = copysign(1.0, goal - c.position[axis])
    end = c.position[:]
    end[axis] = goal - towards * before
    channel.straight(Kind.RAPID, end, nan)
    measured = channel.setup.switches.measure_signal_at.get(channel.axes[axis])
    if measured is None or abs(measured - goal) > window + 1e-9:
        raise words.fail("measure_signal", "G37")
    end = c.position[:]
    end[axis] = measured
    channel.straight(Kind.SKIP, end, feed)
    control.note_length(channel, state.number, measured - goal)
