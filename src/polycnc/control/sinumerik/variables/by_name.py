"""Variables by the names that programs use (`R1`, `FIELD[2,0]`, `$P_GG[6]`), for reports, cases and setups.

A name is read as an expression of the main program, so it means what it means there.
"""

from __future__ import annotations

from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.code import quoted
from polycnc.language.sinumerik.blocks import BlockCompiler
from polycnc.language.sinumerik.lexer import tokenize
from polycnc.language.sinumerik.names.values import Axis, Type, round_half_up
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.executable import SinumerikProgram

#: How a value from outside becomes one of a type.
_CONVERSIONS: dict[Type, Callable[[Any], Any]] = {
    Type.INT: lambda value: round_half_up(float(value)),
    Type.CHAR: lambda value: round_half_up(float(value)),
    Type.REAL: float,
    Type.BOOL: bool,
    Type.STRING: str,
    Type.AXIS: lambda value: Axis(str(value).upper()),
}


def read(channel: SinumerikChannel, name: str) -> Any:
    """The value of a variable: number, text, BOOL as 1 or 0, AXIS as its name.

    Raises:
        KeyError: There is no such variable.
    """
    with _main_program(channel) as program:
        try:
            compiler = _compiler(channel, program, name)
            result: list[Any] = []
            value = compiler.expression()
            if compiler.token.kind != "end":
                raise KeyError(name)
            compiler.emitter.run(quoted("{0}.append({1})", compiler.emitter.object(result), value.code))
            compiler.emitter.uses_clock = False  # who asks from outside starts none
            compiler.emitter.step()(channel)
        except (AlarmError, TypeError, IndexError) as error:  # without value: its DEF was never reached
            raise KeyError(name) from error
    found = result[0]
    return found.name if isinstance(found, Axis) else int(found) if isinstance(found, bool) else found


def write(channel: SinumerikChannel, name: str, value: object) -> None:
    """Set a variable from outside.

    Raises:
        AlarmError: 12550 if there is no such variable, 12150 for a value of another kind, or what the variable itself
            refuses.
    """
    with _main_program(channel) as program:
        compiler = _compiler(channel, program, name)
        place = compiler.scope.place(compiler, compiler.take())
        convert = _CONVERSIONS.get(place.type)
        if convert is None:
            raise AlarmError("12150", text=name)
        try:
            converted = convert(value)
        except (TypeError, ValueError) as error:
            raise AlarmError("12150", text=name) from error
        place.write(compiler, compiler.emitter.object(converted))
        compiler.emitter.uses_clock = False
        compiler.emitter.step()(channel)


def _compiler(channel: SinumerikChannel, program: SinumerikProgram, name: str) -> BlockCompiler:
    return BlockCompiler(tokenize(name, 0), program, 0, channel)


@contextmanager
def _main_program(channel: SinumerikChannel) -> Iterator[SinumerikProgram]:
    """While it lasts, names and local variables are those of the main program."""
    running = channel.level
    channel.level = channel.stack[0]
    try:
        yield channel.level.code.whole
    finally:
        channel.level = running
