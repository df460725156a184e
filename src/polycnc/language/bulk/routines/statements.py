"""How a control tells what a line of a routine does beside blocks of words."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.routines.layout import LineKind

if TYPE_CHECKING:
    from polycnc.language.bulk.scannable import Scannable


class Statement(NamedTuple):
    """What a line does that is no block of words.

    Attributes:
        kind: One of `LineKind`.
        formulas: What it calculates: pairs of `Operation` and argument; what is left is its condition.
        numbers: The numbers in them.
        target: The step to which it jumps.
        loop: The number of the loop that it begins or ends.
        callee: The program that it calls, its number in the toolpath, and how many steps it has.
        is_known: A block that the scanner does not read: the control knows it by its place in the program.
    """

    kind: int
    formulas: tuple[int, ...] = ()
    numbers: tuple[float, ...] = ()
    target: int = 0
    loop: int = 0
    callee: tuple[Scannable, int, int] | None = None
    is_known: bool = False


#: A line that cannot be told yet, one that is the interpreter's, one without a block, one whose block is read.
UNREAD, REFUSED, NOTHING, BLOCK = (
    Statement(kind) for kind in (LineKind.UNREAD, LineKind.REFUSED, LineKind.NOTHING, LineKind.BLOCK)
)
