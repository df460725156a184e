"""Contour preparation: CONTPRON and CONTDCON begin it, EXECUTE ends it (job planning 15.2, 15.3, 15.7).

The blocks between run as they are, but the tool stays where it is: their moves become rows of a table. Each move is
noted as its block means it, before roundings and chamfers are put in, which become elements of their own.
"""

from __future__ import annotations

from math import isnan

from polycnc.channel.moves.path import Rank, Stage
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.plan import ExactStop
from polycnc.control.sinumerik.contours import tables
from polycnc.control.sinumerik.contours.elements import Element, Side, is_full_circle
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.limits import protection
from polycnc.control.sinumerik.motion.contour_reading import (
    ANY_FEED,
    AWAY_MM,
    ContourReading,
    Readings,
    reading_from_here,
    without_away,
)
from polycnc.control.sinumerik.tables import feed_type, length_factor
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import CCW_KINDS

with loaded_when_called():
    from polycnc.geometry import offset

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.arcs import Point

#: Types of machining: longitudinal inside and outside, face inside and outside.
SIDES = {"G": Side(False, -1.0), "L": Side(False, 1.0), "N": Side(True, -1.0), "P": Side(True, 1.0)}
#: What a contour may consist of.
MOTIONS = frozenset(("G0", "G1", "G2", "G3", "CIP", "CT"))
KINDS = frozenset((Kind.RAPID, Kind.FEED, Kind.CW, Kind.CCW))
#: Digits of the code of CONTDCON by G function; what is not here has none.
UNITS = {"G70": 0, "G71": 1, "G700": 2, "G710": 3}
DISTANCES = {"G90": 0, "G91": 1}
FEEDS = {"G93": 0, "G94": 1, "G95": 2, "G96": 3, "G961": 3}
PATHS = {"G60": 0, "G64": 1, "G641": 2, "G642": 3}
#: Coordinates of a first point that are farther off come from words that need the point before (ANG).
_NEAR_MM = AWAY_MM / 10.0


class Surroundings(NamedTuple):
    """What a contour may not change: plane, unit, frame, transformation, geometry axes, compensation."""

    plane: str
    unit: str
    frame: object
    transformation: object
    geometry: tuple[int, ...]
    compensation: str

    @classmethod
    def of(cls, channel: SinumerikChannel) -> Surroundings:
        """What holds now."""
        mode, coordinates = channel.mode, channel.coordinates
        return cls(
            mode["plane"],
            mode["unit"],
            (channel.memory.frames.total(), coordinates.zero),
            coordinates.transformation,
            tuple(coordinates.geometry),
            mode["compensation"],
        )


class Note(NamedTuple):
    """What a table tells of the block of a move beside its geometry.

    Attributes:
        modes: Hundreds and tens of the code of CONTPRON, or all of the code of CONTDCON but its units.
        feed: The feed in force, in internal units.
        factor: From programmed feeds to internal units.
    """

    modes: int
    feed: float
    factor: float


@dataclass(slots=True)
class Preparation:
    """A contour that is being prepared.

    Attributes:
        name: CONTPRON or CONTDCON.
        arguments: Of the call.
        reading: Catches the moves.
        surroundings: What the contour may not change.
        notes: A stage that has noted of every move how its block meant it.
    """

    name: str
    arguments: Arguments
    reading: ContourReading
    surroundings: Surroundings
    notes: Notes


@dataclass(slots=True)
class Preparations(State, lifetime=Lifetime.RESET):
    """The contour that is being prepared; None for none."""

    open: Preparation | None = None


