"""A channel that stands on a memory; what it does lasts only when the memory's owner commits."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.memory.retained import PROGRAMS, RetainedStore
from polycnc.session import open_session

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from polycnc.channel.channel import Channel
    from polycnc.session import Result

#: A program that does nothing: it brings a control to the state after power-on.
NOTHING = b"M30\n"


class Draft:
    """A store whose commits do nothing: whoever owns the store behind it commits once, or never.

    A run may edit programs, and forgets those that have the name of its own: it gets a table of programs of its own.
    """

    def __init__(self, behind: RetainedStore) -> None:
        self._behind = behind
        self._programs = dict(behind.table(PROGRAMS))

    def table(self, name: str, channel: int = 0) -> dict[Any, Any]:
        """The table of the store behind."""
        return self._programs if name == PROGRAMS else self._behind.table(name, channel)

    def commit(self) -> None:
        """Nothing lasts yet."""

    def close(self) -> None:
        """The store behind is its owner's."""


def run_on(
    memory: RetainedStore,
    control: str,
    machine: str | Path | None,
    content: bytes = NOTHING,
    setup: Mapping[str, object] | str | Path | None = None,
) -> Result:
    """Run a text at power-on of a control with a memory."""
    session = open_session(
        content, name="DATA", control=control, machine=machine or None, setup=setup, memory=Draft(memory),
        keep=True, timed=False,
    )  # fmt: skip
    return session.run()


def channel_on(
    memory: RetainedStore,
    control: str,
    machine: str | Path | None,
    setup: Mapping[str, object] | str | Path | None = None,
) -> Channel:
    """A channel after power-on of a control with a memory."""
    return run_on(memory, control, machine, setup=setup).channel
