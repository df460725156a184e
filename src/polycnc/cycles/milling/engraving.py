"""Text that is engraved on a line or along a circle (SINUMERIK CYCLE60)."""

from __future__ import annotations

from math import atan2, cos, hypot, sin

from polycnc.cycles.milling.letters import HEIGHT, WIDTH, drawn
from polycnc.cycles.milling.stroke import Place, cut, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point


@dataclass(frozen=True, slots=True)
class Line:
    """Text in a straight line: its reference point and direction."""

    place: Place

    def at(self, x: float, y: float) -> Point:
        """A point: x along the line, y up."""
        return self.place(x, y)


@dataclass(frozen=True, slots=True)
class Circle:
    """Text along a circle through the reference point.

    Attributes:
        center: Of the circle.
        start: The reference point.
        inwards: The letters stand on the inside and run counter-clockwise; else on the outside, clockwise.
    """

    center: Point
    start: Point
    inwards: bool

    @property
    def radius(self) -> float:
        """Of the circle."""
        return hypot(self.start[0] - self.center[0], self.start[1] - self.center[1])

    def at(self, x: float, y: float) -> Point:
        """A point: x along the circle, y up."""
        side = -1.0 if self.inwards else 1.0
        angle = atan2(self.start[1] - self.center[1], self.start[0] - self.center[0]) - side * x / self.radius
        radius = self.radius + side * y
        return self.center[0] + radius * cos(angle), self.center[1] + radius * sin(angle)


@dataclass(frozen=True, slots=True)
class Inscription:
    """A text and how it is engraved; mm.

    Attributes:
        text: Letters that are all drawn.
        path: Where it stands.
        height: Of capitals.
        gap: Between two letters.
        shift: Parts of length and height by which it lies before the reference point: 0, a half, or 1.
        infeed, feed: Feeds into the work and in it.
        safe, retract, depth: Levels.
        mirrored: The text is written backwards, its letters the wrong way round, in the place where it would stand.
    """

    text: str
    path: Line | Circle
    height: float
    gap: float
    shift: tuple[float, float]
    infeed: float
    feed: float
    safe: float
    retract: float
    depth: float
    mirrored: bool = False

    @property
    def scale(self) -> float:
        """A unit of the drawings, mm."""
        return self.height / HEIGHT

    @property
    def length(self) -> float:
        """Of the text."""
        return len(self.text) * WIDTH * self.scale + max(len(self.text) - 1, 0) * self.gap

    def lines(self) -> Iterator[list[Point]]:
        """The lines of all letters, in the plane."""
        left, down = self.shift[0] * self.length, self.shift[1] * self.height
        for number, letter in enumerate(self.text):
            begin = number * (WIDTH * self.scale + self.gap) - left
            for line in drawn(letter) or ():
                along = (begin + x * self.scale for x, _ in line)
                if self.mirrored:
                    along = (self.length - 2.0 * left - x for x in along)
                yield [self.path.at(x, y * self.scale - down) for x, (_, y) in zip(along, line, strict=True)]


def gap_of_width(count: int, height: float, width: float) -> float:
    """The gap between letters of a height that makes a text so wide."""
    return (width - count * WIDTH * height / HEIGHT) / max(count - 1, 1)


def strokes(inscription: Inscription) -> Iterator[MillStroke]:
    """Over each line at rapid, down, along it, up."""
    for line in inscription.lines():
        yield rapid(line[0])
        yield rapid(w=inscription.safe)
        yield cut(inscription.infeed, w=inscription.depth)
        for point in line[1:]:
            yield cut(inscription.feed, point)
        yield rapid(w=inscription.safe)
    yield rapid(w=inscription.retract)
