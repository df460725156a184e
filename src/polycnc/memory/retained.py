"""Retained memory as named tables.

A table is a plain dict, so that a loop that reads a variable loses nothing. Whoever owns a store says when what stands
in its tables is to last (`commit`): a store in a file writes down what differs then. A channel fills a table that is
empty when it first asks for it, from its setup.
"""

from __future__ import annotations

from os import PathLike

from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol, TypeVar

if TYPE_CHECKING:
    from pathlib import Path

_T = TypeVar("_T")
#: Names of tables. Keys and values are the control's own; lengths are millimetres, angles degrees.
WORK_OFFSETS = "work offsets"
TOOL_OFFSETS = "tool offsets"
VARIABLES = "variables"
VARIABLE_NAMES = "variable names"
WORK_SHIFT = "work shift"
WORK_TURNS = "work turns"
WORKPIECE_ERRORS = "workpiece errors"
TILTED_PLANES = "tilted planes"
MACHINING_CONDITIONS = "machining conditions"
REGISTERS = "registers"
PARAMETERS = "parameters"
TOOLS = "tools"
TOOL_CARRIERS = "tool carriers"
USER_VARIABLES = "user variables"
ALARM_HISTORY = "alarm history"
PROGRAMS = "programs"
COUNTERS = "counters"
MESSAGES = "messages"
PANEL = "panel"
#: The tables that programs read and write.
DATA = (
    WORK_OFFSETS, TOOL_OFFSETS, VARIABLES, VARIABLE_NAMES, WORK_SHIFT, WORK_TURNS, WORKPIECE_ERRORS,
    TILTED_PLANES, MACHINING_CONDITIONS, REGISTERS, PARAMETERS, TOOLS, TOOL_CARRIERS, USER_VARIABLES,
)  # fmt: skip


class RetainedStore(Protocol):
    """Where a control keeps what lasts beyond power-off."""

    def table(self, name: str, channel: int = 0) -> dict[Any, Any]:
        """The one table of a name, of a channel or (0) of the whole control; empty before anybody has filled it."""

    def commit(self) -> None:
        """What the tables hold now lasts from here on."""

    def close(self) -> None:
        """Nobody uses the store any more; what was not committed is lost."""


def filled(table: dict[str, list[_T]], name: str, delivered: list[_T]) -> list[_T]:
    """A list in a table, as long as the delivered one, which fills it where it is shorter."""
    kept = table.setdefault(name, delivered)
    if len(kept) != len(delivered):
        kept[:] = [*kept, *delivered[len(kept) :]][: len(delivered)]
    return kept


class InMemoryStore:
    """Retained memory of a run that keeps nothing: it lasts as long as the store."""

    def __init__(self) -> None:
        self._tables: dict[tuple[str, int], dict[Any, Any]] = {}

    def table(self, name: str, channel: int = 0) -> dict[Any, Any]:
        """The one table of a name."""
        return self._tables.setdefault((name, channel), {})

    def commit(self) -> None:
        """Nothing is written anywhere."""

    def close(self) -> None:
        """Nothing is to be let go."""


def copied(store: RetainedStore, channel: int) -> InMemoryStore:
    """A copy of what programs of a channel read and write: whoever works with it leaves the store alone."""
    from copy import deepcopy

    made = InMemoryStore()
    for name in DATA:
        for number in (0, channel):
            made.table(name, number).update(deepcopy(store.table(name, number)))
    return made


def opened(memory: RetainedStore | str | Path | None, control: str, machine: str) -> RetainedStore:
    """The memory of a control: a file (made where there is none), a store, or a new one in memory.

    Raises:
        MemoryFileError: The file cannot be used.
    """
    if memory is None:
        return InMemoryStore()
    if isinstance(memory, str | PathLike):
        from polycnc.memory.file import FileStore

        return FileStore(memory, control, machine)
    return memory
