"""Alarms of the NC language, by what is wrong. The texts are in the control's catalogue; they name `text`."""

from __future__ import annotations

from polycnc.messages import AlarmError


class NcSyntaxError(AlarmError):
    """A block that cannot be compiled.

    Args:
        code: Alarm code.
        column: Column from 1.
        text: What the alarm text quotes.
    """

    def __init__(self, code: str, column: int, text: str = "", *, hint: str = "") -> None:
        super().__init__(code, column=column, hint=hint, text=text, code=text)


def syntax(column: int, text: str) -> NcSyntaxError:
    """12080: the text cannot stand here."""
    return NcSyntaxError("12080", column, text)


def unknown(column: int, name: str) -> NcSyntaxError:
    """12550: no such name."""
    return NcSyntaxError("12550", column, name)


def not_supported(column: int, name: str) -> NcSyntaxError:
    """PC0001: a word of the control that polycnc does not execute yet."""
    return NcSyntaxError("PC0001", column, name, hint="hint.not-supported")


def arithmetic(text: str = "") -> AlarmError:
    """14051: division by zero, a root of a negative number and the like."""
    return AlarmError("14051", text=text)