class Notes(Stage):
    """Notes of every move how its block means it; behind this stage `Move.context` is the number of the note."""

    rank = Rank.NOTES

    def __init__(self, channel: SinumerikChannel, name: str, surroundings: Surroundings) -> None:
        self._channel = channel
        self._name = name
        self._surroundings = surroundings
        self.notes: list[Note] = []

    def move(self, move: Move) -> None:
        """Check a move, note it and pass it on."""
        channel = self._channel
        self._check(move)
        modes = _pron_modes(channel) if self._name == "CONTPRON" else _coded_modes(channel)
        feed = channel.feed if isnan(move.feed) else move.feed
        factor = feed_type(channel.mode).factor * (INCH_MM if channel.mode["unit"] == "G700" else 1.0)
        self.notes.append(Note(modes, feed, factor))
        self.after.move(replace(move, context=len(self.notes) - 1))

    def block(self) -> None:
        """Behind every block: 10931 where it has changed what a contour may not change."""
        self._check_surroundings()
        self.after.block()

    def _check_surroundings(self) -> None:
        if Surroundings.of(self._channel) != self._surroundings:
            raise AlarmError("10931", text=self._name)

    def _check(self, move: Move) -> None:
        """10930 for what is neither line nor arc, 10931 for what does not lie in the plane, or lies in another one."""
        channel = self._channel
        if channel.mode["motion"] not in MOTIONS or move.kind not in KINDS:
            raise AlarmError("10930", text="G4" if move.kind is Kind.DWELL else channel.mode["motion"])
        self._check_surroundings()
        u, v, w = PLANES[channel.mode["plane"]]
        plane = {channel.coordinates.geometry[axis] for axis in (u, v)}
        others = (i for i in range(len(move.end)) if i not in plane)
        if any(abs(move.end[i] - move.start[i]) > NO_WAY for i in others):
            raise AlarmError("10931", text=self._name)
        if move.is_arc and (not self.notes or abs(move.normal[w]) < 1.0 - NO_WAY or move.turns):
            raise AlarmError("10931", text=self._name)


def _pron_modes(channel: SinumerikChannel) -> int:
    mode = channel.mode
    return 100 * DISTANCES[mode["distance"]] + (0 if length_factor(mode) != 1.0 else tables.METRIC)


def _coded_modes(channel: SinumerikChannel) -> int:
    """The code without its units; PC0001 for a function that has no digit."""
    mode = channel.mode
    for group, known in (("feed", FEEDS), ("path", PATHS)):
        if mode[group] not in known:
            raise not_supported(f"CONTDCON {mode[group]}")
    digits = (
        UNITS[mode["unit"]],
        DISTANCES[mode["distance"]],
        FEEDS[mode["feed"]],
        PATHS[mode["path"]],
        int(ExactStop.of(channel).block),
    )
    return sum(digit * 10**place for place, digit in enumerate(digits, 1))


# ---- begin


def contpron(channel: SinumerikChannel, args: Arguments) -> None:
    """CONTPRON(table, type, VAR number of relief cuts, direction): a table with relief cuts begins."""
    table, kind, reliefs, direction = (*args, None)[:4]
    tables.field(table, tables.LINKED_COLUMNS, "CONTPRON")
    if _letter(kind) not in SIDES or _direction(direction) not in (0, 1) or reliefs is None:
        raise AlarmError("14020", text="CONTPRON")
    if reliefs.variable.type is not Type.INT:
        raise AlarmError("12330", text=reliefs.variable.name)
    _begin(channel, "CONTPRON", args)


def contdcon(channel: SinumerikChannel, args: Arguments) -> None:
    """CONTDCON(table, direction): a coded table begins; only in the direction of the contour."""
    table, direction = (*args, None)[:2]
    tables.field(table, tables.CODED_COLUMNS, "CONTDCON")
    if _direction(direction) != 0:
        raise AlarmError("14020", text="CONTDCON")
    _begin(channel, "CONTDCON", args)


def _letter(value: Any) -> str:
    return value.strip().upper() if isinstance(value, str) else ""


def _direction(value: Any) -> int:
    return 0 if value is None else arguments.whole(value)


def _begin(channel: SinumerikChannel, name: str, args: Arguments) -> None:
    """From here on moves are recorded.

    Raises:
        AlarmError: 10932 where a contour is being read already, 10931 with a radius compensation, 14144 under PTP
            (6.9.1).
    """
    if Readings.of(channel).open:
        raise AlarmError("10932")
    if channel.mode[seat.GROUP] and channel.mode["point_to_point"] == "PTP":
        raise AlarmError("14144")
    if channel.mode["compensation"] != "G40":
        raise AlarmError("10931", text=channel.mode["compensation"])
    columns = _plane_columns(channel)
    reading = reading_from_here(channel, keeps_modes=False)
    reading.arcs_need_centre = name != "CONTDCON"
    surroundings = Surroundings.of(channel)
    notes = Notes(channel, name, surroundings)
    Preparations.of(channel).open = Preparation(name, args, reading, surroundings, notes)
    reading.begin(channel, columns)
    channel.path.put(notes)


def _plane_columns(channel: SinumerikChannel) -> tuple[int, int]:
    """Columns of abscissa and ordinate; 10931 for a plane with an axis that the channel does not have."""
    geometry = channel.coordinates.geometry
    u, v = (geometry[axis] for axis in PLANES[channel.mode["plane"]][:2])
    if u < 0 or v < 0:
        raise AlarmError("10931", text=channel.mode["plane"])
    return u, v


