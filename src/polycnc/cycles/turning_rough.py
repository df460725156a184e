"""Stock removal by parallel strokes: G71 and G72 of FANUC, types I and II (0i-TF Plus II.4.2.1, 4.2.2, 6.4.1).

Coordinates are those of `contour`: `a` along the strokes, `b` in the direction of infeed. The contour begins with the
way from the start point to the shape's first point; the shape follows.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, hypot
from typing import TYPE_CHECKING

from polycnc.cycles.contour import climb, gaps, points, shifted
from polycnc.cycles.plane_stroke import PlaneStroke, feed
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.contour import Contour, Gap
    from polycnc.geometry.arcs import Point

_SAME = 1e-9
_HAIR = 1e-7


@dataclass(frozen=True, slots=True)
class Roughing:
    """What a roughing cycle is told; amounts mm of radius.

    Attributes:
        depth: Infeed of a stroke.
        escape: Way off the work after a stroke.
        allowance: Finishing allowance along (a, b), signed.
        extra: Further allowance that the strokes leave and the rough finishing takes off.
        pockets: Type II: the shape may go down again.
        finishes: Follow the shape after the last stroke.
        infeed_rapid: Infeed as the first block of the shape has it.
        escape_rapid: The way off at 45 degrees is a rapid.
        clearance: Distance from a pocket's next stroke at which rapid becomes feed.
        returns_straight: From the way off straight to the start of the stroke before (RPA); with infeed at feed the
            last `feeds_last` mm of it.
        returns_rapid: The way back to the level before is rapid (ASU); `returns_merged`: it is left out (ASC).
    """

    depth: float
    escape: float
    allowance: Point = (0.0, 0.0)
    extra: Point = (0.0, 0.0)
    pockets: bool = False
    finishes: bool = True
    infeed_rapid: bool = True
    escape_rapid: bool = False
    clearance: float = 0.0
    returns_rapid: bool = False
    returns_merged: bool = False
    returns_straight: bool = False
    feeds_last: float = 0.0


def rough(contour: Contour, cuts: Roughing) -> Iterator[PlaneStroke]:
    """All strokes of the cycle, from the start point and back to it."""
    start, first = contour[0].edge.start, contour[0].edge.end
    towards = copysign(1.0, first[1] - start[1])
    left = (cuts.allowance[0] + cuts.extra[0], cuts.allowance[1] + cuts.extra[1])
    stock = shifted(contour, *left)
    finish = shifted(contour, *cuts.allowance)
    has_extra = cuts.extra != (0.0, 0.0)
    if cuts.pockets:
        yield from _pockets(stock, cuts, towards)
    else:
        yield from _strokes(stock, cuts, towards, to_bottom=has_extra or not cuts.finishes)
    if cuts.finishes or has_extra:
        raised = _raised(contour, cuts, towards)
        if cuts.pockets or has_extra:
            yield from raised
            yield PlaneStroke(Kind.RAPID, start)
        kind = Kind.RAPID if cuts.infeed_rapid else Kind.FEED
        yield PlaneStroke(kind, finish[0].edge.end)
        yield from (piece.stroke() for piece in finish[1:])
        if cuts.pockets:
            yield from raised
    yield PlaneStroke(Kind.RAPID, start)


def _raised(contour: Contour, cuts: Roughing, towards: float) -> list[PlaneStroke]:
    """Type II: a shape as high as the start is passed one depth above it on the way back (II.4.2.1)."""
    start, last = contour[0].edge.start, contour[-1].edge.end
    highest = (
        min(towards * piece.edge.end[1] for piece in contour[1:]) if len(contour) > 1 else towards * last[1]
    )
    if not cuts.pockets or highest > towards * start[1] + _SAME:
        return []
    return [PlaneStroke(Kind.RAPID, (last[0], start[1] - towards * cuts.depth))]


def _levels(contour: Contour, depth: float, towards: float, *, to_bottom: bool) -> Iterator[float]:
    """Levels from the start point to the first point of the shape; the last one, that point's own, if asked for."""
    begin, bottom = contour[0].edge.start[1], contour[0].edge.end[1]
    number = 1
    while towards * (bottom - begin) - number * depth > _SAME:
        yield begin + towards * number * depth
        number += 1
    if to_bottom:
        yield bottom


def _strokes(contour: Contour, cuts: Roughing, towards: float, *, to_bottom: bool) -> Iterator[PlaneStroke]:
    """Type I: from the start side to the shape, off at 45 degrees, back, down to the next level."""
    begin = contour[0].edge.start
    onwards = copysign(1.0, contour[-1].edge.end[0] - begin[0])
    infeed = Kind.RAPID if cuts.infeed_rapid else Kind.FEED
    back = Kind.RAPID if cuts.returns_rapid else infeed
    before: float | None = None
    yield PlaneStroke(Kind.RAPID, begin)
    for level in _levels(contour, cuts.depth, towards, to_bottom=to_bottom):
        if before is not None and not cuts.returns_merged:
            yield PlaneStroke(back, (begin[0], before))
        yield PlaneStroke(infeed, (begin[0], level))
        found = gaps(contour, level, towards)
        end = found[0].end if found else _end_on(contour, level)
        yield feed(end, level)
        away = (end - onwards * cuts.escape, level - towards * cuts.escape)
        yield PlaneStroke(Kind.RAPID if cuts.escape_rapid else Kind.FEED, away)
        if cuts.returns_straight:
            yield from _straight_back(away, (begin[0], level), cuts)
        else:
            yield PlaneStroke(Kind.RAPID, (begin[0], away[1]))
        before = level
    if before is not None and not to_bottom and not cuts.returns_merged:
        yield PlaneStroke(back, (begin[0], before))


