"""The kernels of the account, compiled or as they are."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library
from polycnc.motion.compiled import PLANNING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats
    from polycnc.motion.explain.kernels.held import Ledger, Tables
    from polycnc.motion.kernels.columns import Limits, Rows, State

_OWN = "polycnc.motion.explain.kernels"
LIBRARY = Library(
    "explain",
    (
        *PLANNING,
        f"{_OWN}.held",
        f"{_OWN}.bounds",
        f"{_OWN}.law",
        f"{_OWN}.notes",
        f"{_OWN}.pieces",
        f"{_OWN}.rapids",
    ),
    (f"{_OWN}.notes.note_rows", f"{_OWN}.pieces.share_out"),
)


class Kernels(NamedTuple):
    """The kernels that the account calls; see `kernels/notes.py` and `kernels/pieces.py`."""

    note_rows: Callable[[Rows, int, Floats, int, Floats, Limits, State, int, int, Floats, int], None]
    share_out: Callable[[Floats, int, int, Tables, int, Ledger, Floats, Floats], int]


def kernels(*, compiled: bool = True) -> Kernels:
    """The compiled kernels; the plain ones where there are none, or where they are asked for."""
    return Kernels._make(map(LIBRARY.kernel if compiled else LIBRARY.plain, Kernels._fields))
