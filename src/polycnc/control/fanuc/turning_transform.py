"""Polar coordinate interpolation G12.1 and cylindrical interpolation G07.1 on lathes with a C axis.

Both make C a length of the working plane. Polar: X and C are a Cartesian plane across the spindle; positions in the
toolpath are Cartesian, their context says how the machine's axes follow. Cylindrical: the surface of a cylinder is
unrolled; inside the path C is a length on the surface, the last stage turns it back into degrees.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, cos, degrees, hypot, pi, radians, sin
from typing import TYPE_CHECKING

from polycnc.control.word_address.path import PLANES

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.path import Move, PathStage
    from polycnc.control.word_address.plan import Builder
    from polycnc.control.word_address.words import Words
    from polycnc.toolpath import Event

POLAR, CYLINDER = "polar_interpolation", "cylinder"
_ALLOWED_IN_POLAR = frozenset({"G1", "G2", "G3", "G4", "G9", "G13.1", "G40", "G41", "G42", "G65", "G66", "G66.1", "G67",
                               "G98", "G99"})  # fmt: skip
_FORBIDDEN_IN_CYLINDER = frozenset({"G0", "G12.1", "G27", "G28", "G29", "G30", "G50", "G52", "G53", "G54", "G55",
                                    "G56", "G57", "G58", "G59", "G90", "G92", "G94"})  # fmt: skip
_FEED_CODES = frozenset({"G1", "G2", "G3"})


@dataclass(frozen=True, slots=True)
class PolarAxes:
    """How the real axes follow a Cartesian point: the linear axis by its distance, the rotary one by its angle."""

    linear: int
    rotary: int
    start_deg: float = 0.0
    third: int = -1

    @property
    def geometry(self) -> tuple[int, int, int]:
        """Columns of the plane's axes and of the one that stands on it."""
        return self.linear, self.rotary, self.third

    def real(self, end: list[float]) -> list[float]:
        """Positions of the real axes, work coordinates: radius in mm, angle in degrees."""
        moved = list(end)
        first, second = end[self.linear], end[self.rotary]
        moved[self.linear] = hypot(first, second)
        moved[self.rotary] = self.start_deg + degrees(atan2(second, first))
        return moved

    def display(self, real: list[float]) -> list[float]:
        """The point of the plane for work coordinates of the real axes."""
        distance, angle = real[self.linear], radians(real[self.rotary] - self.start_deg)
        shown = list(real)
        shown[self.linear], shown[self.rotary] = distance * cos(angle), distance * sin(angle)
        return shown


# ---- polar -------------------------------------------------------------------------------------------------------


def start_polar(channel: Channel, words: Words) -> None:
    """G12.1 (G112): X (5460) and C (5461) become a Cartesian plane; the tool stands at angle 0."""
    memory, parameters = channel.memory, channel.memory.parameters
    linear = int(parameters.number(5460, default=1)) - 1
    rotary = int(parameters.number(5461, default=channel.axis_index.get("C", -1) + 1)) - 1
    count = len(channel.axes)
    if not (0 <= linear < count and 0 <= rotary < count) or not channel.axis_data[rotary].rotary:
        raise words.fail("polar_axes", "G12.1")
    if memory.side:
        raise words.fail("polar_code", "G12.1")
    if memory.polar is not None:
        return
    c = channel.coordinates
    memory.polar = PolarAxes(linear, rotary, c.position[rotary], c.geometry[2])
    memory.plane_before = channel.mode["plane"]
    channel.mode = channel.mode.with_code("plane", "G17")
    c.geometry = (linear, rotary, c.geometry[2])
    point = c.position[:]
    point[rotary] = 0.0
    c.arrive(point)
    channel.context_changed()


def end_polar(channel: Channel, _words: Words) -> None:
    """G13.1 (G113): X and C are axes of their own again; the former plane returns."""
    memory = channel.memory
    if memory.polar is None:
        return
    channel.flush()
    point = memory.polar.real(channel.coordinates.position)
    memory.polar = None
    channel.mode = channel.mode.with_code("plane", memory.plane_before)
    channel.coordinates.geometry = memory.basic_geometry
    channel.coordinates.arrive(point)
    channel.context_changed()


# ---- cylinder ----------------------------------------------------------------------------------------------------


