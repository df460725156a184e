"""What planning finds: the cycle time of a toolpath, by row, by tool and in total."""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field, fields
from polycnc.deferred.typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from array import array
    from collections.abc import Mapping


@dataclass(slots=True)
class Times:
    """Seconds by what the machine does in them, and the way that its axes go (mm, as the feed counts it)."""

    cutting_s: float = 0.0
    rapid_s: float = 0.0
    dwell_s: float = 0.0
    tool_change_s: float = 0.0
    spindle_s: float = 0.0
    auxiliary_s: float = 0.0
    cutting_mm: float = 0.0
    rapid_mm: float = 0.0

    @property
    def total_s(self) -> float:
        """All of it."""
        return sum(self.seconds().values())

    def seconds(self) -> dict[str, float]:
        """The parts of the total by the name of their field."""
        return {name: getattr(self, name) for name in SHARES}

    def shares(self) -> dict[str, float]:
        """Each part of the total, 0 to 1, by the name of its field; empty where nothing took time."""
        total = self.total_s
        return {name: seconds / total for name, seconds in self.seconds().items()} if total > 0.0 else {}

    def __iadd__(self, other: Times) -> Self:
        for item in fields(self):
            setattr(self, item.name, getattr(self, item.name) + getattr(other, item.name))
        return self


#: The fields of `Times` that add up to the total.
SHARES = tuple(item.name for item in fields(Times) if item.name.endswith("_s"))


@dataclass(slots=True)
class ToolTimes:
    """What one tool took, its change included. Tool 0 without a name is the time before the first tool."""

    tool: int
    name: str
    times: Times = field(default_factory=Times)


@dataclass(frozen=True, slots=True)
class Plan:
    """The result of planning.

    Attributes:
        times: All of the toolpath.
        tools: By tool, in the order of first use.
        row_s: Seconds of each row of the toolpath, waits before it included; empty where rows were not kept.
        row_mm: The way of each row, mm as the feed counts it (degrees where rotary axes move alone).
        row_waits: Seconds of `row_s` in which the axes stand before what the row itself does, by its number; rows that
            do not wait are left out.
        rows_without_feed: Cutting rows that had no feed. They are planned as fast as the axes can go.
        rows_without_spindle: Cutting rows with a feed per revolution, threads and taps whose spindle stands: a machine
            would wait without end. They are planned as fast as the axes can go.
    """

    times: Times
    tools: tuple[ToolTimes, ...]
    row_s: array[float]
    row_mm: array[float]
    row_waits: Mapping[int, float]
    rows_without_feed: int
    rows_without_spindle: int = 0

    @property
    def total_s(self) -> float:
        """Cycle time in seconds."""
        return self.times.total_s
