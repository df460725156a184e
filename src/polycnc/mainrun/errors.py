"""What a virtual control answers when it does not do what it was asked for."""

from __future__ import annotations

from enum import StrEnum

from polycnc.deferred.typing import TYPE_CHECKING, TypeVar
from polycnc.messages import UserError, text
from polycnc.messages.catalogue import language, listed

if TYPE_CHECKING:
    from polycnc.mainrun.commands.states import Command, Mode, State
    from polycnc.messages import Alarm, Catalogue

_Name = TypeVar("_Name", bound=StrEnum)


class CommandRefused(UserError):  # noqa: N818 - a refusal is an answer, not an error of the control
    """A command is not possible now, or what it names does not exist. Nothing has happened."""


class OutOfPlace(CommandRefused):
    """The control does not take a command in this mode and state.

    Args:
        command: What was asked for.
        mode: What the mode switch says.
        state: What the control is doing.
    """

    def __init__(self, command: Command, mode: Mode, state: State) -> None:
        super().__init__("mainrun.refused", command=command, mode=mode, state=state)
        self._command, self._mode, self._state = command, mode, state

    def text(self, lang: str | None = None) -> str:
        """The refusal with the names that an operator has for the three."""
        command, mode = text(f"command.{self._command}", lang), text(f"mode.{self._mode}", lang)
        return text(self.message, lang, command=command, mode=mode, state=text(f"state.{self._state}", lang))


class SearchStopped(CommandRefused):
    """A block search comes to an alarm in front of its block.

    Args:
        target: The block as it was named.
        alarm: The alarm, with its texts.
    """

    def __init__(self, target: object, alarm: Alarm) -> None:
        super().__init__("mainrun.search-alarm", target=target, line=alarm.line, code=alarm.code)
        self._alarm = alarm

    def text(self, lang: str | None = None) -> str:
        """The refusal with the alarm's own text."""
        return text(
            self.message, lang, **self.args_by_name, text=self._alarm.text_in(lang or language())
        ).rstrip()


class MachineRefused(CommandRefused):
    """The machine's controller refuses a command; it says so with an alarm or a message of its list.

    Args:
        alarms: The texts of alarms and messages.
        code: The alarm or message.
    """

    def __init__(self, alarms: Catalogue, code: str) -> None:
        super().__init__("mainrun.machine", code=code)
        self._alarms, self._code = alarms, code

    def text(self, lang: str | None = None) -> str:
        """The refusal with the machine's own text."""
        return text(self.message, lang, code=self._code, text=self._alarms.text(self._code, lang))


def one_of(kind: type[_Name], name: str, value: object) -> _Name:
    """The member of an enumeration that a value means; `name` is what the value is for.

    Raises:
        CommandRefused: It means none.
    """
    try:
        return kind(str(value).lower())
    except ValueError:
        raise CommandRefused("mainrun.value", name=name, allowed=listed(kind), value=value) from None
