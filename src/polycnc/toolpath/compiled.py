"""The kernels of this folder, compiled or as they are."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32
    from polycnc.toolpath.digits import Forms
    from polycnc.toolpath.fairing import FairedRun, Points
    from polycnc.toolpath.survey import Boxes, Contexts, Moves

#: Writes rows as text; see `digits.fill`.
Fill: TypeAlias = "Callable[[Forms, Ints32, Floats, int, int, Bytes, Ints], int]"
_FAIRING = "polycnc.toolpath.fairing"
LIBRARY = Library(
    "toolpath",
    ("polycnc.toolpath.survey", "polycnc.toolpath.digits", _FAIRING),
    (
        "polycnc.toolpath.survey.survey",
        "polycnc.toolpath.digits.fill",
        f"{_FAIRING}.add_points",
        f"{_FAIRING}.fair",
        f"{_FAIRING}.note_shifts",
    ),
    inline=True,
)


class Fairing(NamedTuple):
    """The kernels that smooth the ends of short cuts; see `fairing.py`."""

    add_points: Callable[[Floats, int, Ints, Floats, float, FairedRun, Floats], int]
    fair: Callable[[FairedRun, Points, Floats], int]
    note_shifts: Callable[[FairedRun, Floats, int, int, Floats, Ints32], int]


@cache
def fairing() -> Fairing:
    """The compiled kernels; the plain ones where there are none."""
    return Fairing._make(map(LIBRARY.kernel, Fairing._fields))


@cache
def survey() -> Callable[[Moves, int, Bytes, Ints, Floats, Contexts, Boxes], int]:
    """The compiled kernel; the plain one where there is none."""
    return LIBRARY.kernel("survey")


@cache
def fill() -> Fill | None:
    """The compiled kernel; None where there is none: Python's own formatting is faster than the plain one."""
    return LIBRARY.compiled("fill")
