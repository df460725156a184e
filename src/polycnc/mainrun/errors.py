"""What a virtual control answers when it does not do what it was asked for."""

from __future__ import annotations

from polycnc.messages import UserError


class CommandRefused(UserError):  # noqa: N818 - a refusal is an answer, not an error of the control
    """A command is not possible now, or what it names does not exist. Nothing has happened."""
