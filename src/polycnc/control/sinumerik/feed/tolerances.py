"""Tolerances of smoothing: CTOL, OTOL, ATOL, and the variables that tell them (job planning 8.8)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import hypot
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.feed.axis_settings import axis_of
from polycnc.control.sinumerik.variables.row import RowWithStop
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape


NO_TOLERANCE = -1.0


@dataclass(slots=True)
class Smoothing(State, lifetime=Lifetime.POWER):
    """How far smoothing may leave the programmed path.

    Attributes:
        distance_mm: ADIS and ADISPOS by address.
        tolerance: CTOL and OTOL by address; `NO_TOLERANCE` for none.
        of_axes: ATOL by column.
    """

    distance_mm: dict[str, float] = field(default_factory=dict)
    tolerance: dict[str, float] = field(default_factory=dict)
    of_axes: dict[int, float] = field(default_factory=dict)


def tolerance(draft: Draft, position: int, shape: WordShape) -> Step:
    """CTOL, OTOL, ATOL[axis]: tolerance of smoothing; a negative value takes it back."""
    column = None if shape.index is None else axis_column(draft, position, shape)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        smoothing, given = Smoothing.of(channel), value if value >= 0.0 else NO_TOLERANCE
        if column is None:
            smoothing.tolerance[shape.address] = given
        else:
            smoothing.of_axes[column] = given
        channel.context_changed()

    return run


def contour_tolerance(channel: SinumerikChannel) -> float:
    """CTOL, mm; 0 where none is programmed."""
    return max(Smoothing.of(channel).tolerance.get("CTOL", NO_TOLERANCE), 0.0)


def _programmed(address: str) -> Callable[[SinumerikChannel, Arguments], float]:
    return lambda channel, _indices: Smoothing.of(channel).tolerance.get(address, NO_TOLERANCE)


def _programmed_of_axis(channel: SinumerikChannel, indices: Arguments) -> float:
    return Smoothing.of(channel).of_axes.get(axis_of(channel, "$PA_ATOL", indices), NO_TOLERANCE)


def _axis_tolerance(channel: SinumerikChannel, column: int) -> float:
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    contour = contour_tolerance(channel)
    if contour and column in geometry:
        return float(contour / len(geometry) ** 0.5)
    own = Smoothing.of(channel).of_axes.get(column, NO_TOLERANCE)
    return own if own >= 0.0 else channel.memory.data.number("$MA_COMPRESS_POS_TOL", channel.axes[column])


def _active_of_axis(channel: SinumerikChannel, indices: Arguments) -> float:
    return _axis_tolerance(channel, axis_of(channel, "$AA_ATOL", indices))


def _active_contour(channel: SinumerikChannel, _indices: Arguments) -> float:
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    return contour_tolerance(channel) or hypot(*(_axis_tolerance(channel, i) for i in geometry))


TOLERANCE_VARIABLES: dict[str, RowWithStop] = {
    "$P_CTOL": (Type.REAL, _programmed("CTOL"), None, False),
    "$P_OTOL": (Type.REAL, _programmed("OTOL"), None, False),
    "$PA_ATOL": (Type.REAL, _programmed_of_axis, None, False),
    "$AC_CTOL": (Type.REAL, _active_contour, None, True),
    "$AA_ATOL": (Type.REAL, _active_of_axis, None, True),
}