# ---- end


def execute(channel: SinumerikChannel, args: Arguments) -> None:
    """EXECUTE(VAR error): the contour is complete; position and path are as before, and the table is filled.

    The error variable gets 0. The manual tells its meaning in two ways (0 = no error in 15.2, 1 = no error in 15.7); a
    contour with an error is an alarm here.
    """
    state = Preparations.of(channel)
    preparation, state.open = state.open, None
    if preparation is None:
        protection.execute(channel, args)
        return
    found = Surroundings.of(channel)
    moves = preparation.reading.end(channel)
    if found != preparation.surroundings:
        raise AlarmError("10931", text=preparation.name)
    elements = _elements(channel, preparation, moves)
    if preparation.name == "CONTPRON":
        _fill_linked(preparation, elements)
    else:
        _fill_coded(channel, preparation, elements)
    error = args[0]
    if error.variable.type is not Type.INT:
        raise AlarmError("12330", text=error.variable.name)
    error.value = 0


def check_end(channel: SinumerikChannel) -> None:
    """PC0009: the program ends while a contour is being prepared, or a protection zone defined."""
    state = Preparations.of(channel)
    if state.open is not None:
        preparation, state.open = state.open, None
        preparation.reading.end(channel)
        raise AlarmError("PC0009", text="M30")
    protection.check_end(channel)


class Prepared(NamedTuple):
    """An element of a contour with what is noted of its block; feeds in internal units."""

    element: Element
    note: Note
    feed: float


def _elements(channel: SinumerikChannel, preparation: Preparation, moves: list[Move]) -> list[Prepared]:
    """The moves as elements of the plane, the approach first; what has no way is none, but for the approach.

    Raises:
        AlarmError: 10931 for a full circle and for a first point that the point before would have to tell.
    """
    columns, applicate = _plane_columns(channel), PLANES[channel.mode["plane"]][2]
    u, v = PLANES[channel.mode["plane"]][:2]
    position = preparation.reading.position
    at: Point = position[columns[0]], position[columns[1]]
    result: list[Prepared] = []
    for move in moves:
        end = _point(move.end, columns)
        note = preparation.notes.notes[move.context]
        if move.center is None:
            element = Element(offset.line(at, end), note.modes, move.kind is Kind.RAPID)
        else:
            center = move.center[u], move.center[v]
            ccw = (move.kind in CCW_KINDS) is (move.normal[applicate] > 0.0)
            element = Element(offset.arc(at, end, center, ccw), note.modes)
        if is_full_circle(element.edge) or max(abs(end[0]), abs(end[1])) > _NEAR_MM:
            raise AlarmError("10931", text=preparation.name, line=move.line)
        if element.edge.length > NO_WAY or not result:
            result.append(Prepared(element, note, note.feed if isnan(move.feed) else move.feed))
        at = end
    if not result or (preparation.name == "CONTPRON" and len(result) == 1):
        raise AlarmError("10933")
    return result


def _point(position: list[float], columns: tuple[int, int]) -> Point:
    return without_away(position[columns[0]]), without_away(position[columns[1]])


def _fill_linked(preparation: Preparation, elements: list[Prepared]) -> None:
    table, kind, reliefs, direction = (*preparation.arguments, None)[:4]
    contour = [each.element for each in elements]
    rows, number = tables.linked_rows(
        contour[0], contour[1:], SIDES[_letter(kind)], table.dims[0], both=_direction(direction) == 1
    )
    tables.fill(table, rows)
    reliefs.value = number


def _fill_coded(channel: SinumerikChannel, preparation: Preparation, elements: list[Prepared]) -> None:
    programmed = not isnan(preparation.reading.feed)
    pieces = []
    for element, note, feed in elements:
        has_feed = not isnan(feed) and (programmed or feed != ANY_FEED)
        code = note.modes + element.code % 10
        pieces.append((code, element, feed / note.factor if has_feed else 0.0))
    factor = length_factor(channel.mode)
    u, v = elements[0].element.edge.start
    tables.fill(
        preparation.arguments[0],
        tables.coded_rows((u / factor, v / factor), UNITS[channel.mode["unit"]], pieces),
    )


PROCEDURES = {"CONTPRON": contpron, "CONTDCON": contdcon, "EXECUTE": execute}
