"""What the caller of a run got wrong."""

from __future__ import annotations

from polycnc.messages import UserError


class SessionError(UserError):
    """A run cannot even begin: the caller asked for something that does not exist or cannot be decided."""
