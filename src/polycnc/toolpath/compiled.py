"""The kernels of this folder, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, TypeAlias

from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32
    from polycnc.toolpath.digits import Forms
    from polycnc.toolpath.survey import Boxes, Contexts, Moves

#: Writes rows as text; see `digits.fill`.
Fill: TypeAlias = "Callable[[Forms, Ints32, Floats, int, int, Bytes, Ints], int]"
LIBRARY = Library(
    "toolpath",
    ("polycnc.toolpath.survey", "polycnc.toolpath.digits"),
    ("polycnc.toolpath.survey.survey", "polycnc.toolpath.digits.fill"),
    inline=True,
)


@cache
def survey() -> Callable[[Moves, int, Bytes, Ints, Floats, Contexts, Boxes], int]:
    """The compiled kernel; the plain one where there is none."""
    return LIBRARY.kernel("survey")


@cache
def fill() -> Fill | None:
    """The compiled kernel; None where there is none: Python's own formatting is faster than the plain one."""
    return LIBRARY.compiled("fill")
