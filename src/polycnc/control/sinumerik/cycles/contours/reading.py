"""Contours that cycles read: a subprogram, or a section of the calling program between two labels.

The blocks run as they are, with the tool held: their moves are caught before they reach the toolpath, and position,
G functions, feed and frames are put back.
"""

from __future__ import annotations

from functools import partial
from math import nan

from polycnc.channel.moves.path import Recorder
from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion.contour_reading import ContourReading, reading_from_here, without_away
from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.statements.calls import call_section, call_without_arguments, named_program
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import (
    Auxiliary,
    HFunction,
    SecondAuxiliary,
    SpindleSpeed,
    Stop,
    ToolSelection,
)
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.moves.path import Move, PlacedEvent
    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point


class Place(NamedTuple):
    """Where a contour stands: in a program (empty for the calling one), all of it or from one label to another.

    A contour by its name stands in the calling program, between the labels that the control's editor writes, or else is
    a program of that name.
    """

    program: str
    first: str = ""
    last: str = ""
    is_by_name: bool = False


@dataclass(slots=True)
class ChosenContour(State, lifetime=Lifetime.RESET):
    """What calls of CYCLE62 have chosen for the next cycle, in their order."""

    places: list[Place] = field(default_factory=list)

    def take(self) -> list[Place]:
        """The contours; none is chosen afterwards."""
        places, self.places = self.places, []
        return places


#: Types of CYCLE62 that name labels: of the calling program, and of another one.
LABELS_HERE, LABELS_IN_PROGRAM = 2, 3
#: Type of CYCLE62 that names a contour, and the labels that the control's editor sets around it.
BY_NAME = 1
EDITOR_FIRST, EDITOR_LAST = "E_LAB_A_", "E_LAB_E_"


def choose(moves: Moves, a: Arguments) -> None:
    """CYCLE62: a contour of the cycle that follows, by program or by labels; several calls in a row choose several.

    Raises:
        AlarmError: 61002 for a type that does not exist.
    """
    kind = a.integer("_TYPE")
    if kind not in (0, BY_NAME, LABELS_HERE, LABELS_IN_PROGRAM):
        raise AlarmError("61002")
    labels = (a.text("_LAB1").upper(), a.text("_LAB2").upper()) if kind >= LABELS_HERE else ("", "")
    name = "" if kind == LABELS_HERE else a.text("_KNAME")
    moves.act(_choose, moves.channel, Place(name, *labels, is_by_name=kind == BY_NAME))
    moves.end_block()


def _choose(channel: SinumerikChannel, place: Place) -> None:
    ChosenContour.of(channel).places.append(place)


def _place(channel: SinumerikChannel, name: str) -> Place:
    """What "NAME" and "LABEL1:LABEL2" mean; an empty name is what CYCLE62 has chosen, once.

    Raises:
        AlarmError: PC0001 where it has chosen several, or the cycle is modal.
    """
    if not name.strip():
        places = _take(channel)
        if len(places) > 1:
            raise not_supported("CYCLE62: two contours")
        return places[0] if places else Place("")
    first, _, last = (part.strip() for part in name.partition(":"))
    return Place("", first.upper(), last.upper()) if last else Place(first)


def _take(channel: SinumerikChannel) -> list[Place]:
    """What CYCLE62 has chosen; PC0001 for a modal cycle, for which it chooses nothing but for its first call."""
    if channel.level.kind is LevelKind.MODAL:
        raise not_supported("MCALL: CYCLE62")
    return ChosenContour.of(channel).take()


def _call(channel: SinumerikChannel, place: Place) -> None:
    """Go on with the contour as a program level.

    Raises:
        AlarmError: 61605 where no contour is named, 14011 for a program that does not exist, 14082 for a label.
    """
    if place.is_by_name:
        first, last = (f"{mark}{place.program.strip().upper()}" for mark in (EDITOR_FIRST, EDITOR_LAST))
        if channel.executable(channel.level.code.program).whole.find_label(first, 0) >= 0:
            call_section(channel, "", first, last)
            return
    if place.first:
        call_section(channel, place.program, place.first, place.last)
    elif place.program:
        call_without_arguments(channel, named_program(channel, place.program))
    else:
        raise AlarmError("61605")


def read(moves: Moves, name: str, use: Callable[[Contour], None]) -> None:
    """Read the contour that a name means, in the plane of the cycle; the first block leads to its first point.

    That takes two blocks: one calls the contour as a program level, the next one has it, and what uses it notes what
    is done with it.

    Raises:
        AlarmError: As `_call`, 61605 for a contour without moves, PC0001 for several of CYCLE62.
    """
    _read(moves, _place(moves.channel, name), use)


