"""What a virtual control answers when it does not do what it was asked for."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, TypeVar

from polycnc.messages import UserError, text
from polycnc.messages.catalogue import language, listed

if TYPE_CHECKING:
    from polycnc.messages import Alarm, Catalogue

_Name = TypeVar("_Name", bound=StrEnum)


class CommandRefused(UserError):  # noqa: N818 - a refusal is an answer, not an error of the control
    """A command is not possible now, or what it names does not exist. Nothing has happened."""


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
