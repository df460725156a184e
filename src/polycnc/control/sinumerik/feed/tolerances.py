"""Tolerances of smoothing: CTOL, OTOL, ATOL, and the variables that tell them (job planning 8.8)."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, prod

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.variables.row import RowWithStop
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.words import WordAlarm

with loaded_when_called():
    from polycnc.control.sinumerik.feed import axis_settings

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Frame
    from polycnc.language.sinumerik.words import WordShape


NO_TOLERANCE = -1.0


@dataclass(slots=True)
class Smoothing(State, lifetime=Lifetime.POWER):
    """How far smoothing may leave the programmed path. What CTOL, OTOL and ATOL say ends with a program or a reset.

    Attributes:
        distance_mm: ADIS and ADISPOS by address.
        tolerance: CTOL, mm, and OTOL, degrees, as programmed; `NO_TOLERANCE` for none.
        of_axes: ATOL by column, mm or degrees.
    """

    distance_mm: dict[str, float] = field(default_factory=dict)
    tolerance: dict[str, float] = lasting(Lifetime.PROGRAM, factory=dict)
    of_axes: dict[int, float] = lasting(Lifetime.PROGRAM, factory=dict)


def tolerance(draft: Draft, position: int, shape: WordShape) -> Step:
    """CTOL, OTOL, ATOL[axis]: tolerance of smoothing; a negative value takes it back."""
    column = None if shape.index is None else axis_column(draft, position, shape)
    is_angle = shape.address == "OTOL" or (column is not None and draft.memory.axes[column].rotary)
    factor = 1.0 if is_angle else length_factor(draft.mode)
    if (shape.address == "ATOL") != (column is not None):
        raise WordAlarm("12400", position, text=shape.address)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factor
        smoothing, given = Smoothing.of(channel), value if value >= 0.0 else NO_TOLERANCE
        if column is None:
            smoothing.tolerance[shape.address] = given
        else:
            smoothing.of_axes[column] = given
        channel.context_changed()

    return run


def contour_tolerance(channel: SinumerikChannel) -> float:
    """CTOL as the axes see it, mm: a frame that scales positions scales it too. 0 where none is programmed."""
    programmed = max(Smoothing.of(channel).tolerance.get("CTOL", NO_TOLERANCE), 0.0)
    return programmed * _scale(seat.frame_in_front(channel)) if programmed else 0.0


def _scale(frame: Frame) -> float:
    """By how much a frame makes lengths longer: the mean of its three scales."""
    return float(prod(hypot(*(row[i] for row in frame.m)) for i in range(3)) ** (1.0 / 3.0))


def _scale_of(channel: SinumerikChannel, column: int) -> float:
    """The scale of one axis."""
    geometry = channel.coordinates.geometry
    if column not in geometry:
        return 1.0
    place = geometry.index(column)
    return hypot(*(row[place] for row in seat.frame_in_front(channel).m))


# ---- reading


def _in_program_units(channel: SinumerikChannel, value: float, *, is_length: bool) -> float:
    """A tolerance as the program counts it: in inches under G700."""
    in_inches = is_length and channel.mode["unit"] == "G700" and value != NO_TOLERANCE
    return value / INCH_MM if in_inches else value


def _programmed(address: str) -> Callable[[SinumerikChannel, Arguments], float]:
    def read(channel: SinumerikChannel, _indices: Arguments) -> float:
        value = Smoothing.of(channel).tolerance.get(address, NO_TOLERANCE)
        return _in_program_units(channel, value, is_length=address == "CTOL")

    return read


def _programmed_of_axis(channel: SinumerikChannel, indices: Arguments) -> float:
    column = axis_settings.axis_of(channel, "$PA_ATOL", indices)
    value = Smoothing.of(channel).of_axes.get(column, NO_TOLERANCE)
    return _in_program_units(channel, value, is_length=not channel.memory.axes[column].rotary)


def _orientation_axes(channel: SinumerikChannel) -> tuple[int, ...]:
    """Columns of the axes that turn the tool; none without an orientation transformation."""
    made = seat.centre_point(channel)
    if made is None:
        return ()
    joints = (*made.kinematics.tool, *made.kinematics.work)
    return tuple(made.axes.index(joint.axis) for joint in joints)


def axis_tolerance(channel: SinumerikChannel, column: int) -> float:
    """CTOL and OTOL come before ATOL, and that before the machine data."""
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    contour, turning = contour_tolerance(channel), _orientation_axes(channel)
    angle = Smoothing.of(channel).tolerance.get("OTOL", NO_TOLERANCE)
    if contour and column in geometry:
        return float(contour / len(geometry) ** 0.5)
    if angle >= 0.0 and column in turning:
        return float(angle / len(turning) ** 0.5)
    own = Smoothing.of(channel).of_axes.get(column, NO_TOLERANCE)
    if own >= 0.0:
        return own * _scale_of(channel, column)
    return channel.memory.data.number("$MA_COMPRESS_POS_TOL", channel.axes[column])


def _active_of_axis(channel: SinumerikChannel, indices: Arguments) -> float:
    column = axis_settings.axis_of(channel, "$AA_ATOL", indices)
    value = axis_tolerance(channel, column)
    return _in_program_units(channel, value, is_length=not channel.memory.axes[column].rotary)


def _active_contour(channel: SinumerikChannel, _indices: Arguments) -> float:
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    value = contour_tolerance(channel) or hypot(*(axis_tolerance(channel, i) for i in geometry))
    return _in_program_units(channel, value, is_length=True)


def _active_orientation(channel: SinumerikChannel, _indices: Arguments) -> float:
    """OTOL; without one what the orientation axes may be off together, -1 without such axes."""
    programmed = Smoothing.of(channel).tolerance.get("OTOL", NO_TOLERANCE)
    if programmed >= 0.0:
        return programmed
    turning = _orientation_axes(channel)
    return hypot(*(axis_tolerance(channel, column) for column in turning)) if turning else NO_TOLERANCE


TOLERANCE_VARIABLES: dict[str, RowWithStop] = {
    "$P_CTOL": (Type.REAL, _programmed("CTOL"), None, False),
    "$P_OTOL": (Type.REAL, _programmed("OTOL"), None, False),
    "$PA_ATOL": (Type.REAL, _programmed_of_axis, None, False),
    "$AC_CTOL": (Type.REAL, _active_contour, None, True),
    "$AC_OTOL": (Type.REAL, _active_orientation, None, True),
    "$AA_ATOL": (Type.REAL, _active_of_axis, None, True),
}
