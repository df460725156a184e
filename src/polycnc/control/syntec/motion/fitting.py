"""The stage of the path that keeps G05 to the blocks that it fits (manual 2.11).

G05 fits geometry axes, and rotary axes that it names with a tolerance. A block that moves another axis, or none of the
geometry axes, is left as it is, and so are its corners: there the path keeps to what holds without G05.
"""

from __future__ import annotations

from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.modes import CornerMode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel

#: Ways below this, mm or degrees, are none.
NO_WAY = 1e-9


class FittingStage(Stage):
    """Takes the tolerance away from corners of blocks that are not fitted.

    Args:
        channel: The channel.
        geometry: Columns of the geometry axes that are fitted.
        rotary: Those of the rotary axes.
    """

    rank = Rank.FITTING
    takes_runs = True

    def __init__(self, channel: Channel, geometry: Sequence[int], rotary: Sequence[int]) -> None:
        self._channel = channel
        self._geometry = tuple(geometry)
        fitted = {*geometry, *rotary}
        self._others = tuple(axis for axis in range(len(channel.axes)) if axis not in fitted)
        self._fits = True
        self._unfitted: dict[int, int] = {}

    def move(self, move: Move) -> None:
        """Pass a move on; its context says how the corner at its start is taken."""
        fits = self._is_fitted(move)
        if not (fits and self._fits):
            move.context = self._without_tolerance(move.context)
        self._fits = fits
        self.after.move(move)

    def _is_fitted(self, move: Move) -> bool:
        start, end = move.start, move.end
        if any(abs(end[axis] - start[axis]) > NO_WAY for axis in self._others):
            return False
        return move.is_arc or any(abs(end[axis] - start[axis]) > NO_WAY for axis in self._geometry)

    def _without_tolerance(self, number: int) -> int:
        if number not in self._unfitted:
            toolpath = self._channel.toolpath
            context = toolpath.contexts[number]
            if context.corner_mode is CornerMode.ROUNDED:
                context = replace(
                    context,
                    corner_mode=CornerMode.CONTINUOUS,
                    tolerance_mm=0.0,
                    turn_tolerance_deg=0.0,
                    fairing=None,
                )
            self._unfitted[number] = toolpath.context_number(context)
        return self._unfitted[number]
