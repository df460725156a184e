"""Indexing axes: coded positions CAC, CIC, CDC, CACP, CACN, and where such an axis stops.

A table of machine data holds the positions, or they lie at even distances; numbers count from 0. Source: job planning
4.1, 10.4.14 (MOV); list of machine data (MD10900 ff., MD30500 ff.); Function Manual T1 (even distances).
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from math import floor

from polycnc.control.sinumerik.block import arguments
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

#: The plain attribute that leads to a coded position.
WAYS = {"CAC": "AC", "CIC": "AC", "CDC": "DC", "CACP": "ACP", "CACN": "ACN"}
#: MD30500: no indexing axis; tables 1 and 2 (MD10910, MD10930); even distances (MD30501 to MD30503).
NO_GRID, TABLES, EVEN = 0, (1, 2), 3
_ASSIGNED = "$MA_INDEX_AX_ASSIGN_POS_TAB"


class Grid(NamedTuple):
    """The positions of an indexing axis.

    Attributes:
        places: Those of a table, or of one turn, ascending, mm or degrees; of a linear axis with even steps the first.
        period: After what they come again; 0 for a table that does not.
        in_period: How many there are in a period; 0 where they go on without end.
    """

    places: list[float]
    period: float
    in_period: int

    def place(self, number: int) -> float | None:
        """The position of a number; None where there is none."""
        if not self.in_period:
            return self.places[0] + number * self.period
        return self.places[number] if 0 <= number < self.in_period else None

    def step(self, here: float, steps: int) -> float | None:
        """The position so many steps from a place, the next one being the first; None beyond the table."""
        turn, among = self._turn(here)
        behind = bisect_right(self.places, among + NO_WAY) - 1
        first = behind if steps >= 0 else bisect_left(self.places, among - NO_WAY)
        turns, number = divmod(first + steps, len(self.places)) if self.period else (0, first + steps)
        if not 0 <= number < len(self.places):
            return None
        return self.places[number] + (turn + turns) * self.period

    def number_at(self, here: float) -> int:
        """The number of the position last reached in positive direction, from 0."""
        turn, among = self._turn(here)
        number = bisect_right(self.places, among + NO_WAY) - 1
        if not self.in_period:
            return int(turn)
        return number % self.in_period if self.period else max(number, 0)

    def beyond(self, here: float, direction: int) -> float:
        """The first position at or behind a place, in a direction; the place itself where there is none."""
        turn, _ = self._turn(here)
        for each in (turn - 1, turn, turn + 1) if direction > 0 else (turn + 1, turn, turn - 1):
            for place in self.places if direction > 0 else reversed(self.places):
                at = place + each * self.period
                if direction * (at - here) >= -NO_WAY:
                    return at
            if not self.period:
                break
        return here

    def _turn(self, here: float) -> tuple[int, float]:
        """How many periods a place lies behind the first one, and where it is within its own."""
        if not self.period:
            return 0, here
        start = self.places[0]
        turn = floor((here - start + NO_WAY) / self.period)
        return turn, here - turn * self.period


def grid_of(channel: SinumerikChannel, column: int) -> Grid | None:
    """The positions of an axis; None for one that is no indexing axis."""
    data, name = channel.memory.data, channel.axes[column]
    axis = channel.memory.axes[column]
    turn = data.number("$MA_MODULO_RANGE", name) if axis.modulo else 0.0
    kind = data.integer(_ASSIGNED, name)
    if kind in TABLES:
        count = data.integer(f"$MN_INDEX_AX_LENGTH_POS_TAB_{kind}")
        places = [data.number(f"$MN_INDEX_AX_POS_TAB_{kind}", i) for i in range(count)]
        return Grid(sorted(places), turn, count) if places else None
    if kind != EVEN:
        return None
    parts = max(data.integer("$MA_INDEX_AX_DENOMINATOR", name), 1)
    first = data.number("$MA_INDEX_AX_OFFSET", name)
    if axis.modulo:
        return Grid(sorted((first + i * turn / parts) % turn for i in range(parts)), turn, parts)
    return Grid([first], data.number("$MA_INDEX_AX_NUMERATOR", name) / parts, 0)


def position(channel: SinumerikChannel, column: int, modifier: str, value: float) -> float:
    """The position that a coded position names.

    Raises:
        AlarmError: 17500 for an axis without positions, 17510 for a number that it does not have.
    """
    grid = grid_of(channel, column)
    if grid is None:
        raise AlarmError("17500", axis=channel.axes[column])
    place = None
    if value == int(value) and modifier == "CIC":
        place = grid.step(channel.coordinates.position[column], int(value))
    elif value == int(value):
        place = grid.place(int(value))
    if place is None:
        raise AlarmError("17510", axis=channel.axes[column])
    turn = grid.period if channel.memory.axes[column].modulo else 0.0
    return place % turn if turn else place


def stop_of(channel: SinumerikChannel, column: int, here: float, left: float, speed: float) -> float | None:
    """Where an indexing axis that goes on without end stops (MOV=0): the next position that it can brake on.

    Args:
        channel: The channel.
        column: The axis.
        here: Its machine position.
        left: The way to its target, signed.
        speed: How fast it goes at most, mm/s or degrees/s.
    """
    grid = grid_of(channel, column)
    if grid is None or not left:
        return None
    direction = 1 if left > 0.0 else -1
    target = here + left
    if abs(grid.beyond(target, direction) - target) <= NO_WAY:
        return target  # it is on its way to a position already
    acceleration = channel.axis_data[column].acceleration
    braking = speed**2 / (2.0 * acceleration) if acceleration else 0.0
    return grid.beyond(here + direction * braking, direction)


def _number(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_ACT_INDEX_AX_POS_NO[axis]`: the position last reached or passed, from 1; 0 for no indexing axis."""
    column = arguments.column(channel, indices[0] if indices else None)
    grid = grid_of(channel, column)
    return 0 if grid is None else grid.number_at(channel.actual.machine[column]) + 1


INDEX_VARIABLES: dict[str, RowWithStop] = {"$AA_ACT_INDEX_AX_POS_NO": (Type.INT, _number, None, True)}
