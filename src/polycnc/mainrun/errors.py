"""What a virtual control answers when it does not do what it was asked for."""

from __future__ import annotations

from polycnc.messages import text


class CommandRefused(Exception):  # noqa: N818 - a refusal is an answer, not an error of the control
    """A command is not possible now, or what it names does not exist. Nothing has happened.

    Args:
        message: Id of the text.
        args: Values for its placeholders.
    """

    def __init__(self, message: str, **args: object) -> None:
        super().__init__(message)
        self.message = message
        self.args_by_name = args

    def text(self, lang: str | None = None) -> str:
        """Why, for the operator."""
        return text(self.message, lang, **self.args_by_name)

    def __str__(self) -> str:
        return self.text()
