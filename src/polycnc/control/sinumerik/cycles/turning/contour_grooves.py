"""Grooving and plunge turning of CYCLE952 (cuts: `polycnc.cycles.plunging`).

Source: SINUMERIK Operate, contour turning (grooving, plunge turning); the manuals at hand give parameter lists alone.
"""

from __future__ import annotations

from polycnc.control.sinumerik.cycles.milling import feed_of
from polycnc.control.sinumerik.cycles.turning import blanks
from polycnc.control.sinumerik.cycles.turning.grooves import STEP, require_edge, tool_width
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.plunging import cuts
from polycnc.cycles.plunging.cuts import Use
from polycnc.cycles.plunging.profile import (
    SNUG_MM,
    Profile,
    cropped,
    dilated,
    envelope,
    level,
    moved,
    of_tool,
    profile,
    upright,
    widened,
)
from polycnc.cycles.turning import outline
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.turning.blanks import Turning
    from polycnc.control.sinumerik.cycles.turning.work import Work
    from polycnc.cycles.plunging.cuts import Stroke
    from polycnc.cycles.turning.contour import Contour

    #: The cuts of roughing.
    _Rough = Callable[[cuts.Work], Iterator[Stroke]]

#: Digits of _VARI: stage, allowance, rounding; the stages.
STAGE, ALLOWANCE, ROUNDING = 1, 4, 5
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
ALONG_CONTOUR, WITHOUT_ROUNDING = 1, 2
#: Digit of _AMODE: finishing leaves _U1 along the contour.
WITH_U1 = 3
#: Length 1 of a turning tool lies along X, length 2 along Z.
_ALONG_X, _ALONG_Z = 0, 1
#: Higher than a level by this is above it, mm.
_HAIR = 1e-5


@dataclass(frozen=True, slots=True)
class Tool:
    """The parting tool: the radius of its noses, and its width, mm."""

    radius: float
    width: float

    @property
    def step(self) -> float:
        """Greatest way between two plunges that leave nothing between them."""
        return min(STEP * self.width, self.width - 2.0 * self.radius)


def plunge(work: Work, a: Arguments, direction: float, found: list[Contour]) -> None:
    """Grooving: plunges side by side, then along the walls.

    Raises:
        AlarmError: 61602 for a tool without width, or one that fits nowhere, 61606 for a contour that runs back, 61608
            for an edge that looks another way.
    """
    tool = _tool(work, a)

    def rough(part: cuts.Work) -> Iterator[Stroke]:
        return cuts.plunge(part, tool.step, abs(a["_D"]))

    _all(work, a, direction, found, tool, rough, dict.fromkeys(Use, feed_of(a, "_F")))


def turn(work: Work, a: Arguments, direction: float, found: list[Contour]) -> None:
    """Plunge turning: level by level a plunge and a cut between the walls, then along the walls.

    `_F` is the feed along X, `_FR` that along Z (the same where there is none).

    Raises:
        AlarmError: As `plunge`.
    """
    tool = _tool(work, a)

    def rough(part: cuts.Work) -> Iterator[Stroke]:
        return cuts.turn(part, a["_D"])

    radial = feed_of(a, "_F")
    along = a["_FR"] or radial
    into, aside = (along, radial) if work.across else (radial, along)
    feeds = {Use.RAPID: radial, Use.PLUNGE: into, Use.TURN: aside, Use.FOLLOW: radial}
    _all(work, a, direction, found, tool, rough, feeds)


def _tool(work: Work, a: Arguments) -> Tool:
    require_edge(work.moves, across=work.across, inwards=work.towards)
    radius = stages.radius(work.moves.channel)
    width = tool_width(work.moves, a.integer("_DN"), _ALONG_X if work.across else _ALONG_Z)
    if width - 2.0 * radius <= NO_WAY:
        raise AlarmError("61602")
    return Tool(radius, width)


def _all(
    work: Work,
    a: Arguments,
    direction: float,
    found: list[Contour],
    tool: Tool,
    rough: _Rough,
    feeds: dict[Use, float],
) -> None:
    """The grooves of a call, one behind the other; from the free corner of the first one's blank and back to it."""
    count, pitch = max(a.integer("_N"), 1), a["_DP"]
    if count > 1 and not pitch:
        raise not_supported("CYCLE952 _N")
    turning = blanks.of_call(work, a, direction, found)
    over = blanks.home(work, a, (0.0, height(work, _top(work, a, turning) + turning.lift)), turning.top)[1]
    begin = (turning.front - direction * turning.lift, over)
    groove = _Groove(work, a, turning, tool, height(work, over))
    finishing = feed_of(a, "_FS") if groove.stage == COMPLETE else feeds[Use.FOLLOW]
    blanks.to_corner(work, turning, turning.front, turning.top, begin)
    for number in range(count):
        away = number * pitch
        if groove.stage != FINISHING:
            part = groove.roughing(away)
            if turning.stock is None and not part.stretches():
                raise AlarmError("61602")
            perform(work, rough(part), feeds)
            if groove.follows:
                perform(work, cuts.follow(part), feeds)
        if groove.stage != ROUGHING:
            perform(work, cuts.follow(groove.finishing(away)), dict.fromkeys(Use, finishing))
    work.perform(PlaneStroke(Kind.RAPID, begin), 0.0)
    blanks.note_left(work, a, turning, tool.width)


