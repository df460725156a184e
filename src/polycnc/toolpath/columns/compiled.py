"""The kernel of this folder, compiled or as it is."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

LIBRARY = Library(
    "columns", ("polycnc.toolpath.columns.shown",), ("polycnc.toolpath.columns.shown.show",), inline=True
)


@cache
def show() -> Callable[..., int]:
    """The compiled kernel; the plain one where there is none."""
    return LIBRARY.kernel("show")
