"""What is stored of an orientable toolholder: `$TC_CARR1` to `$TC_CARR65`, and the kinematics that they describe.

Vectors lead from the reference point of the machine to axis v1, to axis v2, and to the tool (type T) or the table
(type P); of type M, v1 turns the tool and v2 the table (job planning 7.8; Function Manual W1). Angles count
right-handed about v1 and v2.

Source: job planning 7.8.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.geometry.frames import IDENTITY, Frame, translation
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.machine.kinematics import turn_about
from polycnc.memory.retained import TOOL_CARRIERS
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row
    from polycnc.geometry.frames import Vector

    #: Values of one toolholder by the number in their names.
    Values = Mapping[int, float | str]

#: First numbers of the vectors l1 to l4, and of v1 and v2.
LENGTHS, AXES = (1, 4, 15, 18), (7, 10)
ANGLES, AXIS_NAMES, KIND, ZEROS = 13, 21, 23, 24
HIRTH_OFFSETS, HIRTH_STEPS, LOWEST, HIGHEST, NAME = 26, 28, 30, 32, 34
#: From a number to that of its fine offset.
FINE = 40
NUMBERS = frozenset({*range(1, 47), *range(55, 61), 64, 65})
TYPES = {**dict.fromkeys((21, 22), Type.AXIS), **dict.fromkeys((23, 34, 35, 36), Type.STRING)}
KINDS = ("T", "P", "M")
#: What an angle may lie outside its range, degrees.
AT_LIMIT_DEG = 1e-9


@dataclass(slots=True)
class CarrierData(State, lifetime=Lifetime.POWER):
    """What is stored, by the number of the toolholder; axes by their names."""

    carriers: dict[int, dict[int, float | str]] = retained(TOOL_CARRIERS)

    def find(self, number: int) -> Values:
        """The values of a toolholder.

        Raises:
            AlarmError: 14150 for one that is not defined.
        """
        if number not in self.carriers:
            raise AlarmError("14150", number=number)
        return self.carriers[number]

    def named(self, name: str) -> int | None:
        """The number of the toolholder with a name ($TC_CARR34); None for none."""
        wanted = name.upper()
        return next((n for n, v in self.carriers.items() if str(v.get(NAME, "")).upper() == wanted), None)


@dataclass(frozen=True, slots=True)
class Carrier:
    """The kinematics of a toolholder.

    Attributes:
        kind: T: it turns the tool, P the table, M both.
        lengths: l1 to l4, mm.
        axes: v1 and v2; None for an axis that does not exist.
        zeros_deg: Positions of the axes at which nothing is turned.
        hirth_deg: Offset and step of each axis's teeth; a step of 0 for none.
        limits_deg: Lowest and highest position of each axis.
        stored_deg: Positions as they are stored.
        axis_names: Channel axes that tell the positions; empty for none.
    """

    kind: str
    lengths: tuple[Vector, ...]
    axes: tuple[Vector | None, Vector | None]
    zeros_deg: tuple[float, float]
    hirth_deg: tuple[tuple[float, float], ...]
    limits_deg: tuple[tuple[float, float], ...]
    stored_deg: tuple[float, float]
    axis_names: tuple[str, str]

    #: Axes that turn the tool and those that turn the table, with the vectors behind each of them.
    _OF_TOOL: ClassVar[dict[str, tuple[int, ...]]] = {"T": (0, 1), "P": (), "M": (0,)}
    _OF_TABLE: ClassVar[dict[str, tuple[int, ...]]] = {"T": (), "P": (0, 1), "M": (1,)}
    _TOOL_LENGTHS: ClassVar[dict[str, tuple[int, ...]]] = {"T": (0, 1, 2), "P": (0,), "M": (0, 1)}
    _TABLE_LENGTHS: ClassVar[dict[str, tuple[int, ...]]] = {"T": (), "P": (1, 2, 3), "M": (2, 3)}

    @classmethod
    def of(cls, values: Values, data: MachineData, number: int) -> Carrier:
        """A toolholder from its values, with fine offsets where SD42974 says so.

        Raises:
            AlarmError: 14153 for an unknown kinematic type, 14154 for a fine offset that is too large.
        """
        kind = str(values.get(KIND, "")).upper() or KINDS[0]
        if kind not in KINDS:
            raise AlarmError("14153", text=kind)
        fine = bool(data.integer("$SC_TOCARR_FINE_CORRECTION"))

        def value(n: int) -> float:
            found = float(values.get(n, 0.0))
            return found + _fine(values, n, data, number) if fine else found

        def vector(n: int) -> Vector:
            return (value(n), value(n + 1), value(n + 2))

        def pair(n: int) -> tuple[float, float]:
            return (value(n), value(n + 1))

        lows, highs, offsets, steps = (pair(n) for n in (LOWEST, HIGHEST, HIRTH_OFFSETS, HIRTH_STEPS))
        directions = (vector(n) for n in AXES)
        first, second = (direction if any(direction) else None for direction in directions)
        return cls(
            kind,
            tuple(vector(n) for n in LENGTHS),
            (first, second),
            pair(ZEROS),
            tuple(zip(offsets, steps, strict=True)),
            tuple((low, high) if low or high else (-inf, inf) for low, high in zip(lows, highs, strict=True)),
            (float(values.get(ANGLES, 0.0)), float(values.get(ANGLES + 1, 0.0))),
            (str(values.get(AXIS_NAMES, "")), str(values.get(AXIS_NAMES + 1, ""))),
        )

    def on_teeth(self, i: int, position: float) -> float:
        """The position of an axis at the nearest tooth of its Hirth coupling."""
        offset, step = self.hirth_deg[i]
        return offset + step * round((position - offset) / step) if step else position

    def reaches(self, i: int, position: float) -> bool:
        """Whether a position of an axis lies within its limits."""
        low, high = self.limits_deg[i]
        return low - AT_LIMIT_DEG <= position <= high + AT_LIMIT_DEG

    def tool_turn(self, positions: tuple[float, float]) -> Frame:
        """How the holder turns and shifts the lengths of the tool."""
        return self._chain(self._OF_TOOL[self.kind], self._TOOL_LENGTHS[self.kind], positions)

    def table_turn(self, positions: tuple[float, float]) -> Frame:
        """How the table is turned, and where its reference point is."""
        if not self._OF_TABLE[self.kind]:
            return IDENTITY
        return self._chain(self._OF_TABLE[self.kind], self._TABLE_LENGTHS[self.kind], positions)

    def _chain(
        self, axes: tuple[int, ...], lengths: tuple[int, ...], positions: tuple[float, float]
    ) -> Frame:
        frame = translation(*self.lengths[lengths[0]])
        for i, length in zip(axes, lengths[1:], strict=True):
            frame = frame @ self.turn(i, positions[i]) @ translation(*self.lengths[length])
        return frame

    def turn(self, i: int, position: float) -> Frame:
        """What an axis turns at a position."""
        axis = self.axes[i]
        return IDENTITY if axis is None else turn_about(axis, position - self.zeros_deg[i])

    @property
    def chains(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Axes that turn the tool, and those that turn the table."""
        return self._OF_TOOL[self.kind], self._OF_TABLE[self.kind]


