"""From typed numbers to internal units.

How a number was written (the second character of its signature key) decides what it means: without a decimal point it
counts least input increments, unless the control has calculator input; digits below the least increment are cut off;
a value from an expression is rounded to the least increment.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import copysign, floor

from polycnc.language.word_address.functions import round_half_away

Convert = Callable[[float], float]
INCH_MM = 25.4


@dataclass(frozen=True, slots=True)
class NumberRules:
    """How a control reads numbers.

    Attributes:
        decimals: Decimals of the least input increment in millimetres and degrees (IS-B: 3).
        decimals_inch: The same for inches.
        calculator: A number without a point is whole millimetres instead of least increments.
        cuts_digits: Digits below the least increment are cut off (else they are kept).
    """

    decimals: int = 3
    decimals_inch: int = 4
    calculator: bool = False
    cuts_digits: bool = True


def length_converter(form: str, rules: NumberRules, *, inch: bool, diameter: bool = False) -> Convert | None:
    """What turns a typed length into millimetres (radius); None where the number already is one."""
    decimals = rules.decimals_inch if inch else rules.decimals
    unit = (INCH_MM if inch else 1.0) / (2.0 if diameter else 1.0)
    steps = _increments(form, rules, decimals)
    if steps is None:
        return None if unit == 1.0 else lambda value: value * unit
    scale = 10.0**decimals
    return lambda value: steps(value) / scale * unit


def angle_converter(form: str, rules: NumberRules) -> Convert | None:
    """What turns a typed angle into degrees."""
    steps = _increments(form, rules, rules.decimals)
    if steps is None:
        return None
    scale = 10.0**rules.decimals
    return lambda value: steps(value) / scale


def _increments(form: str, rules: NumberRules, decimals: int) -> Convert | None:
    """What turns a number into least increments; None where it counts whole units exactly."""
    scale = 10.0**decimals
    if form == "":
        return None if rules.calculator else lambda value: value
    if form == "#":
        return lambda value: round_half_away(value * scale)
    written = {".": 3, ":": 4, ";": 99}[form]
    if written <= decimals or not rules.cuts_digits:
        return None
    return lambda value: copysign(floor(abs(value) * scale + 1e-6), value)
