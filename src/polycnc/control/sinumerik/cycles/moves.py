"""What a cycle does on its channel: strokes in the axes of its plane, dwells, spindle, messages.

A cycle works in the work coordinates of its call, as its blocks do on the control: absolute, G40, with rapids and
feeds of its own; G functions, F and frames of the caller are not touched.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.motion import circles
from polycnc.control.sinumerik.motion import moves as motion
from polycnc.geometry.planes import PLANES
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.feed.spindles import Spindle
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.geometry.arcs import Point

#: M functions of the directions of a spindle.
M_OF_DIRECTION = {1: 3, -1: 4, 0: 5}


class Moves:
    """Moves in the plane of a cycle: u and v span it, w is its third axis.

    Args:
        channel: The channel.
        applicate: Which axis of the plane is w: 1 the abscissa, 2 the ordinate, else the third (`_AXN`).

    A target for an axis that the channel does not have is alarm 61803.
    """

    def __init__(self, channel: Channel, applicate: int = 3) -> None:
        self.channel = channel
        order = {1: (1, 2, 0), 2: (2, 0, 1)}.get(applicate, (0, 1, 2))
        plane = PLANES[channel.mode["plane"]]
        a, b, c = (plane[i] for i in order)
        self.axes = (a, b, c)
        geometry = channel.coordinates.geometry
        self.columns = (geometry[a], geometry[b], geometry[c])

    @property
    def memory(self) -> Memory:
        """The control's state."""
        memory: Memory = self.channel.memory
        return memory

    @property
    def spindle(self) -> Spindle:
        """The master spindle."""
        return self.memory.spindles.get()

    @property
    def point(self) -> Point:
        """Where the tool stands in the plane; 0 for an axis that does not exist."""
        position = self.channel.coordinates.position
        u, v = (position[column] if column >= 0 else 0.0 for column in self.columns[:2])
        return u, v

    @property
    def level(self) -> float:
        """Where the tool stands along w; 0 for an axis that does not exist."""
        column = self.columns[2]
        return self.channel.coordinates.position[column] if column >= 0 else 0.0

    def _end(self, values: tuple[float | None, float | None, float | None]) -> list[float]:
        end = self.channel.coordinates.position.copy()
        pending = self.channel.coordinates.pending
        for column, axis, value in zip(self.columns, self.axes, values, strict=True):
            if value is not None:
                if column < 0:
                    raise AlarmError("61803", axis="XYZ"[axis])
                end[column] = value
                pending[column] = 0.0
        return end

    def rapid(self, u: float | None = None, v: float | None = None, w: float | None = None) -> None:
        """A rapid move; None for an axis that stays."""
        motion.line(self.channel, Kind.RAPID, self._end((u, v, w)), nan)

    def feed(
        self, feed: float, u: float | None = None, v: float | None = None, w: float | None = None
    ) -> None:
        """A straight cut at a feed; alarm 10860 without one."""
        motion.line(self.channel, Kind.FEED, self._end((u, v, w)), motion.checked_feed(feed))

    def arc(self, feed: float, end: Point, center: Point, ccw: bool, w: float | None = None) -> None:
        """An arc, or a helix with `w`; one that ends where it begins is a full circle."""
        circles.arc(
            self.channel,
            self.columns,
            self.axes,
            self._end((*end, w)),
            center,
            motion.checked_feed(feed),
            ccw,
        )

    def special(self, kind: Kind, lead: float, w: float, feed: float = nan) -> None:
        """A thread or tapping stroke along w."""
        parameters = [lead, 0.0] if kind is Kind.THREAD else [lead]
        motion.special(self.channel, kind, self._end((None, None, w)), feed, parameters)

    def thread(self, u: float, v: float, lead: float, start_angle: float) -> None:
        """A thread stroke in the plane."""
        motion.special(self.channel, Kind.THREAD, self._end((u, v, None)), nan, [lead, start_angle])

    def dwell(self, amount: float) -> None:
        """Stand still: seconds above 0, spindle revolutions below."""
        self.channel.dwell(seconds=max(amount, 0.0), revolutions=max(-amount, 0.0))

    # ---- the machine

    def turn(self, direction: int) -> None:
        """M3 (1), M4 (-1) or M5 (0) of the master spindle."""
        spindle = self.spindle
        spindle.direction = direction
        spindle.controlled = False
        self.channel.context_changed()
        self.channel.event("m", code=M_OF_DIRECTION[direction])

    def orient(self, angle: float) -> None:
        """SPOS: the spindle stands at an angle."""
        spindle = self.spindle
        spindle.position = angle % tables.TURN
        spindle.controlled, spindle.direction = True, 0
        self.channel.context_changed()

    def speed(self, rpm: float) -> None:
        """S of the master spindle."""
        spindle = self.spindle
        if spindle.speed != rpm:
            spindle.speed = rpm
            self.channel.context_changed()
            self.channel.event("s", speed=rpm, spindle=spindle.number)

    def note(self, key: str) -> None:
        """A message of the cycle, by its number; the cycle goes on."""
        self.channel.event("message", text=self.channel.control.catalogue.text(key))


def require_tool(moves: Moves) -> float:
    """Radius of the active tool with wear, mm; 61000 if no tool offset is active."""
    tools = moves.memory.tools
    if tools.edge is None:
        raise AlarmError("61000")
    return tools.radius
