"""What conditions and variables read of a channel's axes: as they are prepared, or as they are executed.

A channel runs ahead of its axes. What asks where they are *now* (an actual position, a limit switch, a condition of the
machine) reads `channel.actual`: a calculation has no other axes than those that are prepared, and the main run puts the
view of its own axes there.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.coordinates import Coordinates
    from polycnc.channel.interpolator import Interpolator


class View(Protocol):
    """The axes of a channel at one moment, mm (radius) and degrees, in the order of the channel."""

    @property
    def machine(self) -> Sequence[float]:
        """Machine position."""

    @property
    def work(self) -> Sequence[float]:
        """Position in the work coordinate system."""

    @property
    def clocked(self) -> Interpolator | None:
        """What executes the channel's rows in time; None where nobody does."""


class Prepared:
    """Where the blocks that have been prepared lead the axes.

    Args:
        coordinates: Of the channel.
    """

    __slots__ = ("_coordinates",)

    def __init__(self, coordinates: Coordinates) -> None:
        self._coordinates = coordinates

    @property
    def machine(self) -> Sequence[float]:
        """Machine position."""
        return self._coordinates.machine

    @property
    def work(self) -> Sequence[float]:
        """Position in the work coordinate system."""
        return self._coordinates.position

    @property
    def clocked(self) -> Interpolator | None:
        """Nobody executes them."""
        return None
