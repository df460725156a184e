"""MEASURE: what measured points say of a workpiece, its zero and its size (job planning 16.1; Function Manual FB2, M5).

A program writes what it has measured into `$A…_MEAS_…`, or latches where the axes are; `MEASURE()` works out the frame
that gives the measured place its setpoint, behind all frames that are active. What has been written counts as valid
until `$AC_MEAS_VALID` says otherwise. The manual names the function only: variables, kinds and errors are those of the
Function Manual.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import SHOWS_DIAMETERS, diameter_function, shown
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.signals import workpiece_kinds as kinds
from polycnc.control.sinumerik.signals.workpiece_memory import (
    INPUTS,
    POINTS,
    RESULTS,
    AxisKey,
    Bit,
    Measurement,
    Result,
)
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row, RowWithStop

#: Bits of $AC_MEAS_TOOL_MASK that are taken.
MASKS = kinds.WITHOUT_RADIUS | kinds.WITHOUT_LENGTH | kinds.LENGTH_IN_CONVERSION
#: Factors of a frame that differ from 1 by less are rounding.
_NO_SCALE = 1e-9


# ---- the function


def measure(channel: SinumerikChannel, _args: Arguments) -> int:
    """MEASURE(): work out a measurement; 0 where there is a result.

    PC0001: other kinds of measurement, and what `_refuse` names.
    """
    state = Measurement.of(channel)
    kind = state.number(Bit.TYPE)
    if kind is None:
        return Result.NO_TYPE
    _refuse(channel, state, kind)
    return kinds.Calculation(channel, state).run(kind)


def _refuse(channel: SinumerikChannel, state: Measurement, kind: int) -> None:
    """PC0001: axes that show diameters; a scale, which acts on the points but not on the probe; what is not done."""
    if kind not in kinds.KINDS:
        raise not_supported(f"$AC_MEAS_TYPE={kind}")
    if (state.number(Bit.MASK) or 0) & ~MASKS:
        raise not_supported(f"$AC_MEAS_TOOL_MASK={state.number(Bit.MASK)}")
    if kind == kinds.SLANTED and state.inputs.get(1):
        raise not_supported("$AC_MEAS_INPUT[1]")
    if kind == kinds.TILTED and state.setangles:
        raise not_supported("$AA_MEAS_SETANGLE: $AC_MEAS_TYPE=17")
    systems = [state.number(bit) or 0 for bit in (Bit.FROM, Bit.TO)]
    if kind == kinds.CONVERSION and (
        max(systems) > kinds.MACHINE or channel.coordinates.transformation is not None
    ):
        raise not_supported("$AC_MEAS_P1_COORD $AC_MEAS_P2_COORD")
    if kind != kinds.CONVERSION and any(systems):
        raise not_supported("$AC_MEAS_P1_COORD")
    transverse = channel.memory.transverse
    for column in range(len(channel.axes)):
        if diameter_function(channel.mode, column, transverse) in SHOWS_DIAMETERS:
            raise not_supported("MEASURE DIAMON")
    scales = channel.memory.frames.total().scales
    if any(abs(abs(factor) - 1.0) > _NO_SCALE for factor in scales):
        raise not_supported("MEASURE SCALE")


# ---- variables


def _key(channel: SinumerikChannel, indices: Indices) -> AxisKey:
    """The axis that an index names."""
    column = arguments.column(channel, indices[0] if indices else None)
    geometry = channel.coordinates.geometry
    return geometry.index(column) if column in geometry else channel.axes[column]


def _column(channel: SinumerikChannel, key: AxisKey) -> int:
    return channel.coordinates.geometry[key] if isinstance(key, int) else channel.axes.index(key)


def _written(
    kind: Type,
    bit: int,
    values: Callable[[Measurement], dict[Any, Any]],
    key: Callable[[SinumerikChannel, Indices], Any],
) -> Row:
    """A variable that a program writes and reads back, and that counts as valid from then on.

    Args:
        kind: Of its values.
        bit: Of `$AC_MEAS_VALID`.
        values: Where they are kept.
        key: Under which of these.
    """
    nothing = 0 if kind is Type.INT else 0.0

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        return values(Measurement.of(channel)).get(key(channel, indices), nothing)

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        state = Measurement.of(channel)
        values(state)[key(channel, indices)] = value
        state.valid |= 1 << bit

    return kind, read, write


def _of_axes(bit: int, values: Callable[[Measurement], dict[AxisKey, float]]) -> Row:
    """$AA_MEAS_POINT1 and the like: a length or an angle of each axis."""
    return _written(Type.REAL, bit, values, _key)


def _whole(bit: int) -> Row:
    return _written(Type.INT, bit, lambda state: state.whole, lambda _channel, _indices: bit)


def _angle(bit: int) -> Row:
    return _written(Type.REAL, bit, lambda state: state.angles, lambda _channel, _indices: bit)


def _input(_channel: SinumerikChannel, indices: Indices) -> int:
    return _index(indices, "$AC_MEAS_INPUT", INPUTS)


def _points(state: Measurement, *, number: int) -> dict[AxisKey, float]:
    return state.points[number]


def _index(indices: Indices, name: str, count: int) -> int:
    if len(indices) != 1 or indices[0] not in range(count):
        raise AlarmError("17020", text=name, index=", ".join(map(str, indices)))
    return int(indices[0])


def _found(name: str) -> Row:
    return Type.REAL, lambda channel, _indices: Measurement.of(channel).found.get(name, 0.0), None


def _set_valid(channel: SinumerikChannel, _indices: Indices, value: int) -> None:
    """$AC_MEAS_VALID: what has no bit is forgotten."""
    state = Measurement.of(channel)
    state.valid &= value
    for number, point in enumerate(state.points):
        if not state.valid >> number & 1:
            point.clear()
    for bit, asked in (
        (Bit.SETPOINT, state.setpoint),
        (Bit.SETANGLES, state.setangles),
        (Bit.INPUT, state.inputs),
    ):
        if not state.valid >> bit & 1:
            asked.clear()


def _latch(channel: SinumerikChannel, number: int, axes: Sequence[AxisKey], *, kept: bool) -> None:
    state = Measurement.of(channel)
    point = state.points[number]
    for axis in axes:
        column = _column(channel, axis)
        if kept and column >= 0:
            point[axis] = shown(channel, column, channel.actual.work[column])
        else:
            point.pop(axis, None)
    state.valid = state.valid | 1 << number if point else state.valid & ~(1 << number)


def _set_latch(channel: SinumerikChannel, indices: Indices, value: int) -> None:
    """$AC_MEAS_LATCH[n]: 1 takes where all axes are in the work as point n+1, 0 forgets it."""
    number = _index(indices, "$AC_MEAS_LATCH", POINTS)
    geometry = channel.coordinates.geometry
    others = [name for column, name in enumerate(channel.axes) if column not in geometry]
    _latch(channel, number, [*range(len(GEOMETRY_AXES)), *others], kept=bool(value))


def _set_latch_of_axis(channel: SinumerikChannel, indices: Indices, value: int, *, number: int) -> None:
    """$AA_MEAS_P1_VALID[axis] and the like: the same of one axis."""
    axis = _key(channel, indices)
    _latch(channel, number, (axis,), kept=bool(value))


def _is_latched(channel: SinumerikChannel, indices: Indices, *, number: int) -> int:
    return int(_key(channel, indices) in Measurement.of(channel).points[number])


def _read_latch(channel: SinumerikChannel, indices: Indices) -> int:
    return int(bool(Measurement.of(channel).points[_index(indices, "$AC_MEAS_LATCH", POINTS)]))


def _read_frame(channel: SinumerikChannel, indices: Indices) -> Any:
    """$AC_MEAS_FRAME, or one of its components."""
    frame = Measurement.of(channel).frame
    if not indices:
        return frame
    if len(indices) != 2 or not isinstance(indices[0], Axis) or not isinstance(indices[1], str):
        raise AlarmError("12400", text="$AC_MEAS_FRAME")
    key = _key(channel, indices)
    return frame.component(GEOMETRY_AXES[key] if isinstance(key, int) else key, indices[1])


def _read_result(channel: SinumerikChannel, indices: Indices) -> float:
    return Measurement.of(channel).results[_index(indices, "$AC_MEAS_RESULTS", RESULTS)]


WHOLE = {
    "$AC_MEAS_TYPE": Bit.TYPE,
    "$AC_MEAS_DIR_APPROACH": Bit.DIRECTION,
    "$AC_MEAS_ACT_PLANE": Bit.PLANE,
    "$AC_MEAS_FINE_TRANS": Bit.FINE,
    "$AC_MEAS_FRAME_SELECT": Bit.SELECT,
    "$AC_MEAS_T_NUMBER": Bit.TOOL,
    "$AC_MEAS_D_NUMBER": Bit.EDGE,
    "$AC_MEAS_TOOL_MASK": Bit.MASK,
    "$AC_MEAS_P1_COORD": Bit.FROM,
    "$AC_MEAS_P2_COORD": Bit.TO,
}
WORKPIECE_VARIABLES: dict[str, RowWithStop] = {
    **{
        f"$AA_MEAS_POINT{number + 1}": (*_of_axes(number, partial(_points, number=number)), False)
        for number in range(POINTS)
    },
    **{
        f"$AA_MEAS_P{number + 1}_VALID": (
            Type.INT,
            partial(_is_latched, number=number),
            partial(_set_latch_of_axis, number=number),
            True,
        )
        for number in range(POINTS)
    },
    "$AA_MEAS_SETPOINT": (*_of_axes(Bit.SETPOINT, lambda state: state.setpoint), False),
    **{name: (*_whole(bit), False) for name, bit in WHOLE.items()},
    "$AC_MEAS_VALID": (
        Type.INT,
        lambda channel, _indices: Measurement.of(channel).valid,
        _set_valid,
        False,
    ),
    "$AC_MEAS_LATCH": (Type.INT, _read_latch, _set_latch, True),
    "$AC_MEAS_FRAME": (Type.FRAME, _read_frame, None, False),
    "$AA_MEAS_SETANGLE": (*_of_axes(Bit.SETANGLES, lambda state: state.setangles), False),
    "$AC_MEAS_WP_SETANGLE": (*_angle(Bit.SETANGLE), False),
    "$AC_MEAS_CORNER_SETANGLE": (*_angle(Bit.CORNER_SETANGLE), False),
    "$AC_MEAS_INPUT": (*_written(Type.REAL, Bit.INPUT, lambda state: state.inputs, _input), False),
    **{name: (*_found(name), False) for name in kinds.FOUND},
    "$AC_MEAS_RESULTS": (Type.REAL, _read_result, None, False),
}
FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], Any]] = {"MEASURE": measure}
