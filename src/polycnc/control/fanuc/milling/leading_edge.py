"""G41.3 leading edge offset: on machines whose tool turns, the tool stands back from its cutting edge along the path.

The offset lies square on the tool, in the plane of tool and path, away from the edge that is the deepest: against the
path where the tool leans ahead, along it where it leans back. General knowledge of FANUC 30i and of the manuals of 15i
(B-63324EN, 14.14.2) and 16i (A-78438E, 1.2), which give the vector at the end of a block by the tool there and the way
of the next one; in between the tip goes straight. G41.3 and G40 move the tool by their vector in blocks of their own.
"""

from __future__ import annotations

from math import acos, degrees, sqrt

from polycnc.channel.moves.path import Move, PlacedEvent, Rank, Stage
from polycnc.control.fanuc.milling import five_axes
from polycnc.control.fanuc.milling.five_axes import not_yet
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.tools.radius import RadiusState, place_of_block
from polycnc.control.word_address.tools.spatial import posture_of
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import dot, minus, times
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.orientation.solutions import Posture

CODE = "G41.3"
NO_MOVE, START = "PS5407", "PS5408"
NOWHERE: Vector = (0.0, 0.0, 0.0)
#: A block with less way than this (mm) has none; angles that differ by less (degrees) are the same.
NO_WAY, NOISE_DEG = 1e-6, 1e-5
#: So many blocks without motion in a row keep the vector.
KEEPING = 2


