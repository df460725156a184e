"""A run as a path whose second derivative by the way is continuous."""

from __future__ import annotations

from functools import cached_property

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Numbers: TypeAlias = "NDArray[np.float64]"


@dataclass(frozen=True)
class BentPath:
    """A run from rest to rest, bent within its tolerance: a cubic spline of n axes by the way, in m pieces.

    The way is that of the programmed path: the speed along it is the programmed one, that of the axes is no higher.
    Between two knots q''' is constant and q'' linear; over the knots q'' is continuous.

    Attributes:
        way: At the knots, mm, (m + 1,); it begins with 0.
        place: Positions of the axes at the knots, mm or degrees, (m + 1, n).
        first: q' there.
        second: q'' there.
        cap2: Largest square of the speed on each piece, by the feed and the highest speeds of the axes, (m,).
        ease: The part of acceleration and jerk that may be used there, (m,).
        row: Number of the row that each piece belongs to, (m,); of a piece that takes several rows, the first.
        rows: Numbers of the rows of the run in order, (r,).
        row_way: The way at which each of them ends, (r,).
    """

    way: Numbers
    place: Numbers
    first: Numbers
    second: Numbers
    cap2: Numbers
    ease: Numbers
    row: NDArray[np.int64]
    rows: NDArray[np.int64]
    row_way: Numbers

    @property
    def axes(self) -> int:
        """Number of axes, n."""
        return int(self.place.shape[1])

    @cached_property
    def third(self) -> Numbers:
        """The third derivative q''' on each piece, (m, n)."""
        import numpy as np

        change: Numbers = np.diff(self.second, axis=0) / np.diff(self.way)[:, None]
        return change

    def piece_at(self, way: Numbers) -> NDArray[np.intp]:
        """Index of the piece at each of some ways, (k,); that behind a knot, at the end the last one."""
        import numpy as np

        return np.clip(np.searchsorted(self.way, way, "right") - 1, 0, len(self.way) - 2)

    def at(self, way: Numbers) -> tuple[Numbers, Numbers, Numbers]:
        """Positions, q' and q'' at ways, each (k, n)."""
        k = self.piece_at(way)
        t = (way - self.way[k])[:, None]
        place, first, second, third = self.place[k], self.first[k], self.second[k], self.third[k]
        bend = second + third * t
        return (
            place + t * (first + t * (0.5 * second + t * third / 6.0)),
            first + t * (second + 0.5 * t * third),
            bend,
        )
