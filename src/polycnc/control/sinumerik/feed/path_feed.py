"""How the path feed is meant, and what it follows."""

from __future__ import annotations

from math import nan

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.toolpath.modes import FeedMode


class ToothFeed(NamedTuple):
    """FZ, mm, and the feed per revolution that it gave."""

    per_tooth: float
    per_revolution: float


@dataclass(slots=True)
class PathFeed(State, lifetime=Lifetime.RESET):
    """What goes with F.

    Attributes:
        mode: How F is meant.
        spindle: The one that a feed per revolution follows (FPR); 0 for the master spindle.
        axis: Column of the axis of a gear that it follows instead; -1 for none.
        tooth: What FZ has set; None before the first.
        of_corners: FRCM in internal units, NaN for the path feed.
        of_axes: Feeds of positioning axes (FA), mm/s or degrees/s, by column.
        of_block: The same for the running block alone (FDA).
        overrides: OVRA of positioning axes, 1 for 100 %, by column.
    """

    mode: FeedMode = FeedMode.PER_MINUTE
    spindle: int = 0
    axis: int = -1
    tooth: ToothFeed | None = None
    of_corners: float = lasting(Lifetime.POWER, nan)
    of_axes: dict[int, float] = lasting(Lifetime.POWER, factory=dict)
    of_block: dict[int, float] = lasting(Lifetime.BLOCK, factory=dict)
    overrides: dict[int, float] = field(default_factory=dict)
