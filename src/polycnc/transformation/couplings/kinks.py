"""Where a following axis would change its velocity at once: the kinks of the curves that lead it, on a row's way."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.couplings.acting import couplings_of
from polycnc.transformation.couplings.laws import ByCurve

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.transformation.contract import Transformation
    from polycnc.transformation.couplings.acting import Places

#: Parts of a row between whose ends a leading axis passes a place once at most; halvings of the search for it.
PARTS, HALVINGS = 64, 60
#: Ways of a leading axis that count as none, mm or degrees; slopes are compared so far before and behind a place.
SAME_PLACE, BESIDE = 1e-7, 1e-5


def has_kinks(transformation: Transformation | None) -> bool:
    """Whether curves lead axes under a transformation."""
    return any(
        isinstance(law, ByCurve)
        for coupled, _ in couplings_of(transformation)
        for each in coupled.following
        for law in each.laws
    )


def kinks(
    transformation: Transformation,
    path: Callable[[float], list[float]],
    most: Callable[[int, int], float],
) -> list[float]:
    """Shares of a row, above 0 and up to 1, at which the slope of a curve steps by more than its axis allows.

    Args:
        transformation: That acts.
        path: The row's points by shares.
        most: The step of the slope that counts as none, by the columns of the following and the leading axis.
    """
    found, shares = set[float](), [k / PARTS for k in range(PARTS + 1)]
    for coupled, placed in couplings_of(transformation):
        axes = [placed(path(share)) for share in shares]
        for each in coupled.following:
            for law in each.laws:
                if isinstance(law, ByCurve):
                    column = law.leading
                    places = [point[column] for point in axes]
                    allowed = most(each.column, column)

                    def leading(share: float, column: int = column, placed: Places = placed) -> float:
                        return placed(path(share))[column]

                    for place in law.kinks(min(places) - SAME_PLACE, max(places) + SAME_PLACE):
                        if law.step(place, BESIDE) > allowed:
                            found.update(_passes(leading, shares, places, place))
    return sorted(found)


def _passes(
    leading: Callable[[float], float], shares: Sequence[float], places: Sequence[float], place: float
) -> Iterator[float]:
    """The shares at which a leading axis that moves comes to a place."""
    for k in range(PARTS):
        before, after = places[k] - place, places[k + 1] - place
        if abs(after) <= SAME_PLACE < abs(before):
            yield shares[k + 1]
        elif before * after < 0.0 and min(abs(before), abs(after)) > SAME_PLACE:
            low, high = shares[k], shares[k + 1]
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                if (leading(middle) - place) * before > 0.0:
                    low = middle
                else:
                    high = middle
            yield high
