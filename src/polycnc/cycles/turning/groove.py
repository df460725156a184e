"""A rectangular groove on a lathe with a parting tool (SINUMERIK CYCLE93).

Points are (w, t): `w` runs from the edge at which the groove begins to the other one, `t` from the rim down to the
base. They are those of the tool's edge that lies nearer to where the groove begins.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from polycnc.cycles.count import parts
from polycnc.deferred.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator

#: The tool goes so far off the wall that it has cut before it leaves the groove, mm.
OFF_WALL_MM = 1.0
_WHOLE = 1e-9


class GrooveStroke(NamedTuple):
    """A stroke; a dwell at the base has no point."""

    end: tuple[float, float] | None
    is_rapid: bool = False


DWELL = GrooveStroke(None)


@dataclass(frozen=True, slots=True)
class Groove:
    """A groove and how it is cut; mm.

    Attributes:
        width: From edge to edge.
        depth: From rim to base.
        tool_width: Of the tool, not above what the flank allowances leave.
        base_allowance, flank_allowance: Left by roughing for a finishing cut.
        infeed: Greatest depth of one infeed; 0 for all at once.
        lift: Height above the rim between cuts, and way back between infeeds.
    """

    width: float
    depth: float
    tool_width: float
    base_allowance: float = 0.0
    flank_allowance: float = 0.0
    infeed: float = 0.0
    lift: float = 1.0


def strokes(groove: Groove) -> Iterator[GrooveStroke]:
    """Plunges side by side, each in equal infeeds, then both walls with half of the base each where stock is left."""
    yield from _rough(groove)
    if groove.base_allowance > 0.0 or groove.flank_allowance > 0.0:
        yield from _finish(groove)


def _rough(groove: Groove) -> Iterator[GrooveStroke]:
    first = groove.flank_allowance
    way = groove.width - 2.0 * groove.flank_allowance - groove.tool_width
    steps = parts(way, groove.tool_width, _WHOLE)
    base = groove.depth - groove.base_allowance
    infeeds = max(parts(base, groove.infeed, _WHOLE), 1) if groove.infeed > 0.0 else 1
    for column in range(max(steps, 0) + 1):
        w = first + (way * column / steps if steps > 0 else 0.0)
        yield GrooveStroke((w, -groove.lift), is_rapid=True)
        for k in range(1, infeeds + 1):
            t = base * k / infeeds
            yield GrooveStroke((w, t))
            if k < infeeds:
                yield GrooveStroke((w, t - groove.lift), is_rapid=True)
        yield DWELL
        out = w
        if column:
            out = w - min(OFF_WALL_MM, way / steps)
            yield GrooveStroke((out, base))
        yield GrooveStroke((out, -groove.lift), is_rapid=True)


def _finish(groove: Groove) -> Iterator[GrooveStroke]:
    last = groove.width - groove.tool_width
    for wall in (0.0, last):
        yield GrooveStroke((wall, -groove.lift), is_rapid=True)
        yield GrooveStroke((wall, groove.depth))
        yield GrooveStroke((0.5 * last, groove.depth))
        yield GrooveStroke((0.5 * last, -groove.lift), is_rapid=True)
