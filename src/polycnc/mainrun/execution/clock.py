"""Simulated time, which all channels of a control share."""

from __future__ import annotations

from math import floor, inf

from polycnc.deferred.typing import Protocol


class Watch(Protocol):
    """What has to look in every interpolation cycle: a condition that only the axes can fulfil."""

    def look(self, time: float) -> None:
        """An interpolation cycle has come, and the axes are where they are in it."""


class Clock:
    """The time since power-on.

    It goes from event to event, however far apart they are: between two of them nothing can happen. Interpolation
    cycles are visited only while somebody has to look in each of them, and has been armed for that. Commands find the
    clock at a whole number of cycles.

    Args:
        cycle_s: Interpolation cycle.

    Attributes:
        time: Now, s.
        cycles: Interpolation cycles that commands have let pass.
        visits: Interpolation cycles that have been visited because somebody was armed.
    """

    __slots__ = ("_watches", "cycle_s", "cycles", "time", "visits")

    def __init__(self, cycle_s: float) -> None:
        self.cycle_s = cycle_s
        self.time = 0.0
        self.cycles = 0
        self.visits = 0
        self._watches: list[Watch] = []

    def soon(self, due: float) -> float:
        """When to ask again: a cycle later, or when something is due before."""
        later = self.time + self.cycle_s
        return due if self.time < due < later else later

    def arm(self, watch: Watch) -> None:
        """From the next interpolation cycle on, somebody looks in each."""
        self._watches.append(watch)

    def disarm(self, watch: Watch) -> None:
        """He looks no more."""
        self._watches.remove(watch)

    @property
    def next_visit(self) -> float:
        """When the next interpolation cycle is visited; inf while nobody is armed."""
        return (floor(self.time / self.cycle_s + 1e-9) + 1) * self.cycle_s if self._watches else inf

    def look(self, since: float) -> None:
        """Let look who is armed, if an interpolation cycle has come since."""
        if not self._watches or floor(self.time / self.cycle_s + 1e-9) <= floor(since / self.cycle_s + 1e-9):
            return
        self.visits += 1
        for watch in tuple(self._watches):
            watch.look(self.time)
