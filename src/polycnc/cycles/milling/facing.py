"""Face milling in strips (SINUMERIK CYCLE61, CYCLE71)."""

from __future__ import annotations

from polycnc.cycles.count import parts
from polycnc.cycles.milling.stroke import Place, cut, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point

_WHOLE = 1e-6


@dataclass(frozen=True, slots=True)
class Face:
    """A rectangle and how it is faced; mm.

    Attributes:
        place: A corner, and the direction of its length.
        length, width: From that corner, signed.
        radius: Of the tool.
        step: Greatest width of a strip.
        overrun: How far the tool leaves the face along the strips, beyond its own radius.
        overrun_across: How far it leaves the face at the last strip.
        across: Strips run along the width.
        alternating: Strips run to and fro; else all in one direction, with a rapid way back at the safety plane: beside
            the strip that was cut the stock still stands.
        feed: Of the cuts.
        safe, retract: Level of the safety plane and of the end.
        walls: Sides that the tool does not pass: lower and upper one of the length, then of the width.
    """

    place: Place
    length: float
    width: float
    radius: float
    step: float
    overrun: float
    overrun_across: float
    across: bool
    alternating: bool
    feed: float
    safe: float
    retract: float
    walls: tuple[bool, bool, bool, bool] = (False, False, False, False)

    @property
    def fits(self) -> bool:
        """Whether the tool has room between two walls."""
        return all(
            abs(way) >= 2.0 * self.radius - _WHOLE or not all(pair)
            for way, pair in ((self.length, self.walls[:2]), (self.width, self.walls[2:]))
        )

    def _walled(self, *, length: bool) -> tuple[bool, bool]:
        """Whether there is a wall where the length (or width) begins at the corner, and at its other end."""
        near, far = self.walls[:2] if length else self.walls[2:]
        return (near, far) if (self.length if length else self.width) > 0.0 else (far, near)

    def strips(self) -> list[tuple[Point, Point]]:
        """Ends of the strips, each in the direction of the first one."""
        along, over = (self.width, self.length) if self.across else (self.length, self.width)
        reach = self.radius + self.overrun
        begins, ends = self._walled(length=not self.across)
        near, far = self._walled(length=self.across)
        low = self.radius if begins else -reach
        high = abs(along) + (-self.radius if ends else reach)
        total = abs(over) + (0.0 if far else self.overrun_across)
        count = max(1, parts(total, self.step, _WHOLE))
        found = []
        for k in range(1, count + 1):
            at = total * k / count - self.radius
            if near:
                at = max(at, self.radius)
            found.append((self._point(low, at), self._point(high, at)))
        return found

    def _point(self, along: float, over: float) -> Point:
        x, y = (over, along) if self.across else (along, over)
        return self.place(x if self.length > 0.0 else -x, y if self.width > 0.0 else -y)


def face(shape: Face, levels: Sequence[float]) -> Iterator[MillStroke]:
    """The strips level by level; every other level back from where the last one ended, if they alternate."""
    strips = shape.strips()
    ends = [(b, a) if shape.alternating and k % 2 else (a, b) for k, (a, b) in enumerate(strips)]
    yield rapid(ends[0][0])
    yield rapid(w=shape.safe)
    for number, level in enumerate(levels):
        order = [(b, a) for a, b in reversed(ends)] if shape.alternating and number % 2 else ends
        for k, (first, last) in enumerate(order):
            if k and shape.alternating:
                yield cut(shape.feed, first)
            elif k or number:
                yield rapid(w=shape.safe)
                yield rapid(first)
            if not (k and shape.alternating):
                yield cut(shape.feed, w=level)
            yield cut(shape.feed, last)
    yield rapid(w=shape.retract)
