"""Protection zones: CPROTDEF, NPROTDEF, EXECUTE define them, CPROT and NPROT switch them (job planning 3.1, 3.2).

The blocks between xPROTDEF and EXECUTE are a contour and move nothing. While a zone is active a guard stands as the
last stage of the path: a move on which a zone of the tool would run into one of the workpiece is refused (10700 for
zones of the machine, 10701 for those of the channel). Without a zone of the tool the way of its tip is looked at.
"""

from __future__ import annotations

from itertools import pairwise
from math import inf

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Rank, Stage
from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.motion.contour_reading import (
    ContourReading,
    Readings,
    reading_from_here,
    without_away,
)
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, zones
from polycnc.geometry.planes import PLANES
from polycnc.language.sinumerik.names.frame import NcFrame
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: Kinds of zones: of the machine (NPROTDEF) and of the channel (CPROTDEF), with the alarm for running into one.
MACHINE, CHANNEL = "N", "C"
ALARMS = {MACHINE: "10700", CHANNEL: "10701"}
#: First PLC bytes that make preactivated zones effective (DB21 ff.).
PLC_BYTES = {MACHINE: 8, CHANNEL: 10}
OFF, PREACTIVE, ACTIVE, CONDITIONAL = range(4)
MAX_MOVES = 11
CHORD_ERROR_MM = 1e-4
UPPER, LOWER = 1, 2
#: Numbers of chords of an arc that the guard looks at.
PIECES = 64


@dataclass(frozen=True, slots=True)
class Zone:
    """A protection zone.

    Attributes:
        kind: MACHINE or CHANNEL.
        number: Its number.
        of_tool: It goes with the tool; else it stands on the workpiece.
        axes: Geometry axes (0 for X) of its plane, and its third axis.
        outline: Closed contour in the plane, mm; what is protected lies to its left.
        low: Lower limit along the third axis.
        high: Upper limit.
    """

    kind: str
    number: int
    of_tool: bool
    axes: tuple[int, int, int]
    outline: tuple[Point, ...]
    low: float
    high: float


@dataclass(slots=True)
class Definition:
    """A zone that is being defined, and its contour."""

    kind: str
    arguments: Arguments
    contour: ContourReading


@dataclass(slots=True)
class Protection(State, lifetime=Lifetime.POWER):
    """The zones of a channel.

    Attributes:
        zones: Definitions by kind and number; those of the machine are shared by all channels.
        states: State and offset of each zone that is not off.
        open: The zone that is being defined.
    """

    zones: dict[tuple[str, int], Zone] = field(default_factory=dict)
    states: dict[tuple[str, int], tuple[int, tuple[float, float, float]]] = field(default_factory=dict)
    open: Definition | None = lasting(Lifetime.RESET, None)

    @classmethod
    def first(cls, channel: Channel) -> Protection:
        """The zones of the machine, which all channels share; none is on."""
        shared = channel.group.shared if channel.group is not None else {}
        return cls(shared.setdefault("protection zones", {}))

    def placed(
        self, channel: SinumerikChannel, *, preactive: bool = False
    ) -> Iterator[tuple[Zone, tuple[float, ...]]]:
        """Zones that are effective with their offsets; with `preactive` those that only wait for the PLC."""
        for (kind, number), (state, offset) in self.states.items():
            signal = _plc_signal(channel, kind, number)
            effective = state == ACTIVE or (state in (PREACTIVE, CONDITIONAL) and signal)
            if effective is not preactive:
                yield self.zones[kind, number], offset


def _plc_signal(channel: SinumerikChannel, kind: str, number: int) -> bool:
    byte, bit = divmod(number - 1, 8)
    name = f"DB{20 + channel.number}.DBX{PLC_BYTES[kind] + byte}.{bit}"
    return bool(channel.setup.switches.plc.get(name))


# ---- definition


def begin(kind: str) -> Callable[[SinumerikChannel, Arguments], None]:
    """CPROTDEF, NPROTDEF(n, of the tool, limits, upper, lower): the contour blocks follow."""

    def run(channel: SinumerikChannel, args: Arguments) -> None:
        if not 2 <= len(args) <= 5 or any(arg is None for arg in args[:2]):
            raise AlarmError("14020", text=f"{kind}PROTDEF")
        arguments.whole(args[0])
        state = Protection.of(channel)
        memory = channel.memory
        if Readings.of(channel).open:
            raise AlarmError("PC0009", text=f"{kind}PROTDEF")
        if channel.mode["compensation"] != "G40":
            raise AlarmError("PC0009", text=channel.mode["compensation"])
        if _is_shifted(memory.frames.total()):
            raise AlarmError("PC0009", text="FRAME")
        contour = reading_from_here(channel, keeps_modes=False)
        state.open = Definition(kind, args, contour)
        contour.begin(channel, channel.coordinates.geometry)

    return run


def _is_shifted(frame: NcFrame) -> bool:
    return not frame.frame.is_identity or any(part.coarse + part.fine for part in frame.others.values())


