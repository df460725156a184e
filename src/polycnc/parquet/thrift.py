"""Values in Thrift's compact protocol, in which Parquet writes its headers.

Each function gives the type of a value and its bytes.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

#: The type of a value, and its bytes.
Value: TypeAlias = "tuple[int, bytes]"
_TRUE, _I32, _I64, _BINARY, _LIST, _STRUCT = 1, 5, 6, 8, 9, 12
#: A list of no more items, and a field no farther from the last one, is told in four bits.
_FOUR_BITS = 15


def varint(number: int) -> bytes:
    """A number that is not negative, seven bits a byte, the lowest first."""
    found = bytearray()
    while number > 0x7F:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    found.append(number)
    return bytes(found)


def _zigzag(number: int) -> bytes:
    return varint(number << 1 if number >= 0 else (-number << 1) - 1)


def true() -> Value:
    """The truth; a field has it in its type."""
    return _TRUE, b""


def i32(number: int) -> Value:
    """A whole number of 32 bits."""
    return _I32, _zigzag(number)


def i64(number: int) -> Value:
    """A whole number of 64 bits."""
    return _I64, _zigzag(number)


def binary(content: bytes | str) -> Value:
    """Bytes, or a text in UTF-8."""
    content = content.encode() if isinstance(content, str) else content
    return _BINARY, varint(len(content)) + content


def struct(fields: Mapping[int, Value]) -> Value:
    """A record: values by the numbers of their fields, which grow."""
    found, last = bytearray(), 0
    for number, (kind, content) in fields.items():
        if number - last <= _FOUR_BITS:
            found.append((number - last) << 4 | kind)
        else:
            found.append(kind)
            found += _zigzag(number)
        found += content
        last = number
    found.append(0)
    return _STRUCT, bytes(found)


def array(items: Sequence[Value]) -> Value:
    """A list of values of one type; records where there is none."""
    kind, count = items[0][0] if items else _STRUCT, len(items)
    head = bytes((count << 4 | kind,)) if count < _FOUR_BITS else bytes((0xF0 | kind,)) + varint(count)
    return _LIST, head + b"".join(content for _, content in items)
