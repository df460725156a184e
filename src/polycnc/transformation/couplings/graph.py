"""In which order following axes are worked out: behind the axes that lead them. None may lead itself."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.transformation.couplings.laws import Law


class CircularCouplingError(ValueError):
    """An axis would lead itself, by way of others or at once.

    Attributes:
        column: Column of one such axis.
    """

    def __init__(self, column: int) -> None:
        super().__init__(f"axis {column} leads itself")
        self.column = column


def in_order(following: Mapping[int, Sequence[Law]]) -> list[int]:
    """The columns of following axes, each behind those that lead it.

    Args:
        following: The laws of each following axis, by its column.

    Raises:
        CircularCouplingError: An axis leads itself.
    """
    ordered: list[int] = []
    under_way: set[int] = set()

    def visit(column: int) -> None:
        if column in ordered or column not in following:
            return
        if column in under_way:
            raise CircularCouplingError(column)
        under_way.add(column)
        for law in following[column]:
            visit(law.leading)
        ordered.append(column)

    for column in sorted(following):
        visit(column)
    return ordered
