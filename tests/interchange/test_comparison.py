"""What one memory holds and another one does not."""

from __future__ import annotations

from polycnc.control.word_address.memory import ToolOffset
from polycnc.interchange.comparison import missing
from polycnc.memory.retained import PROGRAMS, TOOL_OFFSETS, VARIABLES, WORK_OFFSETS, InMemoryStore
from polycnc.program import Program


def store(**tables: object) -> InMemoryStore:
    made = InMemoryStore()
    for name, values in tables.items():
        made.table(name.replace("_", " "), 1).update(values)  # type: ignore[call-overload]
    return made


def test_nothing_and_zero_are_one() -> None:
    held = store(variables={500: None, 501: 0.0}, tool_offsets={1: ToolOffset()}, work_offsets={"EXT": [0.0]})
    assert list(missing(held, InMemoryStore(), 1)) == []


def test_values_that_differ_are_found() -> None:
    held = store(
        variables={500: 1.0, 501: 2.0},
        tool_offsets={1: ToolOffset(length=5.0)},
        work_offsets={"G54": [0.0, 1.0]},
    )
    other = store(
        variables={500: 1.0 + 1e-12, 501: 2.1}, tool_offsets={1: ToolOffset()}, work_offsets={"G54": [0.0]}
    )
    assert list(missing(held, other, 1)) == [(WORK_OFFSETS, "G54"), (TOOL_OFFSETS, 1), (VARIABLES, 501)]


def test_programs_differ_by_their_blocks() -> None:
    held, other = InMemoryStore(), InMemoryStore()
    held.table(PROGRAMS)["", "o1"] = Program("O1", ("O1", "M30"), number=1)
    other.table(PROGRAMS)["", "o1"] = Program("O1", ("O0001", "M30"), number=1)
    assert list(missing(held, other, 1)) == []
    other.table(PROGRAMS)["", "o1"] = Program("O1", ("O0001", "M02"), number=1)
    assert list(missing(held, other, 1)) == [(PROGRAMS, ("", "o1"))]
