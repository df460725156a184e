"""Kernels that are compiled together.

Compiled code is good for one version of the sources, of Python, of LLVM, and for one processor.
"""

from __future__ import annotations

import ctypes
import os
import sys
from functools import cached_property
from hashlib import blake2b
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar, cast

from polycnc.kernels import compiler, layout, store
from polycnc.kernels.layout import Argument, Kind, Places, arguments, flat

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Sequence
    from types import ModuleType

_F = TypeVar("_F", bound="Callable[..., object]")
_DIGEST_BYTES = 16
#: Where this variable of the environment says `python`, kernels run as they are written.
CHOICE = "POLYCNC_KERNELS"


class Library:
    """Kernels that are compiled together.

    Args:
        name: Of their file.
        modules: Modules with the functions that they rest on.
        kernels: The functions that Python calls. Their annotations say what they take (`layout`); they give a whole
            number or nothing.
        inline: Every call is replaced by what it calls.
    """

    def __init__(
        self,
        name: str,
        modules: Sequence[ModuleType],
        kernels: Sequence[Callable[..., object]],
        *,
        inline: bool = False,
    ) -> None:
        self._name, self._modules, self._kernels, self._inline = name, modules, kernels, inline

    @cached_property
    def ready(self) -> bool:
        """Whether the kernels need not be compiled first."""
        return self._file is not None and self._file.is_file()

    def compiled(self, kernel: _F) -> _F | None:
        """A kernel as machine code, called like the plain one; None where it cannot be compiled.

        Its arrays are `array.array`; they must not grow while it runs.
        """
        return cast("_F | None", self._callers.get(kernel.__name__))

    @cached_property
    def _callers(self) -> dict[str, Callable[..., int]]:
        loaded = self._loaded
        return {k.__name__: _Compiled(loaded, k) for k in self._kernels} if loaded is not None else {}

    @cached_property
    def _loaded(self) -> store.Loaded | None:
        if self._file is None:
            return None
        code = store.read(self._file)
        if code is None:
            try:
                code = self.object_code()
            except ImportError:
                return None
            store.write(self._file, code)
        return store.Loaded(code)

    def object_code(self) -> bytes:
        """Compile the kernels.

        Raises:
            ImportError: Numba is not installed.
        """
        return compiler.object_code(self._modules, self._kernels, inline=self._inline)

    @cached_property
    def _file(self) -> Path | None:
        """Where the object code is kept; None where kernels run as they are written."""
        if os.environ.get(CHOICE) == "python":
            return None
        try:
            import llvmlite
            from llvmlite import binding
        except ImportError:
            return None
        folder = store.folder()
        if folder is None:
            return None
        digest = blake2b(digest_size=_DIGEST_BYTES)
        for module in (compiler, layout, *self._modules):
            digest.update(Path(str(module.__file__)).read_bytes())
            digest.update(repr(_constants(module)).encode())
        features = binding.get_host_cpu_features().flatten()
        for part in (sys.version, llvmlite.__version__, binding.get_host_cpu_name(), features):
            digest.update(part.encode())
        return folder / f"{self._name}-{digest.hexdigest()}.kernel"


def _constants(module: ModuleType) -> list[tuple[str, object]]:
    """Numbers that a module knows, those of other modules too: compiled code holds their values."""
    numbers: list[tuple[str, object]] = []
    for name, value in vars(module).items():
        if isinstance(value, (int, float, tuple)):
            numbers.append((name, value))
        elif isinstance(value, type) and issubclass(value, Places):
            numbers.append(
                (name, [(place, getattr(value, place)) for place in dir(value) if place.isupper()])
            )
    return sorted(numbers, key=lambda item: item[0])


class _Compiled:
    """Is called like a kernel, and calls its machine code."""

    def __init__(self, code: store.Loaded, kernel: Callable[..., object]) -> None:
        self._arguments = arguments(kernel)
        types = [item for argument in flat(self._arguments) for item in _TYPES[argument.kind]]
        self._function = code.function(kernel.__name__, types)
        self._code = code  # must live as long as its function

    def __call__(self, *given: object) -> int:
        values: list[object] = []
        for argument, value in zip(self._arguments, given, strict=True):
            _take_apart(argument, value, values)
        return self._function(*values)


_TYPES: dict[Kind, tuple[type, ...]] = {
    Kind.ARRAY: (ctypes.c_void_p, ctypes.c_int64),
    Kind.RECORD: (ctypes.c_void_p,),
    Kind.INTEGER: (ctypes.c_int64,),
    Kind.NUMBER: (ctypes.c_double,),
}


def _take_apart(argument: Argument, value: object, values: list[object]) -> None:
    """Add the addresses, lengths and numbers of an argument."""
    if argument.kind is Kind.ARRAY:
        column = cast("array[float]", value)
        assert column.typecode == argument.code, f"{column.typecode} is not {argument.code}"
        values.extend(column.buffer_info())
    elif argument.kind is Kind.RECORD:
        values.append(ctypes.addressof(cast("ctypes.Structure", value)))
    elif argument.kind is Kind.GROUP:
        for part, item in zip(argument.parts, cast("tuple[object, ...]", value), strict=True):
            _take_apart(part, item, values)
    else:
        values.append(value)
