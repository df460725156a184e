"""Files with object code, and how they come into the process.

Numba needs about a second of processor time before a cached function runs, most of it for importing itself and for
learning its own types anew. So object code is kept in a file of its own, and later runs hand it to LLVM without Numba.
"""

from __future__ import annotations

import ctypes
import os
from hashlib import blake2b
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

_DIGEST_BYTES = 16


def folder() -> Path | None:
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


def read(file: Path) -> bytes | None:
    """Object code in a file; None where there is none, or a damaged one."""
    try:
        digest, _, code = file.read_bytes().partition(b"\n")
    except OSError:
        return None
    return code if digest == _digest(code) else None


def write(file: Path, code: bytes) -> None:
    """Keep object code, whole or not at all; where nothing can be written it is compiled again next time."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with NamedTemporaryFile(dir=file.parent, delete=False) as temporary:
            temporary.write(_digest(code) + b"\n" + code)
        Path(temporary.name).replace(file)
    except OSError:
        return


def _digest(code: bytes) -> bytes:
    return blake2b(code, digest_size=_DIGEST_BYTES).hexdigest().encode()


class Loaded:
    """Object code in the memory of the process."""

    def __init__(self, code: bytes) -> None:
        from llvmlite import binding

        from polycnc.kernels.compiler import machine

        engine = binding.create_mcjit_compiler(binding.parse_assembly(""), machine())
        engine.add_object_file(binding.ObjectFileRef.from_data(code))
        engine.finalize_object()
        self._engine = engine  # owns the machine code

    def function(self, name: str, types: Sequence[type]) -> Callable[..., int]:
        """An entry that takes values of ctypes and gives a whole number."""
        found: Callable[..., int] = ctypes.CFUNCTYPE(ctypes.c_int64, *types)(
            self._engine.get_function_address(name)
        )
        return found
