"""ORISON: the history of the orientation is smoothed over several blocks (6.7).

The rotary axes follow the mean of their programmed course over a stretch of the path, as far as the tool stays within
the tolerance. The tip does not notice: the linear axes lead it where it is programmed. Where a stretch of smoothed
blocks begins and ends the tool stands as programmed.
"""

from __future__ import annotations

from itertools import pairwise
from math import radians

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import EndOfBlock, Move, PlacedEvent, Rank, Stage
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.transformations.posture import Posture
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.orientation.directions import angle_between

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.block.draft import Values
    from polycnc.control.sinumerik.family import SinumerikChannel

    Places = tuple[float, ...]

#: Fewer blocks than this cannot be smoothed.
LEAST_BLOCKS = 4
#: Steps in which the deviation is brought within the tolerance.
NARROWINGS = 30
#: Positions that differ by less (mm, degrees) are the same.
SAME = 1e-9


def select(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """ORISON, ORISOF: PC0015 where fewer than four blocks are kept for it (MD28590)."""
    stage = channel.path.find(HistoryStage)
    if channel.mode["orientation_profile"] == "ORISOF":
        if stage is not None:
            stage.flush()
            channel.path.take(HistoryStage)
        return
    kept = channel.memory.data.integer("$MC_MM_ORISON_BLOCKS")
    if kept < LEAST_BLOCKS:
        raise AlarmError("PC0015", count=kept, least=LEAST_BLOCKS)
    if stage is None:
        channel.path.put(HistoryStage(channel))


class HistoryStage(Stage):
    """Holds a stretch of moves back and turns the tool evenly along it.

    A stretch are cuts, one after the other without anything between, none of them longer than MD20178. Its course are
    the positions of the rotary axes at the ends of moves, by the way along the path.
    """

    rank = Rank.HISTORY

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel
        self._held: list[Move | EndOfBlock] = []
        self._course: list[tuple[float, Places]] = []
        self._left: Places = ()

    @property
    def active(self) -> bool:
        """Always: the next move may belong to a stretch."""
        return True

    def move(self, move: Move) -> None:
        """Take a cut into the stretch; what is none ends it."""
        channel = self._channel
        length = MovePath(move, channel.coordinates.geometry).length
        longest = channel.memory.data.number("$MC_ORISON_BLOCK_PATH_LIMIT")
        if move.kind is Kind.RAPID or seat.centre_point(channel) is None or length > longest:
            self._pass_stretch()
            self.after.move(move)
            return
        if self._transformation() not in (None, channel.toolpath.contexts[move.context].transformation):
            self._pass_stretch()
        columns = self._columns()
        if not self._course:
            self._left = tuple(move.start[column] for column in columns)
            self._course = [(0.0, self._left)]
        self._course.append((self._course[-1][0] + length, tuple(move.end[column] for column in columns)))
        self._held.append(move)
        blocks = channel.memory.data.integer("$MC_MM_ORISON_BLOCKS")
        half = 0.5 * channel.memory.data.number("$SC_ORISON_DIST")
        while self._count() > 1 and (self._count() >= blocks or self._ahead() >= half):
            self._pass_first()

    def event(self, event: PlacedEvent) -> None:
        """What is not motion ends the stretch."""
        self._pass_stretch()
        self.after.event(event)

    def block(self) -> None:
        """The end of a block keeps its place."""
        if self._held:
            self._held.append(EndOfBlock())
        else:
            self.after.block()

    def flush(self) -> None:
        """The stretch ends here."""
        self._pass_stretch()
        self.after.flush()

    def _count(self) -> int:
        """Moves that are held back."""
        return sum(isinstance(item, Move) for item in self._held)

    def _transformation(self) -> object:
        """What the moves held back go through; None for no moves."""
        first = next((item for item in self._held if isinstance(item, Move)), None)
        return None if first is None else self._channel.toolpath.contexts[first.context].transformation

    def _columns(self) -> tuple[int, ...]:
        """Columns of the rotary axes that turn the tool."""
        posture = Posture.of(self._channel, self._channel.mode)
        return tuple(posture.column(axis) for axis in posture.point.kinematics.axes)

    def _first(self) -> int:
        """Where the end of the first move that is held back stands in the course."""
        return len(self._course) - self._count()

    def _ahead(self) -> float:
        """Way that is known behind the end of the first move."""
        return self._course[-1][0] - self._course[self._first()][0]

    def _pass_stretch(self) -> None:
        """Pass all moves on; the last one ends as programmed."""
        while self._held:
            self._pass_first()
        self._course.clear()

    def _pass_first(self) -> None:
        """Pass the first move on, turned as smoothing says, and the ends of blocks behind it."""
        item = self._held[0]
        if isinstance(item, Move):
            columns, at = self._columns(), self._first()
            right = self._smoothed(at)
            moved = replace(item, start=item.start.copy(), end=item.end.copy())
            for column, before, after in zip(columns, self._left, right, strict=True):
                moved.start[column], moved.end[column] = before, after
            self._left = right
            del self._held[0]
            self.after.move(moved)
            self._forget(at)
        while self._held and not isinstance(self._held[0], Move):
            self._held.pop(0)
            self.after.block()

    def _forget(self, at: int) -> None:
        """The course farther back than smoothing reaches is not needed any more; its first place stays its start."""
        half = 0.5 * self._channel.memory.data.number("$SC_ORISON_DIST")
        while at > 1 and self._course[1][0] < self._course[at][0] - half:
            del self._course[0]
            at -= 1

    def _smoothed(self, at: int) -> Places:
        """The mean of the course around a place in it, no farther from the programmed one than the tolerance."""
        data = self._channel.memory.data
        way, programmed = self._course[at]
        half = min(0.5 * data.number("$SC_ORISON_DIST"), way - self._course[0][0], self._course[-1][0] - way)
        if half <= SAME:
            return programmed
        mean = _mean(self._course, way - half, way + half)
        posture = Posture.of(self._channel, self._channel.mode)
        tool = self._tool(posture, programmed)
        tolerance, low, high = radians(data.number("$SC_ORISON_TOL")), 0.0, 1.0
        if angle_between(tool, self._tool(posture, mean)) <= tolerance:
            return mean
        for _ in range(NARROWINGS):
            middle = 0.5 * (low + high)
            near = _between(programmed, mean, middle)
            low, high = (
                (middle, high)
                if angle_between(tool, self._tool(posture, near)) <= tolerance
                else (low, middle)
            )
        return _between(programmed, mean, low)

    def _tool(self, posture: Posture, places: Places) -> tuple[float, float, float]:
        """Direction of the tool at positions of the rotary axes."""
        work = self._channel.coordinates.position.copy()
        for column, place in zip(self._columns(), places, strict=True):
            work[column] = place
        return posture.direction(posture.angles(work))


def _between(a: Places, b: Places, share: float) -> Places:
    return tuple(x + (y - x) * share for x, y in zip(a, b, strict=True))


def _mean(course: Sequence[tuple[float, Places]], low: float, high: float) -> Places:
    """Mean of a course, linear between its places, over a stretch of the way."""
    sums = [0.0] * len(course[0][1])
    for (a, first), (b, last) in pairwise(course):
        begin, end = max(a, low), min(b, high)
        if end <= begin:
            continue
        middle = _between(first, last, (0.5 * (begin + end) - a) / (b - a))
        sums = [total + place * (end - begin) for total, place in zip(sums, middle, strict=True)]
    return tuple(total / (high - low) for total in sums)
