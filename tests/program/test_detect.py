from __future__ import annotations

import pytest

from polycnc.program import guess_control, split_programs
from polycnc.program.detect import _EVIDENCE, Guess
from polycnc.program.errors import texts
from polycnc.program.split import Source
from polycnc.program.text import split_lines


def guess(text: str, name: str = "PART.NC") -> Guess:
    return guess_control(split_programs(split_lines(text), Source(name)))


@pytest.mark.parametrize(
    ("control", "text"),
    [
        ("syntec-mill", "%@MACRO\nG0 X1;"),
        ("syntec-mill", "O1\n#1 := 5\nM30"),
        ("sinumerik-840d", "%_N_A_MPF\n;$PATH=/_N_MPF_DIR\nM30"),
        ("sinumerik-840d", "G0 X0\n;%_N_A_MPF\nM30"),
        ("sinumerik-840d", "N10 DEF REAL A\nM30"),
        ("sinumerik-840d", "PROC SUB(REAL X)\nM17"),
        ("sinumerik-840d", "G0 X0\nR1=5\nM30"),
        ("sinumerik-840d", "N10 GOTOF ENDE\nENDE: M30"),
        ("sinumerik-840d", "G2 X10 CR=5"),
        ("sinumerik-840d", "G1 X=IC(5)"),
        ("sinumerik-840d", 'CYCLE800(1,"TC",0)'),
        ("sinumerik-840d", "$TC_DP1[1,1]=120"),
        ("fanuc-0i-tf", "O1\nG71 U2. R1.\nG71 P10 Q20 U.5 W.1 F.3\nM30"),
        ("fanuc-0i-tf", "O1\nN1 G50 S2000\nM30"),
        ("fanuc-0i-tf", "T0101\nG96S200M3"),
        ("fanuc-0i-tf", "G50 S2000\n#100=[#_ABSIO[1]]"),
        ("fanuc-m", "O1\n#1=[#_ABSIO[1]]"),
        ("fanuc-m", "O1\nSETVN 101[DEPTH]"),
        (None, "O1\nG90 G54 G0 X0\nG43 Z5. H1\nG81 R2. Z-5. F100\nM98 P51000\n#1=#2+1\nM30"),
        (None, "O1\nT01 M6\nG73 Z-10. R2. P100 Q3. F100\nG50\nM30"),
        (None, "T0101 M6\nG0 X0"),
        (None, "G71\nG0 X0"),
        (None, "(R1=5 CYCLE800(1) G71 P10 Q20)\nM30 ; R1=5"),
        (None, 'MSG("x")\nG50 S2000\nR1=5'),
        (None, "(T1  D=10. CR=0. - ZMIN=-5. - FLAT END MILL)\nG0 X0"),
        (None, "(T2 (D=10.) CR=0. TAPER)\nG0 X0"),
        (None, "(T3 CR=1.5 WITHOUT END\nG0 X0"),
        (None, "; G71 U1 R1 then G71 P10 Q20, #1 := 2\nG0 X0"),
        (None, "o100 while [#1 lt 3]\n#1=[#1+1]\no100 endwhile\no<a> ENDIF\nG0 X0"),
        ("sinumerik-840d", "R1=(R2+(R3*2)) ; (G50 S100)"),
        ("sinumerik-840d", "IF R1==1\nG0 X0\nENDIF"),
        (None, ""),
    ],
)
def test_a_control_is_named_only_where_it_is_certain(control: str | None, text: str) -> None:
    assert guess(text).control == control


def test_the_suffix_of_sinumerik_counts() -> None:
    assert guess("G0 X0\nM30", "PART.MPF").control == "sinumerik-840d"


def test_a_reason_names_its_line_and_words_in_both_languages() -> None:
    (reason,) = guess("%\n(R1=1)\nO1\nG0 X0\nN5 G50 S2500\nM30").reasons
    assert (reason.line, reason.found) == (5, "N5 G50 S2500")
    assert reason.text("en") == "line 5: spindle speed limit of a lathe (N5 G50 S2500)"
    assert "第 5 行" in reason.text("zh-TW")


@pytest.mark.parametrize(
    ("text", "line", "found"),
    [
        ("\n;%_N_A_MPF\nM30", 2, ";%_N_A_MPF"),
        ("\n%_N_A_MPF\n;$PATH=/_N_MPF_DIR\nM30", 3, ";$PATH=/_N_MPF_DIR"),
        ("\n%_N_A_MPF\nM30", 2, "_N_A_MPF"),
    ],
)
def test_a_header_is_told_with_its_line(text: str, line: int, found: str) -> None:
    (reason,) = guess(text).reasons
    assert (reason.line, reason.found) == (line, found)


def test_contradicting_reasons_are_all_told() -> None:
    found = guess("G50 S2000\nR1=5")
    assert found.control is None
    assert {reason.message for reason in found.reasons} == {"detect.speed-limit", "detect.sinumerik-variable"}


def test_every_text_of_the_folder_exists_in_both_languages() -> None:
    catalogue = texts()
    assert {row.message for row in _EVIDENCE} <= set(catalogue)
    for key in catalogue:
        assert set(catalogue.entry(key)) == {"en", "zh-TW"}
