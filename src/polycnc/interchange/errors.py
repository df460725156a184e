"""A file that does not go into a memory, or a memory that does not go into files."""

from __future__ import annotations

from polycnc.messages import UserError


class InterchangeError(UserError):
    """Something that the user asked for cannot be read or written."""


class ReadingError(InterchangeError):
    """A file that is refused: where, and why.

    Args:
        file: The file, as the user named it.
        line: From 1.
        column: From 1.
        reason: In the active language.
    """

    def __init__(self, file: object, line: int, column: int, reason: str) -> None:
        super().__init__("memory.refused", file=file, line=line, column=max(column, 1), reason=reason)
