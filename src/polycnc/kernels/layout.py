"""How the data of kernels is declared: kinds of arrays, records with named fields, places in flat arrays.

A kernel's annotations are its declaration. The build reads them (`meaning`), and tells the call what it must know.
"""

from __future__ import annotations

import sys
from collections.abc import MutableSequence, Sequence
from functools import partial

from polycnc.deferred.typing import TYPE_CHECKING, Annotated, Any, TypeVar, cast
from polycnc.kernels.c_types import Integer, Number, Structure, put

if TYPE_CHECKING:
    from collections.abc import Callable

# Arrays by the type of their items, as for `array.array`. A kernel reads and writes them in place.
Bytes = Annotated[MutableSequence[int], "B"]
Ints32 = Annotated[MutableSequence[int], "i"]
Words16 = Annotated[MutableSequence[int], "H"]
Words32 = Annotated[MutableSequence[int], "I"]
Ints = Annotated[MutableSequence[int], "q"]
Floats = Annotated[MutableSequence[float], "d"]
#: What a kernel only reads: `bytes`, for which nothing is copied.
Text = Annotated[Sequence[int], "$"]

_SIMPLE = {each.__name__: each for each in (int, float, bool)}
_R = TypeVar("_R", bound=Structure)


def record(cls: type[_R]) -> type[_R]:
    """Make a `Structure` of its annotations: `float`, `int`, or `Annotated[Floats, count]` for so many numbers.

    The same memory is an object with named fields in Python and a structure in machine code.
    """
    types: dict[object, type[Any]] = {float: Number, int: Integer}
    cls._fields_ = [(name, types.get(hint) or _numbers(hint)) for name, hint in meaning(cls).items()]
    cls.memento = _memento  # type: ignore[attr-defined]
    return cls


def _memento(instance: Structure) -> Callable[[], None]:
    """For a snapshot: what brings the numbers of a record back."""
    return partial(put_back, instance, contents_of(instance))


def contents_of(instance: Structure) -> bytes:
    """The numbers of a record, for `put_back`."""
    return bytes(instance)


def put_back(instance: Structure, contents: bytes) -> None:
    """Give a record the numbers that it once had."""
    put(instance, contents)


def meaning(of: type | Callable[..., object]) -> dict[str, Any]:
    """What the annotations of a record, a group or a kernel mean, by name."""
    scope = vars(sys.modules[of.__module__])
    return {name: _meant(hint, scope) for name, hint in of.__annotations__.items()}


def _meant(hint: Any, scope: dict[str, Any]) -> Any:
    """Most are texts, which are names, or expressions, for which `typing` takes much longer."""
    hint = getattr(hint, "__forward_arg__", hint)  # of a named tuple of the library
    if not isinstance(hint, str):
        return hint
    return _SIMPLE.get(hint) or scope.get(hint) or eval(hint, scope)


def _numbers(hint: Any) -> type[Any]:
    count: int = hint.__metadata__[-1]
    return Number * count


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
                cls.SIZE += int(value)


class _Place(int):
    """A field that has no number yet; it is its width."""


def place(width: int = 1) -> int:
    """A field of `Places`."""
    return cast("int", _Place(width))
