"""Arguments of cycles: names from the signature, values in internal units, omitted ones zero or empty.

A signature is the list of a cycle's parameter names. What kind of value a name stands for is the same in nearly all
cycles and stands in the tables here; a name that stands in none of them is a length. Where a cycle means something
else by a name, its signature says so: `_FR:feed`.
"""

from __future__ import annotations

from functools import cache
from math import isfinite

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.errors import arithmetic
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.family import SinumerikChannel


def _names(text: str) -> frozenset[str]:
    return frozenset(text.split())


#: Plain numbers: angles, times, counts, modes, factors.
NUMBERS = _names(
    """
    DTB DTS _DTD DTD FRF VARI _VARI _AXN _GMODE _DMODE _AMODE _UMODE SDAC SDIR SDR ENC MPIT POSS SST SST1
    _PITA _TECHNO STA1 _STA INDA NUM _NUM _NUM1 _NUM2 _NSP CDIR _CDIR NSP NRC NID NUMT IANG ANG1 ANG2 TYPTH
    _ANG1 _ANG2 _STA2 AFSL SSF _ST _MODE _A _B _C _DIR _FR _TYPE _RL _AS1 _AS2 _LIM S_TOLM S_OTOL DT _LAGE _DN _XA
    _YA _CODEP PIT_INCH _IANG _NRC _NID _NUMT _GST _NR _EW _DR _NT _TYPTH _BL _PK _N _SDAC _SS2 _SV1 _SV2
    """
)
#: Path feeds, in the feed type of the caller.
FEEDS = _names(
    """
    FFR RFF FFD FFP1 FFP2 _FFD _FFP1 _FFP2 _FFCP FF1 FF2 FF3 _FF1 _FF3 S_FA S_FD _FFR _FF2 _F _FZ
    """
)
#: Diameters of turned parts, whatever DIAMON says; the value is the radius.
DIAMETERS = _names("SPD DM1 DM2 DM3 DM4 _SPD _EPD _ZPD _DM1 _DM2")
TEXTS = _names("_TC _KNAME _HIDE _TEXT NPP FORM _FORM _PITM _PRG _LAB1 _LAB2 _TR S_CON S_COFF _CON _CONR")
#: Table of threads and row of it: texts that only say where a pitch came from. Older calls have numbers there.
TABLES = _names("_PTAB _PTABA")


#: What a signature may say of a name.
KINDS = {"number": NUMBERS, "feed": FEEDS, "diameter": DIAMETERS, "text": TEXTS}
LENGTH = "length"


def kind_of(parameter: str) -> tuple[str, str]:
    """Name of a parameter as a signature has it, and what it is."""
    name, _, said = parameter.partition(":")
    return name, said or next((kind for kind, names in KINDS.items() if name in names), LENGTH)


@cache
def _kinds_of(signature: tuple[str, ...]) -> Mapping[str, str]:
    """What the parameters of a cycle are, by name: a modal call has the same at every hole."""
    return dict(map(kind_of, signature))


class Arguments:
    """The arguments of one call.

    Args:
        channel: Where it stands: units and feed type count as they are at the call.
        cycle: Name of the cycle.
        signature: Its parameters.
        values: As written, None for one that is left out.

    Raises:
        AlarmError: 12340 for too many arguments, 12330 for one of another type.
    """

    def __init__(
        self, channel: SinumerikChannel, cycle: str, signature: tuple[str, ...], values: tuple[Any, ...]
    ) -> None:
        written = len(values)
        while written and values[written - 1] is None:
            written -= 1
        if written > len(signature):
            raise AlarmError("12340", text=cycle)
        self.cycle = cycle
        self._kinds = _kinds_of(signature)
        self._length = length_factor(channel.mode)
        self._feed = tables.feed_type(channel.mode).factor
        if channel.mode["unit"] == "G700":
            self._feed *= INCH_MM
        self._values: dict[str, Any] = {
            name: value for name, value in zip(self._kinds, values, strict=False) if value is not None
        }
        for name, value in self._values.items():
            is_wrong = isinstance(value, str) is not (self._kinds[name] == "text") and name not in TABLES
            if is_wrong or not isinstance(value, (int, float, str)):
                raise AlarmError("12330", text=f"{cycle} {name}")
            if isinstance(value, float) and not isfinite(value):
                raise arithmetic(name)

    @property
    def any_given(self) -> bool:
        """Whether any argument was written."""
        return bool(self._values)

    def has(self, name: str) -> bool:
        """Whether the cycle has a parameter."""
        return name in self._kinds

    def given(self, name: str) -> bool:
        """Whether an argument was written."""
        return name in self._values

    def text(self, name: str) -> str:
        """A text, empty where it was left out."""
        return str(self._values.get(name, ""))

    def __getitem__(self, name: str) -> float:
        """A number in internal units (mm, radius, mm/s …), 0 where it was left out."""
        value = float(self._values.get(name, 0.0))
        kind = self._kinds.get(name) or kind_of(name)[1]
        if kind == "number":
            return value
        if kind == "feed":
            return value * self._feed
        return value * self._length * (0.5 if kind == "diameter" else 1.0)

    def plain(self, name: str) -> float:
        """A number as it was written."""
        return float(self._values.get(name, 0.0))

    def integer(self, name: str) -> int:
        """A whole number; a parameter of type INT rounds what is handed over."""
        return round(self.plain(name))

    def digit(self, name: str, place: int) -> int:
        """A decimal digit of a whole number, place 0 on the right."""
        digit: int = abs(self.integer(name)) // 10**place % 10
        return digit
