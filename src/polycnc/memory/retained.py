"""Retained memory as named tables.

A table is a plain dict, so that a loop that reads a variable loses nothing. Whoever owns a store says when what stands
in its tables is to last (`commit`): a store in a file writes down what differs then. A channel fills a table that is
empty when it first asks for it, from its setup.
"""

from __future__ import annotations

from typing import Any, Protocol

#: Names of tables. Keys and values are the control's own; lengths are millimetres, angles degrees.
WORK_OFFSETS = "work offsets"
TOOL_OFFSETS = "tool offsets"
VARIABLES = "variables"
VARIABLE_NAMES = "variable names"
WORK_SHIFT = "work shift"
REGISTERS = "registers"
PARAMETERS = "parameters"


class RetainedStore(Protocol):
    """Where a control keeps what lasts beyond power-off."""

    def table(self, name: str, channel: int = 0) -> dict[Any, Any]:
        """The one table of a name, of a channel or (0) of the whole control; empty before anybody has filled it."""

    def commit(self) -> None:
        """What the tables hold now lasts from here on."""


class InMemoryStore:
    """Retained memory of a run that keeps nothing: it lasts as long as the store."""

    def __init__(self) -> None:
        self._tables: dict[tuple[str, int], dict[Any, Any]] = {}

    def table(self, name: str, channel: int = 0) -> dict[Any, Any]:
        """The one table of a name."""
        return self._tables.setdefault((name, channel), {})

    def commit(self) -> None:
        """Nothing is written anywhere."""
