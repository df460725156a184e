"""Values of system variables that only store (`$AC_PARAM`, `$A_OUT` …), and of words that nothing acts on."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel

Values: TypeAlias = dict[tuple[str, tuple[Any, ...]], Any]


@dataclass(slots=True)
class Stored(State, lifetime=Lifetime.POWER):
    """What is stored, by name and index.

    Attributes:
        values: Of the channel.
        nck: Of all channels.
    """

    values: Values = field(default_factory=dict)
    nck: Values = field(default_factory=dict)

    @classmethod
    def first(cls, channel: Channel) -> Stored:
        """Nothing of its own, and what the channels share."""
        shared = channel.group.shared if channel.group is not None else {}
        return cls(nck=shared.setdefault("system variables", {}))

    def of_name(self, name: str) -> Values:
        """Where the values of a variable lie: all channels have the same `$A_…`."""
        return self.nck if name.startswith("$A_") else self.values
