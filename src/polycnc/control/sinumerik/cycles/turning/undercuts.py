"""Undercuts CYCLE94, CYCLE96 and CYCLE940 (shapes: `polycnc.cycles.turning.undercut`).

Source: SINUMERIK standard cycles; SINUMERIK ONE, NC programming, externally programmed cycles (CYCLE940).
"""

from __future__ import annotations

from math import dist

from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work, onwards
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.count import parts
from polycnc.cycles.turning import undercut as shapes
from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import Contour, Piece, shifted
from polycnc.cycles.turning.groove import GrooveError
from polycnc.cycles.turning.stock_removal import Removal, remove
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

#: Forms of an undercut by cycle.
FORMS = {"CYCLE94": ("E", "F"), "CYCLE96": ("A", "B", "C", "D")}
#: Finished parts and threads of less have no undercut.
LEAST_DIAMETER_MM = 3.0
_ROUNDING = 1e-6
#: By the position of the cutting edge: which way the cylinder lies from the shoulder along Z, and the infeed along X.
CORNERS = {1: (-1.0, 1.0), 2: (1.0, 1.0), 3: (1.0, -1.0), 4: (-1.0, -1.0)}
#: Where the cycle begins and ends: so far from the surface, and from the shoulder.
START_ABOVE_MM, START_BESIDE_MM = 2.0, 10.0


def undercut(moves: Moves, a: Arguments) -> None:
    """CYCLE94, CYCLE96: an undercut of a form, in one cut along its contour at the feed of the caller.

    Raises:
        AlarmError: 61000 without tool offset, 61608 for a tool point that cannot, 61609 for a form that does not
            exist, 61601 for a diameter below 3 mm, 61001 for a thread of none of the coarse pitches, 61002 for
            `_VARI`, 61606 for a nose that does not fit.
    """
    require_tool(moves)
    form = a.text("FORM").strip().upper()
    if form not in FORMS[a.cycle]:
        raise AlarmError("61609", text=a.text("FORM"))
    diameter = 2.0 * a["SPD"] if a.cycle == "CYCLE94" else a["DIATH"]
    onwards, towards = _corner(moves, a, form)
    if diameter < LEAST_DIAMETER_MM - _ROUNDING:
        raise AlarmError("61601")
    if a.cycle == "CYCLE94":
        shape, surface = shapes.of_shaft(form, diameter), 0.5 * diameter
    else:
        found = shapes.of_thread(form, diameter)
        if found is None:
            raise AlarmError("61001")
        shape, surface = found

    work = Work(moves, across=False, towards=towards)
    place = Placing(a["SPL"], surface, onwards, towards)
    path = work.tool_path(place.contour(shapes.contour(shape, None if shape.face else START_ABOVE_MM)), 0.0)
    home = place.point((START_BESIDE_MM, -START_ABOVE_MM))
    _cut(work, path, home, moves.channel.feed)
    work.perform(PlaneStroke(Kind.RAPID, home), 0.0)


class Placing(NamedTuple):
    """Where an undercut lies: its shoulder and its surface, which way the cylinder lies, and the infeed."""

    shoulder: float
    surface: float
    onwards: float
    towards: float

    def point(self, point: Point) -> Point:
        """A point of the shape as one of the plane."""
        return self.shoulder + self.onwards * point[0], self.surface + self.towards * point[1]

    def contour(self, shape: Contour) -> Contour:
        """The shape in the plane; a mirrored one turns its arcs the other way."""
        result: Contour = []
        for piece in shape:
            edge = piece.edge
            start, end = self.point(edge.start), self.point(edge.end)
            if edge.center is None:
                result.append(Piece(offset.line(start, end)))
            else:
                ccw = edge.ccw is (self.onwards * self.towards > 0.0)
                result.append(Piece(offset.arc(start, end, self.point(edge.center), ccw)))
        return result


def _corner(moves: Moves, a: Arguments, form: str) -> tuple[float, float]:
    """Where the cylinder and the infeed lie, by the tool in the holder as the active frame shows it.

    Raises:
        AlarmError: 61002 for another `_VARI`, 61608 for a tool that does not lie so.
    """
    if a.integer("_VARI") not in (0, *CORNERS):
        raise AlarmError("61002")
    number = _edge_position(moves)
    if number is None or a.integer("_VARI") not in (0, number):
        raise AlarmError("61608")
    if a.cycle == "CYCLE96" and (form in shapes.INSIDE) is not (CORNERS[number][1] > 0.0):
        raise AlarmError("61608")
    return CORNERS[number]


