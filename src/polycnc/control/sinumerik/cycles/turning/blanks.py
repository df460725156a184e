"""What CYCLE952 turns: the contour of CYCLE62, its blank, and the limits of the work.

Source: SINUMERIK Operate, contour turning; parameter lists of the externally programmed cycles.
"""

from __future__ import annotations

from itertools import pairwise

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM, Work, onwards
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.plunging.material import Edges, left_by
from polycnc.cycles.plunging.profile import profile, upright
from polycnc.cycles.turning import outline
from polycnc.cycles.turning.allowance import with_stock
from polycnc.cycles.turning.contour import Contour, Piece, turned_round
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: What the blank is.
CYLINDER, SWOLLEN, CONTOUR = 1, 2, 3
#: Digits of _AMODE: values of the blank that count from the contour; of _GMODE: whether there are limits.
XD_RELATIVE, ZD_RELATIVE = 5, 6
HAS_LIMITS = 3
LIMITS = ("_XA", "_XB", "_ZA", "_ZB")
#: Digit of _DMODE: residual material.
RESIDUAL = 2
#: Stock lies no higher than this where a blank has none, mm.
NOTHING = -1e6
#: Digit of _VARI, and the stage at which limits count.
STAGE, ROUGHING = 1, 1
_HAIR = 1e-6


@dataclass(frozen=True, slots=True)
class Turning:
    """What a call turns, in the coordinates of the cuts.

    Attributes:
        part: The finished contour, in the direction of the cuts.
        front, top: Where the blank begins along the cuts, and against the infeed.
        stock: Outline of a blank that is no cylinder.
        lift: Distance off the work.
    """

    part: Contour
    front: float
    top: float
    stock: Contour | None
    lift: float


def home(work: Work, a: Arguments, point: Point, top: float) -> Point:
    """Where a call begins and ends: inside, lengthwise, on the retraction plane if there is one.

    Args:
        work: The cuts.
        a: Arguments of the call.
        point: Off the free corner of the blank.
        top: Where the blank begins against the infeed.

    Raises:
        AlarmError: 61101 for a plane that lies in the stock.
    """
    if work.across or work.towards < 0.0 or not a["_RP"]:
        return point
    if a["_RP"] > top + _HAIR:
        raise AlarmError("61101")
    return (point[0], a["_RP"])


# ---- residual material


@dataclass(slots=True)
class UpdatedBlanks(State, lifetime=Lifetime.RESET):
    """What calls have left of their blanks, by the names that `_CONR` gives, in the plane."""

    contours: dict[str, Contour] = field(default_factory=dict)


def is_residual(a: Arguments) -> bool:
    """Whether a call is about what another one has left."""
    return a.digit("_DMODE", RESIDUAL) == 1 or bool(a.text("_CON").strip())


def _left_before(work: Work, name: str) -> Contour:
    found = UpdatedBlanks.of(work.moves.channel).contours.get(name.strip().upper())
    if found is None:
        raise AlarmError("14011", text=name)
    return found


def note_left(work: Work, a: Arguments, turning: Turning, width: float = 0.0) -> None:
    """Keep what the call leaves of its blank, where it gives that a name; `width` is that of the tool.

    Raises:
        AlarmError: 61606 for a blank that runs back along the cuts.
    """
    name = a.text("_CONR").strip().upper()
    if not name:
        return
    radius = stages.radius(work.moves.channel)
    tip = work.pair(*stages.tip(work.moves.channel))
    tool = Edges(radius, width, (-radius * tip[0], radius * work.towards * tip[1]))
    blank = turning.stock
    if blank is None:
        blank = [
            Piece(offset.line((turning.front, turning.top), (turning.part[-1].edge.end[0], turning.top)))
        ]
    ways = [piece.edge for cut in work.cuts for piece in upright([Piece(cut)], work.towards)]
    try:
        left = left_by(profile(upright(blank, work.towards), NOTHING), ways, tool)
    except ValueError:
        raise AlarmError("61606") from None
    # Upright once more is as it was.
    contour = upright(left.between(left.begin, left.end), work.towards)
    work.moves.act(_keep, work.moves.channel, name, work.contour(contour))


def _keep(channel: SinumerikChannel, name: str, contour: Contour) -> None:
    UpdatedBlanks.of(channel).contours[name] = contour


def to_corner(work: Work, turning: Turning, front: float, top: float, point: Point) -> None:
    """Go to the free corner of the blank, past it; front and top are where the tool's point touches it."""
    part = turning.part
    ways = pairwise(((front, part[0].edge.start[1]), (front, top), (part[-1].edge.end[0], top)))
    work.clear([Piece(offset.line(p, q)) for p, q in ways], point, turning.lift)
    work.perform(PlaneStroke(Kind.RAPID, point), 0.0)


