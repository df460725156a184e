"""MEASURE: what measured points say of a workpiece, its zero and its size (job planning 16.1; Function Manual FB2, M5).

A program writes what it has measured into `$A…_MEAS_…`, or latches where the axes are; `MEASURE()` works out the frame
that gives the measured place its setpoint, behind all frames that are active. What has been written counts as valid
until `$AC_MEAS_VALID` says otherwise. The manual names the function only: variables, kinds and errors are those of the
Function Manual.
"""

from __future__ import annotations

from dataclasses import field
from enum import IntEnum
from functools import partial
from math import dist, hypot, sqrt
from typing import TYPE_CHECKING, Any

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import SHOWS_DIAMETERS, diameter_function, shown
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.records import dataclass
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES, NEUTRAL, NcFrame, cfine, ctrans
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row, RowWithStop
    from polycnc.geometry.arcs import Point


class Result(IntEnum):
    """What MEASURE() gives."""

    OK = 0
    NO_TYPE = 1
    TOOL_ERROR = 2
    NO_POINT_1 = 3
    NO_POINT_2 = 4
    NO_POINT_3 = 5
    NO_DIRECTION = 8
    EQUAL_POINTS = 9
    WRONG_DIRECTION = 12


POINTS, RESULTS = 4, 10
#: Bits of $AC_MEAS_VALID: points 1 to 4, then these.
SETPOINT, TOOL, EDGE, DIRECTION, PLANE, SELECT, TYPE, FINE, MASK = 4, 7, 8, 9, 10, 11, 12, 13, 16
#: $AC_MEAS_TOOL_MASK: the radius is left out.
WITHOUT_RADIUS = 1
#: Values of $AC_MEAS_ACT_PLANE.
PLANE_CODES = ("G17", "G18", "G19")
#: Kinds of measurement by $AC_MEAS_TYPE; an edge by its geometry axis.
EDGES, HOLE, SHAFT, GROOVE, WEB = {1: 0, 2: 1, 3: 2}, 8, 9, 12, 13
KINDS = frozenset((*EDGES, HOLE, SHAFT, GROOVE, WEB))
#: Points of a hole that must differ, mm.
_SAME_MM = 1e-9
#: Factors of a frame that differ from 1 by less are rounding.
_NO_SCALE = 1e-9
_ROUNDS_OF_FIT = 10_000


@dataclass(slots=True)
class Measurement(State, lifetime=Lifetime.POWER):
    """What has been written for MEASURE, and what it has given; lengths as programs count them.

    Attributes:
        valid: What counts, as $AC_MEAS_VALID has it.
        points: Measured places by point and geometry axis.
        setpoint: Where the measured place shall be, by geometry axis.
        whole: Whole numbers by the bit that makes them valid.
        frame: $AC_MEAS_FRAME.
        diameter: $AC_MEAS_DIAMETER.
        results: $AC_MEAS_RESULTS.
    """

    valid: int = 0
    points: list[dict[int, float]] = field(default_factory=lambda: [{} for _ in range(POINTS)])
    setpoint: dict[int, float] = field(default_factory=dict)
    whole: dict[int, int] = field(default_factory=dict)
    frame: NcFrame = NEUTRAL
    diameter: float = 0.0
    results: list[float] = field(default_factory=lambda: [0.0] * RESULTS)

    def number(self, bit: int) -> int | None:
        """A whole number that counts; None for one that does not."""
        return self.whole.get(bit) if self.valid >> bit & 1 else None

    def point(self, number: int) -> dict[int, float] | None:
        """A point that counts, from 0."""
        return self.points[number] if self.valid >> number & 1 and self.points[number] else None


# ---- the function


def measure(channel: SinumerikChannel, _args: Arguments) -> int:
    """MEASURE(): work out a measurement; 0 where there is a result.

    PC0001: other kinds of measurement, a frame that is selected, axes that show diameters, and a scale, which acts on
    the points but not on the probe.
    """
    state = Measurement.of(channel)
    kind = state.number(TYPE)
    if kind is None:
        return Result.NO_TYPE
    _refuse(channel, state, kind)
    return _Calculation(channel, state).run(kind)


