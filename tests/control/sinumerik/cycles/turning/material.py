"""What a turning cycle does to the material: a stock of heights over the cuts, and the ways of a tool's edge.

Coordinates are (a, b): the cuts run towards smaller a, the infeed towards smaller b, on every side of the work.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, ceil, cos, floor, hypot, pi, sin, sqrt
from typing import Any

from polycnc.session import open_session

Point = tuple[float, float]
#: The work reaches from here on; a face stands on a cylinder of this radius.
BORE, CYLINDER = 60.0, 60.0
NOWHERE = -1e9


@dataclass(frozen=True)
class Side:
    """Where the work is turned: the direction of the cuts and of the infeed in `_VARI`, and the tool's point."""

    kind: int
    cuts: int
    infeed: int
    tip: int

    def vari(self, stage: int, rest: str = "10") -> str:
        """`_VARI`; `rest` are the digits for rounding and allowance."""
        return f"{rest}{self.infeed}{self.cuts}{stage}{self.kind}"

    def place(self, point: Point) -> Point:
        """(Z, X of radius) of a point."""
        a, b = point
        if self.kind == 2:
            return (b, CYLINDER + a)
        return (a, b) if self.infeed == 1 else (a, BORE - b)

    def point(self, place: Point) -> Point:
        """(a, b) of a place."""
        z, x = place
        if self.kind == 2:
            return (x - CYLINDER, z)
        return (z, x) if self.infeed == 1 else (z, BORE - x)

    def amounts(self, along: float, into: float) -> Point:
        """An amount along the cuts and one along the infeed, as (Z, X)."""
        return (into, along) if self.kind == 2 else (along, into)


OUTSIDE, INSIDE, FACE = Side(1, 3, 1, 3), Side(1, 3, 2, 2), Side(2, 1, 3, 3)


@dataclass(frozen=True)
class Edge:
    """The tool's edge: its nose, and how wide it is in front of it (towards larger a)."""

    radius: float
    width: float = 0.0

    def centers(self, point: Point) -> Iterator[Point]:
        """Middles of its noses, where the tool's point is."""
        yield (point[0] + self.radius, point[1] + self.radius)
        if self.width:
            yield (point[0] + self.width - self.radius, point[1] + self.radius)

    def foot(self, point: Point, a: float) -> float | None:
        """How deep the edge reaches at a place; None where it is not."""
        low, high = point[0], point[0] + max(self.width, 2.0 * self.radius)
        if not low <= a <= high:
            return None
        beside = max(low + self.radius - a, a - (high - self.radius), 0.0)
        return point[1] + self.radius - sqrt(max(self.radius**2 - beside**2, 0.0))


Ways = list[tuple[bool, list[Point]]]


def turn(side: Side, contour: list[Point], radius: float, call: str, *before: str, **setup: Any) -> Any:
    """Run a call of CYCLE952 on a contour."""
    z, x = side.place((20.0, 40.0))
    lines = [
        "G18 G90 DIAMON G95", "T1 D1", "S500 M3 F0.1", f"G0 X{2 * x} Z{z}", *before, 'CYCLE62("",2,"AA","BB")', call,
        "M30",
    ]  # fmt: skip
    for number, point in enumerate(contour):
        z, x = side.place(point)
        label = "AA: G1 " if not number else "BB: " if number == len(contour) - 1 else ""
        lines.append(f"{label}X{2 * x} Z{z}")
    tools = {1: {"type": 500, "radius": radius, "tip": side.tip}}
    setup = {"machine": "lathe2", "tools": tools, **setup}
    return open_session("\n".join(lines) + "\n", control="sinumerik-840d", setup=setup).run()


def ways(side: Side, result: Any, step: float = 0.1) -> Ways:
    """The ways of the tool's point, each as points that are near to each other, and whether it is a rapid."""
    found: Ways = []
    at: Point | None = None
    for row in result.rows:
        if "to" not in row:
            continue
        end = side.point((row["to"]["Z"], row["to"]["X"] / 2.0))
        if at is not None:
            center = None
            if row["type"] in ("cw", "ccw"):
                center = side.point((row["center"]["Z"], row["center"]["X"] / 2.0))
            found.append((row["type"] == "rapid", list(_points(at, end, center, step))))
        at = end
    return found