def height(work: Work, b: float) -> float:
    """The height of a place of the infeed, or the place of a height."""
    return -work.towards * b


def _top(work: Work, a: Arguments, turning: Turning) -> float:
    """Height of the stock: of the blank, or of the contour with what roughing leaves on it."""
    _, up = work.pair(abs(a["_UZ"]), abs(a["_UX"]))
    part = height(work, outline.farthest(turning.part, 1, -work.towards)) + max(up, abs(a["_U"]), 0.0)
    return max(height(work, turning.top), part)


def perform(work: Work, strokes: Iterator[Stroke], feeds: dict[Use, float]) -> None:
    """Strokes of (a, h) as moves; one to where the tool stands is none."""
    for stroke in strokes:
        end = (stroke.end[0], height(work, stroke.end[1]))
        feed = 0.0 if stroke.use is Use.RAPID else feeds[stroke.use]
        if stroke.center is None:
            work.perform(PlaneStroke(Kind.RAPID if stroke.use is Use.RAPID else Kind.FEED, end), feed)
            continue
        ccw = stroke.ccw is (work.towards < 0.0)
        center = (stroke.center[0], height(work, stroke.center[1]))
        work.perform(PlaneStroke(Kind.CCW if ccw else Kind.CW, end, center), feed)


class _Groove:
    """How deep the tool may go in a groove, and where it meets stock, for roughing and for finishing."""

    def __init__(self, work: Work, a: Arguments, turning: Turning, tool: Tool, over: float) -> None:
        self.work, self.a, self.turning, self.tool, self.over = work, a, turning, tool, over
        self.stage = a.digit("_VARI", STAGE)
        self.follows = a.digit("_VARI", ROUNDING) != WITHOUT_ROUNDING
        self.top = height(work, turning.top)
        contour = upright(outline.from_front(turning.part, turning.front), work.towards)
        self.places = (contour[0].edge.start[0], contour[-1].edge.end[0] - tool.width + SNUG_MM)
        if self.places[1] <= self.places[0]:
            raise AlarmError("61602")
        try:
            self.part = profile(contour, self.top)
        except ValueError:
            raise AlarmError("61606") from None

    def roughing(self, away: float) -> cuts.Work:
        """Down to the allowances, out of the blank; `away` along the cuts from where the contour stands."""
        a, work, tool = self.a, self.work, self.tool
        if a.digit("_VARI", ALLOWANCE) == ALONG_CONTOUR:
            part = dilated(self.part, abs(a["_U"]))
        else:
            part = widened(self.part, *work.pair(abs(a["_UZ"]), abs(a["_UX"])))
        floor = of_tool(self._limited(part), tool.radius, tool.width)
        stock = level(self.top, *self.places)
        if self.turning.stock is not None:
            stock = self._outline(self.turning.stock)
        lift = self.turning.lift
        return cuts.Work(moved(floor, away, 0.0), moved(stock, away, 0.0), lift, self.over)

    def _outline(self, contour: Contour) -> Profile:
        """Where the tool's point meets a blank that is no cylinder."""
        try:
            found = profile(upright(contour, self.work.towards), blanks.NOTHING)
        except ValueError:
            raise AlarmError("61606") from None
        met = of_tool(found, self.tool.radius, self.tool.width)
        return Profile(
            envelope([*cropped(met, *self.places).curves, *level(blanks.NOTHING, *self.places).curves])
        )

    def _limited(self, part: Profile) -> Profile:
        """The contour with walls and a base where the limits of the call are.

        Raises:
            AlarmError: PC0001 where it is not clear whether limits count.
        """
        a, work = self.a, self.work
        if not any(a[name] for name in blanks.LIMITS):
            return part
        if a.digit("_GMODE", blanks.HAS_LIMITS) != 1 or self.stage != ROUGHING:
            raise not_supported(f"CYCLE952 {blanks.LIMITS[0]}")
        first, second = work.pair(a["_ZA"], a["_XA"]), work.pair(a["_ZB"], a["_XB"])
        low, high = sorted((first[0], second[0]))
        base = min(height(work, first[1]), height(work, second[1]))
        beside = max(self.top, part.highest(part.begin, part.end))
        walls = [
            level(beside, part.begin, min(low, part.end)),
            level(beside, max(high, part.begin), part.end),
        ]
        curves = [*part.curves, *level(base, part.begin, part.end).curves]
        curves += [curve for wall in walls for curve in wall.curves if curve.end[0] > curve.start[0]]
        return Profile(envelope(curves), part.posts)

    def finishing(self, away: float) -> cuts.Work:
        """Down to the contour, from end to end of it."""
        left = self.a["_U1"] if self.a.digit("_AMODE", WITH_U1) == 1 else 0.0
        floor = of_tool(dilated(self.part, left), self.tool.radius, self.tool.width)
        stock = level(_top(self.work, self.a, self.turning) + _HAIR, *self.places)
        lift = self.turning.lift
        return cuts.Work(moved(floor, away, 0.0), moved(stock, away, 0.0), lift, self.over)
