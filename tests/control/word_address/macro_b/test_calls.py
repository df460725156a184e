"""Subprograms, macros and registered codes: arguments, levels, lifetimes, refusals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.word_address.macro_b.macro_calls import ARGUMENTS
from tests.support import codes, ends, run

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


def variables(channel: Channel, *numbers: int) -> list[float | None]:
    return [channel.memory.read(number) for number in numbers]


def called(block: str, body: str, **setup: Any) -> Channel:
    """Run a block and, as O9300, what it calls."""
    return run(f"O0001\n{block}\nM30\nO9300\n{body}\nM99\n", **setup)


@given(st.permutations(sorted(set(ARGUMENTS) - set("MIJK"))), st.data())
def test_arguments_reach_their_variables_in_any_order(letters: list[str], data: st.DataObject) -> None:
    chosen = letters[: data.draw(st.integers(1, len(letters)))]
    words = "".join(f"{letter}{i + 1}." for i, letter in enumerate(chosen))
    body = "\n".join(f"#{100 + ARGUMENTS[letter]}=#{ARGUMENTS[letter]}" for letter in chosen)
    channel = called(f"G65 P9300 {words}", body)
    assert codes(channel) == []
    assert variables(channel, *(100 + ARGUMENTS[letter] for letter in chosen)) == [
        float(i + 1) for i in range(len(chosen))
    ]


@given(st.integers(1, 10))
def test_sets_of_i_j_k_follow_each_other(count: int) -> None:
    words = "".join(f"I{3 * n + 1}.J{3 * n + 2}.K{3 * n + 3}." for n in range(count))
    body = "\n".join(f"#{100 + n}=#{4 + n}" for n in range(3 * count))
    channel = called(f"G65 P9300 {words}", body)
    assert variables(channel, *range(100, 100 + 3 * count)) == [float(n + 1) for n in range(3 * count)]


def test_an_eleventh_set_is_refused() -> None:
    assert codes(called("G65 P9300 " + "I1." * 11, "")) == ["PS1095"]


def test_a_vacant_argument_stays_vacant() -> None:
    channel = called("G65 P9300 A#5 B[#5+1]", "#101=#1\n#102=#2")
    assert variables(channel, 101, 102) == [None, 1.0]


def test_locals_of_a_macro_vanish_and_those_of_the_caller_return() -> None:
    channel = called("#1=3\nG65 P9300 A8.\n#102=#1", "#101=#1\n#2=5")
    assert variables(channel, 101, 102, 2) == [8.0, 3.0, None]


def test_a_subprogram_shares_the_variables_of_its_caller() -> None:
    channel = called("#1=3\nM98 P9300\n#102=#1", "#1=#1+1")
    assert variables(channel, 102) == [4.0]


@pytest.mark.parametrize(("kind", "code"), [("M98 P9300", "PS0077"), ("G65 P9300", "PS0122")])
def test_calls_without_end_run_out_of_levels(kind: str, code: str) -> None:
    assert codes(called(kind, kind)) == [code]


@pytest.mark.parametrize("block", ["G65 A1.", "G65 P7777", "G66 P7777", "M98 P7777", "M98", "G65 <NONE>"])
def test_a_call_of_nothing_is_refused(block: str) -> None:
    assert codes(run(block + "\nM30\n")) == ["PS0076"]


def test_a_repeated_call_keeps_what_its_passes_changed() -> None:
    assert variables(called("M98 P9300 L4", "#101=#101+1"), 101) == [4.0]


def test_p_with_more_digits_holds_the_repeats() -> None:
    assert variables(called("M98 P39300", "#101=#101+1"), 101) == [3.0]


def test_long_program_numbers_take_all_digits() -> None:
    text = "O0001\nM98 P39300\nM30\nO39300\n#101=7\nM99\n"
    assert variables(run(text, setup={"parameters": {"11304#3": 1}}), 101) == [7.0]


REGISTERED = {"6050": 300, "6080": 80, "6071": 71, "6001#5": 1}


def registered(main: str, *programs: str, **parameters: int) -> Channel:
    text = f"O0001\n{main}\nM30\n" + "".join(program + "\nM99\n" for program in programs)
    return run(text, setup={"parameters": {**REGISTERED, **parameters}})


def test_a_g_code_that_calls_takes_arguments_and_its_neighbours_act() -> None:
    channel = registered("G91 G300 X4. F5.", "O9010\nG0 X#24\nX#24\n#101=#9")
    assert ends(channel) == [(4, 0, 0), (8, 0, 0)]
    assert variables(channel, 101) == [5.0]


def test_an_m_code_that_is_not_first_is_an_ordinary_one() -> None:
    channel = registered("G0 X1. M80", "O9020\n#101=1")
    assert variables(channel, 101) == [None]


def test_an_m_code_subprogram_lets_the_words_of_its_block_act_first() -> None:
    channel = registered("G0 X1. M71", "O9001\n#101=#5001")
    assert variables(channel, 101) == [1.0]


def test_inside_a_called_program_codes_call_nothing() -> None:
    channel = registered("M80", "O9020\nM71\nT4", "O9001\n#101=1", "O9000\n#102=1")
    assert variables(channel, 101, 102) == [None, None]


def test_codes_of_the_other_kind_may_call_by_parameter() -> None:
    channel = registered("M80", "O9020\nG300", "O9010\n#101=1", **{"6008#6": 1})
    assert variables(channel, 101) == [1.0]


def test_behind_the_return_codes_call_again() -> None:
    channel = registered("M80\nM80", "O9020\n#101=#101+1")
    assert variables(channel, 101) == [2.0]


def test_a_modal_macro_follows_moves_only() -> None:
    channel = called("G66 P9300\nM8\nG4 P1\nG0 X1.\nF5\nX2.\nG67\nX3.", "#101=#101+1")
    assert variables(channel, 101) == [2.0]


def test_an_interrupted_block_restores_the_modal_state() -> None:
    setup = {"switches": {"interrupts": [{"input": 1, "line": 3, "at": {"X": 2}}]}}
    text = "O0001\nM96 P9300\nG1 X5. F100\nX9.\nM30\nO9300\nG91 G0 Z1.\nM99\n"
    channel = run(text, setup=setup)
    assert ends(channel) == [(2, 0, 0), (2, 0, 1), (9, 0, 1)]
    assert channel.mode["distance"] == "G90"
