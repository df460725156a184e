"""The kernels of this folder, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, TypeAlias

from polycnc.kernels.library import Library
from polycnc.toolpath import digits
from polycnc.toolpath import survey as kernels

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32

#: Writes rows as text; see `digits.fill`.
Fill: TypeAlias = "Callable[[digits.Forms, Ints32, Floats, int, int, Bytes, Ints], int]"
LIBRARY = Library("toolpath", (kernels, digits), (kernels.survey, digits.fill), inline=True)


@cache
def survey() -> Callable[[kernels.Moves, int, Bytes, Ints, Floats, kernels.Box], int]:
    """The compiled kernel; the plain one where there is none."""
    return LIBRARY.compiled(kernels.survey) or kernels.survey


@cache
def fill() -> Fill | None:
    """The compiled kernel; None where there is none: Python's own formatting is faster than the plain one."""
    return LIBRARY.compiled(digits.fill)
