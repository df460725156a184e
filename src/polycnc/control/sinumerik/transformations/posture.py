"""The posture of the tool: what blocks of orientation go on from, and the way between work, basic system and joints."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.transformation.orientation.choice import is_within, on_turns_within
from polycnc.transformation.orientation.directions import unit_of
from polycnc.transformation.orientation.solutions import solutions_for

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
    from polycnc.transformation.seated import Seated


@dataclass(slots=True)
class Orienting(State, lifetime=Lifetime.RESET):
    """What later blocks go on from.

    Attributes:
        lead: LEAD; `tilt` TILT, degrees.
        normal: Surface normal at the end of the last block, in the work: frames turn it (6.2.5).
        first_normal: The same at its start.
        tangent: How the direction changed at the end of the last way; None for not at all.
        second: The second point of the tool (ORICURVE), work coordinates; None where none was programmed.
        theta: Angle of the tool about its axis, degrees.
        stat: STAT, the joint configuration.
        rate: ORIS, degrees that the tool turns along a millimetre under OSS and OSSE; 0 for none.
    """

    lead: float = 0.0
    tilt: float = 0.0
    normal: Vector = (0.0, 0.0, 1.0)
    first_normal: Vector = (0.0, 0.0, 1.0)
    tangent: Vector | None = None
    second: Vector | None = None
    theta: float = 0.0
    stat: int = 0
    rate: float = 0.0


class Posture(NamedTuple):
    """The orientation transformation that acts, with its frames: between work, basic system and rotary axes."""

    channel: SinumerikChannel
    seated: Seated
    point: ToolCentrePoint
    turned: bool

    @classmethod
    def of(cls, channel: SinumerikChannel, mode: Mode) -> Posture:
        """The one of a channel; 14101 without an orientation transformation."""
        seated, point = seat.Transformations.of(channel).seated, seat.centre_point(channel)
        if seated is None or point is None:
            raise AlarmError("14101")
        return cls(channel, seated, point, mode["orientation_reference"] == "ORIWKS")

    def basic(self, vector: Vector) -> Vector:
        """A programmed direction in the basic system, of length 1; alarm 14121 for none."""
        direct = self.seated.frame.direct(*vector) if self.turned else vector
        found = unit_of(direct)
        if found is None:
            raise AlarmError("14121")
        return found

    def normal(self, vector: Vector) -> Vector:
        """A programmed surface normal in the work, of length 1; alarm 14121 for none."""
        found = unit_of(vector if self.turned else self.seated.frame.inverse().direct(*vector))
        if found is None:
            raise AlarmError("14121")
        return found

    def angles(self, work: list[float]) -> dict[str, float]:
        """Angles of the rotary joints at a position of the work."""
        basic = self.seated.basic(work)
        names = self.point.axes
        return {
            axis: basic[i] + self.point.zero[i]
            for axis in self.point.kinematics.axes
            for i in (names.index(axis),)
        }

    def column(self, axis: str) -> int:
        """Column of a rotary axis."""
        return self.point.axes.index(axis)

    def place(self, axis: str, angle: float) -> float:
        """Position of the work of a rotary axis at an angle of its joint."""
        column = self.column(axis)
        shift = self.seated.shifts[column] if self.seated.shifts else 0.0
        return angle - self.point.zero[column] - shift

    def places(self, angles: Angles) -> tuple[float, ...]:
        """Positions of the work of all rotary axes, in the order of the joints."""
        return tuple(self.place(axis, angles[axis]) for axis in self.point.kinematics.axes)

    def reaches(self, angles: Angles) -> bool:
        """Whether the travel of the axes allows these angles."""
        return all(
            is_within(angles[axis] - self.point.zero[self.column(axis)], *self.travel(axis))
            for axis in self.point.kinematics.axes
        )

    def travel(self, axis: str) -> tuple[float, float]:
        """Lowest and highest position of a rotary axis."""
        data, column = self.channel.memory.data, self.column(axis)
        own, name = self.channel.axis_data[column], self.channel.axes[column]
        low, high = own.limit_minus, own.limit_plus
        if data.is_set("$MA_POS_LIMIT_MINUS", name):
            low = max(low, data.number("$MA_POS_LIMIT_MINUS", name))
        if data.is_set("$MA_POS_LIMIT_PLUS", name):
            high = min(high, data.number("$MA_POS_LIMIT_PLUS", name))
        return low, high

    def direction(self, angles: Angles) -> Vector:
        """The tool in the basic system at angles of the joints."""
        return self.point.kinematics.tool_on_work(angles)

    def tip(self, work: list[float]) -> Vector:
        """The tip in the basic system."""
        basic = self.seated.basic(work)
        x, y, z = (basic[i] for i in self.seated.geometry)
        return (x, y, z)

    def standing(self, direction: Vector, near: Angles) -> list[dict[str, float]]:
        """Angles that stand the tool along a direction, each on the nearest turn that the travel of its axis allows.

        Raises:
            AlarmError: 14112 where there are none within reach.
        """
        kinematics = self.point.kinematics
        ranges = {axis: self._range(axis) for axis in kinematics.axes}
        placed = (on_turns_within(each, near, ranges) for each in solutions_for(kinematics, direction, near))
        found = [each for each in placed if each is not None]
        if not found:
            raise AlarmError("14112")
        return found

    def _range(self, axis: str) -> tuple[float, float]:
        """Lowest and highest angle of a rotary joint."""
        (low, high), zero = self.travel(axis), self.point.zero[self.column(axis)]
        return low + zero, high + zero
