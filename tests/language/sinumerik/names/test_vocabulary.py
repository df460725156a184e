from __future__ import annotations

import pytest

from polycnc.control.registry import control
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.names.scope import is_known
from tests.language.sinumerik.running import value


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("X", 201), ("A2", 201), ("ADIS", 201), ("INVCW", 202), ("G01", 202), ("G999", 0), ("SIN", 203),
        ("TANG", 204), ("SBLOF", 204), ("DEFINE", 205), ("AP", 205), ("$MC_GCODE_RESET_VALUES", 206),
        ("R5", 207), ("$TC_DP3", 207), ("$TC_MPP4", 0), ("CYCLE81", 208), ("GGV", 209), ("MACRO", 210),
        ("MYVAR", 211), ("T", 400), ("T3", 0), ("XYZ", 0),
    ],
)  # fmt: skip
def test_stringis_tells_what_a_name_is(name: str, kind: int) -> None:
    files = {"_N_MGUD_DEF": "DEF CHAN INT GGV\nDEFINE MACRO AS G1\nM30"}
    assert value(f'DEF INT MYVAR\nR1=STRINGIS("{name}")', files=files) == kind


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("AA", 1), ("BB", 1), ("BB[,]", 1), ("BB[1,]", 1), ("BB[2,0]", 0), ("BB[1]", 0), ("BB[1,1", 0), ("CC", 0),
        ("$P_GG[1]", 1), ("$P_FOO", 0), ("", 0),
    ],
)  # fmt: skip
def test_isvar_tells_whether_a_variable_exists(text: str, known: int) -> None:
    assert value(f'DEF INT AA, BB[2,3]\nR1=ISVAR("{text}")') == known


@pytest.mark.parametrize(
    "word", ["TANGON", "SYNFCT", "OSP1", "EGONSYNE", "DIAMONA", "SIRELIN", "ORICONTO", "WALCS10"]
)
def test_words_of_the_statement_list_are_known(word: str) -> None:
    assert is_known(word, control("sinumerik-840d"))  # type: ignore[arg-type]


def test_functions_of_the_language_itself_are_no_procedures() -> None:
    functions = {
        *keywords.FUNCTIONS,
        *keywords.SAME_TYPE_FUNCTIONS,
        *keywords.NAME_FUNCTIONS,
        *keywords.FILE_FUNCTIONS,
    }
    assert functions.isdisjoint(keywords.PROCEDURES)
