"""System variables about the programs that are running: the language keeps what they tell (1.25)."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.language.sinumerik.interface import NcChannel, NcExecutable


class LevelVariable(NamedTuple):
    """A variable that can only be read; satisfies `SystemVariable`."""

    name: str
    type: Type
    value: Callable[[Channel, tuple[Any, ...]], Any]
    stop: bool = False
    goes_along: bool = False
    timed: bool = False
    of_actions: bool = False
    unit: None = None
    first: int = 0

    def element_count(self, _channel: Channel) -> None:
        """It is no array that could be filled."""

    def read(self, channel: Channel, indices: tuple[Any, ...]) -> Any:
        """The value."""
        return self.value(channel, indices)

    def write(self, _channel: Channel, _indices: tuple[Any, ...], _value: Any) -> None:
        """Alarm 17070: it is read-only."""
        raise AlarmError("17070", text=self.name)


def _depth(channel: Channel, _: tuple[Any, ...]) -> int:
    return len(channel.stack) - 1


def _given(channel: Channel, indices: tuple[Any, ...]) -> bool:
    """Whether a parameter of the call was written; they count from 1."""
    given = channel.level.data.get("given", ())
    if len(indices) != 1 or not isinstance(indices[0], int) or not 1 <= indices[0] <= len(given):
        raise AlarmError("17020", text="$P_SUBPAR", index=", ".join(map(str, indices)))
    return bool(given[indices[0] - 1])


def _level(channel: NcChannel, indices: tuple[Any, ...]) -> Level[NcExecutable]:
    number = indices[0] if indices else len(channel.stack) - 1
    if not 0 <= number < len(channel.stack):
        raise AlarmError("17020", text="$P_PROG", index=number)
    return channel.stack[number]


def _program(channel: Channel, indices: tuple[Any, ...]) -> str:
    return _level(channel, indices).code.program.name


def _directory(channel: Channel, indices: tuple[Any, ...]) -> str:
    return _level(channel, indices).code.program.directory


def _path(channel: NcChannel, _: tuple[Any, ...]) -> str:
    return channel.level.code.program.directory + "/"


LEVEL_VARIABLES = {
    variable.name: variable
    for variable in (
        LevelVariable("$P_STACK", Type.INT, _depth),
        LevelVariable("$P_SUBPAR", Type.BOOL, _given),
        LevelVariable("$P_PROG", Type.STRING, _program),
        LevelVariable("$P_PATH", Type.STRING, _directory),
        LevelVariable("$P_PROGPATH", Type.STRING, _path),
    )
}
