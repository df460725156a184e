from __future__ import annotations

import pytest

from polycnc.language.syntec.tokens import fault, tokenize


def texts(source: str, *, macro: bool = True) -> list[str]:
    return [token.text for token in tokenize(source.split("\n"), macro=macro)][:-1]


def test_packed_words_part_into_letters_and_numbers() -> None:
    assert texts("N10G1X-1.5Y.5") == ["N", "10", "G", "1", "X", "-", "1.5", "Y", ".5"]


def test_x_behind_a_letters_zero_is_no_hexadecimal_number() -> None:
    assert texts("G0X10X0X1F") == ["G", "0", "X", "10", "X", "0", "X", "1", "F"]
    assert texts("#1:=0xFF") == ["#", "1", ":=", "0xFF"]


def test_keywords_need_no_blanks() -> None:
    assert texts("for#1:=1to10by2do") == ["FOR", "#", "1", ":=", "1", "TO", "10", "BY", "2", "DO"]


def test_functions_may_have_digits_in_their_names() -> None:
    assert texts("atan2(1,2)") == ["ATAN2", "(", "1", ",", "2", ")"]


def test_comments_of_a_macro_file_may_span_lines() -> None:
    tokens = tokenize(["G1 (* a", "b *) X1 // Y2", "Z3"], macro=True)
    assert [(t.text, t.line, t.column, t.first) for t in tokens[:-1]] == [
        ("G", 1, 1, True),
        ("1", 1, 2, False),
        ("X", 2, 6, True),
        ("1", 2, 7, False),
        ("Z", 3, 1, True),
        ("3", 3, 2, False),
    ]


def test_round_brackets_are_comments_in_an_iso_file_only() -> None:
    assert texts("G1 (X1) Y2", macro=False) == ["G", "1", "Y", "2"]
    assert texts("G1 X(1)") == ["G", "1", "X", "(", "1", ")"]


def test_longer_spellings_of_a_closing_word_are_the_same() -> None:
    assert texts("ENDIF endwhile END_FOR") == ["END_IF", "END_WHILE", "END_FOR"]


@pytest.mark.parametrize(("source", "code"), [("中", "COM-027"), ("?", "COM-003"), ("EQ", "COM-003")])
def test_what_cannot_stand_anywhere_says_why(source: str, code: str) -> None:
    token = tokenize([source], macro=True)[0]
    assert fault(token, "COM-019").code == code


def test_a_text_may_hold_any_character() -> None:
    assert texts('MSG("完成 \\" //")') == ["MSG", "(", '"完成 \\" //"', ")"]


def test_a_comment_without_end_is_a_fault() -> None:
    assert tokenize(["G1 (* X"], macro=True)[2].kind == "fault"


def test_long_lines_that_are_no_plain_block_are_read_in_passing() -> None:
    line = "X123456 Y123456 " * 100 + "("
    for macro in (True, False):
        assert len(tokenize([line], macro=macro)) > 400
