"""What a cycle does on its channel, written down block by block: strokes, dwells, spindle, messages.

A cycle works in the work coordinates of its call, as its blocks do on the control: absolute, G40, with rapids and
feeds of its own; G functions, F and frames of the caller are not touched. It is planned when its first block is due:
what it does is noted as acts in blocks, and the channel then runs one block after the other (`calls`). So nothing of
a cycle is in flight between two blocks.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import nan

from polycnc.control.sinumerik.axes import spindles as spindle_axes
from polycnc.control.sinumerik.motion import circles
from polycnc.control.sinumerik.motion import moves as motion
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, ParamSpec, TypeAlias
from polycnc.geometry.planes import PLANES
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary, Message, SpindleSpeed

with loaded_when_called():
    from polycnc.control.sinumerik.motion import threads

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.geometry.arcs import Point

_P = ParamSpec("_P")
#: A cycle of more acts is taken for a mistake (an infeed of a thousandth of a micrometre, say).
MOST_ACTS = 200_000
#: One thing that a block of a cycle does.
Act: TypeAlias = Callable[[], object]
#: Where a stroke ends along u, v and w; None for an axis that stays.
Target: TypeAlias = "tuple[float | None, float | None, float | None]"
#: Factors that differ from 1, or from each other, by less are none: rounding.
NO_SCALE = 1e-9
#: M functions of the directions of a spindle.
M_OF_DIRECTION = {1: 3, -1: 4, 0: 5}


class Moves:
    """The blocks of a cycle, and moves in its plane: u and v span it, w is its third axis.

    Every method that does something adds an act to the open block; `end_block` closes it. Where the tool will stand
    behind what is noted so far, `point` and `level` say.

    Args:
        channel: The channel.
        applicate: Which axis of the plane is w: 1 the abscissa, 2 the ordinate, else the third (`_AXN`).

    Attributes:
        blocks: The acts of every block; the last one is open, and the cycle ends behind it.

    A target for an axis that the channel does not have is alarm 61803.
    """

    def __init__(self, channel: SinumerikChannel, applicate: int = 3) -> None:
        self.channel = channel
        self.blocks: list[list[Act]] = [[]]
        self._acts = 0
        order = {1: (1, 2, 0), 2: (2, 0, 1)}.get(applicate, (0, 1, 2))
        plane = PLANES[channel.mode["plane"]]
        a, b, c = (plane[i] for i in order)
        self.axes = (a, b, c)
        geometry = channel.coordinates.geometry
        self.columns = (geometry[a], geometry[b], geometry[c])
        position = channel.coordinates.position
        self._at = [position[column] if column >= 0 else 0.0 for column in self.columns]

    @property
    def memory(self) -> Memory:
        """The control's state."""
        return self.channel.memory

    @property
    def spindle(self) -> Spindle:
        """The master spindle, as it is before anything that is noted here."""
        return self.memory.spindles.get()

    @property
    def point(self) -> Point:
        """Where the tool will stand in the plane; 0 for an axis that does not exist."""
        return self._at[0], self._at[1]

    @property
    def level(self) -> float:
        """Where the tool will stand along w; 0 for an axis that does not exist."""
        return self._at[2]

    # ---- blocks

    def plan(self, work: Callable[[], None]) -> None:
        """Let a function note its blocks; an alarm comes when the blocks noted before it have been run."""
        try:
            work()
        except AlarmError as alarm:
            self.blocks[-1].append(partial(_raise, alarm))

    def act(self, function: Callable[_P, object], *args: _P.args, **kwargs: _P.kwargs) -> None:
        """Something that the open block does."""
        self._acts += 1
        if self._acts > MOST_ACTS:
            raise self.channel.control.block_limit()
        self.blocks[-1].append(partial(function, *args, **kwargs))

    def end_block(self) -> None:
        """The open block is complete: single block operation halts behind it."""
        self.blocks.append([])

    # ---- strokes

    def rapid(self, u: float | None = None, v: float | None = None, w: float | None = None) -> None:
        """A rapid move; None for an axis that stays."""
        self.act(self._line, Kind.RAPID, self._to(u, v, w))

    def feed(
        self, feed: float, u: float | None = None, v: float | None = None, w: float | None = None
    ) -> None:
        """A straight cut at a feed; alarm 10860 without one."""
        self.act(self._line, Kind.FEED, self._to(u, v, w), feed)

    def arc(self, feed: float, end: Point, center: Point, ccw: bool, w: float | None = None) -> None:
        """An arc, or a helix with `w`; one that ends where it begins is a full circle."""
        self.act(self._arc, self._to(*end, w), center, feed, ccw)

    def special(self, kind: Kind, lead: float, w: float, feed: float = nan) -> None:
        """A thread or tapping stroke along w."""
        parameters = [lead, 0.0] if kind is Kind.THREAD else [lead]
        self.act(self._special, kind, self._to(None, None, w), feed, parameters)

    def thread(self, u: float, v: float, lead: float, start_angle: float) -> None:
        """A thread stroke in the plane."""
        self.act(self._special, Kind.THREAD, self._to(u, v, None), nan, [lead, start_angle])

    def dwell(self, amount: float) -> None:
        """Stand still: seconds above 0, spindle revolutions below."""
        self.act(self.channel.dwell, seconds=max(amount, 0.0), revolutions=max(-amount, 0.0))

    def _to(self, u: float | None, v: float | None, w: float | None) -> Target:
        """The target of a stroke, which is where the tool will stand."""
        target = (u, v, w)
        for place, value in enumerate(target):
            if value is not None and self.columns[place] >= 0:
                self._at[place] = value
        return target

    def _end(self, target: Target) -> list[float]:
        end = self.channel.coordinates.position.copy()
        pending = self.channel.coordinates.pending
        for column, axis, value in zip(self.columns, self.axes, target, strict=True):
            if value is not None:
                if column < 0:
                    raise AlarmError("61803", axis="XYZ"[axis])
                end[column] = value
                pending[column] = 0.0
        return end

    def _line(self, kind: Kind, target: Target, feed: float = nan) -> None:
        end = self._end(target)
        motion.line(self.channel, kind, end, feed if kind is Kind.RAPID else motion.checked_feed(feed))

    def _arc(self, target: Target, center: Point, feed: float, ccw: bool) -> None:
        end = self._end(target)
        circles.arc(self.channel, self.columns, self.axes, end, center, motion.checked_feed(feed), ccw)

    def _special(self, kind: Kind, target: Target, feed: float, parameters: list[float]) -> None:
        end = self._end(target)
        if kind is Kind.THREAD:
            threads.cut(self.channel, end, *parameters)
        else:
            motion.special(self.channel, kind, end, feed, parameters)

    # ---- the machine

    def turn(self, direction: int) -> None:
        """M3 (1), M4 (-1) or M5 (0) of the master spindle."""
        self.act(self._turn, direction)

    def orient(self, angle: float) -> None:
        """SPOS: the spindle stands at an angle."""
        self.act(self._orient, angle)

    def speed(self, rpm: float) -> None:
        """S of the master spindle."""
        self.act(self._speed, rpm)

    def stop(self) -> None:
        """M0."""
        self.act(self.channel.stop, "M0")

    def note(self, key: str, text: str = "") -> None:
        """A message of the cycle, by its number, and what it is about; the cycle goes on."""
        self.act(self._note, key, text)

    def _turn(self, direction: int) -> None:
        spindle = self.spindle
        spindle.direction = direction
        spindle.controlled = False
        self.channel.context_changed()
        self.channel.event(Auxiliary(M_OF_DIRECTION[direction]))

    def _orient(self, angle: float) -> None:
        spindle_axes.orient(self.channel, self.spindle, angle)

    def _speed(self, rpm: float) -> None:
        spindle = self.spindle
        if spindle.speed != rpm:
            spindle.speed = rpm
            self.channel.context_changed()
            self.channel.event(SpindleSpeed(speed=rpm, spindle=spindle.number))

    def _note(self, key: str, text: str) -> None:
        message = self.channel.control.catalogue.text(key)
        self.channel.event(Message(f"{message}: {text}" if text else message))


def _raise(alarm: AlarmError) -> None:
    raise alarm


def require_tool(moves: Moves, *, evenly: bool = False, deep: bool = False) -> float:
    """Radius of the active tool with wear, mm, of a cycle that works with it.

    Frames scale what a cycle makes, but not the tool, so a cycle that reckons with its radius takes no scale.

    Args:
        moves: The cycle's moves.
        evenly: Unequal factors in the plane are an alarm of their own.
        deep: A scale of the third axis is refused as well.

    Raises:
        AlarmError: 61000 without a tool offset, 61012 and 61011 where a scale is active.
    """
    tools = moves.memory.tools
    if tools.edge is None:
        raise AlarmError("61000")
    scales = moves.memory.frames.total().scales
    u, v, w = (scales[axis] for axis in moves.axes)
    if evenly and abs(u - v) > NO_SCALE:
        raise AlarmError("61012")
    if any(abs(factor - 1.0) > NO_SCALE for factor in ((u, v, w) if deep else (u, v))):
        raise AlarmError("61011")
    return tools.radius
