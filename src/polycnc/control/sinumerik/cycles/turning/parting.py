"""Parting off, CYCLE92: a chamfer or a rounding on the way in, the rest at a lower feed and speed.

Source: SINUMERIK Operate, cut-off; parameter lists of the externally programmed cycles.
"""

from __future__ import annotations

from math import inf

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Digits of _AMODE: depths that count from the surface, the kind of the corner.
_REDUCED, _FINAL, _CORNER = 0, 1, 2
CHAMFER = 1
#: Directions of _SDAC.
DIRECTIONS = {3: 1, 4: -1}
_ROUNDING = 1e-6


def part_off(moves: Moves, a: Arguments) -> None:
    """CYCLE92: part off at `_SPL` from the surface `_SPD` down to `_DIAG2`.

    The corner of the part that the tool's active edge looks at is chamfered or rounded.

    Raises:
        AlarmError: 61000 without tool offset, 61003 without feed, 61102 for a direction of the spindle, 61601 for a
            final depth outside of the surface, 61606 for a nose that does not fit, 61608 for a tool point that looks
            neither way; PC0001 for a way out that is not the usual one, part catchers, and speeds that the call and
            not the program sets.
    """
    require_tool(moves)
    side = _side(moves)
    _refuse(moves, a)
    feed = abs(a["_FF1"])
    if not feed:
        raise AlarmError("61003")
    surface, final = a["_SPD"], _depth(a, "_DIAG2", _FINAL)
    if final > surface - abs(a["_RC"]) - _ROUNDING:
        raise AlarmError("61601")
    reduced = _depth(a, "_DIAG1", _REDUCED)
    work = Work(moves, across=True, towards=side)
    # The tool's point, which is its lowest, comes to the final depth, not the centre of its nose.
    nose = -stages.radius(moves.channel) * stages.tip(moves.channel)[1]
    path = work.tool_path(_contour(a, side, surface, final + nose), 0.0)
    start = path[0].edge.start
    free = surface + (abs(a["_SDIS"]) or LIFT_MM)
    if moves.point[1] < free:
        moves.rapid(None, free)
        moves.end_block()
    for target in ((start[1], None), (None, free)):
        moves.rapid(*target)
        moves.end_block()
    _turn_spindle(moves, a)
    work.perform(PlaneStroke(Kind.FEED, start), feed)
    for piece in path[:-1]:
        work.perform(piece.stroke(), feed)
    _down(work, a, path[-1].edge.end, reduced, feed)
    moves.rapid(None, free)
    moves.end_block()


def _side(moves: Moves) -> float:
    """The side of the part along Z: that which the point of the tool's active edge looks at."""
    along = stages.tip(moves.channel)[0]
    if abs(abs(along) - 1.0) > _ROUNDING:
        raise AlarmError("61608")
    return along


def _refuse(moves: Moves, a: Arguments) -> None:
    """What is not executed, or not told well enough."""
    spindle = moves.spindle
    is_even = tables.feed_type(moves.channel.mode).surface_speed
    speed = spindle.cutting_speed if is_even else spindle.speed
    if a.integer("_SDAC") not in (0, *DIRECTIONS):
        raise AlarmError("61102")
    unknown = {
        "_SV1": a["_SV1"] not in (0.0, speed),
        "_SV2": bool(a["_SV2"]) and is_even,
        "_SS2": bool(a["_SS2"]) and is_even,
        "_VARI": a.integer("_VARI") != 0,
        "_AMODE": any(a.digit("_AMODE", place) > 1 for place in (_REDUCED, _FINAL, _CORNER)),
    }
    for name, wrong in unknown.items():
        if wrong:
            raise not_supported(f"CYCLE92 {name}")


def _depth(a: Arguments, name: str, place: int) -> float:
    """A depth as a radius: a diameter, or a way from the surface."""
    return a["_SPD"] - abs(2.0 * a[name]) if a.digit("_AMODE", place) else a[name]


def _contour(a: Arguments, side: float, surface: float, final: float) -> Contour:
    """The end of the part, from its surface over its corner down to the final depth, as (radius, Z)."""
    size, face = abs(a["_RC"]), a["_SPL"]
    if not size:
        return [Piece(offset.line((surface, face), (final, face)))]
    begin, foot = (surface, face + side * size), (surface - size, face)
    if a.digit("_AMODE", _CORNER) == CHAMFER:
        corner = offset.line(begin, foot)
    else:
        # The tool runs inwards and towards the face: seen from it the arc bulges outwards.
        corner = offset.arc(begin, foot, (surface - size, face + side * size), ccw=side < 0.0)
    return [Piece(corner), Piece(offset.line(foot, (final, face)))]


def _turn_spindle(moves: Moves, a: Arguments) -> None:
    """The spindle turns as the call says; M3 or M4 where it does not yet."""
    direction = DIRECTIONS.get(a.integer("_SDAC"), moves.spindle.direction)
    if direction != moves.spindle.direction:
        moves.turn(direction)
        moves.end_block()


def _down(work: Work, a: Arguments, end: tuple[float, float], reduced: float, feed: float) -> None:
    """To the final depth: from where it is reduced on at the lower feed and speed, which is put back behind it."""
    moves, lower, speed = work.moves, abs(a["_FF2"]) or feed, a["_SS2"]
    here = moves.point[1]
    first = reduced if reduced > end[0] + _ROUNDING else -inf
    if (lower == feed and not speed) or first == -inf:
        work.perform(PlaneStroke(Kind.FEED, end), feed)
        return
    if first < here - _ROUNDING:
        work.perform(PlaneStroke(Kind.FEED, (first, end[1])), feed)
    before = moves.spindle.speed
    if speed:
        moves.speed(speed)
    work.perform(PlaneStroke(Kind.FEED, end), lower)
    if speed:
        moves.speed(before)