def _refuse(channel: SinumerikChannel, state: Measurement, kind: int) -> None:
    if kind not in KINDS:
        raise not_supported(f"$AC_MEAS_TYPE={kind}")
    if state.number(SELECT) is not None:
        raise not_supported("$AC_MEAS_FRAME_SELECT")
    if (state.number(MASK) or 0) & ~WITHOUT_RADIUS:
        raise not_supported(f"$AC_MEAS_TOOL_MASK={state.number(MASK)}")
    transverse = channel.memory.transverse
    for column in range(len(channel.axes)):
        if diameter_function(channel.mode, column, transverse) in SHOWS_DIAMETERS:
            raise not_supported("MEASURE DIAMON")
    scales = channel.memory.frames.total().scales
    if any(abs(abs(factor) - 1.0) > _NO_SCALE for factor in scales):
        raise not_supported("MEASURE SCALE")


class _Calculation:
    """One call of MEASURE()."""

    def __init__(self, channel: SinumerikChannel, state: Measurement) -> None:
        self.state, self._channel = state, channel
        code = channel.mode["plane"]
        number = state.number(PLANE)
        if number is not None:
            if not 0 <= number < len(PLANE_CODES):
                raise AlarmError("17020", text="$AC_MEAS_ACT_PLANE", index=number)
            code = PLANE_CODES[number]
        self.plane = PLANES[code]
        self._unit = INCH_MM if channel.mode["unit"] == "G700" else 1.0

    def run(self, kind: int) -> int:
        """Work it out."""
        tools = self._channel.memory.tools
        named = (self.state.number(TOOL), tools.active), (self.state.number(EDGE), tools.edge_number)
        if any(number not in (None, 0, active) for number, active in named):
            return Result.TOOL_ERROR
        if kind in EDGES:
            return self._edge(EDGES[kind])
        return self._circle(kind) if kind in (HOLE, SHAFT) else self._groove(kind)

    @property
    def radius(self) -> float:
        """Of the probe; zero where it is in the points already."""
        if (self.state.number(MASK) or 0) & WITHOUT_RADIUS:
            return 0.0
        return self._channel.memory.tools.radius / self._unit

    def _edge(self, axis: int) -> int:
        """Kinds 1 to 3: an edge square on an axis, touched in a direction."""
        point, direction = self.state.point(0), self.state.number(DIRECTION)
        if point is None or axis not in point:
            return Result.NO_POINT_1
        if direction is None:
            return Result.NO_DIRECTION
        if direction // 2 != axis:
            return Result.WRONG_DIRECTION
        sense = -1.0 if direction % 2 else 1.0
        place = point[axis] + sense * (self.radius if axis in self.plane[:2] else 0.0)
        return self._give({axis: place}, [place])

    def _circle(self, kind: int) -> int:
        """Kinds 8 and 9: a hole or a shaft by three points, or four that a circle comes nearest to."""
        u, v, w = self.plane
        points: list[Point] = []
        for number in range(POINTS):
            point = self.state.point(number)
            if point is not None and u in point and v in point:
                points.append((point[u], point[v]))
            elif number < POINTS - 1:
                return Result.NO_POINT_1 + number
        found = circle_through(points)
        if found is None:
            return Result.EQUAL_POINTS
        center, radius = found
        height = (self.state.point(0) or {}).get(w, 0.0)
        quality = sum((dist(point, center) - radius) ** 2 for point in points)
        sense = 1.0 if kind == HOLE else -1.0
        self.state.diameter = 2.0 * (radius + sense * self.radius)
        return self._give({u: center[0], v: center[1]}, [*center, height, quality])

    def _groove(self, kind: int) -> int:
        """Kinds 12 and 13: a groove or a web by a point on each of its walls."""
        direction = self.state.number(DIRECTION)
        if direction is None:
            return Result.NO_DIRECTION
        axis = direction // 2
        if not 0 <= axis < len(GEOMETRY_AXES):
            return Result.WRONG_DIRECTION
        places: list[float] = []
        for number in range(2):
            point = self.state.point(number)
            if point is None or axis not in point:
                return Result.NO_POINT_1 + number
            places.append(point[axis])
        radius = self.radius if axis in self.plane[:2] else 0.0
        width = abs(places[1] - places[0]) + (2.0 if kind == GROOVE else -2.0) * radius
        middle = 0.5 * (places[0] + places[1])
        return self._give({axis: middle}, [middle, width])

    def _give(self, places: Mapping[int, float], results: Sequence[float]) -> int:
        """Keep what has been found: the frame that gives each place its setpoint."""
        state = self.state
        setpoint = state.setpoint if state.valid >> SETPOINT & 1 else {}
        shifts = {
            GEOMETRY_AXES[axis]: (place - setpoint.get(axis, 0.0)) * self._unit
            for axis, place in places.items()
        }
        state.frame = cfine(shifts) if state.number(FINE) == 1 else ctrans(shifts)
        state.results = [*results, *[0.0] * (RESULTS - len(results))]
        return Result.OK


