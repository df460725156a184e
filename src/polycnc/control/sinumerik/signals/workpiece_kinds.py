"""What MEASURE works out of measured points, kind by kind (Function Manual FB2, M5)."""

from __future__ import annotations

from math import acos, asin, atan2, cos, degrees, dist, hypot, radians, sin, sqrt

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.frames.memory import AFTER_PROGRAMMABLE, AFTER_SETTABLE, BEFORE_BASE, chain
from polycnc.control.sinumerik.signals.workpiece_memory import POINTS, RESULTS, Bit, Measurement, Result
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM
from polycnc.geometry.vectors import cross, minus
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES, NEUTRAL, cfine, crot, ctrans
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.frames.memory import Frames
    from polycnc.control.sinumerik.signals.workpiece_memory import AxisKey
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector
    from polycnc.language.sinumerik.names.frame import NcFrame

#: Bits of $AC_MEAS_TOOL_MASK: the radius, the length is left out; it counts in conversions.
WITHOUT_RADIUS, WITHOUT_LENGTH, LENGTH_IN_CONVERSION = 1, 0x10, 0x20
#: Values of $AC_MEAS_ACT_PLANE.
PLANE_CODES = ("G17", "G18", "G19")
#: Kinds of measurement by $AC_MEAS_TYPE; an edge by its geometry axis.
EDGES, HOLE, SHAFT, GROOVE, WEB = {1: 0, 2: 1, 3: 2}, 8, 9, 12, 13
CORNERS, TOOL_LENGTH, TOOL_DIAMETER = frozenset((4, 5, 6, 7)), 10, 11
PRESET, PRESET_BESIDE, SLANTED, TILTED, CONVERSION = 14, 15, 16, 17, 24
KINDS = frozenset(
    (
        *EDGES, *CORNERS, HOLE, SHAFT, TOOL_LENGTH, TOOL_DIAMETER, GROOVE, WEB, PRESET, PRESET_BESIDE, SLANTED, TILTED,
        CONVERSION,
    )
)  # fmt: skip
#: Systems of $AC_MEAS_P1_COORD and $AC_MEAS_P2_COORD.
WORK, BASIC, MACHINE = 0, 1, 2
#: Names of what is found.
DIAMETER, WP_ANGLE, CORNER_ANGLE = "$AC_MEAS_DIAMETER", "$AC_MEAS_WP_ANGLE", "$AC_MEAS_CORNER_ANGLE"
LENGTH_OF_TOOL, DIAMETER_OF_TOOL = "$AC_MEAS_TOOL_LENGTH", "$AC_MEAS_TOOL_DIAMETER"
FOUND = (DIAMETER, WP_ANGLE, CORNER_ANGLE, LENGTH_OF_TOOL, DIAMETER_OF_TOOL)
#: Values of $AC_MEAS_FRAME_SELECT: from, to, and the active frame that they name; stored ones are so much higher.
STORED, WITH_G500, ANY = 2000, (1, 3), -1
SELECTIONS = (
    (0, 0, "$P_SETFRAME"), (1, 1, "$P_PARTFRAME"), (2, 2, "$P_EXTFRAME"), (10, 25, "CHBFRAME"), (50, 65, "NCBFRAME"),
    (100, 199, "IFRAME"), (500, 500, "$P_TOOLFRAME"), (501, 501, "$P_WPFRAME"), (502, 502, "$P_TRAFRAME"),
    (503, 503, "$P_PFRAME"), (504, 504, "$P_CYCFRAME"),
)  # fmt: skip
#: Points that must differ, mm; angles that are equal.
_SAME_MM, _SAME_PLACE_MM, _SAME_ANGLE_DEG = 1e-9, 1e-6, 1e-6
_ROUNDS_OF_FIT = 10_000


