"""Patterns of positions: HOLES1, HOLES2, CYCLE801, CYCLE802. They move, and what MCALL has set works at each."""

from __future__ import annotations

from math import hypot

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.cycles.count import checked
from polycnc.cycles.drilling import patterns
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg
from polycnc.language.sinumerik.statements.calls import call_modal
from polycnc.messages import AlarmError
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

TURN = 360.0
#: Points that a call of CYCLE802 can name.
MOST_POINTS = 9


#: Thousands of _VARI of HOLES2: the holes lie on all of the circle, whatever INDA says. Tens: the ways between them.
ALL_OF_CIRCLE, ALONG_CIRCLE = 1, 1
#: Feed along the circle, mm/min, as setting datum 55230 is delivered.
FEED_ALONG_CIRCLE = 5000.0


def visit(moves: Moves, a: Arguments, points: Iterable[Point], arc: tuple[Point, bool] | None = None) -> None:
    """Rapid from point to point; the modal cycle follows at each. Without one: message 62100 and M0 first.

    `arc` is the centre of a circle along which the tool goes from the first point on, and whether counter-clockwise.

    `_HIDE` leaves positions out, by number from 1; `_NSP` is the first one.
    """
    if moves.channel.memory.language.modal_call is None:
        moves.note("62100")
        moves.stop()
        moves.end_block()
    hidden = {int(part) for part in a.text("_HIDE").replace(",", " ").split() if part.isdigit()}
    first = True
    for number, (u, v) in enumerate(points, 1):
        if number in hidden or number < a.integer("_NSP"):
            continue
        if arc is None or first:
            moves.rapid(u, v)
        else:
            moves.arc(_feed_along_circle(moves), (u, v), *arc)
        first = False
        moves.act(call_modal, moves.channel)
        moves.end_block()


def _feed_along_circle(moves: Moves) -> float:
    """The feed from place to place along a circle, in the feed type of the caller.

    Raises:
        AlarmError: PC0001 for feeds per revolution of a spindle that stands or is not the master, and for inverse time.
    """
    feed, speed = PathFeed.of(moves.channel), moves.spindle.speed
    if feed.mode is FeedMode.PER_MINUTE:
        return FEED_ALONG_CIRCLE / tables.MINUTE
    if feed.mode is not FeedMode.PER_REVOLUTION or feed.spindle or feed.axis >= 0 or not speed:
        raise not_supported("HOLES2 _VARI")
    return FEED_ALONG_CIRCLE / speed


def _nearer_end_first(points: list[Point], tool: Point) -> list[Point]:
    """The same row from the end that is nearer to the tool."""
    first, last = (hypot(p[0] - tool[0], p[1] - tool[1]) for p in (points[0], points[-1]))
    return points if first <= last else points[::-1]


def row(moves: Moves, a: Arguments) -> None:
    """HOLES1: a row of holes, from the end nearer to the tool."""
    count = checked(abs(a.integer("NUM")))
    if count == 0:
        raise AlarmError("61103")
    cosine, sine = cos_sin_deg(a["STA1"])
    ways = [abs(a["FDIS"]) + k * abs(a["DBH"]) for k in range(count)]
    points = [(a["SPCA"] + way * cosine, a["SPCO"] + way * sine) for way in ways]
    visit(moves, a, _nearer_end_first(points, moves.point))


def circle(moves: Moves, a: Arguments) -> None:
    """HOLES2: holes on a circle, on all of it where INDA is 0 or _VARI says so; the way to the next may follow it.

    Raises:
        AlarmError: 61002 for _VARI, 61103 without holes, 61106 for more than a turn.
    """
    if a.digit("_VARI", 1) > ALONG_CIRCLE:
        raise AlarmError("61002")
    count, pitch = checked(abs(a.integer("NUM"))), a["INDA"]
    if a.digit("_VARI", 3) == ALL_OF_CIRCLE:
        pitch = 0.0
    if count == 0:
        raise AlarmError("61103")
    if abs(pitch) * (count - 1) >= TURN:
        raise AlarmError("61106")
    center = (a["CPA"], a["CPO"])
    arc = (center, pitch >= 0.0) if a.digit("_VARI", 1) == ALONG_CIRCLE else None
    visit(moves, a, patterns.arc(center, abs(a["RAD"]), a["STA1"], pitch or TURN / count, count), arc)


def grid(moves: Moves, a: Arguments) -> None:
    """CYCLE801: a turned grid, or its frame, from the corner nearest to the tool.

    The grid is visited to and fro along its smaller pitch, the frame once round.
    """
    columns, rows = (abs(a.integer(name)) for name in ("_NUM1", "_NUM2"))
    if not columns or not rows:
        moves.note("62105")
        columns, rows = max(columns, 1), max(rows, 1)
    checked(columns * rows)
    corners = [(i, j) for j in (0, rows - 1) for i in (0, columns - 1)]
    u, v = moves.point
    near = min(corners, key=lambda cell: hypot(_place(a, *cell)[0] - u, _place(a, *cell)[1] - v))
    if a.digit("_VARI", 0) == 1:
        cells = patterns.frame_cells(columns, rows)
    elif abs(a["_DIS1"]) <= abs(a["_DIS2"]):
        cells = list(patterns.meander_cells(columns, rows))
    else:
        cells = [(i, j) for j, i in patterns.meander_cells(rows, columns)]
    visit(moves, a, (_place(a, abs(near[0] - i), abs(near[1] - j)) for i, j in cells))


def _place(a: Arguments, column: int, row: int) -> Point:
    """A point of the grid: turned by _STA, its axes sheared by _ANG1 and _ANG2."""
    along, across = cos_sin_deg(a["_STA"] + a["_ANG1"]), cos_sin_deg(a["_STA"] + 90.0 + a["_ANG2"])
    first, second = column * a["_DIS1"], row * a["_DIS2"]
    return (
        a["_SPCA"] + first * along[0] + second * across[0],
        a["_SPCO"] + first * along[1] + second * across[1],
    )


def points(moves: Moves, a: Arguments) -> None:
    """CYCLE802: up to nine points, absolute or incremental; an omitted pair ends the list."""
    found: list[Point] = []
    u, v = moves.point
    for i in range(MOST_POINTS):
        if not (a.given(f"_X{i}") or a.given(f"_Y{i}")):
            break
        place = MOST_POINTS - 1 - i
        u = a[f"_X{i}"] + (u if a.digit("_XA", place) == 2 else 0.0)
        v = a[f"_Y{i}"] + (v if a.digit("_YA", place) == 2 else 0.0)
        found.append((u, v))
    visit(moves, a, found)
