"""Which couplings act under a transformation, and which axes follow others there."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.couplings.coupled import Coupled
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.transformation.contract import Transformation

    Places = Callable[[list[float]], list[float]]


def couplings_of(transformation: Transformation | None) -> list[tuple[Coupled, Places]]:
    """Couplings under a transformation, each with what gives the places of axes that it sees at a point of the path."""
    if isinstance(transformation, Coupled):
        return [(transformation, transformation.to_machine)]
    if not isinstance(transformation, Seated):
        return []
    sides = ((transformation.led, transformation.basic), (transformation.driven, transformation.to_machine))
    return [(coupled, placed) for coupled, placed in sides if coupled is not None]


def following(transformation: Transformation | None) -> frozenset[int]:
    """Columns of the axes that follow others: a point of the path has there what they go by themselves."""
    return frozenset(each.column for coupled, _ in couplings_of(transformation) for each in coupled.following)
