"""Link variables `$A_DLB`, `$A_DLW`, `$A_DLD`, `$A_DLR`: one byte-addressed memory, four ways to read it.

Source: job planning 1.1.4. The order of bytes, which it does not state, is that of the least significant
first.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, NamedTuple

from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel


class Access(NamedTuple):
    """One way to read the memory: type, `struct` format, and bytes a value."""

    type: Type
    format: str
    size: int


ACCESS = {
    "$A_DLB": Access(Type.INT, "<B", 1),
    "$A_DLW": Access(Type.INT, "<h", 2),
    "$A_DLD": Access(Type.INT, "<i", 4),
    "$A_DLR": Access(Type.REAL, "<d", 8),
}
_KEY = ("$A_DL", ())


def _bytes(channel: SinumerikChannel) -> bytearray:
    values = Stored.of(channel).nck
    if _KEY not in values:
        values[_KEY] = bytearray(channel.memory.data.integer("$MN_MM_SIZEOF_LINKVAR_DATA"))
    memory: bytearray = values[_KEY]
    return memory


def _place(channel: SinumerikChannel, name: str, indices: tuple[Any, ...]) -> int:
    """The byte of an index; alarm 17020 outside the memory or off the boundary of the format."""
    if len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12400", text=name)
    index, size = indices[0], ACCESS[name].size
    if index < 0 or index % size or index + size > len(_bytes(channel)):
        raise AlarmError("17020", text=name, index=index)
    return index


def reader(name: str) -> Callable[[SinumerikChannel, tuple[Any, ...]], Any]:
    """How a program reads the variable."""
    access = ACCESS[name]

    def read(channel: SinumerikChannel, indices: tuple[Any, ...]) -> Any:
        place = _place(channel, name, indices)
        return struct.unpack_from(access.format, _bytes(channel), place)[0]

    return read


def writer(name: str) -> Callable[[SinumerikChannel, tuple[Any, ...], Any], None]:
    """How a program writes the variable; alarm 12160 for a value that does not fit."""
    access = ACCESS[name]

    def write(channel: SinumerikChannel, indices: tuple[Any, ...], value: Any) -> None:
        place = _place(channel, name, indices)
        try:
            struct.pack_into(access.format, _bytes(channel), place, value)
        except struct.error:
            raise AlarmError("12160", text=str(value)) from None

    return write
