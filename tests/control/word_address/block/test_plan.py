"""Plans: blocks of one shape share a plan, and every word of a block is taken by somebody."""

from __future__ import annotations

import string
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.registry import control
from tests.support import codes, ends, run

CONTROLS = ("fanuc-m", "meldas-m")
#: Alarms of a word that nothing takes, and of a G code that is not in the table.
WORD = {"fanuc-m": "PS0009", "meldas-m": "P32"}
CODE = {"fanuc-m": "PS0010", "meldas-m": "P34"}


def test_blocks_of_one_shape_share_a_plan() -> None:
    channel = run("G1 F100 X1.\nX2.\nX3.\nX4. Y1.\nM30\n")
    plans = list(channel.mode.plans)
    assert plans.count(("X.",)) == 1


def test_a_plan_holds_in_its_modal_state_only() -> None:
    assert ends(run("G0 X1.\nX2.\nG91\nX2.\nG90\nX2.\nM30\n")) == [(1, 0, 0), (2, 0, 0), (4, 0, 0), (2, 0, 0)]


def test_a_change_of_parameters_makes_new_plans() -> None:
    text = "G0 X10\nG10 L50\nN3401 R1\nG11\nX10\nM30\n"
    assert ends(run(text)) == [(0.01, 0, 0), (10, 0, 0)]


@pytest.mark.parametrize("control_id", CONTROLS)
@given(
    letter=st.sampled_from(sorted(set(string.ascii_uppercase) - set("GMNOXYZFSTHDB"))),
    value=st.integers(1, 9),
)
def test_no_word_is_dropped_in_silence(control_id: str, letter: str, value: int) -> None:
    assert codes(run(f"G0 X1. {letter}{value}\nM30\n", control_id)) == [WORD[control_id]]


@pytest.mark.parametrize("control_id", CONTROLS)
def test_every_code_of_the_table_runs_or_says_why_not(control_id: str) -> None:
    """A code alone or with words ends the program or raises an alarm that the catalogue knows."""
    chosen: Any = control(control_id)
    for code in chosen.g_codes:
        for words in ("", " X1.", " X1. Y1. Z1. R1. F100", " P1", " Q1 I1. J1. K1"):
            channel = run(f"F50 S100 M3\n{code}{words}\nM30\n", control_id)
            for alarm in channel.alarms:
                assert alarm.code in chosen.catalogue, f"{code}{words}: {alarm.code}"
                assert "{" not in chosen.catalogue.text(alarm.code, **alarm.args), f"{code}{words}: {alarm}"


@pytest.mark.parametrize("control_id", CONTROLS)
def test_a_code_that_is_not_in_the_table_is_an_alarm(control_id: str) -> None:
    assert codes(run("G999\nM30\n", control_id)) == [CODE[control_id]]


def test_a_refused_block_changes_nothing() -> None:
    channel = run("G1 F100 X5.\nG0 X9. Q1\n")
    assert ends(channel) == [(5, 0, 0)]
    assert channel.coordinates.position[0] == 5.0


def test_words_act_in_the_order_of_the_control_not_of_the_text() -> None:
    assert ends(run("X5. F100 G1 G91\nX5.\nM30\n")) == [(5, 0, 0), (10, 0, 0)]