def _points(start: Point, end: Point, center: Point | None, step: float) -> Iterator[Point]:
    if center is None:
        count = max(1, ceil(hypot(end[0] - start[0], end[1] - start[1]) / step))
        for k in range(count + 1):
            yield tuple(p + (q - p) * k / count for p, q in zip(start, end, strict=True))  # type: ignore[misc]
        return
    radius = hypot(start[0] - center[0], start[1] - center[1])
    begin = atan2(start[1] - center[1], start[0] - center[0])
    sweep = (atan2(end[1] - center[1], end[0] - center[0]) - begin + pi) % (2.0 * pi) - pi
    count = max(2, ceil(abs(sweep) * radius / step))
    for k in range(count + 1):
        angle = begin + sweep * k / count
        yield (center[0] + radius * cos(angle), center[1] + radius * sin(angle))


class Stock:
    """Heights over places along the cuts."""

    def __init__(self, end: float, front: float, top: float, step: float = 0.1) -> None:
        self.places = [front - k * step for k in range(int((front - end) / step) + 1)]
        self.heights = [top] * len(self.places)
        self.front, self.step = front, step

    def _under(self, edge: Edge, point: Point) -> Iterator[tuple[int, float]]:
        reach = max(edge.width, 2.0 * edge.radius)
        first = max(0, floor((self.front - point[0] - reach) / self.step))
        last = min(len(self.places) - 1, ceil((self.front - point[0]) / self.step))
        for number in range(first, last + 1):
            foot = edge.foot(point, self.places[number])
            if foot is not None:
                yield number, foot

    def cut(self, edge: Edge, point: Point) -> None:
        """The edge takes away what it reaches."""
        for number, foot in self._under(edge, point):
            self.heights[number] = min(self.heights[number], foot)

    def met(self, edge: Edge, point: Point) -> float:
        """How deep the edge stands in the stock, mm."""
        return max((self.heights[number] - foot for number, foot in self._under(edge, point)), default=0.0)

    def left(self, contour: list[Point]) -> float:
        """The most that stands above a contour, square to the cuts."""
        heights = [(height(contour, a), h) for a, h in zip(self.places, self.heights, strict=True)]
        return max(h - part for part, h in heights if part is not None)


def height(contour: list[Point], a: float) -> float | None:
    """Height of a contour at a place; None in front of it and behind it."""
    found = [
        max(b0, b1) if a0 == a1 else b0 + (b1 - b0) * (a - a0) / (a1 - a0)
        for (a0, b0), (a1, b1) in pairwise(contour)
        if min(a0, a1) <= a <= max(a0, a1)
    ]
    return max(found, default=None)


def distance(contour: list[Point], point: Point) -> float:
    """From a point to a contour, negative below it."""
    nearest = min(_distance(point, a, b) for a, b in pairwise(contour))
    part = height(contour, point[0])
    return -nearest if part is not None and point[1] < part else nearest


def _distance(point: Point, a: Point, b: Point) -> float:
    u, v = b[0] - a[0], b[1] - a[1]
    share = ((point[0] - a[0]) * u + (point[1] - a[1]) * v) / (u * u + v * v or 1.0)
    share = min(max(share, 0.0), 1.0)
    return hypot(point[0] - a[0] - share * u, point[1] - a[1] - share * v)


def gouge(
    contour: list[Point], edge: Edge, found: Ways, allowance: Point = (0.0, 0.0), even: float = 0.0
) -> float:
    """How deep the edge goes into the contour with what is to stay on it, mm; 0 or less where it does not.

    The stock that stays is what the contour sweeps along `allowance`, (a, b), and `even` all round.
    """
    worst = -1.0
    for _, points in found:
        for point in points:
            for a, b in edge.centers(point):
                for share in (0.0, 0.5, 1.0):
                    center = (a - share * allowance[0], b - share * allowance[1])
                    worst = max(worst, edge.radius + even - distance(contour, center))
    return worst


def cut_all(stock: Stock, edge: Edge, found: Ways) -> float:
    """Take away what the ways do; gives how deep a rapid stood in the stock, mm."""
    worst = 0.0
    for is_rapid, points in found:
        for point in points:
            if is_rapid:
                worst = max(worst, stock.met(edge, point))
            else:
                stock.cut(edge, point)
    return worst
