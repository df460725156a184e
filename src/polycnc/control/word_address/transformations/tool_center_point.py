"""G43.4, G43.5 tool centre point control: words name the tip against the work, the linear axes follow the rotary ones.

The programming system is fixed to the table and turns with it (FANUC 19696#5 = 0). Positions in the toolpath are those
of the tip; their context turns them into positions of the axes.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.motion.path import reach
from polycnc.control.word_address.transformations.tilted_plane import TiltState
from polycnc.machine.kinematics import Kinematics
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector


@dataclass(frozen=True)
class TipFollowing:
    """How the axes follow the tip.

    Attributes:
        kinematics: The machine's rotary joints.
        axes: Names of the channel's axes.
        geometry: Columns of X, Y, Z.
        zero: Shift from work to machine of every axis, without the tool.
        length: Length of the tool, mm.
    """

    kinematics: Kinematics
    axes: tuple[str, ...]
    geometry: tuple[int, int, int]
    zero: tuple[float, ...]
    length: float

    def real(self, end: list[float]) -> list[float]:
        """Work coordinates of the axes for a position of the tip."""
        angles = self._angles(end)
        point = self.kinematics.work_turn(angles).apply(*self._machine(end))
        tip = self._tip(angles)
        return self._with(end, (point[0] - tip[0], point[1] - tip[1], point[2] - tip[2]))

    def display(self, real: list[float]) -> list[float]:
        """Position of the tip for work coordinates of the axes."""
        angles = self._angles(real)
        point, tip = self._machine(real), self._tip(angles)
        fixed = self.kinematics.work_turn(angles).inverse()
        return self._with(real, fixed.apply(point[0] + tip[0], point[1] + tip[1], point[2] + tip[2]))

    def _angles(self, end: list[float]) -> dict[str, float]:
        return {name: value + zero for name, value, zero in zip(self.axes, end, self.zero, strict=True)}

    def _machine(self, end: list[float]) -> Vector:
        x, y, z = (end[axis] + self.zero[axis] for axis in self.geometry)
        return (x, y, z)

    def _tip(self, angles: dict[str, float]) -> Vector:
        """From where the linear axes stand to the tip."""
        tip = self.kinematics.head_turn(angles).apply(0.0, 0.0, -self.length)
        nose = self.kinematics.head_turn({}).apply(0.0, 0.0, 0.0)
        return (tip[0] - nose[0], tip[1] - nose[1], tip[2] - nose[2])

    def _with(self, end: list[float], machine: Vector) -> list[float]:
        moved = list(end)
        for axis, value in zip(self.geometry, machine, strict=True):
            moved[axis] = value - self.zero[axis]
        return moved


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: from here on positions are those of the tip. Without motion in its block nothing moves."""
    memory, c = channel.memory, channel.coordinates
    kinematics = Kinematics.of(channel.machine)
    if not kinematics.axes or not set(kinematics.axes) <= set(channel.axes) or -1 in c.geometry:
        raise words.fail("tip_machine", "G43.4")
    if TiltState.of(channel).plane is not None or memory.side:
        raise words.fail("tip_mode", "G43.4")
    number = words.integer("H") if "H" in words else None
    memory.h = memory.h if number is None else number
    value = channel.control.length_value(channel, memory.h) if memory.h else 0.0
    c.transform(None)
    memory.length_offset = [0.0] * len(channel.axes)
    refresh_zero(channel)
    c.transform(TipFollowing(kinematics, channel.axes, c.geometry, tuple(c.offsets), value))
    channel.context_changed()


def plan_with_direction(builder: Builder, plan: Plan) -> Step | None:
    """G43.5: a straight block names the tip, and with I J K the direction of the tool; None without them."""
    if builder.mode["length"] != "G43.5" or builder.mode["motion"] not in ("G0", "G1"):
        return None
    letters = [letter for letter in "IJK" if builder.has(letter) and builder.is_free(letter)]
    if not letters:
        return None
    builder.take(*letters)
    rapid = builder.mode["motion"] == "G0"

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        words = Words(plan, values)
        if not rapid and not channel.feed > 0.0:
            raise words.fail("no_feed")
        c = channel.coordinates
        end = c.to_position(reach(channel, plan.axis_words, values))
        i, j, k = (words.typed(letter) or 0.0 for letter in "IJK")
        near = dict(zip(channel.axes, c.machine, strict=True))
        angles = Kinematics.of(channel.machine).angles_for((i, j, k), near) if i or j or k else None
        if angles is None:
            raise words.fail("tip_direction", letters[0])
        for name, angle in angles.items():
            axis = channel.axis_index[name]
            end[axis] = angle - c.offsets[axis]
        channel.straight(Kind.RAPID if rapid else Kind.FEED, end, nan if rapid else channel.feed)

    return move


def end_following(channel: WordAddressChannel) -> None:
    """G49 or another length code: the axes are named themselves again; nothing moves."""
    c = channel.coordinates
    if not isinstance(c.transformation, TipFollowing):
        return
    c.transform(None)
    channel.context_changed()
