"""Stock removal by parallel strokes with pockets: type II of G71 and G72 (0i-TF Plus II.4.2.1, 4.2.2).

A pocket is a run of the contour that goes down from a height and comes up to it again (or ends). It is cleared by one
stroke as deep as the infeed allows; what lies below that stroke are pockets again, each cleared to its bottom before
the next one, from the start side on. A step that lies less deep than a stroke is left to the pass along the shape.

    above  ──┐entry          exit┌──      the tool comes to the entry's top, cuts along it to the level,
             └┐    stroke       ┌┘        makes the stroke, follows the exit up to the height above
    level     └─────────────────┘         and retracts; from a bottom it leaves at 45 degrees
"""

from __future__ import annotations

from math import copysign

from polycnc.cycles.turning.contour import bumps, deepest, runs, slopes
from polycnc.cycles.turning.stroke import PlaneStroke, feed
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.turning.contour import Contour, Piece
    from polycnc.cycles.turning.cuts import Roughing
    from polycnc.geometry.arcs import Point

    #: A stroke, or what makes further ones.
    _Work = PlaneStroke | Iterator["_Work"]

#: Strokes shorter than this are points, mm.
_HAIR = 1e-6


@dataclass(slots=True)
class _Tool:
    """Where the tool is, and whether it has already cut: the first infeed begins at the start point."""

    at: Point
    has_cut: bool = False


def clear_pockets(
    contour: Contour, cuts: Roughing, towards: float, *, skips_bottom: bool
) -> Iterator[PlaneStroke]:
    """All strokes of a contour, from its first point on.

    Args:
        contour: From the start point over the shape; its first piece is the infeed.
        cuts: What the cycle is told.
        towards: Direction of infeed along `b`, 1 or -1.
        skips_bottom: The stroke along a bottom is left out (NSP: the pass along the shape makes it).
    """
    begin = contour[0].edge.start
    onwards = copysign(1.0, contour[-1].edge.end[0] - begin[0])
    clearing = _Clearing(cuts, towards, onwards, contour[0], skips_bottom=skips_bottom)
    yield PlaneStroke(Kind.RAPID, begin)
    # Pockets within pockets wait on a stack of their own: recursion would hand every stroke through all levels.
    open_pockets = [clearing.clear(contour, begin[1], _Tool(begin))]
    while open_pockets:
        item = next(open_pockets[-1], None)
        if item is None:
            open_pockets.pop()
        elif isinstance(item, PlaneStroke):
            yield item
        else:
            open_pockets.append(item)


