"""Whatever a block says, it runs or raises an alarm of the catalogue; nothing else."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.control.sinumerik.block.procedures import PROCEDURES
from polycnc.control.sinumerik.block.words import COMPANIONS, WORDS
from polycnc.control.sinumerik.control import Sinumerik
from polycnc.control.sinumerik.gcodes import GROUP_OF, NOT_EXECUTED
from polycnc.control.sinumerik.variables.functions import FUNCTIONS
from polycnc.control.sinumerik.variables.registry import VARIABLES
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


@settings(max_examples=150, deadline=None)
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


ARGUMENTS = st.sampled_from(["X", "A", "S1", "1", "2", "-3", "0.5", '"X"', '"TEXT"', "TRUE", "", "R5"])
PROCEDURE_NAMES = st.sampled_from(sorted(set(PROCEDURES) - {"SETAL"}))
FUNCTION_NAMES = st.sampled_from(sorted(set(FUNCTIONS)))
VARIABLE_NAMES = st.sampled_from(sorted(VARIABLES))


@settings(max_examples=100, deadline=None)
@given(PROCEDURE_NAMES, st.lists(ARGUMENTS, max_size=3))
def test_every_procedure_runs_or_alarms(name: str, arguments: list[str]) -> None:
    result = run(f"{name}({','.join(arguments)})", machine="mill4")
    assert all(alarm.code in CATALOGUE for alarm in result.alarms), [alarm.code for alarm in result.alarms]


@settings(max_examples=100, deadline=None)
@given(FUNCTION_NAMES, st.lists(ARGUMENTS, max_size=4))
def test_every_function_gives_a_value_or_alarms(name: str, arguments: list[str]) -> None:
    result = run(f"R1={name}({','.join(arguments)})", machine="mill4")
    assert all(alarm.code in CATALOGUE for alarm in result.alarms), [alarm.code for alarm in result.alarms]


@settings(max_examples=150, deadline=None)
@given(VARIABLE_NAMES, st.lists(ARGUMENTS.filter(bool), max_size=3), st.booleans(), ARGUMENTS.filter(bool))
def test_every_variable_is_read_and_written_or_alarms(
    name: str, indices: list[str], writes: bool, value: str
) -> None:
    place = f"{name}[{','.join(indices)}]" if indices else name
    line = f"{place}={value}" if writes else f"R1={place}"
    result = run(line, "G0 X1", machine="mill4")
    assert all(alarm.code in CATALOGUE for alarm in result.alarms), [alarm.code for alarm in result.alarms]


@pytest.mark.parametrize(
    "line",
    [
        'MEASA[X]=("a",1) X5',
        'POLY X=PO(IC(1),"a") F1',
        "REDEF",
        'CPROTDEF("a",1)',
        "ADISPOSA[X]=5",
        "R1=CALCPOSI(5,5,5,5)",
        'IPOBRKA(X,"a")',
        "FINEA[5]",
        'R1=ADDFRAME(CTRANS(X,1),"$P_UIFR")',
    ],
)
def test_a_value_of_the_wrong_kind_alarms(line: str) -> None:
    alarms = run(line).alarms
    assert len(alarms) == 1
    assert alarms[0].code in CATALOGUE
