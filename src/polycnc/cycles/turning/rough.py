"""Stock removal by parallel strokes: G71 and G72 of FANUC, types I and II (0i-TF Plus II.4.2.1, 4.2.2, 6.4.1).

Coordinates are those of `contour`: `a` along the strokes, `b` in the direction of infeed. The contour begins with the
way from the start point to the shape's first point; the shape follows.
"""

from __future__ import annotations

from math import copysign, hypot

from polycnc.cycles.turning.contour import gaps, shifted
from polycnc.cycles.turning.pockets import clear_pockets
from polycnc.cycles.turning.stroke import PlaneStroke, feed
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.turning.contour import Contour
    from polycnc.cycles.turning.cuts import Roughing
    from polycnc.geometry.arcs import Point


def rough(contour: Contour, cuts: Roughing) -> Iterator[PlaneStroke]:
    """All strokes of the cycle, from the start point and back to it."""
    start, first = contour[0].edge.start, contour[0].edge.end
    towards = copysign(1.0, first[1] - start[1])
    left = (cuts.allowance[0] + cuts.extra[0], cuts.allowance[1] + cuts.extra[1])
    stock = shifted(contour, *left)
    finish = shifted(contour, *cuts.allowance)
    has_extra = cuts.extra != (0.0, 0.0)
    finishes = cuts.finishes or has_extra
    if cuts.pockets:
        last = start
        skips = cuts.skips_bottoms and finishes and not has_extra
        for stroke in clear_pockets(stock, cuts, towards, skips_bottom=skips):
            last = stroke.end
            yield stroke
        yield from _home(contour, last, cuts, towards)
    else:
        yield from _strokes(stock, cuts, towards, to_bottom=has_extra or not cuts.finishes)
        if has_extra or not finishes:
            yield PlaneStroke(Kind.RAPID, start)
    if not finishes:
        return
    yield PlaneStroke(Kind.RAPID if cuts.infeed_rapid else Kind.FEED, finish[0].edge.end)
    yield from (piece.stroke() for piece in finish[1:])
    yield from _home(contour, finish[-1].edge.end, cuts, towards)


def _home(contour: Contour, at: Point, cuts: Roughing, towards: float) -> Iterator[PlaneStroke]:
    """Back to the start; type II passes one depth above a shape that is as high as the start (II.4.2.1)."""
    start, shape = contour[0].edge.start, contour[1:] or contour
    highest = min(towards * piece.edge.end[1] for piece in shape)
    if cuts.pockets and highest <= towards * start[1] + NO_WAY:
        yield PlaneStroke(Kind.RAPID, (at[0], start[1] - towards * cuts.depth))
    yield PlaneStroke(Kind.RAPID, start)


def _levels(contour: Contour, depth: float, towards: float, *, to_bottom: bool) -> Iterator[float]:
    """Levels from the start point to the first point of the shape; the last one, that point's own, if asked for."""
    begin, bottom = contour[0].edge.start[1], contour[0].edge.end[1]
    number = 1
    while towards * (bottom - begin) - number * depth > NO_WAY:
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
    """RPA: straight back to where the stroke began (II.4.2.9); the last part, or all of a short way, at feed."""
    if cuts.infeed_rapid:
        yield PlaneStroke(Kind.RAPID, start)
        return
    way = hypot(start[0] - away[0], start[1] - away[1])
    if way > cuts.feeds_last:
        part = 1.0 - cuts.feeds_last / way
        yield PlaneStroke(
            Kind.RAPID, (away[0] + part * (start[0] - away[0]), away[1] + part * (start[1] - away[1]))
        )
    yield feed(*start)


def _end_on(contour: Contour, level: float) -> float:
    """Where a stroke at the bottom level ends: where the shape leaves that level."""
    end = contour[0].edge.end[0]
    for piece in contour[1:]:
        if abs(piece.edge.end[1] - level) > NO_WAY or piece.edge.center is not None:
            break
        end = piece.edge.end[0]
    return end
