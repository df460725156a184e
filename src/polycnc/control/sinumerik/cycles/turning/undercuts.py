"""Undercuts CYCLE94 and CYCLE96 (shapes: `polycnc.cycles.turning.undercut`)."""

from __future__ import annotations

from math import dist
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import Work
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.turning import undercut as shapes
from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.cycles.turning.stroke import PlaneStroke
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

    def placed(point: Point) -> Point:
        return a["SPL"] + onwards * point[0], surface + towards * point[1]

    # A mirrored contour turns its arcs the other way.
    contour: Contour = []
    for piece in shapes.contour(shape, START_ABOVE_MM):
        edge = piece.edge
        start, end = placed(edge.start), placed(edge.end)
        if edge.center is None:
            contour.append(Piece(offset.line(start, end)))
        else:
            ccw = edge.ccw is (onwards * towards > 0.0)
            contour.append(Piece(offset.arc(start, end, placed(edge.center), ccw)))
    _cut(moves, contour, placed((START_BESIDE_MM, -START_ABOVE_MM)), towards)


def _corner(moves: Moves, a: Arguments, form: str) -> tuple[float, float]:
    """Where the cylinder and the infeed lie, by the tool in the holder as the active frame shows it.

    Raises:
        AlarmError: 61002 for another `_VARI`, 61608 for a tool that does not lie so.
    """
    if a.integer("_VARI") not in (0, *CORNERS):
        raise AlarmError("61002")
    along, across = stages.tip(moves.channel)
    corner = (-along, across)
    # A frame that turns the work leaves no tool point square to it; one that mirrors it makes another of them.
    number = next((k for k, known in CORNERS.items() if dist(corner, known) <= _ROUNDING), None)
    if number is None or a.integer("_VARI") not in (0, number):
        raise AlarmError("61608")
    is_inside = across > 0.0
    if a.cycle == "CYCLE96" and (form in shapes.INSIDE) is not is_inside:
        raise AlarmError("61608")
    return CORNERS[number]


def _cut(moves: Moves, contour: Contour, home: Point, towards: float) -> None:
    """From the start point along the contour with the nose on it, and back at rapid."""
    work = Work(moves, across=False, towards=towards)
    path, feed = work.tool_path(contour, 0.0), moves.channel.feed
    work.perform(PlaneStroke(Kind.RAPID, home), feed)
    work.perform(PlaneStroke(Kind.FEED, path[0].edge.start), feed)
    for piece in path:
        work.perform(piece.stroke(), feed)
    work.perform(PlaneStroke(Kind.RAPID, home), feed)
