"""Numbers of many lines, as runs of lines that follow each other: a million of them take no more room than two."""

from __future__ import annotations

from array import array
from bisect import bisect_right
from collections.abc import Sequence

from polycnc.deferred.typing import TYPE_CHECKING, overload

if TYPE_CHECKING:
    from collections.abc import Iterable


class LineRuns(Sequence[int]):
    """Line numbers in ascending order.

    Args:
        runs: Lines that follow each other, from the first run to the last one; none is empty.
    """

    def __init__(self, runs: Iterable[range]) -> None:
        #: Of each run: place of its first line among all, and how far numbers lie beyond places.
        self._places, self._beyond = array("q"), array("q")
        self._count = end = 0
        for run in runs:
            if run.start != end or not self._count:
                self._places.append(self._count)
                self._beyond.append(run.start - self._count)
            self._count += len(run)
            end = run.stop

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> int: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[int]: ...
    def __getitem__(self, index: int | slice) -> int | Sequence[int]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(self._count))]
        if not 0 <= index < self._count:
            raise IndexError(index)
        return index + self._beyond[bisect_right(self._places, index) - 1]
