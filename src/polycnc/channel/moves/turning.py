"""The stage in which rotary axes turn along a move: it becomes as many as they need to go evenly in each.

What lies between two of them is no corner of the program: the axes go through without an exact stop, and displays show
one motion. A line becomes chords of a spline, along which the rotary axes change their pace smoothly while the tip
stays on it; an arc becomes so many arcs that they hardly change it from one to the next.
"""

from __future__ import annotations

from polycnc.channel.moves.knots import share_time
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.kinds import Kind
from polycnc.toolpath.modes import CornerMode

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Run
    from polycnc.transformation.orientation.turning import Turning


#: As much may the rotary axes leave their way at a knot, degrees: what its direction may be off.
TOLERANCE_DEG = 0.02
#: From knot to knot of an arc the rotary axes turn by so many degrees at most.
ARC_DEG = 0.5


class TurningStage(Stage):
    """Leads the rotary axes of moves that say how they go."""

    rank = Rank.TURNING
    takes_runs = True

    def __init__(self, channel: Channel) -> None:
        self._channel = channel

    @property
    def active(self) -> bool:
        """Whether the running block turns the tool."""
        return self._channel.turning is not None

    def move(self, move: Move) -> None:
        """Pass a move on, cut at the knots of its turning."""
        turning = move.turning
        if turning is None:
            self.after.move(move)
            return
        path = MovePath(replace(move, turning=None), self._channel.coordinates.geometry)
        standing = [move.start[column] for column in turning.columns]
        is_smooth = move.kind is Kind.FEED and turning.is_smooth(standing)
        if turning.course is not None:
            turning = turning.paced(standing, path.length)
        elif move.is_arc:
            turning = turning.finer(standing, ARC_DEG)
        within = self._through(move)
        before, start, pieces = 0.0, move.start, []
        for share, places in zip(turning.shares, turning.places, strict=True):
            piece = path.between(before, share)
            piece.start, piece.end = start, placed(piece.end, turning, places)
            piece.context = move.context if share == 1.0 else within
            piece.context = self._as_chord(piece.context) if is_smooth else piece.context
            pieces.append(piece)
            before, start = share, piece.end
        share_time(self._channel, pieces)
        for piece in pieces:
            self.after.move(piece)

    def run(self, run: Run) -> int:
        """Rotary axes go evenly along moves of a run."""
        return self.after.run(run)

    def _as_chord(self, context: int) -> int:
        """The context of a row that is a chord of the curve of its rotary axes."""
        toolpath = self._channel.toolpath
        return toolpath.context_number(replace(toolpath.contexts[context], chords=True))

    def _through(self, move: Move) -> int:
        """The context in which the axes go through the knots within a move.

        On a line the rotary axes may round them, since the tip stays on it; on an arc it would leave it.
        """
        toolpath = self._channel.toolpath
        context = toolpath.contexts[move.context]
        if context.corner_mode is CornerMode.EXACT_STOP:
            context = replace(context, corner_mode=CornerMode.CONTINUOUS)
        own = 0.0 if move.is_arc or context.tolerance_mm > TOLERANCE_DEG else TOLERANCE_DEG
        return toolpath.context_number(replace(context, knot=True, knot_deg=own))


def placed(position: list[float], turning: Turning, places: tuple[float, ...]) -> list[float]:
    """A position with the rotary axes at a knot."""
    moved = position.copy()
    for column, place in zip(turning.columns, places, strict=True):
        moved[column] = place
    return moved
