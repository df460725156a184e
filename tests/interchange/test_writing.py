"""Everything that a memory holds as files."""

from __future__ import annotations

import pytest

from polycnc.control.registry import ids
from polycnc.interchange.errors import InterchangeError
from polycnc.interchange.writing import kinds_of, write
from polycnc.memory.retained import TOOL_OFFSETS, InMemoryStore
from tests.interchange.support import filled, machine_of


@pytest.mark.parametrize("control", ids())
def test_an_empty_memory_has_files_too(control: str) -> None:
    written = write(InMemoryStore(), control, machine_of(control), ())
    assert written.left_out == []
    assert len(written.files) == len(kinds_of(control)) - 2  # no programs, and no setup


@pytest.mark.parametrize("control", ids())
def test_every_kind_can_be_written_alone(control: str) -> None:
    for kind in set(kinds_of(control)) - {"programs"}:
        assert len(write(InMemoryStore(), control, machine_of(control), [kind]).files) == 1
    with pytest.raises(InterchangeError, match="programs"):
        write(InMemoryStore(), control, machine_of(control), ["what"])


def test_what_no_file_says_is_told() -> None:
    memory = filled("fanuc-m", "G10 L10 P1 R5.\nM30\n")
    memory.table(TOOL_OFFSETS, 1)[1].tip = 3
    assert write(memory, "fanuc-m", "mill3", ()).left_out == [(TOOL_OFFSETS, 1)]