def _straight_back(away: Point, start: Point, cuts: Roughing) -> Iterator[PlaneStroke]:
    """RPA: straight back to where the stroke began (II.4.2.9)."""
    way = hypot(start[0] - away[0], start[1] - away[1])
    if not cuts.infeed_rapid and way > cuts.feeds_last:
        part = 1.0 - cuts.feeds_last / way
        yield PlaneStroke(
            Kind.RAPID, (away[0] + part * (start[0] - away[0]), away[1] + part * (start[1] - away[1]))
        )
        yield feed(*start)
    else:
        yield PlaneStroke(Kind.RAPID, start)


def _end_on(contour: Contour, level: float) -> float:
    """Where a stroke at the bottom level ends: where the shape leaves that level."""
    end = contour[0].edge.end[0]
    for piece in contour[1:]:
        if abs(piece.edge.end[1] - level) > _SAME or piece.edge.center is not None:
            break
        end = piece.edge.end[0]
    return end


def _pockets(contour: Contour, cuts: Roughing, towards: float) -> Iterator[PlaneStroke]:
    """Type II: every pocket from the start side on, each to its bottom before the next."""
    begin = contour[0].edge.start
    yield PlaneStroke(Kind.RAPID, begin)
    yield from _clear(contour, cuts, towards, begin[1], (begin[0], contour[-1].edge.end[0]), is_pocket=False)


def _clear(
    contour: Contour, cuts: Roughing, towards: float, above: float, span: Point, *, is_pocket: bool
) -> Iterator[PlaneStroke]:
    """Everything below a level between two ends: one stroke deeper, then what lies below that, gap by gap."""
    onwards = copysign(1.0, span[1] - span[0])
    bottom = _deepest(contour, span, towards)
    if towards * (bottom - above) <= _SAME:
        return
    level = above + towards * min(cuts.depth, towards * (bottom - above))
    at_bottom = abs(level - bottom) <= _SAME
    # On the flat of a pocket's bottom the contour is not deeper than the stroke: look a hair above it.
    seen = level - towards * _HAIR if at_bottom else level
    inside = [
        gap
        for gap in gaps(contour, seen, towards)
        if _within(gap, span) and abs(gap.end - gap.start) > _HAIR * 10
    ]
    for number, gap in enumerate(inside):
        yield from _enter(gap, level, above, cuts, towards, is_pocket=is_pocket or number > 0)
        yield feed(gap.end, level)
        yield from _leave(contour, gap, level, above, cuts, towards, onwards, at_bottom=at_bottom)
        pocket = is_pocket or gap.piece < len(contour)
        below = _clear(contour, cuts, towards, level, (gap.start, gap.end), is_pocket=pocket and number > 0)
        yield from below


def _enter(
    gap: Gap, level: float, above: float, cuts: Roughing, towards: float, *, is_pocket: bool
) -> Iterator[PlaneStroke]:
    """To the start of a stroke: down where it begins, in a pocket at rapid up to the clearance."""
    yield PlaneStroke(Kind.RAPID, (gap.start, above - towards * cuts.escape))
    if is_pocket:
        short = level - towards * min(cuts.clearance, abs(level - above) + cuts.escape)
        yield PlaneStroke(Kind.RAPID, (gap.start, short))
        yield feed(gap.start, level)
    else:
        yield PlaneStroke(Kind.RAPID if cuts.infeed_rapid else Kind.FEED, (gap.start, level))


def _leave(
    contour: Contour,
    gap: Gap,
    level: float,
    above: float,
    cuts: Roughing,
    towards: float,
    onwards: float,
    *,
    at_bottom: bool,
) -> Iterator[PlaneStroke]:
    """Off after a stroke: up along the shape to the level above and straight off it; from a bottom at 45 degrees."""
    if at_bottom:
        yield feed(gap.end - onwards * cuts.escape, level - towards * cuts.escape)
        yield PlaneStroke(Kind.RAPID, (gap.end - onwards * cuts.escape, above - towards * cuts.escape))
        return
    last = gap.end
    for piece in climb(contour, gap, level, above, towards):
        yield piece.stroke()
        last = piece.edge.end[0]
    yield feed(last, above - towards * cuts.escape)


def _within(gap: Gap, span: Point) -> bool:
    low, high = min(span) - _HAIR * 10, max(span) + _HAIR * 10
    return low <= min(gap.start, gap.end) and max(gap.start, gap.end) <= high


def _deepest(contour: Contour, span: Point, towards: float) -> float:
    """The deepest `b` of the contour between two ends."""
    low, high = min(span) - _HAIR, max(span) + _HAIR
    values = [towards * b for piece in contour for a, b in (*points(piece.edge),) if low <= a <= high]
    return towards * max(values)
