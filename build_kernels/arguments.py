"""What kernels take, as their annotations say it: for the compiler, and for the call (`kernels/description.py`)."""

from __future__ import annotations

import ctypes
from enum import Enum, auto
from functools import cache
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels import description
from polycnc.kernels.layout import meaning

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class Kind(Enum):
    """What an argument of a kernel is."""

    ARRAY = auto()
    RECORD = auto()
    GROUP = auto()
    INTEGER = auto()
    NUMBER = auto()


class Argument(NamedTuple):
    """An argument of a kernel.

    Attributes:
        kind: What it is.
        code: Type of the items of an array, as for `array.array`.
        type: Class of a record, or of a group: a named tuple of arrays and records.
        parts: The fields of a group.
    """

    kind: Kind
    code: str = ""
    type: type | None = None
    parts: tuple[Argument, ...] = ()


def arguments(kernel: Callable[..., object]) -> tuple[Argument, ...]:
    """What a kernel takes, by its annotations.

    Raises:
        TypeError: An annotation is none that machine code can have.
    """
    hints = meaning(kernel)
    hints.pop("return", None)
    return tuple(_argument(hint) for hint in hints.values())


def _argument(hint: object) -> Argument:
    if hint in (int, bool):
        return Argument(Kind.INTEGER)
    if hint is float:
        return Argument(Kind.NUMBER)
    if isinstance(hint, type) and issubclass(hint, ctypes.Structure):
        return Argument(Kind.RECORD, type=hint)
    if isinstance(hint, type) and issubclass(hint, tuple):
        return _group(hint)
    *_, code = getattr(hint, "__metadata__", (None,))
    if not isinstance(code, str):
        msg = f"a kernel cannot take {hint}"
        raise TypeError(msg)
    return Argument(Kind.ARRAY, code=code)


@cache
def _group(hint: type) -> Argument:
    """A named tuple; many kernels take the same one. None holds another one: a call takes them apart once."""
    parts = tuple(_argument(part) for part in meaning(hint).values())
    if any(part.kind is Kind.GROUP for part in parts):
        msg = f"a kernel cannot take {hint}, which holds a group"
        raise TypeError(msg)
    return Argument(Kind.GROUP, type=hint, parts=parts)


def flat(parts: tuple[Argument, ...]) -> Iterator[Argument]:
    """Arguments with groups taken apart."""
    for part in parts:
        if part.kind is Kind.GROUP:
            yield from flat(part.parts)
        else:
            yield part


_SIGNS = {
    Kind.RECORD: description.RECORD,
    Kind.INTEGER: description.INTEGER,
    Kind.NUMBER: description.NUMBER,
}


def signature(taken: tuple[Argument, ...]) -> str:
    """Arguments as a description tells them."""
    return "".join(
        f"({signature(each.parts)})" if each.kind is Kind.GROUP else each.code or _SIGNS[each.kind]
        for each in taken
    )
