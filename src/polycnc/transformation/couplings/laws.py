"""What a leading axis does to a following one: a share of its place, by the place of the leading axis.

Laws never change, so that a row of the table can say by which it was run. Places are of the axes in the basic
coordinate system, mm or degrees, as numbers or as columns of numbers.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.transformation.numbers import NUMBER, constant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from polycnc.transformation.numbers import N


class Law(Protocol):
    """How one axis leads another one."""

    @property
    def leading(self) -> int:
        """Column of the leading axis."""

    def share(self, leading: N) -> N:
        """What it adds to the following axis where the leading axis is at a place."""

    def slope(self, leading: N) -> N:
        """How fast that changes: by a unit of the leading axis."""


class Curve(Protocol):
    """A place of the following axis for each place of the leading axis: a curve table."""

    def followed(self, leading: float) -> tuple[float, float]:
        """The place, and its slope."""

    def kinks(self, low: float, high: float) -> Iterable[float]:
        """Places of the leading axis between two at which the slope may step."""


@dataclass(frozen=True, slots=True)
class Ratio:
    """A part of the way that the leading axis has gone.

    Attributes:
        leading: Column of the leading axis.
        factor: Way of the following axis by that of the leading one.
        origin: Where the leading axis was when the coupling was switched on.
    """

    leading: int
    factor: float
    origin: float = 0.0

    def share(self, leading: N) -> N:
        """What it adds."""
        return (leading - self.origin) * self.factor

    def slope(self, leading: N) -> N:
        """The factor."""
        return constant(self.factor, leading)


@dataclass(frozen=True, slots=True)
class ByCurve:
    """A place of a curve.

    Attributes:
        leading: Column of the leading axis.
        curve: The curve.
        base: The place of the curve that adds nothing.
        from_place: The leading axis leads from here on, 0 before; None for everywhere.
        rises: It comes to that place from below.
    """

    leading: int
    curve: Curve
    base: float = 0.0
    from_place: float | None = None
    rises: bool = True

    def share(self, leading: N) -> N:
        """What it adds."""
        return _each(self._share, leading)

    def slope(self, leading: N) -> N:
        """The slope of the curve."""
        return _each(self._slope, leading)

    def kinks(self, low: float, high: float) -> Iterator[float]:
        """Places of the leading axis between two at which the slope may step."""
        yield from self.curve.kinks(low, high)
        if self.from_place is not None and low <= self.from_place <= high:
            yield self.from_place

    def step(self, place: float, beside: float) -> float:
        """By how much the slope steps at a place: it is looked at so far before and behind."""
        return abs(self._slope(place + beside) - self._slope(place - beside))

    def _share(self, leading: float) -> float:
        return self.curve.followed(leading)[0] - self.base if self._leads(leading) else 0.0

    def _slope(self, leading: float) -> float:
        return self.curve.followed(leading)[1] if self._leads(leading) else 0.0

    def _leads(self, leading: float) -> bool:
        if self.from_place is None:
            return True
        return leading >= self.from_place if self.rises else leading <= self.from_place


def _each(function: Callable[[float], float], places: N) -> N:
    """A function of a number, for a number or for every number of a column."""
    if isinstance(places, NUMBER):
        return function(places)
    import numpy as np

    return np.fromiter(map(function, places.tolist()), np.float64, len(places))
