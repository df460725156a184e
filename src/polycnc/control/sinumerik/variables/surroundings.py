"""System variables of what surrounds the programs: version, modal call, tables of compensation.

Tables of sag and encoder compensation lie below the setpoint: they are kept, the path is the programmed one.

Source: job planning 1.1.2 (prefixes), the list manual of system variables by name.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row, RowWithStop, Writer

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
        for index in indices:
            if isinstance(index, Axis):
                channel.memory.column(index.name)
            elif index < 0:
                raise AlarmError("17020", text=name, index=index)
        return tuple(indices)

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
_TABLES: dict[str, Row] = {**_ENCODER_ERRORS, **_SAG}
_NOT_WRITTEN: Writer | None = None
SURROUNDINGS: dict[str, RowWithStop] = {
    "$AN_NCK_VERSION": (Type.REAL, _version, _NOT_WRITTEN, False),
    "$P_MC": (Type.BOOL, _modal_call, _NOT_WRITTEN, False),
    **{name: (*row, False) for name, row in _TABLES.items()},
}
