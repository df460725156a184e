"""Macro statements: flow, loops that are left and entered, text behind assignments, printing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support import codes, run

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


def common(channel: Channel, number: int) -> float | None:
    value: float | None = channel.memory.read(number)
    return value


@given(st.integers(0, 40), st.integers(1, 7))
def test_a_while_loop_runs_as_often_as_in_python(limit: int, step: int) -> None:
    channel = run(f"#1=0\nWHILE [#1 LT {limit}] DO1\n#101=#101+#1\n#1=#1+{step}\nEND1\nM30\n")
    assert (common(channel, 101) or 0.0) == sum(range(0, limit, step))


@given(st.integers(1, 12), st.integers(1, 12))
def test_nested_loops_multiply(outer: int, inner: int) -> None:
    text = f"""#1=0
WHILE [#1 LT {outer}] DO1
#2=0
WHILE [#2 LT {inner}] DO2
#101=#101+1
#2=#2+1
END2
#1=#1+1
END1
M30
"""
    assert common(run(text), 101) == outer * inner


def test_a_jump_out_of_a_loop_leaves_it() -> None:
    channel = run("DO1\n#101=#101+1\nIF [#101 EQ 5] GOTO 7\nEND1\nN7 M30\n")
    assert common(channel, 101) == 5


def test_a_jump_into_a_loop_finds_no_do() -> None:
    assert codes(run("GOTO 5\nDO1\nN5 #1=1\nEND1\nM30\n")) == ["PS1124"]


def test_a_subprogram_has_loops_of_its_own() -> None:
    text = "O0001\nDO1\nM98 P2\nIF [#101 GE 4] GOTO 9\nEND1\nN9 M30\n"
    text += "O0002\n#2=0\nWHILE [#2 LT 2] DO1\n#2=#2+1\n#101=#101+1\nEND1\nM99\n"
    channel = run(text)
    assert codes(channel) == []
    assert common(channel, 101) == 4


def test_a_computed_jump_is_rounded_to_a_whole_number() -> None:
    assert common(run("#1=9.6\nGOTO #1\n#101=1\nN10 M30\n"), 101) is None


@pytest.mark.parametrize(("target", "code"), [("77", "PS0128"), ("0", "PS1128"), ("[0-1]", "PS1128")])
def test_a_jump_that_leads_nowhere_is_an_alarm(target: str, code: str) -> None:
    assert codes(run(f"GOTO {target}\nM30\n")) == [code]


def test_the_text_of_an_alarm_is_the_comment_behind_it() -> None:
    (alarm,) = run("IF [1 EQ 1] THEN #3000=5(Check Gauge)\nM30\n").alarms
    assert (alarm.code, alarm.detail) == ("MC3005", "Check Gauge")


@pytest.mark.parametrize(
    ("value", "form", "printed"),
    [
        ("12.3456", "42", "   12.35"),
        ("-0.5", "31", "-   .5".replace(" .", "0.")),
        ("7", "20", "  7"),
        ("-7", "20", "- 7"),
        ("0", "11", " 0.0"),
    ],
)
def test_printed_numbers_have_a_sign_place_and_blanks(value: str, form: str, printed: str) -> None:
    channel = run(f"#1={value.replace('-', '0-')}\nDPRNT[#1[{form}]]\nM30\n")
    events = [row.event for row in channel.toolpath.rows() if row.event and row.event.type == "print"]
    assert [event.data["text"] for event in events] == [printed]
