"""User access to variables by name, and definition files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.language.sinumerik.emitter import Emitter
from polycnc.language.sinumerik.expressions import ExpressionReader
from polycnc.language.sinumerik.lexer import tokenize
from polycnc.language.sinumerik.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.places import Place


def _place(channel: Channel, name: str) -> tuple[ExpressionReader, Place]:
    """The place that a name with indices means in the main program; `KeyError` if there is none."""
    code: Any = channel.stack[0].code
    scope = code.scope_of(channel)
    reader = ExpressionReader(tokenize(name), scope, Emitter())
    token = reader.take()
    if not scope.is_place(token):
        raise KeyError(name)
    place: Place = scope.place(reader, token)
    if reader.token.kind != "end":
        raise KeyError(name)
    return reader, place


def _run(reader: ExpressionReader, channel: Channel) -> None:
    """Run the code with the main program's variables, wherever the channel stands."""
    reader.emitter.uses_stop = False
    kept = channel.level
    try:
        channel.level = channel.stack[0]
        reader.emitter.step()(channel)
    finally:
        channel.level = kept


def read_variable(channel: Channel, name: str) -> object:
    """The value of `R1`, `NAME[2]`, `$P_GG[6]` … as a user reads it: BOOL as 1 or 0, AXIS as its name.

    Raises:
        KeyError: There is no such variable, or it has no value now.
    """
    try:
        reader, place = _place(channel, name)
        value = place.read(reader)
        result: list[Any] = []
        reader.emitter.line(f"{reader.emitter.object(result)}.append({value.code})")
        _run(reader, channel)
    except (AlarmError, TypeError, IndexError) as error:
        raise KeyError(name) from error
    return _shown(result[0], value.type)


def _shown(value: Any, type_: Type) -> object:
    if type_ is Type.BOOL:
        return int(value)
    if type_ is Type.CHAR:
        return chr(value)
    return value.name if isinstance(value, Axis) else value


def write_variable(channel: Channel, name: str, value: object) -> None:
    """Set a variable from outside.

    Raises:
        KeyError: There is no such variable.
        AlarmError: It cannot hold the value.
    """
    try:
        reader, place = _place(channel, name)
    except AlarmError as error:
        raise KeyError(name) from error
    place.write(reader, reader.emitter.object(_stored(channel, value, place.type)))
    try:
        _run(reader, channel)
    except (TypeError, IndexError) as error:
        raise KeyError(name) from error


def _stored(channel: Channel, value: Any, type_: Type) -> object:
    """A value of a setup file as a type of the language; alarm 12150 if it is none."""
    try:
        if type_ is Type.REAL:
            return float(value)
        if type_ is Type.INT:
            return int(value)
        if type_ is Type.BOOL:
            return bool(value)
        if type_ is Type.CHAR:
            return ord(value) if isinstance(value, str) else int(value)
        if type_ is Type.AXIS:
            return channel.memory.language.axes[str(value).upper()]
    except (TypeError, ValueError, KeyError) as error:
        raise AlarmError("12150", text=str(value)) from error
    return str(value) if type_ is Type.STRING else value
