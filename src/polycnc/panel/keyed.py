"""Numbers as they are keyed in: digits with one point and a sign, as the keys of a control have them."""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.mainrun import CommandRefused

_NUMBER = regex(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)")
#: A number with a larger magnitude has more digits than any field.
_BEYOND = 1e12


def number_of(typed: str) -> float:
    """The number that a text is.

    Raises:
        CommandRefused: It is none (`1e3` and `nan` are words to a control), or it is too long.
    """
    if _NUMBER.fullmatch(typed.strip()) is None:
        raise CommandRefused("screen.no-number", typed=typed)
    value = float(typed)
    if abs(value) >= _BEYOND:
        raise CommandRefused("screen.value", value=typed)
    return value


def whole_number_of(typed: str) -> int:
    """The whole number that a text is; `5.` is one, `2.5` none. Raises as `number_of` does."""
    value = number_of(typed)
    if not value.is_integer():
        raise CommandRefused("screen.no-number", typed=typed)
    return int(value)
