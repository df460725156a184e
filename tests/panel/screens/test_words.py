"""Words of a program under edit by the keys of the MDI unit (FANUC controls, mode EDIT)."""

from __future__ import annotations

from time import process_time

import pytest

from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.screens.words import Edited, Place, moved, spans, word_with
from tests.panel.bench import Bench


@pytest.mark.parametrize(
    ("block", "words"),
    [
        ("N10 G0X10.5Y-3 ;", ["N10", "G0", "X10.5", "Y-3"]),
        ("/2 (A B) Z[#1+SIN[#2]]F#3", ["/2", "(A B)", "Z[#1+SIN[#2]]", "F#3"]),
        ("IF [#1 EQ 2] GOTO 10", ["IF", "[#1 EQ 2]", "GOTO", "10"]),
        ("#100=#101*2", ["#100=#101*2"]),
        ("", []),
    ],
)
def test_a_block_has_words(block: str, words: list[str]) -> None:
    assert [block[start:end] for start, end in spans(block)] == words


def edited(row: int, word: int) -> Edited:
    return Edited(["O1", "G0X1. Y2.", "M30"], Place(row, word))


def test_insert_goes_behind_the_word() -> None:
    program = edited(1, 0)
    program.insert("Z3.")
    assert (program.text, program.place) == ("O1\nG0 Z3. X1. Y2.\nM30\n", Place(1, 1))
    program.insert("F100;M8;")
    assert (program.text, program.place) == ("O1\nG0 Z3. F100\nM8\nX1. Y2.\nM30\n", Place(2, 1))


def test_insert_behind_the_end_of_a_block_begins_the_next_one() -> None:
    program = edited(1, 3)
    program.insert("X9.;")
    assert (program.text, program.place) == ("O1\nG0X1. Y2.\nX9.\nM30\n", Place(2, 1))


def test_alter_and_delete() -> None:
    program = edited(1, 1)
    program.alter("X-5.")
    assert (program.text, program.place) == ("O1\nG0 X-5. Y2.\nM30\n", Place(1, 1))
    program.delete()
    assert (program.text, program.place) == ("O1\nG0 Y2.\nM30\n", Place(1, 1))
    program.delete_block()
    assert program.text == "O1\nG0 M30\n"


def test_the_end_of_a_block_can_be_deleted() -> None:
    program = edited(1, 3)
    program.delete()
    assert program.text == "O1\nG0X1. Y2. M30\n"


def test_the_cursor_goes_from_block_to_block() -> None:
    lines = ["O1", "G0X1. Y2.", "M30"]
    assert moved(lines, Place(0, 0), 1) == Place(0, 1)
    assert moved(lines, Place(0, 1), 1) == Place(1, 0)
    assert moved(lines, Place(1, 0), -1) == Place(0, 1)
    assert moved(lines, Place(0, 1), -9) == Place(0, 0)
    assert moved(lines, Place(0, 0), 99) == Place(2, 1)
    assert moved((), Place(3, 4), 1) == Place(0, 0)


@pytest.mark.parametrize(
    ("place", "wanted", "step", "found"),
    [
        ((0, 0), "X4.", 1, (2, 0)),  # X40. is another word
        ((1, 0), "Z5.", 1, (1, 3)),  # in the same block
        ((1, 3), "N10", -1, (1, 0)),
        ((1, 2), "X", 1, (1, 4)),  # an address
        ((2, 0), "X4", -1, (1, 4)),  # no word of that text: the nearest with it
        ((0, 0), "X4. M", 1, (2, 0)),
        ((2, 0), "Z5.", 1, None),
    ],
)
def test_a_word_is_looked_for(
    place: tuple[int, int], wanted: str, step: int, found: tuple[int, int] | None
) -> None:
    lines = ["O1", "N10 G0 F9. Z5. X40.", "X4. M30"]
    assert word_with(lines, Place(*place), wanted, step) == (None if found is None else Place(*found))


def test_a_long_program_is_edited_on_the_screen() -> None:
    panel = Bench("fanuc-m", "en", "O1\n" + "G1 X1. F500.\n" * 50_000 + "M30\n")
    panel.turn("mode", "edit")
    panel.keys("PROG")
    panel.screen.look_at(40_000)
    panel.keys("RIGHT")
    began = process_time()
    for _ in range(20):
        panel.keys("RIGHT")
        assert panel.view.windows
    assert process_time() - began < 0.5
    panel.typed("M8", "INSERT")
    assert panel.message == ""
    assert "M8" in panel.text


def names_of(panel: Bench) -> list[str]:
    return sorted(each.name for each in panel.control.programs)


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("control", ["fanuc-m", "fanuc-0i-tf"])
def test_another_number_is_that_of_the_same_program(control: str, lang: str) -> None:
    panel = Bench(control, lang, "O1\nG0 X5.\nM30\n")
    panel.turn("mode", "edit")
    panel.keys("PROG")
    panel.typed("O7", "INSERT")
    panel.typed("O0001", "ALTER")
    assert panel.message == panel.says("the memory has a program O0001 already", "記憶體中已有程式 O0001")
    panel.screen.buffer = ""
    panel.typed("O1", "DOWN")
    panel.typed("O22", "ALTER")
    assert panel.message == ""
    assert (panel.control.program, names_of(panel)) == ("O0022", ["O0007", "O0022"])
    assert list(panel.control.program_lines("O22")) == ["O22", "G0 X5.", "M30"]
    for keys in (("DELETE",), ("EOB", "DELETE")):
        panel.keys(*keys)
        assert panel.message == panel.says("nothing can be written here", "此處無法寫入")
        panel.screen.buffer = ""
    panel.keys("DOWN")
    for key in ("ALTER", "INSERT"):
        panel.typed("X1.;O7;M99;", key)  # it would stand in the place of another program
        assert panel.message == panel.says("nothing can be written here", "此處無法寫入")
        panel.screen.buffer = ""
    assert list(panel.control.program_lines("O7")) == ["O7"]
    assert list(panel.control.program_lines("O22")) == ["O22", "G0 X5.", "M30"]


def test_no_program_is_left_that_cannot_be_begun() -> None:
    panel = Bench("fanuc-m", "en", "O1\nG1 X50. F100.\nM30\n")
    panel.press("START")
    panel.passes(1.0)
    panel.press("HOLD")
    panel.control.run()
    panel.turn("mode", "edit")
    panel.keys("PROG")
    panel.typed("O5", "INSERT")
    assert "hold" in panel.message
    assert names_of(panel) == ["O0001"]
