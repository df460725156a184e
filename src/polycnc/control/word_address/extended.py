"""Codes of machining centres beyond plain motion: G54.1, G92 with S, exact stop, look-ahead modes, stroke limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from polycnc.control.word_address.coordinates import refresh_zero, set_position

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.words import Words


def select_work_offset(channel: Channel, words: Words) -> None:
    """G54 to G59, G54.1 P1 … (also `G54 P1`): the work coordinate system; no motion by itself."""
    code = channel.mode["wcs"]
    number = words.integer("P") if "P" in words else None
    if number is not None and not 0 <= number <= channel.control.EXTENDED_WORK_SYSTEMS:
        raise words.fail("offset_number", "P")
    if number:
        channel.memory.wcs = f"G54.1 P{number}"
    else:
        channel.memory.wcs = "G54" if code == "G54.1" else code
    refresh_zero(channel)


def set_position_or_limit(channel: Channel, words: Words) -> None:
    """G92: sets the position; with S the highest speed under constant surface speed."""
    if words.axes():
        set_position(channel, words)
    limit = words.typed("S")
    if limit is not None:
        channel.memory.spindle_limit_rpm = limit
        channel.context_changed()


def exact_stop_block(channel: Channel, _words: Words) -> None:
    """G09: exact stop at the end of this block."""
    channel.memory.exact_stop_block = True
    channel.context_changed()


def end_of_exact_stop(channel: Channel, _values: list[float]) -> None:
    """The block of a G09 ends."""
    channel.memory.exact_stop_block = False
    channel.context_changed()


def _refuse_company(words: Words, *own: str) -> None:
    """Alarm for any other word in the block."""
    for key in words.plan.order:
        if key not in own:
            raise words.fail("address", key)


def high_speed_machining(channel: Channel, words: Words) -> None:
    """G05 P10000 / P0, alone in its block: the path is unchanged; the planner looks further ahead."""
    _refuse_company(words, "G5", "P")
    if words.integer("P") not in (0, 10000):
        raise words.fail("address", "P")
    channel.memory.contour_control = words.integer("P") == 10000
    channel.context_changed()


def high_speed_mode(channel: Channel, words: Words) -> None:
    """G05 P0, P1, P2, P10000 of MELDAS: high-speed modes; the path is unchanged."""
    number = words.integer("P")
    if number not in (0, 1, 2, 10000):
        raise words.fail("address", "P")
    channel.memory.contour_control = number != 0
    channel.context_changed()


def contour_control(channel: Channel, words: Words) -> None:
    """G05.1 Q1 [R1 … R10] / Q0, alone in its block: AI contour control; R chooses a level of precision."""
    _refuse_company(words, "G5.1", "Q", "R")
    level = words.integer("R") if "R" in words else None
    if words.integer("Q") not in (0, 1) or (level is not None and not 1 <= level <= 10):
        raise words.fail("address", "Q")
    channel.memory.contour_control = words.integer("Q") == 1
    channel.context_changed()


def advance_preview(channel: Channel, words: Words) -> None:
    """G08 P1 / P0."""
    if words.integer("P") not in (0, 1):
        raise words.fail("preview_value", "P")
    channel.memory.contour_control = words.integer("P") == 1
    channel.context_changed()


@dataclass(frozen=True, slots=True)
class StrokeZone:
    """A box in machine coordinates that the tool must not enter (`inside`) or not leave: stored stroke check 2 or 3."""

    low: tuple[float, ...]
    high: tuple[float, ...]
    axes: tuple[int, ...]
    inside: bool
    number: int = 2

    def check(self, channel: Channel, machine: list[float], *, straight: bool) -> None:
        """The control's alarm for a way into the zone, or out of it; of a curve the end and points on it."""
        start = channel.coordinates.machine if straight else machine
        axis = self._entered(start, machine) if self.inside else self._left(machine)
        if axis >= 0:
            direction = 1 if machine[axis] >= channel.coordinates.machine[axis] else -1
            raise channel.control.forbidden_zone(channel.axes[axis], direction, self.number)

    def check_point(self, channel: Channel, machine: list[float]) -> None:
        """The control's alarm for a point of a curve."""
        self.check(channel, machine, straight=False)

    def _left(self, end: list[float]) -> int:
        """The first axis that stands outside, or -1."""
        within = zip(self.axes, self.low, self.high, strict=True)
        return next((axis for axis, low, high in within if not low <= end[axis] <= high), -1)

    def _entered(self, start: list[float], end: list[float]) -> int:
        """The axis by which a straight way comes into the box last, or -1 where it stays outside."""
        first, last, blamed = 0.0, 1.0, self.axes[0]
        for axis, low, high in zip(self.axes, self.low, self.high, strict=True):
            way = end[axis] - start[axis]
            if way == 0.0:
                if not low <= start[axis] <= high:
                    return -1
                continue
            enter, leave = sorted(((low - start[axis]) / way, (high - start[axis]) / way))
            if enter > first:
                first, blamed = enter, axis
            last = min(last, leave)
        return blamed if first <= last else -1


def stroke_check_on(channel: Channel, words: Words) -> None:
    """G22 X Y Z I J K: stored stroke check 2; X Y Z the upper corner, I J K the lower, machine coordinates."""
    upper = {axis: value for axis, value, _ in words.axes()}
    named: list[tuple[int, float, float]] = []
    for letter, axis in zip("IJK", channel.coordinates.geometry, strict=True):
        low = words.length(letter)
        if (low is None) != (axis not in upper):
            raise words.fail("address", letter)
        if low is not None:
            named.append((axis, min(low, upper[axis]), max(low, upper[axis])))
    if named:
        axes, lows, highs = zip(*named, strict=True)
        inside = not channel.memory.parameters.bit(1300, 0)
        channel.stroke_zone = StrokeZone(tuple(lows), tuple(highs), tuple(axes), inside)


def stroke_check_off(channel: Channel, _words: Words) -> None:
    """G23: the zone of G22 may be entered again."""
    channel.stroke_zone = None
