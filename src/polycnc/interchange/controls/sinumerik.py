"""SINUMERIK: data as initialisation programs, one for each type of data, and an archive of all programs (2.1, 2.2)."""

from __future__ import annotations

from polycnc.control.sinumerik.data.archive import AREAS
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.interchange.controls.kinds import ARCHIVE, Kind, Texts, Writer

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Kinds of data by the type of the control's file.
_KINDS = {
    "machine-data": "TEA",
    "setting-data": "SEA",
    "user-data": "GUD",
    "tools": "TOA",
    "frames": "UFR",
    "r-parameters": "RPA",
}


def _writer(type_: str) -> Writer:
    def write(channel: SinumerikChannel) -> str:
        lines = (f"%_N_COMPLETE_{type_}_INI", *AREAS[type_](channel), "M17")
        return "".join(f"{line}\n" for line in lines)

    return write


TEXTS = Texts(
    {name: Kind(f"COMPLETE_{type_}.INI", _writer(type_)) for name, type_ in _KINDS.items()},
    ARCHIVE,
    "PROGRAMS.ARC",
)
