"""Splines and polynomials: ASPLINE, BSPLINE, CSPLINE, SPLINEPATH, POLY (job planning 4.2, 4.3, 4.6).

A and C splines go through every programmed point, and a display shows one motion for each. The control points of a B
spline and the coefficients of a polynomial give curves of their own. All are cut into chords.
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from math import hypot

from polycnc.channel.moves.chord_path import ChordPath
from polycnc.channel.moves.knots import write_chords
from polycnc.channel.moves.path import Recorder
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.arguments import Procedure
from polycnc.control.sinumerik.block.positions import AxisTerm, axis_term, number, target
from polycnc.control.sinumerik.curve_tables.recorder import recorder_of
from polycnc.control.sinumerik.feed.pace import Overrides
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.motion.points_stage import POINT, PointsStage, direction_before
from polycnc.control.sinumerik.motion.polynomial_groups import AXES, PolynomialGroups
from polycnc.control.sinumerik.motion.spline_stage import TOLERANCE_MM
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.tools import stages
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.through_points import End
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector

LARGEST_WEIGHT, DEGREES, STANDARD_DEGREE = 3.0, (2, 3), 3
LEAST_PARAMETER, LARGEST_PARAMETER = 0.0001, 99999.9999
LARGEST_GROUP = 8
#: Without SPLINEPATH the first three axes of the channel are bent.
LEAST_GROUP = 3
MAX_COEFFICIENTS = 5
#: Chords of a polynomial at most, and the points at which its denominator is looked at.
MAX_CHORDS, SAMPLES = 4096, 1000
#: Half the part of the parameter over which the direction of a polynomial is taken.
SLOPE = 1e-6


@dataclass(slots=True)
class Splines(State, lifetime=Lifetime.POWER):
    """What splines and polynomials are for.

    Attributes:
        group: Columns of SPLINEPATH; None for the first axes.
        window: Which of the last blocks were points of the active spline.
    """

    group: frozenset[int] | None = None
    window: list[bool] = field(default_factory=list)


# ---- splines

#: What holds at an end of a spline (BNAT, BTAN, BAUTO and the like); without a neighbour a tangent is that of NAT.
ENDS = {"NAT": End.STRAIGHT, "TAN": End.STRAIGHT, "AUTO": End.FREE}

#: Points of the spline that 10 blocks need at least; C splines: MD20160 and one more (4.2).
WINDOW, LEAST_POINTS = 10, {"ASPLINE": 4, "BSPLINE": 6}


def count_blocks(draft: Draft, *, is_point: bool) -> Step:
    """A block while a spline is active: PC0007 if too few of the last ten have been points of it."""
    code = draft.mode["motion"]
    begins = draft.channel.mode["motion"] != code
    datum = draft.memory.data.integer("$MC_CUBIC_SPLINE_BLOCKS")
    least = LEAST_POINTS.get(code, datum + 1)

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        state = Splines.of(channel)
        state.window = last = [*([] if begins else state.window), is_point][-WINDOW:]
        if len(last) == WINDOW and sum(last) < least:
            raise AlarmError("PC0007", code=code, count=sum(last), least=least)

    return run


def positioned(draft: Draft) -> Step | None:
    """PC0008 for a positioning axis that belongs to the active spline."""
    words = [word for _, word in draft.open_words() if word.address in ("POS", "POSA")]
    columns = [draft.memory.column(word.index.name) for word in words if isinstance(word.index, Axis)]
    if not columns:
        return None

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        bent = Splines.of(channel).group
        group = range(LEAST_GROUP) if bent is None else bent
        for column in columns:
            if column in group:
                raise AlarmError("PC0008", axis=channel.axes[column])

    return run


def through_points(draft: Draft) -> Step | None:
    """ASPLINE, CSPLINE: the next point of the curve; groups 19 and 20 say how it begins and ends."""
    goal = moves.goal_of(draft)
    if goal is None:
        return None
    mode = draft.mode
    is_akima, begins, ends = mode["motion"] == "ASPLINE", mode["spline_start"], mode["spline_end"]

    def run(channel: SinumerikChannel, values: Values) -> None:
        end, feed = goal(channel, values), moves.checked_feed(channel.feed)
        if channel.path.find(Recorder) is not None:  # a contour or a curve table takes the points
            moves.line(channel, Kind.SPLINE, end, feed)
            return
        group = Splines.of(channel).group
        columns = tuple(range(min(LEAST_GROUP, len(end)))) if group is None else tuple(sorted(group))
        stage = channel.path.find(PointsStage) or channel.path.put(PointsStage(channel))
        stage.choose(is_akima=is_akima, columns=columns)
        if not stage.active:
            before = direction_before(channel, columns) if begins == "BTAN" else None
            stage.begins = before or ENDS[begins[1:]]
        stage.ends = None if ends == "ETAN" else ENDS[ends[1:]]
        moves.special(channel, Kind.SPLINE, end, feed, [POINT])

    return run


def control_points(draft: Draft) -> Step | None:
    """BSPLINE: the next control point; PW is its weight, SD the degree, PL the knot distance."""
    weight, degree, distance = draft.take("PW"), draft.take("SD"), draft.take("PL")
    goal = moves.goal_of(draft)
    if goal is None:
        return None

    def run(channel: SinumerikChannel, values: Values) -> None:
        pull = number(values, weight) if weight is not None else 1.0
        if weight is not None and not 0.0 <= pull <= LARGEST_WEIGHT:
            raise WordAlarm("12560", weight, text="PW")
        order = number(values, degree) if degree is not None else STANDARD_DEGREE
        if degree is not None and order not in DEGREES:
            raise WordAlarm("12560", degree, text="SD")
        end, feed = goal(channel, values), moves.checked_feed(channel.feed)
        stages.spline(channel).columns = Splines.of(channel).group
        moves.special(channel, Kind.SPLINE, end, feed, [pull, order, _parameter(values, distance)])

    return run


def _parameter(values: Values, position: int | None) -> float:
    """PL: length of the parameter interval, 1 without it; alarm 12560 outside its range."""
    if position is None:
        return 1.0
    value = number(values, position)
    if not LEAST_PARAMETER <= value <= LARGEST_PARAMETER:
        raise WordAlarm("12560", position, text="PL")
    return value


def spline_group(channel: SinumerikChannel, args: tuple[Any, ...]) -> None:
    """SPLINEPATH(1, axis, …): the axes that a spline bends; the others move evenly with the path."""
    if len(args) < 2 or args[0] != 1 or len(args) - 1 > LARGEST_GROUP:
        raise AlarmError("14020", text="SPLINEPATH")
    columns = frozenset(arguments.column(channel, axis) for axis in args[1:])
    Splines.of(channel).group = columns


# ---- polynomials


class Polynomial(NamedTuple):
    """What a block says of one axis.

    Attributes:
        position: Place of the word.
        term: How its end point is meant.
    """

    position: int
    term: AxisTerm


class Curve(NamedTuple):
    """A polynomial of one axis, lowest coefficient first, and whether the denominator divides it."""

    column: int
    coefficients: list[float]
    divided: bool


def polynomial(draft: Draft) -> Step | None:
    """POLY: PO[axis]=(end,a2,a3,a4,a5), axis=PO(…), PO[]=(b_end,b2,…), PL; plain axes move evenly."""
    length = draft.take("PL")
    polynomials, denominator = _take_polynomials(draft)
    terms, lead = draft.take_axes(), draft.take_lead()
    if not polynomials and not terms and lead is None:
        return None
    factor = length_factor(draft.mode)

    def run(channel: SinumerikChannel, values: Values) -> None:
        feed = moves.checked_feed(channel.feed)
        end = _end(channel, terms, polynomials, values)
        interval = _parameter(values, length)
        if AXES not in PolynomialGroups.of(channel).acting:
            moves.line(channel, Kind.FEED, end if lead is None else lead(channel, values, end, None), feed)
            return
        below = _denominator(values, denominator, interval)
        start = channel.coordinates.position
        curves = []
        for column, term in enumerate(_by_column(polynomials, len(end))):
            divided = denominator is not None and column in channel.coordinates.geometry
            higher = [] if term is None else [float(a) * factor for a in _list(values, term.position)[1:]]
            scale = _at(below, interval) if divided else 1.0
            straight = term is None and not divided
            lifted = [] if straight else higher
            curves.append(
                Curve(column, _coefficients(start[column], end[column] * scale, lifted, interval), divided)
            )
        recorder = recorder_of(channel)
        if recorder is not None:  # a curve table takes the curve itself
            recorder.bend(lambda share: _point(curves, below, start, interval * share))
            moves.line(channel, Kind.SPLINE, end, feed)
            return
        kind = Kind.SPLINE if polynomials else Kind.FEED
        points = _chords(curves, below, start, end, interval)
        if channel.mode["path_reference"] == "SPATH":
            _by_length(points, start, curves, _path_axes(channel), interval)
        path = _path(channel, points, lambda part: _point(curves, below, start, interval * part))
        if lead is not None:
            points[-1][:] = lead(channel, values, end, path)
        write_chords(channel, path.led(channel), feed, partial(moves.line, channel, kind))

    return run


def _path(
    channel: SinumerikChannel, points: list[list[float]], at: Callable[[float], list[float]]
) -> ChordPath:
    """The way along chords that are equal parts of the parameter; `at` is the curve itself."""
    geometry = channel.coordinates.geometry

    def toward(part: float) -> Vector:
        low, high = max(part - SLOPE, 0.0), min(part + SLOPE, 1.0)
        a, b = at(low), at(high)
        x, y, z = (b[column] - a[column] if column >= 0 else 0.0 for column in geometry)
        size = hypot(x, y, z)
        return (x / size, y / size, z / size) if size else (0.0, 0.0, 0.0)

    chords = [(k / len(points), point) for k, point in enumerate(points, 1)]
    return ChordPath(channel.coordinates.position, chords, toward, geometry)


def _path_axes(channel: SinumerikChannel) -> tuple[int, ...]:
    """Columns of the axes that the path feed is for (FGROUP): those of the geometry where none is named."""
    named = Overrides.of(channel).group
    return named or tuple(column for column in channel.coordinates.geometry if column >= 0)


def _by_length(
    points: list[list[float]],
    start: list[float],
    curves: list[Curve],
    group: tuple[int, ...],
    interval: float,
) -> None:
    """SPATH: the other axes follow the length of the way that the axes of FGROUP make (job planning 4.6).

    They keep the curve parameter (UPATH) where those axes stand.
    """
    ways = [hypot(*(b[i] - a[i] for i in group)) for a, b in pairwise([start, *points])]
    whole = sum(ways)
    if not whole > 0.0:
        return
    done = 0.0
    for point, way in zip(points[:-1], ways, strict=False):
        done += way
        for curve in curves:
            if curve.column not in group and not curve.divided:
                point[curve.column] = _at(curve.coefficients, done / whole * interval)


def straight_to_ends(draft: Draft) -> Step | None:
    """Coefficients without POLY: the end points are approached in a straight line."""
    draft.take("PL")
    polynomials, _ = _take_polynomials(draft)
    terms = draft.take_axes()
    kind = Kind.RAPID if draft.mode["motion"] == "G0" else Kind.FEED

    def run(channel: SinumerikChannel, values: Values) -> None:
        end = _end(channel, terms, polynomials, values)
        moves.line(channel, kind, end, moves.checked_feed(channel.feed))

    return run


def _take_polynomials(draft: Draft) -> tuple[list[Polynomial], int | None]:
    """The words `PO[axis]=` and `axis=PO(…)`, and the place of `PO[]=`.

    The end points beside a denominator do not depend on G90 and G91 (job planning 4.5).
    """
    found: list[Polynomial] = []
    words = list(draft.open_words())
    denominator = next((k for k, word in words if word.address == "PO" and word.index == ""), None)
    usual = "" if denominator is None else "AC"
    for position, word in words:
        name = word.index.name if isinstance(word.index, Axis) else ""
        if position == denominator:
            pass
        elif word.address == "PO" or (word.modifier == "PO" and word.address in draft.memory.columns):
            if word.address == "PO" and not name:
                raise WordAlarm("12040", position, text=str(word.index or ""))
            column = draft.memory.column(name or word.address)
            way = (word.modifier if word.address == "PO" else "") or usual
            found.append(Polynomial(position, axis_term(draft.channel, draft.mode, position, column, way)))
        else:
            continue
        draft.close(position)
    return found, denominator


def _list(values: Values, position: int) -> tuple[Any, ...]:
    """The numbers of a PO word; alarm 12560 for too many."""
    value = values[position]
    numbers = value if isinstance(value, tuple) else (value,)
    if not 1 <= len(numbers) <= MAX_COEFFICIENTS:
        raise WordAlarm("12560", position, text="PO")
    if any(not isinstance(each, (int, float)) for each in numbers):
        raise WordAlarm("12150", position, text="PO")
    return numbers


def _end(
    channel: SinumerikChannel, terms: Sequence[AxisTerm], polynomials: Sequence[Polynomial], values: Values
) -> list[float]:
    """The target of a block: a polynomial's end point stands for the value of its axis."""
    ends = tuple(value[0] if isinstance(value, tuple) and value else value for value in values)
    return target(channel, [*terms, *(each.term for each in polynomials)], ends)


