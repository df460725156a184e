"""How others write the same blocks: marks of block skip, small letters, what stands between; both ways, and scanned."""

from __future__ import annotations

import pytest

from polycnc.language.bulk.buffers import MOST_SKIPPED, Window
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned

HEADS = {
    "fanuc-m": "O0001\nG21 G17 G90 G94\nG54 G0 X0 Y0 Z10.\nG1 Z-1. F1000.\n",
    "meldas-m": "G21 G17 G90 G94\nG54 G0 X0 Y0 Z10.\nG1 Z-1. F1000.\n",
    "syntec-mill": "G71 G17 G90 G94\nG54 G0 X0 Y0 Z10.\nG1 Z-1. F1000.\n",
    "sinumerik-840d": "G71 G17 G90 G94\nG54 G0 X0 Y0 Z10\nG1 Z-1 F1000\n",
}
MILLS = sorted(HEADS)
BLOCKS = 120


def program(control_id: str, *forms: str) -> str:
    """Blocks that are written in some forms by turns; `@` is a number that grows."""
    lines = [forms[i % len(forms)].replace("@", str(i)) for i in range(BLOCKS)]
    return HEADS[control_id] + "\n".join([*lines, "M30", ""])


@pytest.mark.parametrize("control_id", MILLS)
@pytest.mark.parametrize("mark", ["/", "/ ", "/1", "/2", " /3 ", "/N@ "])
def test_marked_blocks_are_scanned(control_id: str, mark: str) -> None:
    text = program(control_id, mark + "G1 X@. Y1.5", "X-@. Y2.")
    assert scanned(text, control_id) >= BLOCKS - 8
    assert differences(text, control_id) == []


@pytest.mark.parametrize("control_id", MILLS)
@pytest.mark.parametrize("on", [True, [1], [2], [1, 2, 3]])
def test_marked_blocks_are_left_out_where_their_level_is_on(control_id: str, on: object) -> None:
    text = program(control_id, "/G1 X@. Y1.5", "X-@. Y2.", "/2 X5. Y@.", "/1 Y-@.", "/N@ F@.")
    assert differences(text, control_id, {"switches": {"block_skip": on}}) == []


def test_blocks_that_are_left_out_are_passed_by_the_scanner() -> None:
    text = program("fanuc-m", "/G1 X@. Y1.5", "X-@. Y2.")
    assert scanned(text, "fanuc-m", {"switches": {"block_skip": True}}) >= BLOCKS - 8


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "syntec-mill", "fanuc-0i-tf"])
@pytest.mark.parametrize(
    "block", ["O5", "O5 X1.", "X[1.", "X[#1+*2.]", "X[1. 2.]", "#1=", "#1=2.+", "#1=[3.", "#1=1. 2."]
)
def test_what_is_wrong_in_a_block_that_is_left_out_alarms_both_ways(control_id: str, block: str) -> None:
    head = HEADS.get(control_id, "G98 G1 X0 Z0 F100.\n")
    text = head + "X1.\nX2.\n/X3.\n" + f"/{block}\nX4.\n/2 {block}\nX5.\nM30\n"
    for switches in ({}, {"switches": {"block_skip": True}}, {"switches": {"block_skip": [2]}}):
        assert differences(text, control_id, switches) == []


@pytest.mark.parametrize("mark", ["N@/", "N@ /2 ", "N@ / "])
def test_a_mark_behind_the_block_number(mark: str) -> None:
    text = program("fanuc-m", mark + "G1 X@. Y1.5")
    assert scanned(text, "fanuc-m") >= BLOCKS - 8
    for switches in ({}, {"switches": {"block_skip": True}}):
        assert differences(text, "fanuc-m", switches) == []


@pytest.mark.parametrize(
    "line", ["/", "/2", "/(A)", "G1 X@. /Y2.", "//X@.", "/ /2 X@.", "/X@.;Y1.", "/X@1234567890123456"]
)
def test_other_marks_are_the_interpreters(line: str) -> None:
    text = program("fanuc-m", line, "X-@.")
    for switches in ({}, {"switches": {"block_skip": True}}):
        assert differences(text, "fanuc-m", switches) == []


@pytest.mark.parametrize("control_id", MILLS)
def test_marked_blocks_with_expressions(control_id: str) -> None:
    word = "X=R1+@" if control_id == "sinumerik-840d" else "X[#1+@]" if control_id != "syntec-mill" else "X@"
    first = {"sinumerik-840d": "R1=2", "syntec-mill": "X1"}.get(control_id, "#1=2.")
    text = program(control_id, f"/{first}", f"/G1 {word}", f"{word} Y1.")
    assert differences(text, control_id) == []
    assert scanned(text, control_id) >= BLOCKS // 2


@pytest.mark.parametrize("control_id", MILLS)
def test_small_letters_are_scanned(control_id: str) -> None:
    text = program(control_id, "g1 x@. y1.5", "N@ x-@. y2. f@.", "Y@. G0")
    assert scanned(text, control_id) >= BLOCKS - 10
    assert differences(text, control_id) == []


def test_small_letters_in_formulas_are_scanned() -> None:
    text = program("fanuc-m", "#1=@*0.5", "g1 x[sin[#1]*10.] y[#1 mod 7]")
    assert scanned(text, "fanuc-m") >= BLOCKS - 10
    assert differences(text, "fanuc-m") == []


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "syntec-mill"])
@pytest.mark.parametrize("notes", ["M8", "M9", "M3", "M4", "M5", "T2", "M77", "S@ M3", "M60 X@."])
def test_codes_that_only_tell_the_machine_are_scanned(control_id: str, notes: str) -> None:
    text = program(control_id, "X@. Y1.", notes, "Y-@.")
    assert scanned(text, control_id) >= BLOCKS - 12
    assert differences(text, control_id) == []


def test_an_m_code_that_takes_time_beside_the_motion_of_its_block_is_told_apart() -> None:
    """Both in blocks of its own, which are scanned, and beside a motion."""
    text = program("fanuc-m", "X@. Y1.", "M8", "Y-@.", "M9 X@.", "M8 X-@.")
    one, other = (run(text, "fanuc-m", bulk=bulk).toolpath for bulk in (None, PLAIN))
    assert one.block_starts == other.block_starts != []


def test_a_window_is_kept_where_the_interpreter_takes_some_lines() -> None:
    window, lines = Window(), [f"X{i}" for i in range(2 * MOST_SKIPPED + 3)]
    assert window.stand_at(lines, 0, len(lines))
    text = window.text
    for line in (1, 5, 60):
        assert window.stand_at(lines, line, len(lines))
        assert window.text is text
        assert window.next_line() == f"X{line}"
    assert window.stand_at(lines, 61 + MOST_SKIPPED, len(lines))
    assert window.next_line() == f"X{61 + MOST_SKIPPED}"
    assert window.stand_at(lines, 3, len(lines))
    assert window.next_line() == "X3"


def test_a_window_is_folded_once_and_stays_so() -> None:
    window, lines = Window(), [*["x1"] * 70, "y2"]
    assert window.stand_at(lines, 0, len(lines))
    assert window.fold()
    assert not window.fold()
    assert window.next_line() == "X1"
    assert window.stand_at(lines, 70, len(lines))
    assert window.next_line() == "Y2"
    assert window.stand_at(["X1", "(a)"], 0, 2)
    assert not window.fold()
