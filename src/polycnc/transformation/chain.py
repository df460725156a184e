"""Transformations one after the other: a polar plane on a machine with an inclined axis, and the like (TRACON)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import product

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry, Transformation
    from polycnc.transformation.numbers import N
    from polycnc.transformation.pole import Pole


@dataclass(frozen=True, slots=True)
class Chain:
    """Each link takes the positions of the one before it as its points of the path.

    Attributes:
        links: The transformations, that of the path first; at least one.

    Raises:
        ValueError: A link behind the first one has a pole: it would lie at no fixed place of the path.
    """

    links: tuple[Transformation, ...]

    def __post_init__(self) -> None:
        if any(link.pole is not None for link in self.links[1:]):
            raise ValueError("only the first link of a chain may have a pole")

    @property
    def geometry(self) -> Geometry:
        """Columns of X, Y and Z in points of the path."""
        return self.links[0].geometry

    @property
    def pole(self) -> Pole | None:
        """That of the first link."""
        return self.links[0].pole

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Positions of the axes at a point of the path."""
        point = list(work)
        for link in self.links:
            point = link.to_machine(point)
        return point

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point of the path for positions of the axes."""
        point = list(axes)
        for link in reversed(self.links):
            point = link.to_work(point)
        return point

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """The product of those of the links, each at its own point."""
        point, slopes = list(work), self.links[0].jacobian(work)
        for before, link in zip(self.links, self.links[1:], strict=False):
            point = before.to_machine(point)
            slopes = product(link.jacobian(point), slopes)
        return slopes

    def solutions(self, work: Sequence[float]) -> list[list[float]]:
        """Every solution of a link for every one of those before it."""
        points = [list(work)]
        for link in self.links:
            points = [found for point in points for found in link.solutions(point)]
        return points
