"""The scanner's kernels, compiled or as they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.language.bulk import kernels, moves
from polycnc.language.bulk.native import Native, address

if TYPE_CHECKING:
    from array import array
    from collections.abc import Callable

#: Types of the items of `Tables` and `Columns`, in their order.
TYPECODES = "BqdiiidBIddidqd"
TABLES = 7


def plain_scan(*arrays: array[Any]) -> int:
    """The kernel as it is written."""
    return kernels.scan(kernels.Tables(*arrays[:TABLES]), moves.Columns(*arrays[TABLES:]))


def compiled_scan(*arrays: array[Any]) -> int:
    """The compiled kernel; ask `NATIVE.function` first whether there is one."""
    function = NATIVE.function
    assert function is not None
    return function(*map(address, arrays))


def _entry(functions: dict[str, Any]) -> Callable[..., int]:
    """The kernel for pointers. How far an array reaches is not asked: the scan keeps within its rooms."""
    from numba import carray  # type: ignore[attr-defined]

    scan, tables, columns, far = functions["scan"], kernels.Tables, moves.Columns, 1 << 40

    def entry(
        text: Any, ints: Any, floats: Any, nexts: Any, leaves: Any, rules: Any, factors: Any,
        kind: Any, line: Any, feed: Any, end: Any, curve: Any, curves: Any, notes: Any, said: Any,
    ) -> int:  # fmt: skip
        given = tables(
            carray(text, far), carray(ints, far), carray(floats, far), carray(nexts, far), carray(leaves, far),
            carray(rules, far), carray(factors, far),
        )  # fmt: skip
        written = columns(
            carray(kind, far), carray(line, far), carray(feed, far), carray(end, far), carray(curve, far),
            carray(curves, far), carray(notes, far), carray(said, far),
        )  # fmt: skip
        outcome: int = scan(given, written)
        return outcome

    return entry


NATIVE = Native("bulk", (moves, kernels), _entry, TYPECODES)
