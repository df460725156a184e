"""Kernels as machine code that is ready at once.

Numba needs about a second of processor time before a cached function runs, most of it for importing itself and for
learning its own types anew. So Numba compiles a kernel once, the object code goes into a file, and later runs hand that
file to LLVM without Numba. The file is good for one version of the sources, of Python, of LLVM, and for one processor.
"""

from __future__ import annotations

import ctypes
import os
import sys
from functools import cached_property
from hashlib import blake2b
from pathlib import Path
from tempfile import NamedTemporaryFile
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable, Sequence

_DIGEST_BYTES = 16
#: Helpers of the wrappers that Numba lays round a function, by what stands in for them; none is called here.
_HELPERS = {
    "numba_gil_ensure": "PyGILState_Ensure",
    "numba_gil_release": "PyGILState_Release",
    "NRT_MemInfo_call_dtor": "Py_DecRef",
}


class Native:
    """A kernel that takes pointers to arrays and gives a whole number.

    Args:
        name: Of the kernel; its file is called so.
        modules: Modules whose functions the kernel rests on, lower ones first. Each may be called by those
            behind it.
        entry: Makes, from the compiled functions by name, the function that takes the pointers. It is plain
            Python for Numba's `cfunc`.
        typecodes: Type of the items of every argument, as for `array.array`.
    """

    def __init__(
        self,
        name: str,
        modules: Sequence[ModuleType],
        entry: Callable[[dict[str, Any]], Callable[..., int]],
        typecodes: str,
    ) -> None:
        self._name = name
        self._modules = modules
        self._entry = entry
        self._typecodes = typecodes
        self._engine: Any = None  # owns the machine code

    @cached_property
    def ready(self) -> bool:
        """Whether the kernel need not be compiled first."""
        return self._file is not None and self._file.is_file()

    @cached_property
    def function(self) -> Callable[..., int] | None:
        """The kernel, called with `address` of each array; None where it cannot be compiled."""
        if self._file is None:
            return None
        stored = self._stored()
        if stored is None:
            try:
                stored = self._compile()
            except ImportError:
                return None
            _write(self._file, stored)
        return self._load(stored)

    # ---- the file ------------------------------------------------------------------------------------------

    @cached_property
    def _file(self) -> Path | None:
        try:
            import llvmlite
            from llvmlite import binding
        except ImportError:
            return None
        folder = _folder()
        if folder is None:
            return None
        digest = blake2b(digest_size=_DIGEST_BYTES)
        names = {function.__module__ for function in (self._entry, Native)}
        files = {str(sys.modules[name].__file__) for name in names}
        for path in sorted(files | {str(module.__file__) for module in self._modules}):
            digest.update(Path(path).read_bytes())
        for module in self._modules:
            digest.update(repr(_constants(module)).encode())
        features = binding.get_host_cpu_features().flatten()
        for part in (sys.version, llvmlite.__version__, binding.get_host_cpu_name(), features):
            digest.update(part.encode())
        return folder / f"{self._name}-{digest.hexdigest()}.kernel"

    def _stored(self) -> tuple[str, bytes] | None:
        """Symbol and object code in the file; None where there is none, or a damaged one."""
        assert self._file is not None
        try:
            digest, _, rest = self._file.read_bytes().partition(b"\n")
        except OSError:
            return None
        if digest != blake2b(rest, digest_size=_DIGEST_BYTES).hexdigest().encode():
            return None
        symbol, _, code = rest.partition(b"\n")
        return symbol.decode(), code

    # ---- machine code --------------------------------------------------------------------------------------

    def _compile(self) -> tuple[str, bytes]:
        from llvmlite import binding
        from numba import cfunc, njit, types

        scopes = [dict(vars(module)) for module in self._modules]
        functions: dict[str, Any] = {}
        for scope in scopes:
            for name, value in scope.items():
                if isinstance(value, FunctionType) and value.__module__ == scope["__name__"]:
                    copy = FunctionType(value.__code__, scope, name, value.__defaults__)
                    functions[name] = njit(error_model="numpy", forceinline=True)(copy)
        # Numba compiles at the first call: from here on the copies find each other, not the plain functions.
        for scope in scopes:
            scope.update((name, function) for name, function in functions.items() if name in scope)
        items = {"B": types.uint8, "i": types.int32, "I": types.uint32, "q": types.int64, "d": types.float64}
        pointers = (types.CPointer(items[code]) for code in self._typecodes)  # type: ignore[no-untyped-call]
        signature = types.int64(*pointers)
        made = cfunc(signature, error_model="numpy")(self._entry(functions))
        module = binding.parse_assembly(made.inspect_llvm())
        return made.native_name, _machine().emit_object(module)

    def _load(self, stored: tuple[str, bytes]) -> Callable[..., int]:
        from llvmlite import binding

        symbol, code = stored
        for helper, stand_in in _HELPERS.items():
            address = ctypes.cast(getattr(ctypes.pythonapi, stand_in), ctypes.c_void_p).value
            binding.add_symbol(helper, address)
        engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _machine())
        engine.add_object_file(binding.ObjectFileRef.from_data(code))
        engine.finalize_object()
        self._engine = engine
        pointers = [ctypes.c_void_p] * len(self._typecodes)
        prototype = ctypes.CFUNCTYPE(ctypes.c_int64, *pointers)
        function: Callable[..., int] = prototype(engine.get_function_address(symbol))
        return function


def address(column: array[Any]) -> int:
    """Where the items of an array lie. It must not grow before the kernel has run."""
    return column.buffer_info()[0]


def _constants(module: ModuleType) -> list[tuple[str, object]]:
    """Numbers that a module knows, those of other modules too: compiled code holds their values."""
    numbers = [item for item in vars(module).items() if isinstance(item[1], (int, float, tuple))]
    return sorted(numbers, key=lambda item: item[0])


def _machine() -> Any:
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    target = binding.Target.from_default_triple()
    features = binding.get_host_cpu_features().flatten()
    return target.create_target_machine(
        cpu=binding.get_host_cpu_name(), features=features, opt=3, jit=True, codemodel="jitdefault"
    )


def _folder() -> Path | None:
    """Where kernels are kept: Numba's own folder if the user named one, beside this module, or the user's cache.

    None for a user without a home: a folder that all share is no place for code that is run.
    """
    named = os.environ.get("NUMBA_CACHE_DIR")
    if named:
        return Path(named)
    beside = Path(__file__).parent / "__pycache__"
    if os.access(beside if beside.is_dir() else beside.parent, os.W_OK):
        return beside
    try:
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "polycnc"
    except RuntimeError:
        return None


def _write(file: Path, stored: tuple[str, bytes]) -> None:
    """Keep a kernel, whole or not at all; where nothing can be written it is compiled again next time."""
    symbol, code = stored
    rest = symbol.encode() + b"\n" + code
    digest = blake2b(rest, digest_size=_DIGEST_BYTES).hexdigest().encode()
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with NamedTemporaryFile(dir=file.parent, delete=False) as temporary:
            temporary.write(digest + b"\n" + rest)
        Path(temporary.name).replace(file)
    except OSError:
        return
