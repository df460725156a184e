from __future__ import annotations

import pytest

from polycnc.language.sinumerik.words import WordAlarm, WordShape, block_of
from tests.language.sinumerik.running import alarm, run, targets


def test_blocks_with_equal_functions_and_addresses_are_one_object() -> None:
    words = (WordShape("X"), WordShape("POS", 1, "IC"))
    assert block_of(("G1",), words) is block_of(("G1",), words)
    assert block_of(("G1",), words) is not block_of(("G0",), words)


def test_a_block_knows_where_words_without_an_index_have_their_values() -> None:
    assert block_of(("G1",), (WordShape("M", 2), WordShape("X"))).positions == {"X": 1}


def test_five_m_functions_are_allowed_and_no_sixth() -> None:
    m = WordShape("M")
    assert len(block_of((), (m,) * 5).words) == 5
    with pytest.raises(WordAlarm) as raised:
        block_of((), (m,) * 6)
    assert (raised.value.code, raised.value.position) == ("12010", 5)


@pytest.mark.parametrize(
    ("line", "code", "column"),
    [
        ("X10 X20", "12010", 5),
        ("G1 G2 X1", "12060", 4),
        ("G1 G999", "12470", 4),
        ("G1 FOO=3", "12550", 4),
        ("FOO", "12550", 1),
        ("X1=5 Q7=3", "12550", 6),
        ("X10 CR5", "12550", 5),
        ("CR 5", "12080", 4),
        ("POS[X]5", "12080", 7),
        ("G1 5", "12080", 4),
        ("R1=5 X10", "12080", 1),
        ("X10 R1=5", "12080", 5),
        ("AND", "12080", 1),
        ("X=GP(5,99)", "12560", 8),
        ("G[8]=999", "12470", 1),
        ("G[2]=1", "12470", 1),
        ("G[8]=R1+1", "12080", 8),
        ("WHEN TRUE DO R1=1", "12580", 14),
    ],
)
def test_a_wrong_word_alarms_at_its_column(line: str, code: str, column: int) -> None:
    assert alarm(line) == (code, 1, column)


def test_an_alarm_of_the_control_about_a_word_has_the_word_s_column() -> None:
    assert alarm("G0 X5 Y=AC(3) Z=DC(2)")[1:] == (1, 15)


def test_values_may_stand_apart_and_have_signs() -> None:
    assert targets("G0 X -5 Y+3 Z.5")[0] == {"X": -5, "Y": 3, "Z": 0.5}


def test_words_without_blanks_are_words() -> None:
    assert targets("N10G0X10Y=5+2Z-1")[0] == {"X": 10, "Y": 7, "Z": -1}


def test_an_axis_may_come_from_a_variable() -> None:
    program = 'DEF AXIS AA\nAA=Y\nG0 AX[AA]=5\nAA=Z\nAX[AA]=IC(7)\nAX[AXNAME("X")]=1'
    assert targets(program)[-1] == {"X": 1, "Y": 5, "Z": 7}


def test_the_same_axis_twice_through_variables_alarms() -> None:
    assert alarm("DEF AXIS AA=X\nG0 AX[AA]=5 X=3")[:2] == ("12010", 2)


def test_a_positioning_attribute_may_be_a_number() -> None:
    assert targets("G0 X=GP(5,1)\nR1=2\nX=GP(3,R1)\nX=GP(3,IC)")[-1]["X"] == 11


def test_a_g_function_may_be_named_by_group_and_number() -> None:
    assert targets("R1=1\nG[1]=R1 X5\nG[14]=2\nX5")[-1]["X"] == 10


def test_m_functions_come_in_the_order_typed() -> None:
    codes = [row["code"] for row in run("M7 M=8 M77").rows if row["type"] == "m"]
    assert codes == [7, 8, 77]


def test_a_skipped_block_is_not_even_read() -> None:
    setup = {"switches": {"block_skip": [1]}}
    assert run("/1 FOO BAR", setup=setup).alarms == []
    assert alarm("/2 FOO", setup=setup)[0] == "12550"
