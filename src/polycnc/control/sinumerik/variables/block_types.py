"""`$AC_BLOCKTYPE` and its companions: which block is in execution, and what has made it (job planning 10.3.11)."""

from __future__ import annotations

from polycnc.channel.moves.origins import KIND
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.toolpath.context import SHORTENED

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

#: Roundings between two blocks, by the function that asks for them.
ROUNDINGS = {"G641": 5001, "G642": 5002, "G643": 5003, "G644": 5004}
#: $AC_SPLITBLOCK.
AS_PROGRAMMED, SPLIT, LAST_OF_SPLIT = 0, 1, 3


def _info(channel: SinumerikChannel, _indices: Indices) -> int:
    """What has made an intermediate block; 0 for one of the program, and where nothing is executed."""
    clocked = channel.actual.clocked
    if clocked is None:
        return 0
    kind = clocked.block_kind
    if kind.rounding is not None:
        code = kind.rounding["path"]
        if code not in ROUNDINGS:  # the manual gives G645 no number
            raise not_supported(f"$AC_BLOCKTYPE {code}")
        return ROUNDINGS[code]
    return kind.origin if kind.origin > SHORTENED else 0


def _type(channel: SinumerikChannel, indices: Indices) -> int:
    return _info(channel, indices) // KIND


def _split(channel: SinumerikChannel, _indices: Indices) -> int:
    clocked = channel.actual.clocked
    own, next_one = clocked.block_split if clocked is not None else (False, False)
    return (SPLIT if next_one else LAST_OF_SPLIT) if own else AS_PROGRAMMED


BLOCK_VARIABLES: dict[str, RowWithStop] = {
    "$AC_BLOCKTYPE": (Type.INT, _type, None, True),
    "$AC_BLOCKTYPEINFO": (Type.INT, _info, None, True),
    "$AC_SPLITBLOCK": (Type.INT, _split, None, True),
}
