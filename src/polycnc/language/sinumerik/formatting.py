"""SPRINT: a text with values in the places that its format marks (job planning, operations on strings).

A mark is `%`, a width, a point with a number of decimals, and a letter: B (TRUE or FALSE), C (character), D (whole
number), F (6 decimals), E, G, S (text), X (hexadecimal); `%%` is a percent sign.
"""

from __future__ import annotations

import re

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import MAX_STRING, Axis, round_half_up
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

_MARK = regex(r"%(?:(?P<percent>%)|(?P<zero>0?)(?P<width>\d*)(?:\.(?P<decimals>\d+))?(?P<kind>[A-Za-z]))")


def _number(value: object) -> float:
    if isinstance(value, (int, float)):
        return value
    raise AlarmError("12150", text=str(value))


def _whole(value: object) -> int:
    return round_half_up(_number(value))


def _text(value: object) -> str:
    if isinstance(value, (str, Axis)):
        return str(value)
    raise AlarmError("12150", text=str(value))


def _hexadecimal(value: object, _decimals: int | None) -> str:
    return f"{_whole(value) & 0xFFFFFFFF:X}"


def _exponent(value: object, decimals: int | None) -> str:
    return f"{_number(value):.{6 if decimals is None else decimals}E}"


_KINDS: dict[str, Callable[[object, int | None], str]] = {
    "B": lambda value, _decimals: "TRUE" if _number(value) else "FALSE",
    "C": lambda value, _decimals: _text(value)[:1] if isinstance(value, str) else chr(_whole(value) & 0xFF),
    "D": lambda value, _decimals: str(_whole(value)),
    "E": _exponent,
    "F": lambda value, decimals: f"{_number(value):.{6 if decimals is None else decimals}f}",
    "G": lambda value, decimals: f"{_number(value):.{6 if decimals is None else decimals}G}",
    "S": lambda value, decimals: _text(value)[:decimals],
    "X": _hexadecimal,
}


def formatted(text: str, values: Sequence[object]) -> str:
    """The format with its marks replaced by values, in order.

    Raises:
        AlarmError: 14020 for more or fewer values than marks, 12150 for a value of another type, 12160 for a letter
            that marks nothing, 14099 for a result longer than a string may be.
    """
    rest = list(values)

    def replaced(mark: re.Match[str]) -> str:
        if mark["percent"]:
            return "%"
        kind = _KINDS.get(mark["kind"].upper())
        if kind is None:
            raise AlarmError("12160", text=mark[0])
        if not rest:
            raise AlarmError("14020", text="SPRINT")
        shown = kind(rest.pop(0), int(mark["decimals"]) if mark["decimals"] else None)
        width = int(mark["width"] or 0)
        return shown.zfill(width) if mark["zero"] else shown.rjust(width)

    result = _MARK.sub(replaced, text)
    if rest:
        raise AlarmError("14020", text="SPRINT")
    if len(result) > MAX_STRING:
        raise AlarmError("14099", text=result[:32])
    return result
