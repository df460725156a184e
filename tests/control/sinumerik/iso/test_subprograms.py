"""Programs that the ISO dialect calls."""

from __future__ import annotations

import pytest

from polycnc.session import open_session
from polycnc.session.result import Result

STEP = {"0007.SPF": "G91 G0 X1\nM99\n", "1234.SPF": "PROC P\nR1=R1+$C_A R2=$C_B_PROG\nM17\n"}


def run(*lines: str) -> Result:
    text = "\n".join(("G291", *lines, "G290", "M30")) + "\n"
    return open_session(text, control="sinumerik-840d", files=STEP).run()


@pytest.mark.parametrize(
    ("block", "steps"), [("M98 P7", 1), ("M98 P0007 L3", 3), ("M98 P20007", 2), ("G65 P7 L2", 2)]
)
def test_programs_and_how_often(block: str, steps: int) -> None:
    result = run(block)
    assert result.alarms == []
    assert [row["to"]["X"] for row in result.rows if "to" in row] == [float(n) for n in range(1, steps + 1)]


def test_words_are_those_of_the_innermost_call() -> None:
    result = run("G65 P1234 A2.5", "G65 P1234 A4 B0")
    assert result.alarms == []
    assert (result.variables["R1"], result.variables["R2"]) == (6.5, 1.0)


@pytest.mark.parametrize(
    ("block", "code"),
    [
        ("M98", "PC0001"),
        ("M98 P7.", "PC0001"),
        ("M98 P20007 L2", "PC0001"),
        ("M98 P8", "14011"),
        ("G65 A1", "PC0001"),
        ("G65 P12345", "PC0001"),
        ("G66 P8", "14011"),
        ("M99", "PC0001"),
        ("M99 P10", "PC0001"),
    ],
)
def test_what_is_refused(block: str, code: str) -> None:
    assert [alarm.code for alarm in run(block).alarms] == [code]


@pytest.mark.parametrize("front", ["", "; a comment\n", "%_N_0007_SPF\n;$PATH=/_N_SPF_DIR\n\n"])
def test_a_macro_of_the_controls_own_language_may_begin_with_comments(front: str) -> None:
    files = {"0007.SPF": f"{front}PROC P\nR1=$C_A\nM17\n"}
    result = open_session("G291\nG65 P7 A3\nM30\n", control="sinumerik-840d", files=files).run()
    assert (result.alarms, result.variables["R1"]) == ([], 3.0)


def test_no_drilling_cycle_while_a_program_is_modal() -> None:
    assert [alarm.code for alarm in run("G66 P7", "G81 R1 Z-1").alarms] == ["PC0001"]
    assert [alarm.code for alarm in run("G81 R1 Z-1 K0", "G66 P7").alarms] == ["PC0001"]
