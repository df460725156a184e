from __future__ import annotations

from typing import TYPE_CHECKING
from unittest.mock import patch

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.language.sinumerik.joining import Joiner
from tests.language.sinumerik.running import run, value

if TYPE_CHECKING:
    from polycnc.session import Result

SIMPLE = [
    "R1=R1+1",
    "R2=R2+R1*2 R3=R3-1",
    "II=II+1",
    "AA[II MOD 5]=R1",
    "R4=AA[1]+SIN(II)",
    "G1 X=IC(1)",
    "G1 X=R1 Y=II",
    "M7",
    "IF R1>4 GOTOF OUT",
    "IF R1==2 GOTOF SKIP",
    "SUBB",
]


@st.composite
def bodies(draw: st.DrawFn, depth: int = 0) -> list[str]:
    lines: list[str] = []
    for _ in range(draw(st.integers(1, 4))):
        kind = draw(st.sampled_from(["simple", "simple", "if", "for", "while", "repeat", "loop"]))
        if kind == "simple" or depth == 3:
            lines.append(draw(st.sampled_from(SIMPLE)))
            continue
        inner = draw(bodies(depth + 1))
        if kind == "if":
            other = ["ELSE", *draw(bodies(depth + 1))] if draw(st.booleans()) else []
            lines += [f"IF II MOD {draw(st.integers(2, 4))}==0", *inner, *other, "ENDIF"]
        elif kind == "for":
            lines += [f"FOR JJ[{depth}]=1 TO {draw(st.integers(0, 4))}", *inner, "ENDFOR"]
        elif kind == "while":
            limit = draw(st.integers(3, 12))
            lines += [f"WHILE KK<{limit}", "KK=KK+1", *inner, "ENDWHILE"]
        elif kind == "repeat":
            lines += ["REPEAT", "KK=KK+1", *inner, f"UNTIL KK>={draw(st.integers(1, 20))}"]
        else:
            lines += ["LOOP", "KK=KK+1", *inner, "IF KK>25 GOTOF OUT", "ENDLOOP"]
    return lines


def outcome(result: Result) -> tuple[object, ...]:
    names = ("R1", "R2", "R3", "R4", "II", "KK", "AA[0]", "AA[1]")
    return (
        [(row["type"], row.get("to"), row.get("line"), row.get("code")) for row in result.rows],
        [(alarm.code, alarm.line, alarm.column) for alarm in result.alarms],
        [result.variables[name] for name in names],
    )


@settings(max_examples=80, deadline=None)
@given(bodies())
def test_joined_blocks_do_what_they_do_one_by_one(body: list[str]) -> None:
    program = "\n".join(
        [
            "DEF INT II, KK, JJ[4]",
            "DEF REAL AA[5]",
            "G1 F100",
            "AGAIN: R5=R5+1",
            *body,
            "SKIP: R6=R6+1",
            "IF R5<4 GOTOB AGAIN",
            "OUT: M30",
        ]
    )
    files = {"SUBB.SPF": "R7=R7+1\nII=R7\nG1 Z=R7\nM17".replace("II=R7\n", "")}
    joined = outcome(run(program, files))
    with patch.object(Joiner, "step", lambda *_: None):
        one_by_one = outcome(run(program, files))
    assert joined == one_by_one


def test_an_alarm_in_a_joined_loop_names_its_line_and_takes_back_its_block_only() -> None:
    program = "DEF INT II\nG1 F100\nFOR II=1 TO 100\nG1 X=II\nR1=II\nG1 Y=1/(50-II)\nENDFOR"
    result = run(program)
    assert [(alarm.code, alarm.line) for alarm in result.alarms] == [("14051", 6)]
    assert result.variables["R1"] == 50
    assert sum("to" in row for row in result.rows) == 50 + 49


def test_a_long_loop_hands_over_now_and_then() -> None:
    assert value("DEF INT II\nFOR II=1 TO 20000\nR1=R1+1\nENDFOR") == 20000
    assert value("WHILE R1<20000\nR1=R1+1\nENDWHILE") == 20000
    assert value("REPEAT\nR1=R1+1\nUNTIL R1>=20000") == 20000


def test_an_endless_loop_of_calculations_reaches_the_block_limit() -> None:
    result = run("LOOP\nR1=R1+1\nENDLOOP")
    assert [alarm.code for alarm in result.alarms] == ["PC0002"]


def test_a_branch_that_comes_to_life_late_is_joined_too() -> None:
    program = "DEF INT II\nFOR II=1 TO 100\nIF II>50\nR1=R1+1\nELSE\nR2=R2+1\nENDIF\nENDFOR\nR3=II"
    assert [value(program, name) for name in ("R1", "R2", "R3")] == [50, 50, 101]


@pytest.mark.parametrize(("single_block", "made"), [(False, True), ("SBL1", False)])
def test_blocks_that_run_one_by_one_are_not_joined(*, single_block: bool | str, made: bool) -> None:
    with patch.object(Joiner, "step", autospec=True, side_effect=Joiner.step) as step:
        result = run(
            "FOR R1=1 TO 5\nR2=R2+R1\nR3=R2\nENDFOR", setup={"switches": {"single_block": single_block}}
        )
    assert (result.variables["R3"], step.called) == (15, made)