def execute(channel: SinumerikChannel, _args: Arguments) -> None:
    """EXECUTE: the zone is defined; position, path and feed are as before."""
    definition = Protection.of(channel).open
    if definition is None:
        raise AlarmError("14020", text="EXECUTE")
    zone = _zone(channel, definition, _leave(channel, definition))
    Protection.of(channel).zones[zone.kind, zone.number] = zone


def _leave(channel: SinumerikChannel, definition: Definition) -> list[Move]:
    """A definition ends: position, path and feed are as before it. Gives its moves."""
    Protection.of(channel).open = None
    return definition.contour.end(channel)


def check_end(channel: SinumerikChannel) -> None:
    """PC0009: the program ends while a zone is being defined."""
    definition = Protection.of(channel).open
    if definition is not None:
        _leave(channel, definition)
        raise AlarmError("PC0009", text="M30")


def _zone(channel: SinumerikChannel, definition: Definition, moves: list[Move]) -> Zone:
    number, of_tool, sides, upper, lower = (*definition.arguments, None, None, None)[:5]
    axes = PLANES[channel.mode["plane"]]
    outline = _outline(channel, moves, axes)
    name = f"{definition.kind}PROTDEF({number})"
    sides = arguments.whole(sides or 0)
    if not 0 <= sides <= (UPPER | LOWER) or arguments.whole(number) < 1:
        raise AlarmError("14020", text=name)
    counter_clockwise = zones.area(outline) > 0.0
    if of_tool and not (counter_clockwise and zones.is_convex(outline)):
        raise AlarmError("PC0010", text=name)
    if of_tool and any(_sense(move) == "G2" for move in moves):
        raise AlarmError("PC0010", text=f"{name} G2")
    low = arguments.real(lower or 0.0) if sides & LOWER else -inf
    high = arguments.real(upper or 0.0) if sides & UPPER else inf
    return Zone(definition.kind, int(number), bool(of_tool), axes, tuple(outline), low, high)


def _sense(move: Move) -> str:
    if move.center is None:
        return "G1"
    return "G3" if move.kind in CCW_KINDS else "G2"


def _outline(channel: SinumerikChannel, moves: list[Move], axes: tuple[int, int, int]) -> list[Point]:
    """The closed contour of the moves; PC0010 where it is none."""
    if not len(moves) + 1 >= 4 or len(moves) > MAX_MOVES:
        raise AlarmError("PC0010", text=str(len(moves)))
    geometry = channel.coordinates.geometry
    outline = [_point(moves[0].end, geometry, axes)]
    for before, move in pairwise(moves):
        end = _point(move.end, geometry, axes)
        if {_sense(before), _sense(move)} == {"G2", "G3"}:
            raise AlarmError("PC0010", text="G2 G3")
        if move.center is not None:
            center = move.center[axes[0]], move.center[axes[1]]
            ccw = _sense(move) == "G3"
            sweep = abs(arcs.sweep_angle(outline[-1], end, center, ccw))
            radius = arcs.radius_of(center, outline[-1])
            parts = arcs.parts_for_chord_error(radius, sweep, CHORD_ERROR_MM)
            outline += arcs.split(outline[-1], end, center, ccw, parts)[:-1]
        outline.append(end)
    if any(abs(a - b) > 1e-3 for a, b in zip(outline[0], outline[-1], strict=True)):
        raise AlarmError("PC0010", text="X Y Z")
    outline[-1] = outline[0]
    return outline


def _point(position: list[float], geometry: tuple[int, ...], axes: tuple[int, int, int]) -> Point:
    """A position in the plane; an axis that the first block does not name stays where the tool stands."""
    u, v = (position[geometry[axis]] if geometry[axis] >= 0 else 0.0 for axis in axes[:2])
    return without_away(u), without_away(v)


# ---- activation


def switch(kind: str) -> Callable[[SinumerikChannel, Arguments], None]:
    """CPROT, NPROT(n, state, x, y, z)."""

    def run(channel: SinumerikChannel, args: Arguments) -> None:
        if not 2 <= len(args) <= 5:
            raise AlarmError("14020", text=f"{kind}PROT")
        number, state = arguments.whole(args[0]), arguments.whole(args[1])
        found = Protection.of(channel)
        key = kind, number
        if state not in range(4) or key not in found.zones:
            raise AlarmError("14020", text=f"{kind}PROT({number},{state})")
        offset = [arguments.real(arg or 0.0) for arg in (*args[2:], 0.0, 0.0, 0.0)[:3]]
        channel.flush()
        found.states.pop(key, None)
        if state != OFF:
            found.states[key] = state, (offset[0], offset[1], offset[2])
        _guard(channel, bool(found.states))

    return run


def deselect(channel: SinumerikChannel) -> None:
    """No zone is active: a transformation is selected (job planning 6.10)."""
    Protection.of(channel).states.clear()
    _guard(channel, wanted=False)


def _guard(channel: SinumerikChannel, wanted: bool) -> None:
    """Put the guard into the path, or take it out."""
    if not wanted:
        channel.path.take(Guard)
    elif channel.path.find(Guard) is None:
        channel.path.put(Guard(channel))