def of_call(work: Work, a: Arguments, direction: float, found: list[Contour]) -> Turning:
    """Contour and blank of a call.

    Raises:
        AlarmError: 61605 where a blank contour is missing, 14011 where no call has left what residual material is cut
            out of; PC0001 for further contours.
    """
    kind = a.integer("_BL")
    if is_residual(a):
        kind, found = CONTOUR, [_left_before(work, a.text("_CON")), *found]
    if len(found) != (2 if kind == CONTOUR else 1):
        if len(found) < 2:
            raise AlarmError("61605")
        raise not_supported("CYCLE952: CYCLE62")
    *blanks, part = (_in_direction(work, contour, direction) for contour in found)
    stock: Contour | None = None
    if kind == CYLINDER:
        front, top = _cylinder(work, a, direction, part)
    else:
        stock = blanks[0] if blanks else _swollen(work, a, direction, part)
        front = outline.farthest(stock, 0, -direction)
        top = outline.farthest(stock, 1, -work.towards)
    # A blank is not smaller than its part.
    front = -direction * max(-direction * front, -direction * part[0].edge.start[0])
    top = -work.towards * max(-work.towards * top, -work.towards * outline.farthest(part, 1, -work.towards))
    return Turning(part, front, top, stock, abs(a["_SC"]) or LIFT_MM)


def _in_direction(work: Work, read_: Contour, direction: float) -> Contour:
    contour = work.contour(read_)
    return contour if onwards(contour) == direction else turned_round(contour)


def _cylinder(work: Work, a: Arguments, direction: float, part: Contour) -> Point:
    """Front and top of a cylinder; its values are positions, X a diameter, or amounts in front of the contour."""
    radial, along = a["_XD"], a["_ZD"]
    places = work.pair(along, 0.5 * radial)
    amounts = work.pair(abs(along), abs(radial))
    relative = work.pair(a.digit("_AMODE", ZD_RELATIVE), a.digit("_AMODE", XD_RELATIVE))
    edges = []
    for axis, way in enumerate((-direction, -work.towards)):
        by_contour = outline.farthest(part, axis, way) + way * amounts[axis]
        edges.append(by_contour if relative[axis] else places[axis])
    return edges[0], edges[1]


def _swollen(work: Work, a: Arguments, direction: float, part: Contour) -> Contour:
    """The part with an allowance along both axes; 61606 where that leaves nothing between two walls."""
    off_a, off_b = work.pair(abs(a["_ZD"]), abs(a["_XD"]))
    try:
        stock = with_stock(part, (-direction * off_a, -work.towards * off_b), work.towards)
    except ValueError:
        raise AlarmError("61606") from None
    # In front of a wall at the end it is as thick as along the cuts, and reaches up to there.
    end, last = stock[-1].edge.end, part[-1].edge.end[0]
    return (
        stock if direction * (last - end[0]) <= _HAIR else [*stock, Piece(offset.line(end, (last, end[1])))]
    )


def limited(work: Work, a: Arguments, direction: float, turning: Turning) -> Turning:
    """The part of the work that lies between the limits of the call.

    Raises:
        AlarmError: 61605 where nothing of the contour does; PC0001 where they would leave stock in front of the cuts
            or above them, and where it is not clear whether they count.
    """
    if not any(a[name] for name in LIMITS):
        return turning
    first, second = work.pair(a["_ZA"], a["_XA"]), work.pair(a["_ZB"], a["_XB"])
    low, high = tuple(map(min, first, second)), tuple(map(max, first, second))
    front, last = (low[0], high[0]) if direction > 0.0 else (high[0], low[0])
    top, floor = (low[1], high[1]) if work.towards > 0.0 else (high[1], low[1])
    end = turning.part[-1].edge.end[0]
    bottom = outline.farthest(turning.part, 1, work.towards)
    cuts_short = direction * (end - last) > _HAIR or work.towards * (bottom - floor) > _HAIR
    in_the_way = direction * (front - turning.front) > _HAIR or work.towards * (top - turning.top) > _HAIR
    if in_the_way or (cuts_short and a.digit("_GMODE", HAS_LIMITS) != 1):
        raise not_supported(f"CYCLE952 {LIMITS[0]}")
    if not cuts_short:
        return turning
    if a.digit("_VARI", STAGE) != ROUGHING:
        raise not_supported(f"CYCLE952 {LIMITS[0]}")
    part = outline.not_deeper(outline.not_beyond(turning.part, last, direction), floor, work.towards)
    if not part:
        raise AlarmError("61605")
    onwards(part)
    return replace(turning, part=part)
