"""A channel that stands on a memory."""

from __future__ import annotations

from polycnc.interchange.power_on import Draft, channel_on, run_on
from polycnc.memory.retained import PROGRAMS, VARIABLES, InMemoryStore
from polycnc.program import Program


def test_a_run_writes_into_the_memory_but_edits_no_program_of_it() -> None:
    memory = InMemoryStore()
    memory.table(PROGRAMS)["", "main"] = kept = Program("MAIN", ("M30",))
    run_on(memory, "fanuc-m", "mill3", b"#500=5\nM30\n")
    assert memory.table(VARIABLES, 1)[500] == 5.0
    assert memory.table(PROGRAMS) == {("", "main"): kept}


def test_a_channel_has_what_the_memory_holds() -> None:
    memory = InMemoryStore()
    memory.table(VARIABLES, 1)[500] = 7.0
    channel = channel_on(memory, "fanuc-m", "mill3")
    assert channel.control.read_variable(channel, "#500") == 7.0


def test_a_draft_commits_nothing() -> None:
    class Store(InMemoryStore):
        def commit(self) -> None:
            raise AssertionError

    draft = Draft(Store())
    draft.commit()
    draft.close()
