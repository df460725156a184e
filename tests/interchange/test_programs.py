"""Programs of a memory as files."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.interchange import programs
from polycnc.interchange.controls.kinds import texts_of
from polycnc.interchange.errors import InterchangeError, ReadingError
from polycnc.memory.retained import PROGRAMS, InMemoryStore
from polycnc.program import Form, Program
from tests.interchange.support import files_of, read

BLOCKS = st.lists(st.sampled_from(["G0 X1.", "(NOTE)", "", "N10 M3 S100", "#1=5"]), max_size=5)


@given(st.dictionaries(st.integers(1, 9999), BLOCKS, min_size=1, max_size=4))
def test_programs_of_a_tape_come_back(bodies: dict[int, list[str]]) -> None:
    memory = InMemoryStore()
    held = [Program(f"O{n:04d}", (f"O{n:04d}", *lines), number=n) for n, lines in bodies.items()]
    programs.put(memory, held, Form.WORD_ADDRESS)
    again = read("fanuc-m", files_of(memory, "fanuc-m", "programs"))
    assert [(each.name, list(each.lines)) for each in programs.kept_programs(again)] == [
        (each.name, list(each.lines)) for each in held
    ]


def test_a_program_without_a_heading_gets_one() -> None:
    files = programs.written([Program("part", ("G0 X1.", "M30"))], texts_of("fanuc-m"))
    assert files == {"ALL-PROG.TXT": "%\n<PART>\nG0 X1.\nM30\n%\n"}


def test_a_block_that_looks_like_a_heading_is_not_written() -> None:
    with pytest.raises(InterchangeError) as caught:
        programs.written([Program("O0001", ("O0001", "O0002 G0", "M30"), number=1)], texts_of("fanuc-m"))
    assert "O0001" in caught.value.text()


def test_files_of_syntec_have_the_names_of_their_programs() -> None:
    held = [
        Program("O0001", ("G0 X1.", "M30"), number=1),
        Program("TOOL.MAC", ("@1 := 2;",), form=Form.MACRO),
    ]
    files = programs.written(held, texts_of("syntec-mill"))
    assert files == {"O0001": "G0 X1.\nM30\n", "TOOL.MAC": "%@MACRO\n@1 := 2;\n"}
    again = programs.kept_programs(read("syntec-mill", files))
    assert [(each.name, list(each.lines), each.form) for each in again] == [
        (each.name, list(each.lines), each.form) for each in held
    ]


def test_a_name_that_leads_elsewhere_is_no_file() -> None:
    with pytest.raises(InterchangeError):
        programs.written([Program("../O1", ("M30",))], texts_of("syntec-mill"))


def test_an_archive_brings_programs_back_to_their_directories() -> None:
    memory = InMemoryStore()
    held = [
        Program("_N_A_MPF", ("G0 X1", "M30"), directory="/_N_WKS_DIR/_N_SHAFT_WPD", form=Form.SINUMERIK),
        Program("_N_B_SPF", ("M17",), directory="/_N_SPF_DIR", form=Form.SINUMERIK),
        Program("_N_MGUD_DEF", ("DEF NCK REAL A", "M17"), directory="/_N_DEF_DIR", form=Form.SINUMERIK),
    ]
    programs.put(memory, held, Form.SINUMERIK)
    files = files_of(memory, "sinumerik-840d", "programs")
    again = read("sinumerik-840d", files)
    assert {key: list(each.lines) for key, each in again.table(PROGRAMS).items()} == {
        (each.directory, each.name.casefold()): list(each.lines) for each in held
    }


@pytest.mark.parametrize(
    ("tape", "line"),
    [
        ("O0001\nM30\n%\n", 1),
        ("%\nO0001\nM30\n", 3),
        ("%\nM30\nO0002\nM30\n%\n", 2),
        ("%\nO1\nM30\nO0001\nM30\n%\n", 4),
    ],
)
def test_a_tape_that_is_not_whole_is_refused(tape: str, line: int) -> None:
    with pytest.raises(ReadingError) as caught:
        programs.of_tape(Path("tape.txt"), tape)
    assert f"tape.txt:{line}:1: " in caught.value.text("en")
