"""The signal image: inputs and outputs by name, with the time of their last edge."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


class SignalImage:
    """Signals between control and machine.

    Args:
        start: Signals and their values at power-on.
        on_edge: Called with name and value when a signal changes.
        clock: Gives the simulated time.
    """

    def __init__(
        self,
        start: Mapping[str, float],
        on_edge: Callable[[str, float], None],
        clock: Callable[[], float],
    ) -> None:
        self._values: dict[str, float] = dict(start)
        self._edges: dict[str, float] = {}
        self._on_edge = on_edge
        self._clock = clock

    @property
    def values(self) -> Mapping[str, float]:
        """A copy of all signals."""
        return dict(self._values)

    def __getitem__(self, name: str) -> float:
        return self._values.get(name, 0.0)

    def __setitem__(self, name: str, value: float) -> None:
        if self._values.get(name, 0.0) != value:
            self._values[name] = value
            self._edges[name] = self._clock()
            self._on_edge(name, value)
        else:
            self._values[name] = value

    def since(self, name: str) -> float:
        """When a signal last changed; 0 where it never has."""
        return self._edges.get(name, 0.0)

    @property
    def due(self) -> float:
        """When a rule acts next."""
        return inf

    def advance(self, time: float) -> None:
        """Let rules act that are due."""

    def begin(self, code: int) -> bool:
        """An M function goes out; whether a rule of the machine says when it is done."""
        self[f"M{code}"] = 1.0
        return False

    def is_finished(self, code: int) -> bool:
        """Whether the machine has said that a function is done."""
        return False

    def finish(self, code: int) -> None:
        """A function is done."""
        self[f"M{code}"] = 0.0

    def reset(self) -> None:
        """Functions under way are given up."""
        for name in [name for name in self._values if name[:1] == "M" and name[1:].isdigit()]:
            self[name] = 0.0