class Calculation:
    """One call of MEASURE()."""

    def __init__(self, channel: SinumerikChannel, state: Measurement) -> None:
        self.state, self._channel = state, channel
        code = channel.mode["plane"]
        number = state.number(Bit.PLANE)
        if number is not None:
            if not 0 <= number < len(PLANE_CODES):
                raise AlarmError("17020", text="$AC_MEAS_ACT_PLANE", index=number)
            code = PLANE_CODES[number]
        self.plane = PLANES[code]
        self._unit = INCH_MM if channel.mode["unit"] == "G700" else 1.0

    def run(self, kind: int) -> int:
        """Work it out."""
        tools = self._channel.memory.tools
        named = (self.state.number(Bit.TOOL), tools.active), (self.state.number(Bit.EDGE), tools.edge_number)
        if any(number not in (None, 0, active) for number, active in named):
            return Result.TOOL_ERROR
        if kind in EDGES:
            return self._edge(EDGES[kind])
        if kind in (HOLE, SHAFT):
            return self._circle(kind)
        if kind in (GROOVE, WEB):
            return self._groove(kind)
        others = {
            SLANTED: self._slanted, TILTED: self._tilted, PRESET: self._preset, PRESET_BESIDE: self._preset,
            CONVERSION: self._conversion,
        }  # fmt: skip
        if kind in others:
            return others[kind](kind)
        return self._corner() if kind in CORNERS else self._tool(kind)

    @property
    def radius(self) -> float:
        """Of the probe; zero where it is in the points already."""
        if (self.state.number(Bit.MASK) or 0) & WITHOUT_RADIUS:
            return 0.0
        return self._channel.memory.tools.radius / self._unit

    def _edge(self, axis: int) -> int:
        """Kinds 1 to 3: an edge square on an axis, touched in a direction."""
        point, direction = self.state.point(0), self.state.number(Bit.DIRECTION)
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
        self.state.found[DIAMETER] = 2.0 * (radius + sense * self.radius)
        return self._give({u: center[0], v: center[1]}, [*center, height, quality])

    def _groove(self, kind: int) -> int:
        """Kinds 12 and 13: a groove or a web by a point on each of its walls."""
        direction = self.state.number(Bit.DIRECTION)
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

    def _corner(self) -> int:
        """Kinds 4 to 7: an outer corner by two points on each of its edges; given angles stand for points 2 and 4."""
        u, v, w = self.plane
        alpha, phi = self.state.angle(Bit.SETANGLE), self.state.angle(Bit.CORNER_SETANGLE)
        if alpha is not None and not -90.0 < alpha < 180.0:
            return Result.WRONG_ANGLE
        if phi is not None and not 0.0 < phi < 180.0:
            return Result.WRONG_CORNER
        points: list[Point | None] = []
        for number, needed in enumerate((True, alpha is None, True, phi is None)):
            point = self.state.point(number) or {}
            if needed and not {u, v} <= point.keys():
                return Result.NO_POINT_1 + number
            points.append((point[u], point[v]) if needed else None)
        first = given_direction(alpha) if alpha is not None else direction_of(points[0], points[1])
        if first is None:
            return Result.EQUAL_POINTS
        if phi is None and direction_of(points[2], points[3]) is None:
            return Result.EQUAL_POINTS
        found = corners_of(points, first, phi)
        if not found:
            return Result.NO_CROSSING
        if any(dist(place, found[0][0]) > _SAME_PLACE_MM for place, *_ in found):
            raise not_supported("$AC_MEAS_CORNER_SETANGLE")  # on either side of the points
        place, first, second = found[0]
        angle = line_angle(first) if alpha is None else alpha
        inwards = self.radius / abs(first[0] * second[1] - first[1] * second[0])
        a, b = (at + inwards * (one + two) for at, one, two in zip(place, first, second, strict=True))
        self.state.found[WP_ANGLE] = angle
        self.state.found[CORNER_ANGLE] = degrees(acos(first[0] * second[0] + first[1] * second[1]))
        turned = crot({GEOMETRY_AXES[w]: angle})
        return self._give({u: a, v: b}, [a, b, (self.state.point(0) or {}).get(w, 0.0)], turned)

    def _slanted(self, _kind: int) -> int:
        """Kind 16: an edge by two points; the frame turns until it has its angle (setpoint, else along the axis)."""
        u, v, w = self.plane
        places: list[Point] = []
        for number in range(2):
            point = self.state.point(number) or {}
            if not {u, v} <= point.keys():
                return Result.NO_POINT_1 + number
            places.append((point[u], point[v]))
        along = direction_of(*places)
        if along is None:
            return Result.EQUAL_POINTS
        by_ordinate = bool(self.state.inputs.get(0, 0.0))
        angle = line_angle((along[1], -along[0]) if by_ordinate else along)
        asked = self.state.setangles if self.state.valid >> Bit.SETANGLES & 1 else {}
        wanted = asked.get(w, next(iter(asked.values()), 0.0))
        self.state.found[WP_ANGLE] = angle
        return self._give({}, [], crot({GEOMETRY_AXES[w]: angle - wanted}))

    def _tilted(self, _kind: int) -> int:
        """Kind 17: a plane by three points; the frame turns about abscissa and ordinate until it is level."""
        places: list[Vector] = []
        for number in range(3):
            point = self.state.point(number) or {}
            if not {0, 1, 2} <= point.keys():
                return Result.NO_POINT_1 + number
            places.append((point[0], point[1], point[2]))
        a, b, c = places
        normal = cross(minus(b, a), minus(c, a))
        if max(map(abs, normal)) <= _SAME_MM:
            return Result.NO_PLANE
        u, v, w = self.plane
        size = sqrt(sum(each * each for each in normal)) * (1.0 if normal[w] >= 0.0 else -1.0)
        first, second = tilt([each / size for each in normal], w)
        return self._give({}, [first, second, 0.0], crot({GEOMETRY_AXES[u]: first, GEOMETRY_AXES[v]: second}))

    def _preset(self, kind: int) -> int:
        """Kinds 14 and 15: axes are called by their setpoints where they are; of 15 none of the geometry."""
        point = self.state.point(0) or {}
        places = {axis: at for axis, at in point.items() if isinstance(axis, str) or kind == PRESET}
        if not places:
            return Result.NO_POINT_1
        return self._give(places, [])

    def _conversion(self, _kind: int) -> int:
        """Kind 24: the first point in another system (work, basic, machine) becomes the second point."""
        systems = [self.state.number(bit) or 0 for bit in (Bit.FROM, Bit.TO)]
        point = self.state.point(0) or {}
        if not {0, 1, 2} <= point.keys():
            return Result.NO_POINT_1
        channel, found = self._channel, {axis: at for axis, at in point.items() if isinstance(axis, int)}
        frame = channel.memory.frames.total().frame
        place = [found[axis] * self._unit for axis in range(3)]
        # Without a transformation the axes of the basic system are those of the machine, beside the tool.
        counts = (self.state.number(Bit.MASK) or 0) & LENGTH_IN_CONVERSION
        lengths = channel.memory.tools.lengths if counts else (0.0, 0.0, 0.0)
        if systems[0] == MACHINE:
            place = [at - length for at, length in zip(place, lengths, strict=True)]
        if systems[0] != WORK and systems[1] == WORK:
            place = list(frame.inverse().apply(*place))
        elif systems[0] == WORK and systems[1] != WORK:
            place = list(frame.apply(*place))
        if systems[1] == MACHINE:
            place = [at + length for at, length in zip(place, lengths, strict=True)]
        self.state.points[1] = {axis: at / self._unit for axis, at in enumerate(place)}
        self.state.valid |= 2
        return Result.OK

    def _tool(self, kind: int) -> int:
        """Kinds 10 and 11: length of the tool along the approach, or its diameter, by an edge whose place is known."""
        point, direction = self.state.point(0) or {}, self.state.number(Bit.DIRECTION)
        if direction is None:
            return Result.NO_DIRECTION
        axis = direction // 2
        if not 0 <= axis < len(GEOMETRY_AXES):
            return Result.WRONG_DIRECTION
        if axis not in point:
            return Result.NO_POINT_1
        setpoint = self.state.setpoint if self.state.valid >> Bit.SETPOINT & 1 else {}
        way = point[axis] - setpoint.get(axis, 0.0)
        results = [0.0] * RESULTS
        if kind == TOOL_DIAMETER:
            self.state.found[DIAMETER_OF_TOOL] = 2.0 * abs(way)
        else:
            without = (self.state.number(Bit.MASK) or 0) & WITHOUT_LENGTH
            own = 0.0 if without else self._channel.memory.tools.lengths[axis] / self._unit
            self.state.found[LENGTH_OF_TOOL] = results[axis] = own + way
        self.state.results = results
        return Result.OK

    def _give(
        self, places: Mapping[AxisKey, float], results: Sequence[float], turned: NcFrame = NEUTRAL
    ) -> int:
        """Keep what has been found: the frame that gives each place its setpoint, turned where the work is."""
        state = self.state
        asked = state.setpoint if state.valid >> Bit.SETPOINT & 1 else {}
        setpoint = [asked.get(axis, 0.0) if axis in places else 0.0 for axis in range(len(GEOMETRY_AXES))]
        led = turned.frame.apply(*setpoint)
        shifts = {
            GEOMETRY_AXES[axis] if isinstance(axis, int) else axis: (
                place - (led[axis] if isinstance(axis, int) else asked.get(axis, 0.0))
            )
            * self._unit
            for axis, place in places.items()
        }
        own = (cfine(shifts) if state.number(Bit.FINE) == 1 else ctrans(shifts)) @ turned
        number = state.number(Bit.SELECT)
        if number is not None:
            selected = Selected.of(self._channel.memory.frames, number)
            if selected is None:
                return Result.WRONG_FRAME
            own = selected.with_addition(own)
        state.frame = own
        state.results = [*results, *[0.0] * (RESULTS - len(results))]
        return Result.OK


