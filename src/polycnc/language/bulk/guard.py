"""Watches the travel of the axes behind a tool's tip while the scanner works (`reach`)."""

from __future__ import annotations

from array import array

from polycnc.channel.states.unchanging import unchanging
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.compiled import LIBRARY
from polycnc.language.bulk.layout import NoteRecord
from polycnc.transformation.orientation.linkage import room_for
from polycnc.transformation.orientation.linked import linkage_of, zero_of

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.kernels.layout import Ints
    from polycnc.transformation.contract import Transformation


@unchanging
class Guard:
    """Says how far scanned rows are certain to stay within the travel of the axes behind a tip.

    Args:
        axes: Number of the channel's axes.
        plain: Use the kernel as it is written, though it may be there compiled.
    """

    def __init__(self, axes: int, *, plain: bool = False) -> None:
        self._within = LIBRARY.plain("rows_within") if plain else LIBRARY.kernel("rows_within")
        self._axes = axes
        self._transformation: Transformation | None = None
        self._linkage, self._behind = array("d"), (0.0,) * axes
        self._room, self._unit = array("d", bytes(8 * room_for(axes))), array("d", bytes(8 * axes))

    def is_able(self, channel: Channel) -> bool:
        """Whether it knows where the transformation leads the axes."""
        coordinates = channel.coordinates
        if coordinates.transformation is not self._transformation:
            self._transformation = coordinates.transformation
            self._linkage = linkage_of(coordinates.transformation)
            self._behind = zero_of(coordinates.transformation, self._axes)
        return len(self._linkage) > 0 and coordinates.zero.is_identity

    def rows(self, channel: Channel, kinds: array[int], ends: array[float], count: int) -> int:
        """How many of some rows, from where the channel stands, are certain to stay within the travel."""
        offsets = array("d", map(sum, zip(self._behind, channel.coordinates.offsets, strict=True)))
        low, high = (array("d", ends_of) for ends_of in zip(*channel.limits, strict=True))
        found: int = self._within(
            kinds, ends, count, array("d", channel.coordinates.position), self._linkage, offsets, low, high,
            self._room, self._unit,
        )  # fmt: skip
        return found


def notes_before(row: int, notes: Ints, count: int) -> int:
    """How many of some notes were left before the rows up to a number were there."""
    return sum(notes[NoteRecord.SIZE * i + NoteRecord.ROW] < row for i in range(count))
