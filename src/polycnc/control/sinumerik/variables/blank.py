"""The blank that WORKPIECE describes: data for pictures, without any motion.

`WORKPIECE(name, clamping, zero, form, mode, ZA, ZI, ZB, …)`; bits of the mode say which values are absolute.
"""

from __future__ import annotations

from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.channel.channel import Channel

#: Where the values of WORKPIECE stand that all forms have.
_ZERO, _FORM, _MODE, _ZA, _ZI, _ZB, _FURTHER = 2, 3, 4, 5, 6, 7, 8
#: Bits of the mode: the value is absolute; the last one: the inner diameter is given by the wall.
_X1_ABSOLUTE, _Y1_ABSOLUTE, _ZI_ABSOLUTE, _ZB_ABSOLUTE, _WALL = 4, 5, 6, 7, 8
#: What each form has beside the heights.
_FORMS = {
    "CYLINDER": ("XA",),
    "PIPE": ("XA", "XI"),
    "RECTANGLE": ("W", "L"),
    "BOX": ("X0", "Y0", "X1", "Y1"),
    "N_CORNER": ("N", "SW"),
}


@dataclass(frozen=True, slots=True)
class Blank:
    """A blank.

    Attributes:
        form: `CYLINDER`, `PIPE`, `RECTANGLE`, `BOX`, `N_CORNER`; another word as the program has it.
        zero: The work offset that its values refer to; empty for the active one.
        values: Its dimensions by name, absolute, in the program's unit: heights ZA (upper face), ZI (lower face) and ZB
            (end of machining); XA and XI are diameters, W and L lie about the zero point.
    """

    form: str
    zero: str
    values: Mapping[str, float]


def blank_of(channel: Channel) -> Blank | None:
    """The blank that a program of the channel has described last; None for none, or after WORKPIECE()."""
    given: Sequence[Any] | None = Stored.of(channel).values.get(("WORKPIECE", ()))
    if not given:
        return None
    form = _text(given, _FORM).upper()
    mode = int(_number(given, _MODE))
    upper = _number(given, _ZA)
    values = {"ZA": upper}
    for name, place, bit in (("ZI", _ZI, _ZI_ABSOLUTE), ("ZB", _ZB, _ZB_ABSOLUTE)):
        values[name] = _number(given, place) + (0.0 if mode >> bit & 1 else upper)
    for place, name in enumerate(_FORMS.get(form, ()), _FURTHER):
        values[name] = _number(given, place)
    if form == "BOX":
        for axis, bit in (("X", _X1_ABSOLUTE), ("Y", _Y1_ABSOLUTE)):
            values[f"{axis}1"] += 0.0 if mode >> bit & 1 else values[f"{axis}0"]
    if form == "PIPE" and mode >> _WALL & 1:
        values["XI"] = values["XA"] - 2.0 * values["XI"]
    return Blank(form, _text(given, _ZERO), values)


def _number(given: Sequence[Any], place: int) -> float:
    value = given[place] if place < len(given) else None
    return float(value) if isinstance(value, int | float) else 0.0


def _text(given: Sequence[Any], place: int) -> str:
    value = given[place] if place < len(given) else None
    return "" if value is None else str(value)