class _Clearing:
    """The strokes of one cycle."""

    def __init__(
        self, cuts: Roughing, towards: float, onwards: float, infeed: Piece, *, skips_bottom: bool
    ) -> None:
        self.cuts, self.towards, self.onwards = cuts, towards, onwards
        self.infeed_from, self.infeed_to = infeed.edge.start, infeed.edge.end
        self.skips_bottom = skips_bottom

    def clear(self, pocket: Contour, above: float, tool: _Tool) -> Iterator[_Work]:
        """Everything of a pocket below the height `above`: strokes, and pockets to be cleared in between."""
        towards = self.towards
        bottom = deepest(pocket, towards)
        if towards * (bottom - above) <= _HAIR:
            return
        level = above + towards * min(self.cuts.depth, towards * (bottom - above))
        found = runs(pocket, level, towards)
        for number, (is_deep, run) in enumerate(found):
            if not is_deep:
                for bump in bumps(run, towards):
                    # One that just touches the level is a point there: nothing to clear.
                    if towards * (deepest(bump, towards) - level) < -_HAIR:
                        yield self.clear(bump, above, tool)
                continue
            if abs(run[-1].edge.end[0] - run[0].edge.start[0]) <= _HAIR:
                continue
            entry = self._entry(found[number - 1][1], above, is_first=number == 1) if number else []
            leaving = found[number + 1][1] if number + 1 < len(found) else []
            is_bottom = towards * (deepest(run, towards) - level) <= _HAIR
            if is_bottom and self.skips_bottom:
                continue
            yield from self._enter(entry, run, level, above, tool)
            yield feed(run[-1].edge.end[0], level)
            yield from self._leave(leaving, run, level, tool, is_bottom=is_bottom)
            yield self.clear(run, level, tool)

    def _entry(self, run: Contour, above: float, *, is_first: bool) -> Contour:
        """The way down to a stroke: what lies behind the last point at the height `above`, else behind the ridge."""
        pieces, begin = slopes(run), 0
        for number, piece in enumerate(pieces, 1):
            if self.towards * (piece.edge.end[1] - above) <= _HAIR:
                begin = number
        while not is_first and begin < len(pieces) and self._rise(pieces[begin]) > _HAIR:
            begin += 1
        return pieces[begin:]

    def _rise(self, piece: Piece) -> float:
        return self.towards * (piece.edge.start[1] - piece.edge.end[1])

    def _enter(
        self, entry: Contour, run: Contour, level: float, above: float, tool: _Tool
    ) -> Iterator[PlaneStroke]:
        """To the start of a stroke: along the infeed of the shape's first block, or down the pocket's side."""
        cuts = self.cuts
        top = entry[0].edge.start if entry else run[0].edge.start
        target = (run[0].edge.start[0], level)
        if self._is_on_infeed(top):
            infeed = Kind.RAPID if cuts.infeed_rapid else Kind.FEED
            if tool.has_cut:
                yield from self._up(above, tool)
                yield PlaneStroke(Kind.RAPID, (top[0], tool.at[1]))
                yield PlaneStroke(Kind.RAPID if cuts.returns_rapid else infeed, top)
            if self._is_on_infeed(target):
                yield PlaneStroke(infeed, target)
            else:
                yield PlaneStroke(infeed, self.infeed_to)
                yield from (piece.stroke() for piece in entry if not self._is_on_infeed(piece.edge.end))
        else:
            yield from self._approach(top, above, tool)
            yield from (piece.stroke() for piece in entry)
        tool.at, tool.has_cut = target, True

    def _is_on_infeed(self, point: Point) -> bool:
        """Whether a point lies on the way from the start point to the first point of the shape."""
        (a0, b0), (a1, b1) = self.infeed_from, self.infeed_to
        across = (point[0] - a0) * (b1 - b0) - (point[1] - b0) * (a1 - a0)
        inside = min(b0, b1) - _HAIR <= point[1] <= max(b0, b1) + _HAIR
        return inside and abs(across) <= _HAIR * max(abs(b1 - b0), abs(a1 - a0), 1.0)

    def _up(self, above: float, tool: _Tool) -> Iterator[PlaneStroke]:
        """Out of a deeper pocket, to the height that is free."""
        if self.towards * (tool.at[1] - above) > NO_WAY:
            tool.at = (tool.at[0], above)
            yield PlaneStroke(Kind.RAPID, tool.at)

    def _approach(self, top: Point, above: float, tool: _Tool) -> Iterator[PlaneStroke]:
        """To the top of a pocket's side: rapid to the clearance in front of it, the rest at feed (5134)."""
        clearance = self.cuts.clearance
        yield from self._up(above, tool)
        a, b = tool.at
        if abs(b - above) <= NO_WAY:
            short = min(clearance, abs(top[0] - a))
            yield PlaneStroke(Kind.RAPID, (top[0] - copysign(short, top[0] - a), above))
        else:
            yield PlaneStroke(Kind.RAPID, (top[0], b))
            short = min(clearance, abs(b - above))
            yield PlaneStroke(Kind.RAPID, (top[0], above - self.towards * short))
        if abs(top[1] - above) > _HAIR:
            yield feed(top[0], above)
        yield feed(*top)

    def _leave(
        self, leaving: Contour, run: Contour, level: float, tool: _Tool, *, is_bottom: bool
    ) -> Iterator[PlaneStroke]:
        """Off after a stroke: from a bottom at 45 degrees, else along the shape and straight off it."""
        cuts, towards = self.cuts, self.towards
        at = (run[-1].edge.end[0], level)
        if is_bottom:
            tool.at = (at[0] - self.onwards * cuts.escape, at[1] - towards * cuts.escape)
            yield feed(*tool.at)
            return
        for piece in slopes(leaving):
            rise = self._rise(piece)
            if rise < -_HAIR or (rise <= _HAIR and not cuts.follows_flats):
                break
            yield piece.stroke()
            at = piece.edge.end
        tool.at = (at[0], at[1] - towards * cuts.escape)
        yield feed(*tool.at)