class LeadingEdgeStage(Stage):
    """Moves the tip off its programmed points.

    Args:
        geometry: Columns of X, Y, Z.
        posture: How the tool stands on the work.
        radius: Offset, mm; a negative one leads the other way.
        fluctuation: Angles between tool and path that are so close to 0, 90 and 180 degrees count as these (19631).
        place: A move without way that stands for the block of G41.3.
    """

    rank = Rank.SPATIAL_COMPENSATION

    def __init__(
        self,
        geometry: tuple[int, int, int],
        posture: Posture,
        radius: float,
        fluctuation: float,
        place: Move,
    ) -> None:
        self._geometry = geometry
        self._posture = posture
        self._radius = radius
        self._close = max(fluctuation, NOISE_DEG)
        self._held: Move | None = place
        self._begins = True
        self._queue: list[Move | PlacedEvent] = []
        self._at: list[float] = place.start
        self._shift: Vector = NOWHERE
        self._sense = 0.0
        self._blocks = 0

    def beside(self, position: list[float]) -> list[float]:
        """Where the tip stands when the program stands at a position; see `Stage`."""
        return self._shifted(position, self._shift)

    def programmed(self, position: list[float]) -> list[float]:
        """Where the program stands when the tip stands at a position; see `Stage`."""
        return self._shifted(position, times(self._shift, -1.0))

    def move(self, move: Move) -> None:
        """Take the next move: its way tells the vector at the end of the one that waits."""
        way = self._way(move)
        if way is None:
            self._queue.append(move)
            return
        self._end_held(way, keeps=self._blocks > KEEPING)
        self._held, self._blocks = move, 0

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it keeps its place between the moves."""
        self._queue.append(event)
        if self._held is None:
            self._run_queue()

    def block(self) -> None:
        """Count blocks; the one behind G41.3 must move the tip."""
        self._blocks += 1
        if self._begins and self._blocks >= KEEPING:
            raise AlarmError(NO_MOVE)
        self.after.block()

    def flush(self) -> None:
        """What reads no further keeps the vector that there is."""
        if self._begins:
            raise AlarmError(NO_MOVE)
        self._end_held(None, keeps=True)
        self.after.flush()

    def end(self, place: Move) -> None:
        """G40: the block in front ends by its own way, then the tool goes back to the programmed point."""
        if self._begins:
            raise AlarmError(NO_MOVE)
        self._end_held(None if self._held is None else self._way(self._held), keeps=False)
        self._emit(place, NOWHERE)

    def _end_held(self, way: Vector | None, *, keeps: bool) -> None:
        held, self._held = self._held, None
        if held is not None:
            kept = keeps or way is None
            self._emit(held, self._shift if kept else self._vector(held, way or NOWHERE))
            self._begins = False
        self._run_queue()

    def _vector(self, move: Move, way: Vector) -> Vector:
        """The vector at the end of a move, by the tool there and the direction of the next way."""
        tool = self._posture.tool_at(move.end)
        along = max(-1.0, min(1.0, dot(tool, way)))
        angle = degrees(acos(along))
        if min(angle, 180.0 - angle) <= self._close:
            if self._begins:
                raise AlarmError(START, line=move.line)
            return self._shift
        if abs(angle - 90.0) > self._close:
            self._sense = -1.0 if along > 0.0 else 1.0
        elif not self._sense:
            raise not_yet(f"{CODE}: 90 deg")
        flat = minus(way, times(tool, along))
        return times(flat, self._sense * self._radius / sqrt(dot(flat, flat)))

    def _way(self, move: Move) -> Vector | None:
        x, y, z = (move.end[axis] - move.start[axis] for axis in self._geometry)
        size = sqrt(x * x + y * y + z * z)
        return None if size < NO_WAY else (x / size, y / size, z / size)

    def _run_queue(self) -> None:
        queue, self._queue = self._queue, []
        for item in queue:
            if isinstance(item, Move):
                self._emit(item, self._shift)
            else:
                self.after.event(item)

    def _emit(self, move: Move, shift: Vector) -> None:
        start, self._at, self._shift = self._at, self._shifted(move.end, shift), shift
        self.after.move(replace(move, start=start, end=self._at))

    def _shifted(self, position: list[float], shift: Vector) -> list[float]:
        moved = list(position)
        for axis, value in zip(self._geometry, shift, strict=True):
            moved[axis] += value
        return moved


def offset_edge(channel: WordAddressChannel, words: Words) -> None:
    """G41.3 [D]: in a block without motion; the tool goes beside its edge at once."""
    kinematics, c = channel.control.kinematics(channel), channel.coordinates
    if words.axes():
        raise words.fail("edge_words", CODE)
    if channel.mode["motion"] not in five_axes.STRAIGHT:
        raise words.fail("edge_start", CODE)
    if not kinematics.tool or kinematics.work or -1 in c.geometry:
        raise words.fail("edge_machine", CODE)
    state = RadiusState.of(channel)
    if state.side:
        raise words.fail("tip_mode", CODE)
    if channel.mode["length"] not in TIP_CODES:
        five_axes.check_axes(channel, CODE)
    number = words.integer("D")
    state.number = state.number if number is None else number
    parameters = FanucMillingParameters.naming(channel.setup.parameters)
    amount: float = channel.control.radius_value(channel, state.number)
    channel.flush()
    place = place_of_block(channel)
    stage = LeadingEdgeStage(
        c.geometry, posture_of(channel), amount, parameters.edge_angle_fluctuation, place
    )
    channel.path.put(stage)


def cancel(channel: WordAddressChannel, words: Words) -> None:
    """G40: ends every compensation of the radius; that of the leading edge in a block without motion."""
    stage = channel.path.find(LeadingEdgeStage)
    if stage is not None:
        if words.axes():
            raise words.fail("edge_words", "G40")
        stage.end(place_of_block(channel))
        channel.path.take(LeadingEdgeStage)
    five_axes.cancel(channel, words)


def check_block(builder: Builder) -> None:
    """Refuse other motions and compensations, and what nobody here knows the control to do."""
    if builder.before["compensation"] != CODE:
        return
    for row in builder.codes:
        foreign = row.group == "motion" and row.code not in five_axes.STRAIGHT
        if foreign or (row.group == "compensation" and row.code != "G40"):
            raise builder.control.fail("edge_command", address=row.code)
        if row.code not in five_axes.ALLOWED:
            raise not_yet(f"{row.code}: {CODE}")
    if builder.mode["cycle"] != "G80":
        raise not_yet(f"{builder.mode['cycle']}: {CODE}")
    for address in ("D", "H"):
        if builder.has(address):
            raise not_yet(f"{address}: {CODE}")
