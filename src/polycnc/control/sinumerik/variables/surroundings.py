"""System variables of what surrounds the programs: version, modal call, tables of compensation.

Tables of sag and encoder compensation lie below the setpoint: they are kept, the path is the programmed one.

Source: job planning 1.1.2 (prefixes), the list manual of system variables by name.
"""

from __future__ import annotations

from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, Row, RowWithStop, Writer

#: Of the software that the manuals describe (4.5); `$AN_NCK_VERSION` among the parameters of the setup overrides it.
_NCK_VERSION = 92.0


def _version(channel: SinumerikChannel, _indices: Indices) -> float:
    data = channel.memory.data
    name = "$AN_NCK_VERSION"
    return data.number(name) if data.is_set(name) else _NCK_VERSION


def _modal_call(channel: SinumerikChannel, _indices: Indices) -> bool:
    return channel.memory.language.modal_call is not None


def _kept(name: str, type_: Type, *kinds: type) -> Row:
    """A table that only keeps what is written; `kinds` are those of its indices."""
    empty: Any = {Type.AXIS: Axis(""), Type.BOOL: False, Type.INT: 0}.get(type_, 0.0)

    def place(channel: SinumerikChannel, indices: Indices) -> tuple[Any, ...]:
        if len(indices) != len(kinds) or any(map(_is_other, indices, kinds)):
            raise AlarmError("12400", text=name)
        if any(not isinstance(index, Axis) and index < 0 for index in indices):
            raise AlarmError("17020", text=name, index=min(i for i in indices if not isinstance(i, Axis)))
        # X, X1 and AX1 are the same axis.
        return tuple(
            channel.axes[channel.memory.column(index.name)] if isinstance(index, Axis) else index
            for index in indices
        )

    def read(channel: SinumerikChannel, indices: Indices) -> Any:
        return Stored.of(channel).nck.get((name, place(channel, indices)), empty)

    def write(channel: SinumerikChannel, indices: Indices, value: Any) -> None:
        Stored.of(channel).nck[name, place(channel, indices)] = value

    return type_, read, write


def _is_other(index: object, kind: type) -> bool:
    return not isinstance(index, kind)


#: Encoder and spindle pitch errors: `[encoder, point, axis]`, `[encoder, axis]`.
_ENCODER_ERRORS: dict[str, Row] = {
    "$AA_ENC_COMP": _kept("$AA_ENC_COMP", Type.REAL, int, int, Axis),
    **{
        name: _kept(name, type_, int, Axis)
        for name, type_ in (
            ("$AA_ENC_COMP_STEP", Type.REAL),
            ("$AA_ENC_COMP_MIN", Type.REAL),
            ("$AA_ENC_COMP_MAX", Type.REAL),
            ("$AA_ENC_COMP_IS_MODULO", Type.BOOL),
        )
    },
}
#: Quadrant errors: `[0, point, axis]`, `[0, axis]`.
_QUADRANT_ERRORS: dict[str, Row] = {
    "$AA_QEC": _kept("$AA_QEC", Type.REAL, int, int, Axis),
    **{
        name: _kept(name, type_, int, Axis)
        for name, type_ in (
            ("$AA_QEC_COARSE_STEPS", Type.INT),
            ("$AA_QEC_FINE_STEPS", Type.INT),
            ("$AA_QEC_ACCEL_1", Type.REAL),
            ("$AA_QEC_ACCEL_2", Type.REAL),
            ("$AA_QEC_ACCEL_3", Type.REAL),
            ("$AA_QEC_MEAS_TIME_1", Type.REAL),
            ("$AA_QEC_MEAS_TIME_2", Type.REAL),
            ("$AA_QEC_MEAS_TIME_3", Type.REAL),
            ("$AA_QEC_TIME_1", Type.REAL),
            ("$AA_QEC_LEARNING_RATE", Type.REAL),
            ("$AA_QEC_DIRECTIONAL", Type.BOOL),
        )
    },
}
#: Sag: `[table, point]`, `[table]`.
_SAG: dict[str, Row] = {
    "$AN_CEC": _kept("$AN_CEC", Type.REAL, int, int),
    **{
        name: _kept(name, type_, int)
        for name, type_ in (
            ("$AN_CEC_INPUT_AXIS", Type.AXIS),
            ("$AN_CEC_OUTPUT_AXIS", Type.AXIS),
            ("$AN_CEC_STEP", Type.REAL),
            ("$AN_CEC_MIN", Type.REAL),
            ("$AN_CEC_MAX", Type.REAL),
            ("$AN_CEC_DIRECTION", Type.INT),
            ("$AN_CEC_MULT_BY_TABLE", Type.INT),
            ("$AN_CEC_IS_MODULO", Type.BOOL),
            ("$AN_CEC_TYPE", Type.INT),
            ("$AN_CEC_INPUT_NCU", Type.INT),
            ("$AN_CEC_OUTPUT_NCU", Type.INT),
        )
    },
}
_TABLES: dict[str, Row] = {**_ENCODER_ERRORS, **_QUADRANT_ERRORS, **_SAG}
_NOT_WRITTEN: Writer | None = None
#: What the cycles of interpolation and control cost, ms or per cent (10.4.30). The clock of the main run is simulated:
#: computing takes none of its time, and nothing is ever overloaded.
_LOADS = (
    *(f"$AN_IPO_{of}" for of in ("ACT_LOAD", "MAX_LOAD", "MIN_LOAD", "LOAD_PERCENT")),
    *(f"$AN_SERVO_{of}_LOAD" for of in ("ACT", "MAX", "MIN")),
    *("$AN_SYNC_ACT_LOAD", "$AN_SYNC_MAX_LOAD", "$AN_SYNC_TO_IPO"),
    *(f"$AC_SYNC_{of}_LOAD" for of in ("ACT", "MAX", "AVERAGE")),
)
_NO_TIME: Reader = lambda _channel, _indices: 0.0  # noqa: E731 - a row of the table
_NO_OVERLOAD: Reader = lambda _channel, _indices: False  # noqa: E731
SURROUNDINGS: dict[str, RowWithStop] = {
    "$AN_NCK_VERSION": (Type.REAL, _version, _NOT_WRITTEN, False),
    "$P_MC": (Type.BOOL, _modal_call, _NOT_WRITTEN, False),
    **{name: (*row, False) for name, row in _TABLES.items()},
    **dict.fromkeys(_LOADS, (Type.REAL, _NO_TIME, _NOT_WRITTEN, True)),
    "$AN_IPO_LOAD_LIMIT": (Type.BOOL, _NO_OVERLOAD, _NOT_WRITTEN, True),
}
