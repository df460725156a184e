"""Least input units of SYNTEC by Pr17 (manual, chapter 5)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.syntec.parameters import SyntecParameters

#: Decimals of millimetres or degrees, and of inches, by Pr17.
DECIMALS = {1: 2, 2: 3, 3: 4}
DECIMALS_INCH = {1: 3, 2: 4, 3: 5}
_DELIVERED = 2


def decimals(parameters: SyntecParameters, *, inch: bool) -> int:
    """Decimals of the least input unit; of another number as delivered."""
    table = DECIMALS_INCH if inch else DECIMALS
    return table.get(parameters.input_unit, table[_DELIVERED])


def least_unit(parameters: SyntecParameters) -> float:
    """Least input unit of millimetres, degrees and seconds."""
    return float(10.0 ** -decimals(parameters, inch=False))
