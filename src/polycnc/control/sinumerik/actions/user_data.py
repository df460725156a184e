"""User data of synchronised actions: `SYG_RS[i]` … `SYG_S9[i]`, arrays that machine data create (10.3.3)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.names.variables import Array, Variable

if TYPE_CHECKING:
    from polycnc.control.sinumerik.data.machine_data import MachineData

#: Letter of the type, its machine datum, and what the elements are at first.
_TYPES: dict[str, tuple[Type, str, Any]] = {
    "R": (Type.REAL, "$MM_NUM_SYNACT_GUD_REAL", 0.0),
    "I": (Type.INT, "$MM_NUM_SYNACT_GUD_INT", 0),
    "B": (Type.BOOL, "$MM_NUM_SYNACT_GUD_BOOL", False),
    "A": (Type.AXIS, "$MM_NUM_SYNACT_GUD_AXIS", Axis("")),
    "C": (Type.CHAR, "$MM_NUM_SYNACT_GUD_CHAR", 0),
    "S": (Type.STRING, "$MM_NUM_SYNACT_GUD_STRING", ""),
}
#: Letters of the blocks of access rights: SGUD, MGUD, UGUD, GUD4 … GUD9.
_BLOCKS = "SMU456789"
#: Characters of a text.
_LENGTH = 31


def user_data(data: MachineData) -> dict[str, Variable]:
    """The arrays by name, as many elements as the machine data say; none of a size of 0."""
    made: dict[str, Variable] = {}
    for letter, (type_, datum, first) in _TYPES.items():
        for place, block in enumerate(_BLOCKS):
            size = data.count(datum, place)
            if size > 0:
                name = f"SYG_{letter}{block}"
                variable = made[name] = Variable(name, type_, (size,), _LENGTH, range="CHAN")
                variable.store = [Array(variable, [first] * size)]
    return made
