"""Memories that a program has filled, and what comes back of them from their files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from polycnc.interchange import comparison
from polycnc.interchange.power_on import run_on
from polycnc.interchange.reading import Reading
from polycnc.interchange.writing import write
from polycnc.memory.retained import InMemoryStore

if TYPE_CHECKING:
    from polycnc.memory.retained import RetainedStore

MACHINES = {"fanuc-0i-tf": "lathe2"}


def machine_of(control: str) -> str:
    return MACHINES.get(control, "mill3")


def filled(control: str, program: str, into: RetainedStore | None = None) -> RetainedStore:
    """A memory in which a program has left something behind."""
    memory = InMemoryStore() if into is None else into
    result = run_on(memory, control, machine_of(control), program.encode())
    assert not result.alarms, [str(alarm) for alarm in result.alarms]
    return memory


def files_of(memory: RetainedStore, control: str, *kinds: str) -> dict[str, str]:
    written = write(memory, control, machine_of(control), kinds)
    assert written.left_out == []
    return written.files


def read(control: str, files: dict[str, str], into: RetainedStore | None = None) -> RetainedStore:
    memory = InMemoryStore() if into is None else into
    Reading(memory, control, machine_of(control)).take_texts(
        {Path(name): text for name, text in files.items()}
    )
    return memory


def check_identity(control: str, memory: RetainedStore) -> None:
    """What is read from its files is the memory, and nothing else."""
    files = files_of(memory, control)
    again = read(control, files)
    assert list(comparison.missing(memory, again, 1)) == []
    assert list(comparison.missing(again, memory, 1)) == []