def _fine(values: Values, n: int, data: MachineData, number: int) -> float:
    """Fine offset of a value; 14154 where it is larger than MD20188 or MD20190 allow."""
    if n + FINE not in NUMBERS:
        return 0.0
    offset = float(values.get(n + FINE, 0.0))
    limit = "$MC_TOCARR_FINE_LIM_ROT" if n >= ZEROS else "$MC_TOCARR_FINE_LIM_LIN"
    if abs(offset) > data.number(limit):
        raise AlarmError("14154", parameter=n + FINE, number=number)
    return offset


# ---- as variables


def row(number: int) -> Row:
    """`$TC_CARRn[m]`; `$TC_CARR1[0]=0` deletes all toolholders."""
    name, type_ = f"$TC_CARR{number}", TYPES.get(number, Type.REAL)
    empty: float | str = "" if type_ is not Type.REAL else 0.0

    def which(indices: Indices) -> int:
        if len(indices) != 1 or isinstance(indices[0], (Axis, str)):
            raise AlarmError("12400", text=name)
        return int(indices[0])

    def read(channel: SinumerikChannel, indices: Indices) -> float | str | Axis:
        values = CarrierData.of(channel).carriers.get(which(indices), {})
        found = values.get(number, KINDS[0] if number == KIND else empty)
        return Axis(str(found) or "X") if type_ is Type.AXIS else found

    def write(channel: SinumerikChannel, indices: Indices, value: float | str | Axis) -> None:
        carriers, holder = CarrierData.of(channel).carriers, which(indices)
        if holder == 0 and number == 1 and value == 0:
            carriers.clear()
        elif holder < 1:
            raise AlarmError("17020", text=name, index=holder)
        else:
            kept = value.name if isinstance(value, Axis) else value
            carriers.setdefault(holder, {})[number] = kept if isinstance(kept, str) else float(kept)

    return type_, read, write
