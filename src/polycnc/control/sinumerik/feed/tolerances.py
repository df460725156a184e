"""Tolerances of smoothing: CTOL, OTOL, ATOL, and the variables that tell them (job planning 8.8)."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.feed.axis_settings import of_axis
from polycnc.control.sinumerik.variables.row import RowWithStop
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.language.sinumerik.words import WordShape


NO_TOLERANCE = -1.0


def tolerance(draft: Draft, position: int, shape: WordShape) -> Step:
    """CTOL, OTOL, ATOL[axis]: tolerance of smoothing; a negative value takes it back."""
    key = () if shape.index is None else (axis_column(draft, position, shape),)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        channel.memory.values[shape.address, key] = value if value >= 0.0 else NO_TOLERANCE
        channel.context_changed()

    return run


def contour_tolerance(memory: Memory) -> float:
    """CTOL, mm; 0 where none is programmed."""
    return max(float(memory.values.get(("CTOL", ()), NO_TOLERANCE)), 0.0)


def _programmed(address: str) -> Callable[[SinumerikChannel, Arguments], float]:
    return lambda channel, _indices: float(channel.memory.values.get((address, ()), NO_TOLERANCE))


def _programmed_of_axis(channel: SinumerikChannel, indices: Arguments) -> float:
    return float(of_axis("$PA_ATOL", "ATOL", -1)(channel, indices))


def _axis_tolerance(channel: SinumerikChannel, column: int) -> float:
    memory = channel.memory
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    contour = contour_tolerance(memory)
    if contour and column in geometry:
        return float(contour / len(geometry) ** 0.5)
    own = float(memory.values.get(("ATOL", (column,)), NO_TOLERANCE))
    return own if own >= 0.0 else memory.data.number("$MA_COMPRESS_POS_TOL", channel.axes[column])


def _active_of_axis(channel: SinumerikChannel, indices: Arguments) -> float:
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text="$AA_ATOL")
    return _axis_tolerance(channel, channel.memory.column(indices[0].name))


def _active_contour(channel: SinumerikChannel, _indices: Arguments) -> float:
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    return contour_tolerance(channel.memory) or hypot(*(_axis_tolerance(channel, i) for i in geometry))


TOLERANCE_VARIABLES: dict[str, RowWithStop] = {
    "$P_CTOL": (Type.REAL, _programmed("CTOL"), None, False),
    "$P_OTOL": (Type.REAL, _programmed("OTOL"), None, False),
    "$PA_ATOL": (Type.REAL, _programmed_of_axis, None, False),
    "$AC_CTOL": (Type.REAL, _active_contour, None, True),
    "$AA_ATOL": (Type.REAL, _active_of_axis, None, True),
}