def cylinder(channel: Channel, words: Words) -> None:
    """G07.1 C r (G107): C is unrolled at the radius r; r = 0 ends the mode."""
    named = words.plan.axis_words
    if len(named) != 1 or not channel.axis_data[named[0].axis].rotary:
        raise words.fail("cylinder_axis", "G7.1")
    radius = abs(words.length(named[0].address) or 0.0)
    memory = channel.memory
    if not radius:
        _end_cylinder(channel)
        return
    if memory.cylinder is not None:
        raise words.fail("cylinder_axis", "G7.1")
    if channel.mode["motion"] not in _FEED_CODES or memory.side:
        raise words.fail("cylinder_code", "G7.1")
    axis = named[0].axis
    memory.cylinder = Cylinder(axis, radius * pi / 180.0)
    u, v, _ = PLANES[channel.mode["plane"]]
    geometry = list(channel.coordinates.geometry)
    role = channel.control.axis_role(channel, axis)
    slot = role - 5 if role in (5, 6, 7) else (v if channel.mode["plane"] != "G19" else u)
    geometry[slot] = axis
    channel.coordinates.geometry = (geometry[0], geometry[1], geometry[2])
    channel.mode = channel.mode.with_code(CYLINDER, "G7.1")
    point = channel.coordinates.position[:]
    point[axis] *= memory.cylinder.mm_per_degree
    channel.coordinates.arrive(point)
    channel.flush()
    channel.table = CylinderStage(memory.cylinder, memory.table)
    memory.compensation = None
    channel.head = channel.table


def _end_cylinder(channel: Channel) -> None:
    memory = channel.memory
    if memory.cylinder is None:
        return
    channel.flush()
    point = channel.coordinates.position[:]
    point[memory.cylinder.axis] /= memory.cylinder.mm_per_degree
    channel.table = memory.table
    channel.head = None
    memory.compensation = memory.cylinder = None
    channel.coordinates.geometry = memory.basic_geometry
    channel.mode = channel.mode.with_code(CYLINDER, "")
    channel.coordinates.arrive(point)


def end_all(channel: Channel) -> None:
    """Reset: no transformation is on."""
    if channel.memory.polar is not None:
        point = channel.memory.polar.real(channel.coordinates.position)
        channel.memory.polar = None
        channel.mode = channel.mode.with_code("plane", channel.memory.plane_before)
        channel.coordinates.geometry = channel.memory.basic_geometry
        channel.coordinates.arrive(point)
    _end_cylinder(channel)


@dataclass(frozen=True, slots=True)
class Cylinder:
    """An unrolled cylinder: its axis, and the length of a degree on its surface, mm."""

    axis: int
    mm_per_degree: float


class CylinderStage:
    """The last stage of the path on a cylinder: lengths on its surface become degrees."""

    def __init__(self, cylinder: Cylinder, after: PathStage) -> None:
        self.after = after
        self._cylinder = cylinder

    def move(self, move: Move) -> None:
        """Take the next move; see `PathStage`."""
        self.after.move(replace(move, start=self._turned(move.start), end=self._turned(move.end)))

    def _turned(self, point: list[float]) -> list[float]:
        turned = list(point)
        turned[self._cylinder.axis] /= self._cylinder.mm_per_degree
        return turned

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Take an event; it keeps its place between the moves."""
        self.after.event(event, program, line, context)

    def block(self) -> None:
        """Nothing waits here."""

    def flush(self) -> None:
        """Nothing is held back here."""


# ---- blocks ------------------------------------------------------------------------------------------------------


def check_block(builder: Builder) -> None:
    """Refuse codes that a transformation does not allow."""
    control = builder.control
    motion = builder.mode["motion"]
    moves = any(control.axis_of_address(builder.channel, a, builder) for a in builder.slots)
    if builder.before[POLAR] == "G12.1":
        for row in builder.codes:
            if row.code not in _ALLOWED_IN_POLAR:
                raise control.fail("polar_code", address=row.code)
        if moves and motion not in _FEED_CODES and not any(row.axis_words for row in builder.codes):
            raise control.fail("polar_code", address=motion)
    if builder.before.codes.get(CYLINDER):
        for row in builder.codes:
            if row.code in _FORBIDDEN_IN_CYLINDER or row.group == "cycle":
                raise control.fail("cylinder_code", address=row.code)


def unroll(channel: Channel, axis: int, angle_deg: float) -> float:
    """A word of the unrolled axis as a length on the surface, mm."""
    active: Cylinder | None = channel.memory.cylinder
    return angle_deg * active.mm_per_degree if active is not None and active.axis == axis else angle_deg