def _edge_position(moves: Moves) -> int | None:
    """The position of the cutting edge, as the active frame mirrors it; None where that is none of a corner.

    A frame that turns the work leaves no tool point square to it; one that mirrors it makes another of them.
    """
    along, across = stages.tip(moves.channel)
    return next((k for k, known in CORNERS.items() if dist((-along, across), known) <= _ROUNDING), None)


def _cut(work: Work, path: Contour, home: Point, feed: float) -> None:
    """From a start point along a path of the tool."""
    work.perform(PlaneStroke(Kind.RAPID, home), feed)
    work.perform(PlaneStroke(Kind.FEED, path[0].edge.start), feed)
    for piece in path:
        work.perform(piece.stroke(), feed)


# ---- undercuts of the editor

#: _LAGE of CYCLE940 by the position of the cutting edge: outside and inside, the shoulder towards +Z, -Z.
SEATS = {4: 0, 3: 1, 1: 2, 2: 3}
#: Digits of _VARI: what is done, and along which way it is roughed.
_STAGE, _WAY = 0, 1
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
ALONG_CONTOUR, LENGTHWISE = 0, 1
ON_SHAFTS, FREE = ("E", "F"), "T"
#: Pitches of the editor's list, _PITI, from 0 on (DIN 76).
PITCHES = tuple(shapes.THREADS)
#: Digits of _AMODE: what counts from X0, Z0 and X0.
_X1, _Z1, _VX = 0, 1, 2
#: Steepest way down into an undercut, degrees.
SQUARE = 90.0


def undercut_of_mask(moves: Moves, a: Arguments) -> None:
    """CYCLE940: forms E and F in one cut; A to D of threads and the free form T roughed, finished or both.

    Raises:
        AlarmError: 61000 without tool offset, 61001 for a pitch that is not in the list, 61002 for `_VARI` and `_LAGE`,
            61003 without feed, 61601 for a diameter that is too small, 61606 for a nose, slope or corner that does not
            fit, 61608 for a tool point that cannot, 61609 for a form that does not exist, 61610 for roughing without
            depth; PC0001 for an allowance on the face of form E, and values that contradict each other.
    """
    require_tool(moves)
    form = a.text("_FORM").strip().upper()
    if form not in (*ON_SHAFTS, *FORMS["CYCLE96"], FREE):
        raise AlarmError("61609", text=a.text("_FORM"))
    seat = a.integer("_LAGE")
    if seat not in SEATS.values():
        raise AlarmError("61002")
    number = _edge_position(moves)
    if number is None or SEATS[number] != seat:
        raise AlarmError("61608")
    onwards, towards = CORNERS[number]
    if form in FORMS["CYCLE96"] and (form in shapes.INSIDE) is not (towards > 0.0):
        raise AlarmError("61608")
    _refuse(a, form)
    feed, lift = feed_of(a, "_FFP"), abs(a["_SDIS"]) or LIFT_MM
    shape, surface = _shape(a, form, onwards, towards)
    stage = FINISHING if form in ON_SHAFTS else a.digit("_VARI", _STAGE)
    if not ROUGHING <= stage <= COMPLETE or a.integer("_VARI") < 0:
        raise AlarmError("61002")
    work = Work(moves, across=False, towards=towards)
    place = Placing(a["_SPL"], surface, onwards, towards)
    try:
        contour = place.contour(shapes.contour(shape, _up_the_face(a, place, shape, lift)))
    except GrooveError:
        raise AlarmError("61606") from None
    home = place.point((shape.reach + lift, -shape.stock - lift))
    if stage != FINISHING:
        _rough(work, a, contour, home, shape.depth)
    if stage != ROUGHING:
        _cut(work, work.tool_path(contour, 0.0), home, feed)
        work.perform(PlaneStroke(Kind.RAPID, home), 0.0)


