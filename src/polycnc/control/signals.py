"""Signals between program and machine, as programs read them where nobody executes their rows in time."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel


class AskedSignals(dict[str, int]):
    """Signals by name. Who reads one waits until everything before is executed, so the axes rest there.

    Args:
        start: Their values.
        channel: The channel whose programs read them.
    """

    def __init__(self, start: Mapping[str, object], channel: Channel) -> None:
        super().__init__({name: int(bool(value)) for name, value in start.items()})
        self._channel = channel

    def get(self, name: str, default: Any = 0) -> Any:
        """The value of a signal."""
        self._channel.synchronise()
        return super().get(name, default)
