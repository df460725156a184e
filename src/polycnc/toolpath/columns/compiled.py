"""The kernel of this folder, compiled or as it is."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.kernels.library import Library
from polycnc.toolpath.columns import shown

if TYPE_CHECKING:
    from collections.abc import Callable

LIBRARY = Library("columns", (shown,), (shown.show,), inline=True)


@cache
def show() -> Callable[..., int]:
    """The compiled kernel; the plain one where there is none."""
    return LIBRARY.compiled(shown.show) or shown.show