def _refuse(a: Arguments, form: str) -> None:
    """What is not executed, or contradicts itself."""
    is_shaft = form in ON_SHAFTS
    even, odd = abs(a["_FAL"]), (abs(a["_FALX"]), abs(a["_FALZ"]))
    unknown = {
        "_EPL": form == "E" and a["_EPL"] not in (0.0, 0.0 if a.digit("_AMODE", _Z1) else a["_SPL"]),
        "_AMODE": a.integer("_AMODE") >= 1000 or any(a.digit("_AMODE", k) > 1 for k in (_X1, _Z1, _VX)),
        "_VARI": not is_shaft
        and (a.digit("_VARI", _WAY) > LENGTHWISE or a.integer("_VARI") >= 10 ** (_WAY + 1)),
        "_FAL": not is_shaft and bool(even and any(odd)) and odd != (even, even),
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE940 {name}")


def _shape(a: Arguments, form: str, onwards: float, towards: float) -> tuple[shapes.Undercut, float]:
    """The undercut of a call, and the radius of the surface it begins on.

    Raises:
        AlarmError: 61001 for a pitch that is not in the list, 61601 for a diameter that is too small, 61606 for an
            undercut without depth or width or an angle that is none.
    """
    if form in ON_SHAFTS:
        if 2.0 * a["_SPD"] < LEAST_DIAMETER_MM - _ROUNDING:
            raise AlarmError("61601")
        # What is left for grinding, where it is told: up to a diameter and a place, or so much.
        stock = _beyond(a, "_EPD", _X1, a["_SPD"], -towards) if a["_EPD"] else 0.0
        on_face = _beyond(a, "_EPL", _Z1, a["_SPL"], onwards) if form == "F" and a["_EPL"] else 0.0
        if min(stock, on_face) < 0.0:
            raise AlarmError("61606")
        return shapes.of_shaft(form, 2.0 * a["_SPD"])._replace(stock=stock, face_stock=on_face), a["_SPD"]
    slope = a["_STA"]
    if not 0.0 <= slope <= SQUARE or (form == FREE and not slope):
        raise AlarmError("61606")
    if form == FREE:
        depth = _beyond(a, "_EPD", _X1, a["_SPD"], towards)
        width = _beyond(a, "_EPL", _Z1, a["_SPL"], onwards)
        if depth <= 0.0 or width <= 0.0:
            raise AlarmError("61606")
        shape = shapes.Undercut(width, depth, abs(a["_R1"]), slope, corner=abs(a["_R2"]))
        surface = a["_SPD"]
    else:
        number = a.integer("_PITI")
        if not 0 <= number < len(PITCHES):
            raise AlarmError("61001")
        shape, surface = shapes.of_pitch(form, 2.0 * a["_SPD"], PITCHES[number], slope)
    if surface + towards * shape.depth <= 0.0 or surface <= 0.0:
        raise AlarmError("61601")
    return shape, surface


def _beyond(a: Arguments, name: str, digit: int, reference: float, sense: float) -> float:
    """How far an end lies beyond X0 or Z0, as a position (a diameter along X) or so much from there (of radius)."""
    if a.digit("_AMODE", digit):
        return abs(a[name])
    return (a[name] * (0.5 if digit == _X1 else 1.0) - reference) * sense


def _up_the_face(a: Arguments, place: Placing, shape: shapes.Undercut, lift: float) -> float | None:
    """How far the cut goes up the face of the shoulder: by `_VRT`, to the diameter it names, else by the lift-off.

    Form F ends where its slope leaves the face, unless `_VRT` says more.
    """
    out = abs(a["_VRT"]) if a.digit("_AMODE", _VX) else (place.surface - 0.5 * a["_VRT"]) * place.towards
    if not a["_VRT"] or out <= 0.0:
        return None if shape.face else shape.stock + lift
    return max(out, shape.stock)


def _rough(work: Work, a: Arguments, contour: Contour, home: Point, depth: float) -> None:
    """Cuts down to the allowances, lengthwise or along the contour, of at most `_MID`; 61610 without one."""
    if not a["_MID"] > 0.0:
        raise AlarmError("61610")
    feed = feed_of(a, "_FFP")
    along = onwards(contour)
    path = work.tool_path(contour, abs(a["_FAL"]), roughs=True)
    off = (0.0, 0.0) if a["_FAL"] else (-along * abs(a["_FALZ"]), -work.towards * abs(a["_FALX"]))
    try:
        path = with_stock(path, off, work.towards)
    except ValueError:
        raise AlarmError("61606") from None
    if a.digit("_VARI", _WAY) == LENGTHWISE:
        top = work.touching(contour[0].edge.start[1])
        begin = path[0].edge.start
        led = [
            Piece(offset.line((home[0], top), (begin[0], top))),
            Piece(offset.line((begin[0], top), begin)),
            *path,
        ]
        led = [piece for piece in led if piece.edge.length > _ROUNDING]
        lift = abs(home[1] - contour[0].edge.start[1])
        for cut in remove(led, Removal(a["_MID"], lift, work.towards, top=top)):
            work.perform(cut.stroke, feed)
        work.clear(path, home, lift)
        work.perform(PlaneStroke(Kind.RAPID, home), 0.0)
        return
    count = max(parts(depth, a["_MID"], 1e-9), 1)
    for k in range(count - 1, -1, -1):
        _cut(work, shifted(path, 0.0, -work.towards * depth * k / count), home, feed)
        work.perform(PlaneStroke(Kind.RAPID, home), 0.0)
