"""From typed numbers to internal units.

How a number was written (the second character of its signature key) decides what it means: without a decimal point it
counts least input increments, unless the control has calculator input; digits below the least increment are cut off;
a value from an expression is rounded to the least increment.
"""

from __future__ import annotations

from collections.abc import Callable
from math import copysign, floor

from polycnc.deferred.records import dataclass
from polycnc.geometry.units import INCH_MM
from polycnc.language.bulk import Conversion, Scaling, declare, declared
from polycnc.language.bulk.conversions import HALF

Convert = Callable[[float], float]


@dataclass(frozen=True, slots=True)
class NumberRules:
    """How a control reads numbers.

    Attributes:
        decimals: Decimals of the least input increment in millimetres and degrees (IS-B: 3).
        decimals_inch: The same for inches.
        calculator: A number without a point is whole millimetres instead of least increments.
        tenfold: A number without a point counts ten least increments.
        cuts_digits: Digits below the least increment are cut off (else they are kept).
    """

    decimals: int = 3
    decimals_inch: int = 4
    calculator: bool = False
    tenfold: bool = False
    cuts_digits: bool = True


def length_converter(form: str, rules: NumberRules, *, inch: bool, diameter: bool = False) -> Convert | None:
    """What turns a typed length into millimetres (radius); None where the number already is one."""
    decimals = rules.decimals_inch if inch else rules.decimals
    unit = (INCH_MM if inch else 1.0) / (2.0 if diameter else 1.0)
    return _converter(form, rules, decimals, unit)


def angle_converter(form: str, rules: NumberRules) -> Convert | None:
    """What turns a typed angle into degrees."""
    return _converter(form, rules, rules.decimals, 1.0)


def _converter(form: str, rules: NumberRules, decimals: int, unit: float) -> Convert | None:
    scale = 10.0**decimals
    if form == "" and not rules.calculator:
        counts = scale / 10.0 if rules.tenfold else scale
        return declare(lambda value: value / counts * unit, Conversion(Scaling.INCREMENTS, counts, unit))
    if form == "#":
        return declare(
            lambda value: (
                floor(value * scale + HALF) / scale * unit
                if value >= 0.0
                else -floor(HALF - value * scale) / scale * unit
            ),
            Conversion(Scaling.ROUNDED, scale, unit),
        )
    written = {"": 0, ".": 3, ":": 4, ";": 99}[form]
    if written > decimals and rules.cuts_digits:
        return declare(
            lambda value: copysign(floor(abs(value) * scale + 1e-6), value) / scale * unit,
            Conversion(Scaling.CUT, scale, unit),
        )
    return None if unit == 1.0 else declare(lambda value: value * unit, Conversion(Scaling.TIMES, 1.0, unit))


def conversion(convert: Convert | None) -> Conversion | None:
    """What a converter does, told as data; None where that cannot be told."""
    told = Conversion() if convert is None else declared(convert)
    return told if isinstance(told, Conversion) else None