def read_chosen(moves: Moves, use: Callable[[list[Contour]], None]) -> None:
    """Read all contours that calls of CYCLE62 have chosen, one after the other, as `read` does.

    Raises:
        AlarmError: As `read`; 61605 where none is chosen, PC0001 for a modal cycle.
    """
    places = _take(moves.channel)
    found: list[Contour] = []

    def go_on(contour: Contour | None = None) -> None:
        if contour is not None:
            found.append(contour)
        if len(found) < max(len(places), 1):
            _read(moves, places[len(found)] if places else Place(""), go_on)
        else:
            use(found)

    go_on()


def _read(moves: Moves, place: Place, use: Callable[[Contour], None]) -> None:
    reading = _Reading(moves, place, use)
    moves.act(reading.begin)
    moves.end_block()
    moves.act(reading.end)


#: Events of a contour that would have to happen along it, and the word that each is told by.
EVENTS = {
    Auxiliary: "M",
    SecondAuxiliary: "B",
    HFunction: "H",
    SpindleSpeed: "S",
    ToolSelection: "T",
    Stop: "M0",
}
#: What a contour consists of.
KINDS = frozenset((Kind.RAPID, Kind.FEED, Kind.CW, Kind.CCW))


class ContourRecorder(Recorder):
    """Keeps the moves of a contour; what else its blocks do is refused, for the cycle does not do it.

    Args:
        moves: The cycle that reads; its plane is that of the contour.

    Raises:
        AlarmError: PC0001 for auxiliary functions, 10930 for what is neither line nor arc, 10931 for a move that leaves
            the plane behind the first point.
    """

    def __init__(self, moves: Moves) -> None:
        super().__init__()
        self._columns = moves.columns

    def event(self, event: PlacedEvent) -> None:
        """An event of a block."""
        letter = EVENTS.get(type(event.event))
        if letter is not None:
            code = event.event.code if isinstance(event.event, Auxiliary) else ""
            raise not_supported(f"CYCLE62: {letter}{code}")

    def move(self, move: Move) -> None:
        """A move of a block."""
        if move.kind not in KINDS:
            raise AlarmError("10930", text="G4" if move.kind is Kind.DWELL else move.kind.name)
        away = (
            abs(b - a)
            for i, (a, b) in enumerate(zip(move.start, move.end, strict=True))
            if i not in self._columns[:2]
        )
        if self.moves and max(away, default=0.0) > NO_WAY:
            raise AlarmError("10931", text="CYCLE62")
        super().move(move)


class _Reading:
    """A contour that is being read.

    Args:
        moves: The cycle that wants it.
        place: Where it stands.
        use: What is done with it.
    """

    def __init__(self, moves: Moves, place: Place, use: Callable[[Contour], None]) -> None:
        self._moves, self._place, self._use = moves, place, use
        self._reading: ContourReading | None = None

    def begin(self) -> None:
        """The contour runs as a program level, and its moves are caught."""
        moves, channel = self._moves, self._moves.channel
        self._reading = reading_from_here(channel, keeps_modes=True, recorder=ContourRecorder(moves))
        # A cycle has chosen them for itself; a contour may change them.
        channel.mode = channel.mode.with_code("distance", "G90").with_code("motion", "G1")
        _call(channel, self._place)
        self._reading.begin(channel, moves.columns[:2])

    def end(self) -> None:
        """The contour is through: everything is as before, and the cycle goes on with it.

        Raises:
            AlarmError: 61605 for a contour without moves, PC0001 for one that shifts or turns its own frame.
        """
        moves, reading = self._moves, self._reading
        assert reading is not None
        channel = moves.channel
        caught = reading.end(channel)
        contexts = channel.toolpath.contexts
        frames = {
            contexts[number].frame
            for number in (channel.context_number(), *(move.context for move in caught))
        }
        if len(frames) > 1:
            raise not_supported("CYCLE62: TRANS, ROT, SCALE, MIRROR")
        caught = caught[1:]
        if not caught:
            raise AlarmError("61605")
        moves.plan(partial(self._use, [_piece(moves, move) for move in caught]))


def _piece(moves: Moves, move: Move) -> Piece:
    start, end = _point(moves, move.start), _point(moves, move.end)
    if move.center is None:
        return Piece(offset.line(start, end), move.kind is Kind.RAPID)
    center = move.center[moves.axes[0]], move.center[moves.axes[1]]
    ccw = (move.kind in CCW_KINDS) is (move.normal[moves.axes[2]] > 0.0)
    return Piece(offset.arc(start, end, center, ccw))


def _point(moves: Moves, position: list[float]) -> Point:
    """A position in the plane; an axis that the first block does not name stays where the tool stands."""
    u, v = (without_away(position[column]) if column >= 0 else nan for column in moves.columns[:2])
    return u, v
