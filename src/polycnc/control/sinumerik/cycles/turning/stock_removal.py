"""Stock removal CYCLE95 along a turned contour (cuts: `polycnc.cycles.turning.stock_removal`)."""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.cycles.contours.reading import read
from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.moves import require_tool
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work, finish, in_steps, onwards
from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import Contour, turned_round
from polycnc.cycles.turning.outline import farthest
from polycnc.cycles.turning.stock_removal import Removal, blank, remove
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves

#: Kinds of CYCLE95 by (VARI - 1) // 4.
ROUGHING, FINISHING, COMPLETE = 0, 1, 2
#: For each of the four sides of a kind: whether the cuts run across, and the direction of infeed.
SIDES = ((False, -1.0), (True, -1.0), (False, 1.0), (True, -1.0))
#: Hundreds of VARI: cuts end without following the contour.
WITHOUT_ROUNDING = 2


def stock_removal(moves: Moves, a: Arguments) -> None:
    """CYCLE95: remove stock along a contour, lengthwise or across, outside or inside."""
    require_tool(moves)
    rounding, number = divmod(a.integer("VARI"), 100)
    if not 1 <= number <= 12 or not 0 <= rounding <= WITHOUT_ROUNDING:
        raise AlarmError("61002")
    kind, side = divmod(number - 1, len(SIDES))
    across, towards = SIDES[side]
    work = Work(moves, across=across, towards=towards)
    read(moves, a.text("NPP"), partial(_remove, work, a, kind, rounding))


def _remove(work: Work, a: Arguments, kind: int, rounding: int, read_: Contour) -> None:
    """Rough and finish along the contour that was read, and back to where the cycle began."""
    moves = work.moves
    home = moves.point
    contour = work.contour(read_)
    work.require_point()
    stock: Contour | None = None
    if kind != FINISHING:
        stock = _rough(work, a, contour, follows=rounding != WITHOUT_ROUNDING, finishes=kind == COMPLETE)
    if kind != ROUGHING:
        _finish(work, a, contour, stock)
        stock = None
    work.clear(work.tool_path(contour, 0.0), work.pair(*home), _lift(a), stock=stock)
    moves.rapid(*home)
    moves.end_block()


def _lift(a: Arguments) -> float:
    return a["_VRT"] if a["_VRT"] > 0.0 else LIFT_MM


def _rough(work: Work, a: Arguments, contour: Contour, *, follows: bool, finishes: bool) -> Contour:
    """Cuts down to the allowances, from the open end of the contour; gives what they leave."""
    if not a["MID"] > 0.0:
        raise AlarmError("61610")
    if work.towards * (contour[0].edge.start[1] - contour[-1].edge.end[1]) < 0.0:
        contour = turned_round(contour)
    work.require_point(onwards(contour))
    path = work.tool_path(contour, abs(a["FAL"]), roughs=True, rounds_begin=True)
    off_a, off_b = work.pair(abs(a["FALZ"]), abs(a["FALX"]))
    try:
        path = with_stock(path, (-onwards(contour) * off_a, -work.towards * off_b), work.towards)
    except ValueError:
        raise AlarmError("61606") from None
    straight = feed_of(a, "FF1")
    relief = a["FF2"] or straight
    if finishes:
        feed_of(a, "FF3")  # one that is missing is told before the tool cuts
    top = work.touching(farthest(contour, 1, -work.towards))
    front = work.front(contour[0].edge.start[0], onwards(contour))
    before = blank(path, work.towards, top)
    removal = Removal(a["MID"], _lift(a), work.towards, follows, front=front, top=top)
    for number, cut in enumerate(remove(path, removal)):
        if not number:
            work.clear(path, cut.stroke.end, _lift(a), stock=before)
        if cut.stroke.center is None:
            work.require_clear(path, cut.stroke.end)
        if cut.is_straight and a["DAM"] > 0.0:
            in_steps(work, cut.stroke, straight, a["DAM"], a["DT"])
        else:
            work.perform(cut.stroke, relief if cut.is_relief else straight)
    # Cuts that do not follow the contour leave steps on it.
    return path if follows else before


def _finish(work: Work, a: Arguments, contour: Contour, stock: Contour | None) -> None:
    """The contour once, in its own direction, at the finished size; `stock` is what roughing has left."""
    path = work.tool_path(contour, 0.0, rounds_begin=True)
    finish(work, path, onwards(contour), feed_of(a, "FF3"), _lift(a), stock)
