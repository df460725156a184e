"""Whatever a block says, it runs or raises an alarm of the catalogue; nothing else."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.control.sinumerik.control import Sinumerik
from polycnc.control.sinumerik.gcodes import GROUP_OF, NOT_EXECUTED
from polycnc.control.sinumerik.words import COMPANIONS, WORDS
from tests.control.sinumerik.support import run

NUMBERS = st.one_of(st.integers(-5, 40), st.floats(-50, 400).map(lambda value: round(value, 3)))
MODIFIERS = st.sampled_from([*[""] * 30, "AC", "IC", "DC", "ACP", "DIC", "RAC", "CAC", "QU"])
INDICES = st.sampled_from([*[""] * 30, "[X]", "[2]", "[A]"])
ADDRESSES = st.sampled_from([*"XYZA" * 8, *"IJK" * 2, "X1", "POS", "S2", *sorted(WORDS), *sorted(COMPANIONS)])
CODES = st.sampled_from(sorted(set(GROUP_OF) - NOT_EXECUTED - {"-"}))
CATALOGUE = Sinumerik().catalogue


@st.composite
def word(draw: st.DrawFn) -> str:
    address, index, modifier, value = draw(ADDRESSES), draw(INDICES), draw(MODIFIERS), draw(NUMBERS)
    return f"{address}{index}={modifier}({value})" if modifier else f"{address}{index}={value}"


@st.composite
def block(draw: st.DrawFn) -> str:
    codes = draw(st.lists(CODES, max_size=2))
    return " ".join([*codes, *draw(st.lists(word(), max_size=3))])


@settings(max_examples=300, deadline=None)
@given(st.lists(block(), min_size=1, max_size=4))
def test_every_block_runs_or_alarms(lines: list[str]) -> None:
    result = run(
        "G1 F100 S500 T1 D1",
        *lines,
        machine="mill4",
        tools={1: {"length": 50, "radius": 3}},
        work_offsets={"G54": {"X": 1, "A": 2}},
    )
    assert all(alarm.code in CATALOGUE for alarm in result.alarms), [alarm.code for alarm in result.alarms]
    assert all(value == value for row in result.rows if "to" in row for value in row["to"].values())