class Selected(NamedTuple):
    """A frame of the chain that takes what has been found into itself.

    Attributes:
        active: The frame as it acts now in its place.
        behind: The frames between it and the work.
    """

    active: NcFrame
    behind: NcFrame

    @classmethod
    def of(cls, frames: Frames, number: int) -> Selected | None:
        """The frame that a value of $AC_MEAS_FRAME_SELECT names, active or stored; None for one that is not there.

        Raises:
            AlarmError: PC0001 for frames that shall act with G500.
        """
        if number // 1000 in WITH_G500:
            raise not_supported(f"$AC_MEAS_FRAME_SELECT={number}")
        value = number % STORED
        name, index = next(
            ((name, value - low) for low, high, name in SELECTIONS if low <= value <= high), ("", 0)
        )
        chained = _chained(frames)
        place = next(
            (i for i, (key, at, _) in enumerate(chained) if key == name and at in (index, ANY)), None
        )
        if place is None or number >= STORED + 1000:
            return None
        return cls(chained[place][2], chain([frame for _, _, frame in chained[place + 1 :]]))

    def with_addition(self, own: NcFrame) -> NcFrame:
        """What the frame must be so that `own` stands behind all frames."""
        if self.behind is NEUTRAL:
            return self.active @ own
        return self.active @ self.behind @ own @ self.behind.inverse()