class Guard(Stage):
    """Refuses moves into zones while any are active."""

    rank = Rank.ZONES
    lasts = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel

    def move(self, move: Move) -> None:
        """Pass a move on; 10700 or 10701 for one that leads into a zone."""
        channel = self._channel
        way = MovePath(move, channel.coordinates.geometry)
        parts = [k / PIECES for k in range(PIECES + 1)] if move.is_arc else [0.0, 1.0]
        points = [channel.coordinates.to_machine(way.at(part)) for part in parts]
        placed = list(Protection.of(channel).placed(channel))
        for start, end in pairwise(points):
            found = contact(channel, placed, start, end)
            if found is not None and found[0] < 1.0:
                self._refuse(move, found[1])
        self.after.move(move)

    def _refuse(self, move: Move, zone: Zone) -> None:
        channel = self._channel
        here = channel.level.line_of(channel.level.current)
        if move.line == here:
            raise AlarmError(ALARMS[zone.kind], number=zone.number)
        raise AlarmError(ALARMS[zone.kind], line=move.line, program=move.program, number=zone.number)


def is_watched(channel: SinumerikChannel) -> bool:
    """Whether any zone is on."""
    return bool(Protection.of(channel).states)


def comes_near(channel: SinumerikChannel, start: list[float], end: list[float], distance: float) -> bool:
    """Whether a straight way of the machine's axes comes nearer than a distance to a contact with any zone."""
    placed = list(Protection.of(channel).placed(channel))
    found = contact(channel, placed, start, end, distance)
    return found is not None and found[0] <= 1.0


Placed = list[tuple[Zone, tuple[float, ...]]]


def contact(
    channel: SinumerikChannel, placed: Placed, start: list[float], end: list[float], beside: float = 0.0
) -> tuple[float, Zone] | None:
    """The part of a straight way of the machine's axes at which a zone is first run into, and that zone.

    Parts above 1 are contacts behind the end. None where the way leads into no zone. What goes with the tool may count
    as larger, by some mm `beside` it on all sides.
    """
    geometry = channel.coordinates.geometry
    a, b = ([point[i] if i >= 0 else 0.0 for i in geometry] for point in (start, end))
    tools = [(zone, offset) for zone, offset in placed if zone.of_tool]
    best: tuple[float, Zone] | None = None
    for zone, offset in placed:
        if zone.of_tool:
            continue
        for part in _contacts(channel, zone, offset, tools, (a, b), beside):
            if best is None or part < best[0]:
                best = part, zone
    return best


def _contacts(
    channel: SinumerikChannel,
    zone: Zone,
    offset: tuple[float, ...],
    tools: Placed,
    ends: tuple[list[float], list[float]],
    beside: float,
) -> Iterator[float]:
    """Contacts of everything that goes with the tool with one zone of the workpiece."""
    i, j, k = zone.axes
    a, b = ends
    region = zones.moved(zone.outline, (offset[i], offset[j]))
    low, high = zone.low + offset[k], zone.high + offset[k]
    way = [y - x for x, y in zip(a, b, strict=True)]
    if not tools:
        lengths = channel.memory.tools.lengths
        tip = [x - length for x, length in zip(a, lengths, strict=True)]
        body = zones.grown([(tip[i], tip[j])], beside), -beside, beside
        yield from _first(body, tip[k], (region, low, high), (way[i], way[j], way[k]))
        return
    for tool, shift in tools:
        if tool.axes != zone.axes:
            raise AlarmError("PC0010", text=f"{tool.kind}{tool.number} {zone.kind}{zone.number} G17 G18 G19")
        outline = zones.grown(zones.moved(tool.outline, (a[i] + shift[i], a[j] + shift[j])), beside)
        body = outline, tool.low + shift[k] - beside, tool.high + shift[k] + beside
        yield from _first(body, a[k], (region, low, high), (way[i], way[j], way[k]))


Body = tuple[list["Point"], float, float]


def _first(body: Body, height: float, region: Body, way: tuple[float, float, float]) -> Iterator[float]:
    """The first contact of a moving prism with a standing one, if there is any."""
    outline, bottom, top = body
    contour, low, high = region
    begin, end = _common(height + bottom, height + top, low, high, way[2])
    if begin >= end:
        return
    shifted = zones.moved(outline, (way[0] * begin, way[1] * begin))
    part = zones.first_contact(shifted, contour, (way[0], way[1]))
    if part is not None and begin + part < end:
        yield begin + part


def _common(bottom: float, top: float, low: float, high: float, rise: float) -> tuple[float, float]:
    """The parts of a way between which two ranges overlap, one of them rising."""
    slack = zones.TOUCH_MM
    if abs(rise) < slack:
        is_common = top > low + slack and bottom < high - slack
        if top == bottom:
            is_common = low + slack < top < high - slack
        return (0.0, inf) if is_common else (0.0, 0.0)
    parts = sorted(((low - top) / rise, (high - bottom) / rise))
    return max(parts[0], 0.0), parts[1]


PROCEDURES = {
    "CPROTDEF": begin(CHANNEL),
    "NPROTDEF": begin(MACHINE),
    "CPROT": switch(CHANNEL),
    "NPROT": switch(MACHINE),
}
