"""How long single moves take: for what comes by the clock in a run without one."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


class MoveTimes(Protocol):
    """What a channel asks of the planner; each move counts as one from rest to rest."""

    def share_after(self, channel: Channel, end: list[float], feed: float, seconds: float) -> float | None:
        """The share of a skip move to an end, at a feed, that is done after some seconds; None for all of it."""
        ...

    def later_on_row(
        self, channel: Channel, mark: int, start: list[float], share: float, seconds: float
    ) -> tuple[float | None, float]:
        """The share of a row that is done some seconds after another one, else what is left of them at its end."""
        ...
