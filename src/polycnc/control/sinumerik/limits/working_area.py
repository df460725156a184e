"""Software limit switches and working areas: ways beyond them raise an alarm before anything moves.

The working area is that of the tool tip, in the basic system; with MD21020 the tool's radius belongs to it. Source:
Fundamentals (G25, G26, WALIMON, WALIMOF; WALCS0 to WALCS10), machine data 36100 and 36110, setting data 43400 to 43430,
`$P_WORKAREA_CS_…`.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.moves.path import Move
from polycnc.channel.moves.travel import Travel, walls_between
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import gcodes
from polycnc.control.sinumerik.variables.row import Indices, Row
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.moves.travel import Wall
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Frame
    from polycnc.toolpath import Context

SWITCH, WORKING_AREA, WORK_SYSTEM_AREA = "10720", "10730", "10735"
_SLACK = 1e-6
#: Data that limits are made of.
DATA = frozenset(
    (
        "$SA_WORKAREA_PLUS_ENABLE",
        "$SA_WORKAREA_MINUS_ENABLE",
        "$SA_WORKAREA_LIMIT_PLUS",
        "$SA_WORKAREA_LIMIT_MINUS",
    )
)


#: Coordinate systems: the machine's, the basic one of the tool tip, and those of $P_WORKAREA_CS_COORD_SYSTEM, workpiece
#: and settable zero.
MACHINE, WORK, BASIC, SETTABLE = range(4)
GROUPS = range(1, 11)
AREA = "$P_WORKAREA_CS_"


class Limit(NamedTuple):
    """The range of an axis in one of the coordinate systems, and the alarm for a target outside it."""

    column: int
    low: float
    high: float
    alarm: str
    system: int = MACHINE


@dataclass(slots=True)
class Ranges(State, lifetime=Lifetime.POWER):
    """The ranges that moves must stay in."""

    limits: tuple[Limit, ...] = ()

    def check(self, channel: SinumerikChannel, travel: Travel) -> None:
        """Refuse a way beyond a limit: 10720 for a software limit switch, 10730 and 10735 for working areas.

        The whole way counts, and that of the tool's middle where radius compensation acts.
        """
        points = {
            system: _points(channel, travel, system) for system in {each.system for each in self.limits}
        }
        for limit in self.limits:
            margin = radius_beside(channel, limit, travel.context.plane)
            for point in points[limit.system][1:]:
                _check(channel, limit, point[limit.column], margin)

    def walls(self, channel: SinumerikChannel, context: Context) -> Iterator[Wall]:
        """All the ranges, for rows without a transformation."""
        for limit in self.limits:
            margin = radius_beside(channel, limit, context.plane)
            frame, shift = _system(channel, limit.system, context)
            sides = [(limit.column, limit.low + margin, limit.high - margin)]
            yield from walls_between(channel, frame, shift, sides)

    def comes_near(
        self, _channel: SinumerikChannel, _start: list[float], _end: list[float], _distance: float
    ) -> bool:
        """Nothing else is forbidden."""
        return False


def refresh(channel: SinumerikChannel) -> None:
    """Work out the limits that hold now; only those that setup or program gave a value."""
    data = channel.memory.data
    limits = []
    for column, name in enumerate(channel.axes):
        limits.append(Limit(column, *switches(channel, column), SWITCH))
        if channel.mode["working_area"] == "WALIMON":
            below, above = (
                bool(data.number(f"$SA_WORKAREA_{side}_ENABLE", name)) for side in ("MINUS", "PLUS")
            )
            low = data.number("$SA_WORKAREA_LIMIT_MINUS", name) if below else -inf
            high = data.number("$SA_WORKAREA_LIMIT_PLUS", name) if above else inf
            limits.append(Limit(column, low, high, WORKING_AREA, BASIC))
    limits += _of_work_system(channel)
    ranges = Ranges.of(channel)
    ranges.limits = tuple(limit for limit in limits if limit.low > -inf or limit.high < inf)
    channel.boundary = ranges if ranges.limits else None


def switches(channel: SinumerikChannel, column: int) -> tuple[float, float]:
    """The software limit switches of an axis; those alone that setup or program gave a value."""
    data, name = channel.memory.data, channel.axes[column]
    minus, plus = (f"$MA_POS_LIMIT_{side}{_pair(channel, column, side)}" for side in ("MINUS", "PLUS"))
    return (
        data.number(minus, name) if data.is_set(minus, name) else -inf,
        data.number(plus, name) if data.is_set(plus, name) else inf,
    )


def _of_work_system(channel: SinumerikChannel) -> list[Limit]:
    """WALCS1 to WALCS10: the ranges of a group, in the system that the group names."""
    values = Stored.of(channel).values
    group = gcodes.number_of(channel.mode["working_area_wcs"]) - 1
    if group == 0:
        return []
    limits = []
    for column in range(len(channel.axes)):
        low, high = (
            float(values.get((f"{AREA}LIMIT_{side}", (group, column)), 0.0))
            if values.get((f"{AREA}{side}_ENABLE", (group, column)), False)
            else beyond
            for side, beyond in (("MINUS", -inf), ("PLUS", inf))
        )
        system = int(values.get((f"{AREA}COORD_SYSTEM", (group,)), WORK))
        limits.append(Limit(column, low, high, WORK_SYSTEM_AREA, system))
    return limits


def _area(name: str, type_: Type, *, of_axis: bool) -> Row:
    """A variable of the working areas in the workpiece system: by group, and by axis."""

    def place(channel: SinumerikChannel, indices: Indices) -> tuple[int, ...]:
        if len(indices) != 1 + of_axis:
            raise AlarmError("12400", text=name)
        group = arguments.whole(indices[0])
        if group not in GROUPS:
            raise AlarmError("17020", text=name, index=group)
        return (group, arguments.column(channel, indices[1])) if of_axis else (group,)

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        empty = {Type.BOOL: False, Type.INT: WORK}.get(type_, 0.0)
        return Stored.of(channel).values.get((name, place(channel, indices)), empty)

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        if name.endswith("COORD_SYSTEM") and value not in (WORK, SETTABLE):
            raise AlarmError("12560", text=name)
        Stored.of(channel).values[name, place(channel, indices)] = value
        refresh(channel)

    return type_, read, write


AREA_VARIABLES: dict[str, Row] = {
    f"{AREA}COORD_SYSTEM": _area(f"{AREA}COORD_SYSTEM", Type.INT, of_axis=False),
    **{
        f"{AREA}{name}": _area(f"{AREA}{name}", type_, of_axis=True)
        for side in ("PLUS", "MINUS")
        for name, type_ in ((f"{side}_ENABLE", Type.BOOL), (f"LIMIT_{side}", Type.REAL))
    },
}


def _pair(channel: SinumerikChannel, column: int, side: str) -> str:
    """Which of the two limit switches the PLC has chosen: nothing for the first, `2` for the second."""
    bit = {"MINUS": 2, "PLUS": 3}[side]
    return "2" if channel.setup.switches.plc.get(f"DB{31 + column}.DBX12.{bit}") else ""


def check_target(channel: SinumerikChannel, end: list[float]) -> None:
    """The same for a positioning axis, which goes to a target beside the path."""
    start = channel.coordinates.position
    if channel.boundary is not None:
        channel.boundary.check(
            channel, Travel(channel, Move(Kind.FEED, start, end, context=channel.context_number()))
        )


def radius_beside(channel: SinumerikChannel, limit: Limit, plane: str) -> float:
    """How far the tool tip must stay inside a limit: its radius in the plane, for working areas with MD21020."""
    if limit.alarm == SWITCH or not channel.memory.data.number("$MC_WORKAREA_WITH_TOOL_RADIUS"):
        return 0.0
    geometry = channel.coordinates.geometry
    return channel.memory.tools.radius if limit.column in (geometry[i] for i in PLANES[plane][:2]) else 0.0


def _system(channel: SinumerikChannel, system: int, context: Context) -> tuple[Frame, tuple[float, ...]]:
    """Where positions lead to the system of a limit: a frame, and a shift behind it (empty for none).

    The basic system is that of the tool's tip, but for axes beside X, Y and Z, which have no tip.
    """
    offsets = context.offsets
    if system == BASIC:
        geometry = channel.coordinates.geometry
        offsets = tuple(0.0 if column in geometry else by for column, by in enumerate(offsets))
    frame = {WORK: IDENTITY, SETTABLE: context.part}.get(system, context.frame)
    return frame, offsets if system in (MACHINE, BASIC) else ()


def _points(channel: SinumerikChannel, travel: Travel, system: int) -> list[list[float]]:
    """Points of a way in the system of a limit, each with all at which a coordinate turns back."""
    context = travel.context
    if system == MACHINE or (system == BASIC and context.transformation is not None):
        return travel.machine
    frame, shift = _system(channel, system, context)
    points = [list(channel.coordinates.image(frame, point)) for point in travel.turns(frame)]
    return [[at + by for at, by in zip(point, shift, strict=True)] for point in points] if shift else points


def _check(channel: SinumerikChannel, limit: Limit, value: float, margin: float) -> None:
    if not limit.low + margin - _SLACK <= value <= limit.high - margin + _SLACK:
        side = "-" if value < limit.low + margin else "+"
        raise AlarmError(limit.alarm, axis=channel.axes[limit.column], side=side)
