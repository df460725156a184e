"""Stock removal along a turned contour: equal cuts, section by section (SINUMERIK CYCLE95).

Coordinates are those of `contour`: `a` along the cuts, `b` in the direction of infeed. There is no blank: the highest
point of the contour is where the material begins. A contour that goes down again behind a summit has a relief; it is
cut after what lies in front of it, from the level at which the summit closes it off.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, copysign
from typing import TYPE_CHECKING

from polycnc.cycles.turning.contour import climb, gaps, points
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.turning.contour import Contour, Gap
    from polycnc.geometry.arcs import Point

_HAIR = 1e-7
_WHOLE = 1e-6


@dataclass(frozen=True, slots=True)
class Removal:
    """What stock removal is told; mm.

    Attributes:
        depth: Greatest depth of a cut.
        lift: Way off the work along both axes after a cut, and distance in front of it.
        towards: Direction of infeed, 1 or -1.
        follows: After a cut the tool follows the contour up to the cut before.
    """

    depth: float
    lift: float
    towards: float
    follows: bool = True


@dataclass(frozen=True, slots=True)
class Cut:
    """A stroke, what it belongs to, and whether it goes down into a relief."""

    stroke: PlaneStroke
    is_relief: bool = False
    is_straight: bool = False


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the contour that opens upwards: its deepest point, and the height at which it is closed off."""

    place: float
    bottom: float
    top: float


def sections(contour: Contour, towards: float) -> list[Section]:
    """The parts of the contour between its summits, in its direction; the first one is open to the front."""
    heights = _heights(contour, towards)
    result: list[Section] = []
    top = max(height for _, height in heights)
    lowest, summit, rising = heights[0], heights[0][1], False
    for a, height in heights[1:]:
        if rising and height < summit - _HAIR:
            result.append(Section(*lowest, top))
            top, lowest, rising = summit, (a, height), False
        elif rising:
            summit = max(summit, height)
        elif height > lowest[1] + _HAIR:
            summit, rising = height, True
        elif height < lowest[1]:
            lowest = (a, height)
    return [*result, Section(*lowest, top)]


def _heights(contour: Contour, towards: float) -> list[Point]:
    """(a, height) along the contour; heights count against the direction of infeed."""
    return [(a, -towards * b) for piece in contour for a, b in points(piece.edge)]


def _levels(section: Section, depth: float) -> list[float]:
    """Heights of the cuts of a section: as few as the depth allows, all equally deep."""
    total = section.top - section.bottom
    if total <= _HAIR:
        return []
    count = max(1, ceil(total / depth - _WHOLE))
    return [section.top - total * k / count for k in range(1, count)] + [section.bottom]


def remove(contour: Contour, removal: Removal) -> Iterator[Cut]:
    """All cuts of the contour, each from its infeed to the way back."""
    towards = removal.towards
    begin, end = contour[0].edge.start, contour[-1].edge.end
    onwards = copysign(1.0, end[0] - begin[0])
    for section in sections(contour, towards):
        above = section.top
        for height in _levels(section, removal.depth):
            level = -towards * height
            # On the flat of a base the contour is not deeper than the cut: look a hair above it.
            seen = level - towards * _HAIR if height == section.bottom else level
            gap = _gap_at(contour, seen, towards, section.place)
            if gap is None:
                continue
            front = abs(gap.start - begin[0]) <= 2.0 * _HAIR
            entry = begin[0] - onwards * removal.lift if front else gap.start
            yield from _cut(contour, removal, gap, (entry, level, -towards * above), onwards, front=front)
            above = height


def _gap_at(contour: Contour, level: float, towards: float, place: float) -> Gap | None:
    """The gap of a level over a place; None where it is only a point."""
    for gap in gaps(contour, level, towards):
        low, high = sorted((gap.start, gap.end))
        if low - 2.0 * _HAIR <= place <= high + 2.0 * _HAIR and high - low > 10.0 * _HAIR:
            return gap
    return None


def _cut(
    contour: Contour,
    removal: Removal,
    gap: Gap,
    at: tuple[float, float, float],
    onwards: float,
    *,
    front: bool,
) -> Iterator[Cut]:
    """One cut; `at` is where it begins, its level, and the level of the cut before."""
    entry, level, former = at
    towards, lift = removal.towards, removal.lift
    if front:
        yield Cut(PlaneStroke(Kind.RAPID, (entry, level)))
    else:
        yield Cut(PlaneStroke(Kind.RAPID, (entry, former - towards * lift)))
        yield Cut(PlaneStroke(Kind.FEED, (entry, level)), is_relief=True)
    yield Cut(PlaneStroke(Kind.FEED, (gap.end, level)), is_straight=True)
    last = (gap.end, level)
    if removal.follows:
        for piece in climb(contour, gap, level, former, towards):
            yield Cut(piece.stroke())
            last = piece.edge.end
    if not front:
        last = (last[0], former)
    # A relief has a flank behind the tool: straight up. In front of the open section nothing stands.
    off = (last[0] - onwards * lift if front else last[0], last[1] - towards * lift)
    yield Cut(PlaneStroke(Kind.FEED, off))
    yield Cut(PlaneStroke(Kind.RAPID, (entry, off[1])))
