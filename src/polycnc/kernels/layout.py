"""How the data of kernels is declared: kinds of arrays, records with named fields, places in flat arrays.

A kernel's annotations are its declaration: `arguments` reads them for the compiler and for the call.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import MutableSequence
from enum import Enum, auto
from functools import cache, partial
from typing import TYPE_CHECKING, Annotated, Any, ForwardRef, TypeVar, cast, get_args

from polycnc.deferred.named_tuples import NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# Arrays by the type of their items, as for `array.array`. A kernel reads and writes them in place.
Bytes = Annotated[MutableSequence[int], "B"]
Ints32 = Annotated[MutableSequence[int], "i"]
Words16 = Annotated[MutableSequence[int], "H"]
Words32 = Annotated[MutableSequence[int], "I"]
Ints = Annotated[MutableSequence[int], "q"]
Floats = Annotated[MutableSequence[float], "d"]

_SIMPLE = {each.__name__: each for each in (int, float, bool)}
_R = TypeVar("_R", bound=ctypes.Structure)


def record(cls: type[_R]) -> type[_R]:
    """Make a `ctypes.Structure` of its annotations: `float`, `int`, or `Annotated[Floats, count]` for so many numbers.

    The same memory is an object with named fields in Python and a structure in machine code.
    """
    types: dict[object, type[Any]] = {float: ctypes.c_double, int: ctypes.c_int64}
    cls._fields_ = [(name, types.get(hint) or _numbers(hint)) for name, hint in _hints(cls).items()]
    cls.memento = _memento  # type: ignore[attr-defined]
    return cls


def _memento(instance: ctypes.Structure) -> Callable[[], None]:
    """For a snapshot: what brings the numbers of a record back."""
    return partial(put_back, instance, contents_of(instance))


def contents_of(instance: ctypes.Structure) -> bytes:
    """The numbers of a record, for `put_back`."""
    return bytes(instance)


def put_back(instance: ctypes.Structure, contents: bytes) -> None:
    """Give a record the numbers that it once had."""
    ctypes.memmove(ctypes.addressof(instance), contents, len(contents))


def _hints(of: type | Callable[..., object]) -> dict[str, Any]:
    """What annotations mean."""
    scope = vars(sys.modules[of.__module__])
    return {name: _meant(hint, scope) for name, hint in of.__annotations__.items()}


def _meant(hint: Any, scope: dict[str, Any]) -> Any:
    """Most are texts, which are names, or expressions, for which `typing` takes much longer."""
    if isinstance(hint, ForwardRef):  # of a named tuple
        hint = hint.__forward_arg__
    if not isinstance(hint, str):
        return hint
    return _SIMPLE.get(hint) or scope.get(hint) or eval(hint, scope)


def _numbers(hint: object) -> type[Any]:
    *_, count = get_args(hint)
    return ctypes.c_double * cast("int", count)


class Places:
    """Places of the fields of a record in a flat array: each class attribute `place()` becomes its number.

    `place(width)` takes so many places. `SIZE` is the number of places.
    """

    SIZE = 0

    def __init_subclass__(cls) -> None:
        """Number the fields in the order in which they stand."""
        for name, value in list(vars(cls).items()):
            if isinstance(value, _Place):
                setattr(cls, name, cls.SIZE)
                cls.SIZE += value.width


class _Place(NamedTuple):
    width: int


def place(width: int = 1) -> int:
    """A field of `Places`."""
    return cast("int", _Place(width))


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
    hints = _hints(kernel)
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
    code = get_args(hint)[-1] if get_args(hint) else None
    if not isinstance(code, str):
        msg = f"a kernel cannot take {hint}"
        raise TypeError(msg)
    return Argument(Kind.ARRAY, code=code)


@cache
def _group(hint: type) -> Argument:
    """A named tuple; many kernels take the same one."""
    parts = _hints(hint).values()
    return Argument(Kind.GROUP, type=hint, parts=tuple(_argument(part) for part in parts))


def flat(parts: tuple[Argument, ...]) -> Iterator[Argument]:
    """Arguments with groups taken apart."""
    for part in parts:
        if part.kind is Kind.GROUP:
            yield from flat(part.parts)
        else:
            yield part