def _by_column(polynomials: Sequence[Polynomial], count: int) -> list[Polynomial | None]:
    by_column = {each.term.column: each for each in polynomials}
    return [by_column.get(column) for column in range(count)]


def _coefficients(start: float, end: float, higher: Sequence[float], length: float) -> list[float]:
    """Of 1, p, p² …: from `start` at 0 to `end` at `length`; the higher ones are given."""
    lifted = sum(a * length ** (k + 2) for k, a in enumerate(higher))
    return [start, (end - start - lifted) / length, *higher]


def _at(coefficients: Sequence[float], p: float) -> float:
    value = 0.0
    for coefficient in reversed(coefficients):
        value = value * p + coefficient
    return value


def _denominator(values: Values, position: int | None, length: float) -> list[float]:
    """The polynomial that divides the geometry axes; 1 at the start. Alarm 12560 if it becomes zero on the way."""
    if position is None:
        return [1.0]
    end, *higher = (float(b) for b in _list(values, position))
    below = _coefficients(1.0, end, higher, length)
    if min(_at(below, length * k / SAMPLES) for k in range(SAMPLES + 1)) <= 0.0:
        raise WordAlarm("12560", position, text="PO[]")
    return below


def _chords(
    curves: Sequence[Curve], below: Sequence[float], start: list[float], end: list[float], length: float
) -> list[list[float]]:
    """Points of the curve, halved until it stays within the tolerance of the chords; the last one is the end."""
    if all(len(curve.coefficients) == 2 for curve in curves) and len(below) == 1:
        return [end]

    chords = 2
    while True:
        points = [_point(curves, below, start, length * k / (2 * chords)) for k in range(2 * chords + 1)]
        if chords >= MAX_CHORDS or _deviation(points) <= TOLERANCE_MM:
            return [*points[2:-1:2], end]
        chords *= 2


def _point(curves: Sequence[Curve], below: Sequence[float], start: list[float], p: float) -> list[float]:
    """The position at a parameter."""
    point = start.copy()
    for curve in curves:
        value = _at(curve.coefficients, p)
        point[curve.column] = value / _at(below, p) if curve.divided else value
    return point


def _deviation(points: Sequence[Sequence[float]]) -> float:
    """Greatest distance, along an axis, of the odd points from the middle of their neighbours."""
    gaps: list[float] = [
        abs(half - 0.5 * (a + b))
        for k in range(0, len(points) - 2, 2)
        for a, half, b in zip(*points[k : k + 3], strict=True)
    ]
    return max(gaps)


PROCEDURES: dict[str, Procedure] = {"SPLINEPATH": spline_group}
