"""How far axes are beside the path of their program because an operator has moved them while it waited.

On controls that do not lead the axes back (`MotionSettings.returns_to_path`) the program goes on from where they are.
With manual absolute on, the coordinates count what was moved by hand, and the control takes it back axis by axis: a
straight line to a programmed end goes there from where the axes are; increments and arcs are run beside the path. With
manual absolute off, the coordinates do not know of it, and everything that follows is shifted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

#: Ways below this count as none, mm or degrees.
NO_WAY = 1e-9


class ManualOffset:
    """What lies between the path and the axes, mm and degrees; nothing after power-on.

    Args:
        axes: Number of axes.

    Attributes:
        owed: Moved with manual absolute on; absolute words take it back.
        kept: Moved with manual absolute off; it stays until the axis has returned to its reference point, or power-on.
    """

    def __init__(self, axes: int) -> None:
        self.pending = [0.0] * axes
        self.shift = [0.0] * axes

    def __bool__(self) -> bool:
        return any(self.pending) or any(self.shift)

    def applied_to(self, path: Sequence[float]) -> list[float]:
        """Where the axes are when the path is here."""
        return [a + b + c for a, b, c in zip(path, self.pending, self.shift, strict=True)]

    def counted(self, path: Sequence[float]) -> list[float]:
        """What the coordinates know when the path is here."""
        return [a + b for a, b in zip(path, self.pending, strict=True)]

    def path(self, axes: Sequence[float]) -> list[float]:
        """Where the path is when the axes are here and nothing is owed."""
        return [a - b for a, b in zip(axes, self.shift, strict=True)]

    def moved(self, way: Sequence[float], *, absolute: bool) -> None:
        """An operator has moved the axes by this way, with manual absolute on or off."""
        into = self.pending if absolute else self.shift
        for axis, value in enumerate(way):
            into[axis] += value if abs(value) > NO_WAY else 0.0

    def is_pending(self, axes: int) -> bool:
        """Whether something is owed by one of these axes, a bit mask."""
        return any(value and axes >> axis & 1 for axis, value in enumerate(self.pending))

    def take_back(self, axes: int) -> list[float]:
        """What these axes owe, a bit mask; they owe it no more."""
        taken = [value if axes >> axis & 1 else 0.0 for axis, value in enumerate(self.pending)]
        self.pending = [pending - value for pending, value in zip(self.pending, taken, strict=True)]
        return taken