def circle_through(points: Sequence[Point]) -> tuple[Point, float] | None:
    """Centre and radius of the circle with the least sum of squared distances; None for points that make none.

    Three points lie on it. Else the circle of the algebraic fit goes step by step to where the distances pull evenly.
    """
    count = len(points)
    mean = (sum(x for x, _ in points) / count, sum(y for _, y in points) / count)
    rows = [(x - mean[0], y - mean[1]) for x, y in points]
    xx, xy, yy = (sum(row[i] * row[j] for row in rows) for i, j in ((0, 0), (0, 1), (1, 1)))
    determinant = xx * yy - xy * xy
    if determinant <= _SAME_MM * max(xx, yy, _SAME_MM):
        return None
    right = [sum(row[i] * (row[0] ** 2 + row[1] ** 2) for row in rows) for i in (0, 1)]
    a = 0.5 * (right[0] * yy - right[1] * xy) / determinant
    b = 0.5 * (right[1] * xx - right[0] * xy) / determinant
    radius = sqrt(a * a + b * b + (xx + yy) / count)
    for _ in range(_ROUNDS_OF_FIT if count > 3 else 0):
        ways = [(x - a, y - b, hypot(x - a, y - b)) for x, y in rows]
        if any(length <= _SAME_MM for *_, length in ways):
            return None
        radius = sum(length for *_, length in ways) / count
        cosines = sum(dx / length for dx, _, length in ways) / count
        sines = sum(dy / length for _, dy, length in ways) / count
        before, a, b = (a, b), -radius * cosines, -radius * sines
        if hypot(a - before[0], b - before[1]) <= 1e-13 * radius:
            break
    return (mean[0] + a, mean[1] + b), radius


# ---- variables


def _geometry(channel: SinumerikChannel, indices: Indices) -> int:
    """The geometry axis that an index names; PC0001 for another one."""
    column = arguments.column(channel, indices[0] if indices else None)
    if column not in channel.coordinates.geometry:
        raise not_supported(f"$AA_MEAS_…[{channel.axes[column]}]")
    return channel.coordinates.geometry.index(column)


def _place(number: int) -> Row:
    """$AA_MEAS_POINT1 to 4."""

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        return Measurement.of(channel).points[number].get(_geometry(channel, indices), 0.0)

    def write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        state = Measurement.of(channel)
        state.points[number][_geometry(channel, indices)] = value
        state.valid |= 1 << number

    return Type.REAL, read, write


def _read_setpoint(channel: SinumerikChannel, indices: Indices) -> float:
    return Measurement.of(channel).setpoint.get(_geometry(channel, indices), 0.0)


