"""What polycnc answers when it cannot do what it was asked for, and where a mistake of its own has come up."""

from __future__ import annotations

from polycnc.messages.catalogue import Catalogue, messages


class UserError(Exception):
    """What the user asked for does not exist or cannot be done; `str()` says why, in the active language.

    A folder that keeps its texts in a catalogue of its own overrides `catalogue`.

    Args:
        message: Id of the text in the catalogue.
        args: Values for its placeholders.
    """

    def __init__(self, message: str, **args: object) -> None:
        super().__init__(message)
        self.message = message
        self.args_by_name = args

    def catalogue(self) -> Catalogue:
        """Where the text stands: among polycnc's own, unless a subclass says otherwise."""
        return messages()

    def text(self, lang: str | None = None) -> str:
        """Why not, for the user."""
        return self.catalogue().text(self.message, lang, **self.args_by_name)

    def __str__(self) -> str:
        return self.text()


def place_of_failure(error: BaseException) -> str:
    """The line of polycnc, or of a library, at which a mistake came up: `channel/run.py:41`; empty if unknown."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if trace is None:
        return ""
    return f"{trace.tb_frame.f_code.co_filename.rpartition('polycnc/')[2]}:{trace.tb_lineno}"
