"""Kernels that are compiled together, when polycnc is built.

Their machine code is good for one version of their sources, which a digest in it names.
"""

from __future__ import annotations

import ctypes
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, cast
from zlib import crc32

from polycnc.kernels import native
from polycnc.kernels.layout import Argument, Kind, Places, arguments, flat

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import ModuleType
    from typing import TypeVar

    _F = TypeVar("_F", bound=Callable[..., object])
_DIGEST_BYTES = 4


class Library:
    """Kernels that are compiled together.

    Args:
        name: Of the library.
        modules: Modules with the functions that they rest on.
        kernels: The functions that Python calls. Their annotations say what they take (`layout`); they give a whole
            number or nothing. No other library has kernels of the same names.
        inline: Every call is replaced by what it calls.
        file: Shared object with their machine code; that of this installation where it is left out.
    """

    def __init__(
        self,
        name: str,
        modules: Sequence[ModuleType],
        kernels: Sequence[Callable[..., object]],
        *,
        inline: bool = False,
        file: Path = native.FILE,
    ) -> None:
        self.modules, self.kernels, self.inline = modules, kernels, inline
        self.digest_name = f"digest_of_{name}"
        self._file = file
        self._callers: dict[Callable[..., object], Callable[..., int]] = {}

    @cached_property
    def lack(self) -> native.Lack | None:
        """Why there is no machine code; None where there is."""
        code = native.load(self._file)
        if code is None:
            return native.Lack.MISSING if native.is_wanted() else native.Lack.CHOSEN
        return None if self._digest_in(code) == self.digest else native.Lack.STALE

    def compiled(self, kernel: _F) -> _F | None:
        """A kernel as machine code, called like the plain one; None where there is none.

        Its arrays are `array.array`; they must not grow while it runs.
        """
        code = native.load(self._file)
        if code is None or self.lack is not None or kernel not in self.kernels:
            return None
        if kernel not in self._callers:
            self._callers[kernel] = _caller(code, kernel)
        return cast("_F", self._callers[kernel])

    def _digest_in(self, code: ctypes.CDLL) -> bytes:
        """The digest of the sources of machine code; nothing where it was made before there was this library."""
        try:
            return (ctypes.c_char * _DIGEST_BYTES).in_dll(code, self.digest_name).raw
        except ValueError:
            return b""

    @cached_property
    def digest(self) -> bytes:
        """Of the sources, and of every number that they take from other modules: code holds its value."""
        digest = 0
        known: dict[type, list[tuple[str, int]]] = {}  # many modules know the same records
        for module in self.modules:
            digest = crc32(Path(str(module.__file__)).read_bytes(), digest)
            digest = crc32(repr(_constants(module, known)).encode(), digest)
        return digest.to_bytes(_DIGEST_BYTES, "big")


def _constants(module: ModuleType, known: dict[type, list[tuple[str, int]]]) -> list[tuple[str, object]]:
    """Numbers that a module knows, those of other modules too; `known` are places of records, and takes more."""
    numbers: list[tuple[str, object]] = []
    for name, value in vars(module).items():
        if isinstance(value, (int, float, tuple)):
            numbers.append((name, value))
        elif isinstance(value, type) and issubclass(value, Places):
            if value not in known:
                known[value] = _places(value)
            numbers.append((name, known[value]))
    return sorted(numbers, key=lambda item: item[0])


def _places(cls: type[Places]) -> list[tuple[str, int]]:
    """Names and places of the fields of a record."""
    found: dict[str, int] = {}
    for each in reversed(cls.__mro__):
        found |= {name: place for name, place in vars(each).items() if name.isupper()}
    return sorted(found.items())


def _caller(code: ctypes.CDLL, kernel: Callable[..., object]) -> Callable[..., int]:
    """What is called like a kernel, and calls its machine code.

    It is written out for the arguments of the kernel: taken apart one by one, they took longer than many a kernel.
    """
    entry = code[kernel.__name__]
    taken = arguments(kernel)
    entry.argtypes = [item for argument in flat(taken) for item in _TYPES[argument.kind]]
    entry.restype = ctypes.c_int64
    given: list[str] = []
    arrays: list[str] = []
    for number, argument in enumerate(taken):
        _give(argument, f"a{number}", given, arrays)
    codes = tuple(argument.code for argument in flat(taken) if argument.kind is Kind.ARRAY)
    scope = {
        "entry": entry,
        "addressof": ctypes.addressof,
        "codes": codes,
        "refuse": partial(_refuse, codes),
    }
    source = (
        f"def call({', '.join(f'a{number}' for number in range(len(taken)))}):\n"
        f"    found = ({''.join(f'{array}.typecode, ' for array in arrays)})\n"
        "    if found != codes: refuse(found)\n"
        f"    return entry({', '.join(given)})\n"
    )
    exec(source, scope)
    return cast("Callable[..., int]", scope["call"])


def _refuse(codes: tuple[str, ...], found: tuple[str, ...]) -> None:
    msg = f"a kernel was given arrays of {''.join(found)}, not of {''.join(codes)}"
    raise TypeError(msg)


def _give(argument: Argument, name: str, given: list[str], arrays: list[str]) -> None:
    """Add how an argument is handed to machine code, and the arrays in it."""
    if argument.kind is Kind.GROUP:
        for number, part in enumerate(argument.parts):
            _give(part, f"{name}[{number}]", given, arrays)
    elif argument.kind is Kind.ARRAY:
        arrays.append(name)
        given.append(f"*{name}.buffer_info()")
    else:
        given.append(f"addressof({name})" if argument.kind is Kind.RECORD else name)


_TYPES: dict[Kind, tuple[type, ...]] = {
    Kind.ARRAY: (ctypes.c_void_p, ctypes.c_int64),
    Kind.RECORD: (ctypes.c_void_p,),
    Kind.INTEGER: (ctypes.c_int64,),
    Kind.NUMBER: (ctypes.c_double,),
}