def _chained(frames: Frames) -> list[tuple[str, int, NcFrame]]:
    """All frames from the machine to the work, by name and number; base frames that a mask leaves out are neutral."""
    bases = (
        ("NCBFRAME", frames.active_global_base, frames.global_base_mask),
        ("CHBFRAME", frames.active_base, frames.base_mask),
    )
    inner = (*AFTER_SETTABLE, "$P_PFRAME", *AFTER_PROGRAMMABLE)
    return [
        *((name, 0, frames.system[name]) for name in BEFORE_BASE),
        *(
            (name, i, frame if mask >> i & 1 else NEUTRAL)
            for name, active, mask in bases
            for i, frame in enumerate(active)
        ),
        ("IFRAME", ANY, frames.active_settable),
        *((name, 0, frame) for name, frame in zip(inner, frames.inner(), strict=True)),
    ]


def given_direction(angle_deg: float) -> Point:
    """The unit vector at an angle."""
    return cos(radians(angle_deg)), sin(radians(angle_deg))


def direction_of(start: Point | None, end: Point | None) -> Point | None:
    """The unit vector from a point to another; None for equal ones."""
    if start is None or end is None:
        return None
    length = dist(start, end)
    return ((end[0] - start[0]) / length, (end[1] - start[1]) / length) if length > _SAME_MM else None


def line_angle(along: Point) -> float:
    """Angle of a line to the abscissa, above -90 and up to 90 degrees."""
    angle = degrees(atan2(along[1], along[0]))
    return angle - 180.0 if angle > 90.0 else angle + 180.0 if angle <= -90.0 else angle


def corners_of(
    points: Sequence[Point | None], first: Point, phi: float | None
) -> list[tuple[Point, Point, Point]]:
    """Where two edges may meet, and the directions from there along them, to the points that lie on them.

    Args:
        points: Two on the first edge, of which the second may be missing, and two on the second one alike.
        first: Direction of the first edge, either way.
        phi: Angle between the edges; None where both points of the second one tell it.
    """
    one, other = points[0], points[2]
    assert one is not None
    assert other is not None
    if phi is None:
        second = direction_of(other, points[3])
        candidates = [] if second is None else [second]
    else:
        turn = atan2(first[1], first[0])
        angles = (turn + radians(phi), turn - radians(phi))
        candidates = [(cos(angle), sin(angle)) for angle in angles]
    found = []
    for second in candidates:
        area = first[0] * second[1] - first[1] * second[0]
        if abs(area) <= _SAME_MM:
            continue
        way = ((other[0] - one[0]) * second[1] - (other[1] - one[1]) * second[0]) / area
        place = (one[0] + way * first[0], one[1] + way * first[1])
        led = [
            _towards(place, along, [point for point in pair if point is not None])
            for along, pair in ((first, points[:2]), (second, points[2:]))
        ]
        if led[0] is None or led[1] is None:
            continue
        between = degrees(acos(max(-1.0, min(1.0, led[0][0] * led[1][0] + led[0][1] * led[1][1]))))
        if phi is None or abs(between - phi) < _SAME_ANGLE_DEG:
            found.append((place, led[0], led[1]))
    return found


def _towards(place: Point, along: Point, points: Sequence[Point]) -> Point | None:
    """The direction of a line from a place on it to all points; None where they lie on both sides."""
    ways = [(x - place[0]) * along[0] + (y - place[1]) * along[1] for x, y in points]
    if all(way > _SAME_MM for way in ways):
        return along
    return (-along[0], -along[1]) if all(way < -_SAME_MM for way in ways) else None


def tilt(normal: Sequence[float], w: int) -> Point:
    """Rotations about abscissa and ordinate, in RPY order, that turn the third axis into a normal, degrees."""
    x, y, z = normal
    if w == 2:
        return -degrees(asin(y)), degrees(atan2(x, z))
    if w == 1:
        return degrees(atan2(-x, y)), degrees(asin(z))
    return -degrees(asin(z)), degrees(atan2(y, x))


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