def _set_setpoint(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    state = Measurement.of(channel)
    state.setpoint[_geometry(channel, indices)] = value
    state.valid |= 1 << SETPOINT


def _whole(bit: int) -> Row:
    def read(channel: SinumerikChannel, _indices: Indices) -> int:
        return Measurement.of(channel).whole.get(bit, 0)

    def write(channel: SinumerikChannel, _indices: Indices, value: int) -> None:
        state = Measurement.of(channel)
        state.whole[bit] = value
        state.valid |= 1 << bit

    return Type.INT, read, write


def _set_valid(channel: SinumerikChannel, _indices: Indices, value: int) -> None:
    """$AC_MEAS_VALID: what has no bit is forgotten."""
    state = Measurement.of(channel)
    state.valid &= value
    for number, point in enumerate(state.points):
        if not state.valid >> number & 1:
            point.clear()
    if not state.valid >> SETPOINT & 1:
        state.setpoint.clear()


def _latch(channel: SinumerikChannel, number: int, geometry: Sequence[int], *, kept: bool) -> None:
    state = Measurement.of(channel)
    point = state.points[number]
    for axis in geometry:
        column = channel.coordinates.geometry[axis]
        if kept and column >= 0:
            point[axis] = shown(channel, column, channel.actual.work[column])
        else:
            point.pop(axis, None)
    state.valid = state.valid | 1 << number if point else state.valid & ~(1 << number)


def _set_latch(channel: SinumerikChannel, indices: Indices, value: int) -> None:
    """$AC_MEAS_LATCH[n]: 1 takes where all axes are in the work as point n+1, 0 forgets it."""
    if len(indices) != 1 or indices[0] not in range(POINTS):
        raise AlarmError("17020", text="$AC_MEAS_LATCH", index=", ".join(map(str, indices)))
    _latch(channel, indices[0], range(len(GEOMETRY_AXES)), kept=bool(value))


def _set_latch_of_axis(channel: SinumerikChannel, indices: Indices, value: int, *, number: int) -> None:
    """$AA_MEAS_P1_VALID[axis] and the like: the same of one axis."""
    axis = _geometry(channel, indices)
    _latch(channel, number, (axis,), kept=bool(value))


def _is_latched(channel: SinumerikChannel, indices: Indices, *, number: int) -> int:
    return int(_geometry(channel, indices) in Measurement.of(channel).points[number])


def _read_latch(channel: SinumerikChannel, indices: Indices) -> int:
    if len(indices) != 1 or indices[0] not in range(POINTS):
        raise AlarmError("17020", text="$AC_MEAS_LATCH", index=", ".join(map(str, indices)))
    return int(bool(Measurement.of(channel).points[indices[0]]))


def _read_frame(channel: SinumerikChannel, indices: Indices) -> Any:
    """$AC_MEAS_FRAME, or one of its components."""
    frame = Measurement.of(channel).frame
    if not indices:
        return frame
    if len(indices) != 2 or not isinstance(indices[0], Axis) or not isinstance(indices[1], str):
        raise AlarmError("12400", text="$AC_MEAS_FRAME")
    return frame.component(GEOMETRY_AXES[_geometry(channel, indices)], indices[1])


def _read_result(channel: SinumerikChannel, indices: Indices) -> float:
    if len(indices) != 1 or indices[0] not in range(RESULTS):
        raise AlarmError("17020", text="$AC_MEAS_RESULTS", index=", ".join(map(str, indices)))
    return Measurement.of(channel).results[indices[0]]


WHOLE = {
    "$AC_MEAS_TYPE": TYPE,
    "$AC_MEAS_DIR_APPROACH": DIRECTION,
    "$AC_MEAS_ACT_PLANE": PLANE,
    "$AC_MEAS_FINE_TRANS": FINE,
    "$AC_MEAS_FRAME_SELECT": SELECT,
    "$AC_MEAS_T_NUMBER": TOOL,
    "$AC_MEAS_D_NUMBER": EDGE,
    "$AC_MEAS_TOOL_MASK": MASK,
}
WORKPIECE_VARIABLES: dict[str, RowWithStop] = {
    **{f"$AA_MEAS_POINT{number + 1}": (*_place(number), False) for number in range(POINTS)},
    **{
        f"$AA_MEAS_P{number + 1}_VALID": (
            Type.INT,
            partial(_is_latched, number=number),
            partial(_set_latch_of_axis, number=number),
            True,
        )
        for number in range(POINTS)
    },
    "$AA_MEAS_SETPOINT": (Type.REAL, _read_setpoint, _set_setpoint, False),
    **{name: (*_whole(bit), False) for name, bit in WHOLE.items()},
    "$AC_MEAS_VALID": (
        Type.INT,
        lambda channel, _indices: Measurement.of(channel).valid,
        _set_valid,
        False,
    ),
    "$AC_MEAS_LATCH": (Type.INT, _read_latch, _set_latch, True),
    "$AC_MEAS_FRAME": (Type.FRAME, _read_frame, None, False),
    "$AC_MEAS_DIAMETER": (
        Type.REAL,
        lambda channel, _indices: Measurement.of(channel).diameter,
        None,
        False,
    ),
    "$AC_MEAS_RESULTS": (Type.REAL, _read_result, None, False),
}
FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], Any]] = {"MEASURE": measure}
