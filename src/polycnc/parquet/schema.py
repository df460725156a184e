"""What fields are: to Parquet, and to Arrow.

Arrow's readers look for the schema of the table as Arrow has it, which tells names that repeat (dictionaries) from
other texts. It is a FlatBuffer: tables whose fields lie at places that a list in front of each says.
"""

from __future__ import annotations

import struct
from binascii import b2a_base64
from enum import Enum, auto

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias, Union
from polycnc.parquet import thrift

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class Content(Enum):
    """What a column holds."""

    NUMBER = auto()
    WHOLE = auto()
    TEXT = auto()
    #: One of few names: Arrow takes them as categories.
    NAME = auto()


class Field(NamedTuple):
    """A column."""

    name: str
    content: Content


#: Types of Parquet.
_INT32, _DOUBLE, _BYTE_ARRAY = 1, 5, 6
TYPES = {
    Content.NUMBER: _DOUBLE,
    Content.WHOLE: _INT32,
    Content.TEXT: _BYTE_ARRAY,
    Content.NAME: _BYTE_ARRAY,
}
_OPTIONAL = 1
#: A text among the types of old readers, and of new ones.
_UTF8, _STRING = thrift.i32(0), thrift.struct({1: thrift.struct({})})


def elements(fields: Sequence[Field]) -> thrift.Value:
    """The schema as Parquet has it: the root, and its columns, whose values may be null."""
    made = [thrift.struct({4: thrift.binary("schema"), 5: thrift.i32(len(fields))})]
    for name, content in fields:
        kind = TYPES[content]
        element = {1: thrift.i32(kind), 3: thrift.i32(_OPTIONAL), 4: thrift.binary(name)}
        if kind == _BYTE_ARRAY:
            element |= {6: _UTF8, 10: _STRING}
        made.append(thrift.struct(element))
    return thrift.array(made)


#: What a field of a table is: a number with its format, a text, a table, tables, or left out.
_Slot: TypeAlias = Union["tuple[str, int]", str, "_Table", "list[_Table]", None]


class _Table(NamedTuple):
    """A table of a FlatBuffer: fields by their numbers."""

    slots: tuple[_Slot, ...]


#: Of Arrow's format: its version and the kind of message; types; 64 bits of a number.
_V5, _SCHEMA, _INT, _FLOAT, _UTF8_TYPE, _DOUBLE_PRECISION = 4, 1, 2, 3, 5, 2
_WHOLE_TYPE = _Table((("<i", 32), ("<b", 1)))
_ARROW_TYPES: dict[Content, tuple[int, _Table]] = {
    Content.NUMBER: (_FLOAT, _Table((("<h", _DOUBLE_PRECISION),))),
    Content.WHOLE: (_INT, _WHOLE_TYPE),
    Content.TEXT: (_UTF8_TYPE, _Table(())),
    Content.NAME: (_UTF8_TYPE, _Table(())),
}
#: Stands in front of a message of Arrow; such places are filled up to.
_CONTINUES, _WIDEST = b"\xff\xff\xff\xff", 8


def arrow_schema(fields: Sequence[Field], metadata: Mapping[str, str]) -> str:
    """The schema as Arrow has it, as a message in Base64."""
    made: list[_Table] = []
    dictionaries = 0
    for name, content in fields:
        number, kind = _ARROW_TYPES[content]
        dictionary = None
        if content is Content.NAME:
            dictionary = _Table((("<q", dictionaries), _WHOLE_TYPE))
            dictionaries += 1
        made.append(_Table((name, ("<b", 1), ("<b", number), kind, dictionary, [])))
    said = [_Table(pair) for pair in metadata.items()]
    message = _Table((("<h", _V5), ("<b", _SCHEMA), _Table((("<h", 0), made, said))))
    told = _flat_buffer(message)
    return b2a_base64(_CONTINUES + struct.pack("<i", len(told)) + told, newline=False).decode()


def _flat_buffer(root: _Table) -> bytes:
    """A FlatBuffer with what tables refer to behind them."""
    written = bytearray(4)
    waiting: list[tuple[int, _Slot]] = [(0, root)]
    while waiting:
        reference, target = waiting.pop()
        if isinstance(target, _Table):
            at = _add_table(written, target, waiting)
        else:
            _fill_up(written, 4)
            at = len(written)
            if isinstance(target, str):
                text = target.encode()
                written += struct.pack("<i", len(text)) + text + b"\0"
            elif isinstance(target, list):
                written += struct.pack("<i", len(target)) + bytes(4 * len(target))
                waiting.extend((at + 4 + 4 * i, item) for i, item in enumerate(target))
        struct.pack_into("<I", written, reference, at - reference)
    _fill_up(written, _WIDEST)
    return bytes(written)


def _add_table(written: bytearray, table: _Table, waiting: list[tuple[int, _Slot]]) -> int:
    """Write a table behind the places of its fields; its own place. What it refers to waits."""
    places: list[int] = []
    size = 4
    for slot in table.slots:
        width = struct.calcsize(slot[0]) if isinstance(slot, tuple) and not isinstance(slot, _Table) else 4
        size += -size % width if slot is not None else 0
        places.append(size if slot is not None else 0)
        size += width if slot is not None else 0
    head = struct.pack(f"<{2 + len(places)}H", 4 + 2 * len(places), size, *places)
    written += bytes(-(len(written) + len(head)) % _WIDEST)
    written += head
    at = len(written)
    written += struct.pack("<i", len(head)) + bytes(size - 4)
    for slot, place in zip(table.slots, places, strict=True):
        if isinstance(slot, _Table | str | list):
            waiting.append((at + place, slot))
        elif slot is not None:
            struct.pack_into(slot[0], written, at + place, slot[1])
    return at


def _fill_up(written: bytearray, width: int) -> None:
    written += bytes(-len(written) % width)
