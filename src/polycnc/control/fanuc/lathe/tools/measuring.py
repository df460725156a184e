"""Skip and automatic tool offset: G31, G36, G37 (0i-TF Plus II.5.8)."""

from __future__ import annotations

from math import copysign, nan

from polycnc.control.fanuc.lathe.coordinates.systems import plane_axes
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.offsets import OffsetState, nose_radius, nose_tip, offset_changed
from polycnc.control.word_address.motion import skip
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.words import Words


#: P of G31: the signals of multi-step skip, and torque limit skip.
_SKIP_INPUTS = frozenset({1, 2, 3, 4, 98, 99})


def skip_move(channel: LatheChannel, words: Words) -> None:
    """G31: straight at F to the target or to where the skip signal comes; P1 to P4 choose the signal."""
    if "P" in words and words.integer("P") not in _SKIP_INPUTS:
        raise words.fail("gauge_number", "P")
    skip.skip_or_torque_move(channel, words)


def measure_first(channel: LatheChannel, words: Words) -> None:
    """G36 X (3405#3 = 1: G37.1)."""
    _measure(channel, words, "X")


def measure_second(channel: LatheChannel, words: Words) -> None:
    """G37 Z (3405#3 = 1: G37.2)."""
    _measure(channel, words, "Z")


def _measure(channel: LatheChannel, words: Words, name: str) -> None:
    """Rapid to the deceleration point, on at 6241 to the signal; its distance from the target goes to the offset.

    Deceleration point: 6251 before the target; the signal counts within 6254 on either side of it.
    """
    memory, c = channel.memory, channel.coordinates
    parameters = memory.parameters.of(name)
    named = words.axes()
    if len(named) != 1 or channel.axes[named[0][0]] != name or named[0][2]:
        raise words.fail("measure_axis", name)
    if not OffsetState.of(channel).number:
        raise words.fail("measure_no_offset", name)
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_skip", name)
    axis, target, _ = named[0]
    # 6251 and 6254 are radius values whatever the axis.
    before, window = parameters.measuring_deceleration, parameters.measuring_window
    programmed = c.programmed[:]
    programmed[axis] = target
    target_position = c.to_position(programmed)[axis]
    towards = copysign(1.0, target_position - c.position[axis])
    end = c.position[:]
    end[axis] = target_position - towards * before
    channel.straight(Kind.RAPID, end, nan)
    measured, comes = _stop(channel, axis, end[axis], target_position + towards * window)
    end = c.position[:]
    end[axis] = measured
    channel.straight(Kind.SKIP, end, parameters.measuring_feed / _seconds(channel))
    if not comes or abs(measured - target_position) > window + 1e-9:
        channel.keep_rows()
        raise words.fail("measure_signal", name)
    values = OffsetMemory.of(channel).at(OffsetState.of(channel).number).wear
    values[name] = values.get(name, 0.0) + measured + towards * _nose_reach(channel, axis) - target_position
    offset_changed(channel)


def _nose_reach(channel: LatheChannel, axis: int) -> float:
    """How far the nose reaches beyond the measured point: its radius where the tip number has no part along the axis.

    II.5.8: tips 0, 5, 7 for X, 0, 6, 8 for Z; with nose radius compensation available (8136#7 NCR = 0).
    """
    if channel.memory.parameters.NCR:
        return 0.0
    along = dict(zip(plane_axes(channel), nose_tip(channel), strict=True)).get(axis, 0.0)
    return 0.0 if along else nose_radius(channel)


def _seconds(channel: LatheChannel) -> float:
    """6241 is mm/min; under G99 the toolpath counts mm/rev."""
    return 60.0 if channel.mode["feed"] == "G98" else 1.0


def _stop(channel: LatheChannel, axis: int, begin: float, furthest: float) -> tuple[float, bool]:
    """Where the stroke at measuring speed ends, and whether the signal ends it: one that is on before acts at once."""
    at = channel.setup.switches.measure_signal_at.get(channel.axes[axis])
    if at is None:
        return furthest, False
    signal = channel.memory.radius_of(axis, at)
    if abs(signal - furthest) > abs(furthest - begin):
        signal = begin
    comes = (furthest - signal) * (furthest - begin) >= -1e-9
    return (signal, True) if comes else (furthest, False)
