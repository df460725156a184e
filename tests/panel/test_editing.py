"""A program under edit: findings with their places in both languages, and coloured parts."""

from __future__ import annotations

import pytest

from polycnc.control.registry import ids
from polycnc.mainrun import VirtualControl
from polycnc.panel.editing import findings, parts

WRONG = {
    "fanuc-m": "G0 X1.\nG1 X2. F100.\nG999 X3.\nM30\n",
    "fanuc-0i-tf": "G0 X1.\nG1 X2. F100.\nG999 X3.\nM30\n",
    "meldas-m": "G0 X1.\nG1 X2. F100.\nG999 X3.\nM30\n",
    "sinumerik-840d": "G0 X1\nG1 X2 F100\nX=UNKNOWN+1\nM30\n",
    "syntec-mill": "G0 X1.\nG1 X2. F100.\nG999 X3.\nM30\n",
}


@pytest.mark.parametrize("control", ids())
def test_a_wrong_block_is_found_with_its_line_in_both_languages(control: str) -> None:
    virtual = VirtualControl(control)
    texts = set()
    for lang in ("en", "zh-TW"):
        (found,) = findings(virtual, "MAIN", WRONG[control], lang)
        assert found.line == 3
        texts.add(found.text)
    assert len(texts) == 2
    assert findings(virtual, "MAIN", "G0 X1.\nM30") == ()
    assert virtual.positions.work["X"] == 0.0
    assert virtual.alarms == ()


def test_an_endless_program_is_looked_at_for_a_while() -> None:
    assert findings(VirtualControl("fanuc-m"), "MAIN", "N1 G0 X1.\nX0.\nGOTO 1\nM30\n") == ()


def test_a_subprogram_of_the_memory_is_found() -> None:
    control = VirtualControl("fanuc-m")
    text = "O1\nM98 P77\nM30\n"
    assert [found.line for found in findings(control, "O0001", text)] == [2]
    control.store_program("O0077", "O77\nG0 X1.\nM99\n")
    assert findings(control, "O0001", text) == ()
    control.store_program("O0077", "O77\nG999\nM99\n")
    (found,) = findings(control, "O0001", text)
    assert found.line == 0


@pytest.mark.parametrize(
    ("control", "text", "shown"),
    [
        ("fanuc-m", "N10 G1 X#100 (G2 WAY)\n", "block:N10 code:G1 variable:#100 comment:(G2 WAY)"),
        ("sinumerik-840d", 'N1 MSG("G1") ; M3', 'block:N1 word:MSG text:"G1" comment:; M3'),
        ("sinumerik-840d", "R1=$AA_IM[X]", "variable:R1 variable:$AA_IM[X]"),
        ("syntec-mill", "@1 := 2; // G1\nG04.1 P1", "variable:@1 comment:// G1 code:G04.1"),
    ],
)  # fmt: skip
def test_parts_of_a_text_have_their_kinds(control: str, text: str, shown: str) -> None:
    assert (
        " ".join(f"{part.kind}:{text[part.start : part.end].strip()}" for part in parts(control, text))
        == shown
    )
