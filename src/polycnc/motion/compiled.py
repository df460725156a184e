"""The planner's kernels, compiled or as they are.

The kernels are plain functions. For a long program a copy of each is handed to Numba; the copies see each
other, not the plain ones.
"""

from __future__ import annotations

import importlib
from functools import cache
from hashlib import blake2b
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from polycnc.motion.kernels.lay import lay
from polycnc.motion.kernels.speeds import backward, forward

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable

MODULES = ("alone", "arcs", "columns", "corners", "feeds", "hold", "jerk", "lay", "speeds")


class Kernels(NamedTuple):
    """The three kernels that the planner calls.

    Attributes:
        lay: See `kernels/lay.py`.
        backward: See `kernels/speeds.py`.
        forward: See `kernels/speeds.py`.
        see: Turns an `array.array` into what these kernels read and write.
        ready: They start at once: plain, or in Numba's cache.
    """

    lay: Callable[..., int]
    backward: Callable[..., int]
    forward: Callable[..., None]
    see: Callable[[array[Any]], Any]
    ready: bool


PLAIN = Kernels(lay, backward, forward, lambda column: column, ready=True)


@cache
def compiled_kernels() -> Kernels | None:
    """The kernels compiled by Numba, or None where it is not installed.

    Numba keeps what it compiled and looks at one file to see whether it is out of date. A kernel also rests
    on kernels of other files, so the digest of all of them is part of its name.
    """
    try:
        from numba import njit
    except ImportError:
        return None
    modules = [importlib.import_module(f"polycnc.motion.kernels.{name}") for name in MODULES]
    folder = Path(cast("str", modules[0].__file__)).parent
    sources = [Path(__file__), *sorted(folder.glob("*.py"))]
    digest = blake2b(b"".join(path.read_bytes() for path in sources), digest_size=6).hexdigest()
    scopes = [dict(vars(module)) for module in modules]
    kernels: dict[str, Any] = {}
    for scope in scopes:
        for name, value in scope.items():
            if isinstance(value, FunctionType) and value.__module__ == scope["__name__"]:
                copy = FunctionType(value.__code__, scope, name, value.__defaults__)
                copy.__qualname__ = f"{name}_{digest}"
                kernels[name] = njit(cache=True, error_model="numpy")(copy)
    # Numba compiles at the first call: from here on the copies find each other, not the plain functions.
    for scope in scopes:
        scope.update((name, kernel) for name, kernel in kernels.items() if name in scope)
    lay = kernels["lay"]
    ready = any(Path(lay.stats.cache_path).glob(f"*{lay.py_func.__qualname__}*.nbi"))
    return Kernels(lay, kernels["backward"], kernels["forward"], _view, ready)


def _view(column: array[Any]) -> Any:
    """A NumPy view of the same memory. An array must not grow while a view of it is held."""
    import numpy as np

    return np.frombuffer(column, column.typecode) if len(column) else np.zeros(0, column.typecode)
