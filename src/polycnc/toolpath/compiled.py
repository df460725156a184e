"""The kernels of this folder, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.kernels.library import Library
from polycnc.toolpath import survey as kernels

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Bytes, Floats, Ints

LIBRARY = Library("toolpath", (kernels,), (kernels.survey,))


@cache
def survey() -> Callable[[kernels.Moves, int, Bytes, Ints, Floats, kernels.Box], int]:
    """The compiled kernel; the plain one where there is none."""
    return LIBRARY.compiled(kernels.survey) or kernels.survey
