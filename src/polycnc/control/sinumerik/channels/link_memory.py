"""Byte-addressed memories with four ways to read each: link variables `$A_DL…`, data for the PLC `$A_DB…`.

Source: job planning 1.1.4 for `$A_DLB`, `$A_DLW`, `$A_DLD`, `$A_DLR`. `$A_DBB`, `$A_DBW`, `$A_DBD`, `$A_DBR` are the
1024 bytes that NC and PLC read and write both (functions manual, basic functions); a REAL has four bytes there. Bytes
are read without sign. A write goes along with the path and acts when the axes are there; a read waits for that.
The order of bytes, which neither states, is that of the least significant first.
"""

from __future__ import annotations

import struct

from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from polycnc.toolpath.events import MemoryWrite

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel


class Access(NamedTuple):
    """One way to read a memory: type, `struct` format, and bytes a value."""

    type: Type
    format: str
    size: int


ACCESS = {
    "$A_DLB": Access(Type.INT, "<B", 1),
    "$A_DLW": Access(Type.INT, "<h", 2),
    "$A_DLD": Access(Type.INT, "<i", 4),
    "$A_DLR": Access(Type.REAL, "<d", 8),
    "$A_DBB": Access(Type.INT, "<B", 1),
    "$A_DBW": Access(Type.INT, "<h", 2),
    "$A_DBD": Access(Type.INT, "<i", 4),
    "$A_DBR": Access(Type.REAL, "<f", 4),
}
_LINKED = "$A_DL"
_PLC_BYTES = 1024


def _bytes(channel: SinumerikChannel, name: str) -> bytearray:
    values, key = Stored.of(channel).nck, (name[:-1], ())
    if key not in values:
        is_linked = name.startswith(_LINKED)
        values[key] = bytearray(
            max(channel.memory.data.integer("$MN_MM_SIZEOF_LINKVAR_DATA"), 0) if is_linked else _PLC_BYTES
        )
    memory: bytearray = values[key]
    return memory


def _place(channel: SinumerikChannel, name: str, indices: tuple[Any, ...]) -> int:
    """The byte of an index; alarm 17020 outside the memory or off the boundary of the format."""
    if len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12400", text=name)
    index, size = indices[0], ACCESS[name].size
    if index < 0 or index % size or index + size > len(_bytes(channel, name)):
        raise AlarmError("17020", text=name, index=index)
    return index


def _signed(value: int, access: Access) -> int:
    """A value for the PLC as its format keeps it: bits that fit may be written with or without sign."""
    bits = 8 * access.size
    if -(1 << bits - 1) <= value < 1 << bits:
        value %= 1 << bits
    return value - (1 << bits) if access.format != "<B" and value >= 1 << bits - 1 else value


def reader(name: str) -> Callable[[SinumerikChannel, tuple[Any, ...]], Any]:
    """How a program reads the variable."""
    access = ACCESS[name]

    def read(channel: SinumerikChannel, indices: tuple[Any, ...]) -> Any:
        place = _place(channel, name, indices)
        return struct.unpack_from(access.format, _bytes(channel, name), place)[0]

    return read


def writer(name: str) -> Callable[[SinumerikChannel, tuple[Any, ...], Any], None]:
    """How a program writes the variable, in order with its moves; alarm 12160 for a value that does not fit."""
    access = ACCESS[name]

    def write(channel: SinumerikChannel, indices: tuple[Any, ...], value: Any) -> None:
        place = _place(channel, name, indices)
        try:
            if not name.startswith(_LINKED) and access.type is Type.INT:
                value = _signed(value, access)
            written = struct.pack(access.format, value)
        except (struct.error, OverflowError):
            raise AlarmError("12160", text=str(value)) from None
        write = MemoryWrite(f"{name}[{place}]", value, _bytes(channel, name), place, written)
        if channel.main_run is None:
            write.store()
        else:
            channel.event(write)

    return write
