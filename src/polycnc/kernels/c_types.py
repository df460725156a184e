"""What kernels need of `ctypes`, from the module of C behind it.

The library's own makes classes for all types of C, thirty in all, and loads two modules for that: a fortieth of a
short run, which needs five types. These are as good for `ctypes` as its own.
"""

from __future__ import annotations

import sys
from _ctypes import FUNCFLAG_CDECL, CFuncPtr, Structure, _SimpleCData, addressof

from polycnc.deferred.typing import Any

__all__ = [
    "Byte", "Integer", "Number", "Pointer", "SharedObject", "Structure", "Text", "addressof", "contents", "place_of",
    "put",
]  # fmt: skip


class Integer(_SimpleCData):  # type: ignore[type-arg]
    """A whole number of eight bytes."""

    _type_ = "q"


class Number(_SimpleCData):  # type: ignore[type-arg]
    """A number of eight bytes."""

    _type_ = "d"


class Pointer(_SimpleCData):  # type: ignore[type-arg]
    """An address."""

    _type_ = "P"


class Byte(_SimpleCData):  # type: ignore[type-arg]
    """A byte."""

    _type_ = "c"


class Text(_SimpleCData):  # type: ignore[type-arg]
    """The address of bytes that end with a zero, which are its value."""

    _type_ = "z"


class _Function(CFuncPtr):
    _flags_ = FUNCFLAG_CDECL
    _restype_ = Integer


class SharedObject:
    """A file of functions that is loaded, or the process itself where `file` is None.

    Raises:
        OSError: It cannot be loaded.
    """

    def __init__(self, file: str | None) -> None:
        #: What `ctypes` looks for.
        self._handle = _loaded(file)

    def function(self, name: str) -> Any:
        """A function that gives a whole number; what it takes is to be told (`argtypes`).

        Raises:
            AttributeError: There is none.
        """
        return _Function((name, self))  # type: ignore[arg-type]  # it looks for the handle

    def address(self, name: str) -> int:
        """Where something lies.

        Raises:
            ValueError: There is no such thing.
        """
        return addressof(Byte.in_dll(self, name))  # type: ignore[arg-type]  # it looks for the handle


if sys.platform == "win32":

    def _loaded(file: str | None) -> int:
        from ctypes import CDLL  # which knows where Windows looks

        return CDLL(file)._handle  # noqa: SLF001

else:

    def _loaded(file: str | None) -> int:
        from _ctypes import RTLD_LOCAL, dlopen

        return dlopen(file, RTLD_LOCAL)  # type: ignore[arg-type]  # None is the process


def contents(place: int, size: int) -> bytes:
    """So many bytes at an address."""
    there: Any = (Byte * size).from_address(place)
    return there.raw  # type: ignore[no-any-return]


def place_of(text: bytes) -> int:
    """The address of bytes, good as long as somebody has them."""
    place: int = Integer.from_buffer(Text(text)).value
    return place


def put(thing: Structure, found: bytes) -> None:
    """Give a structure the bytes that it had."""
    there: Any = (Byte * len(found)).from_buffer(thing)
    there.raw = found
