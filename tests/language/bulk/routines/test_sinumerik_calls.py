# ruff: noqa: E501 - programs stand as they are written
"""Subprograms of the NC language give the same whether the scanner runs them or not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.channel.channel import Channel
from polycnc.channel.stack import Level
from polycnc.language.bulk.compiled import LIBRARY
from polycnc.language.bulk.settings import Bulk
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned
from tests.language.bulk.routines.test_sinumerik import CONTROL, HEAD, SETUP, line

FOLDER = "/_N_WKS_DIR/_N_TEST_WPD/_N_{}_SPF"
CALLS = st.sampled_from(
    (
        "L1", "L1 P3", "L1 P=R7", "L2", "L2 P2", "SUB", "SUB P2", "SUB()", "SAVER", "GIVEN(R1)", "GIVEN(2,NUM)", "GIVEN(1.5) P2", "GIVEN(R1,R7)", "GIVEN(R1/R3)", "GIVEN(LIST[NUM],COUNT)", "GIVEN(,1)", "GIVEN", "OWN", "SELF", "L1 P0", "L9", "DEEP",
        'CALL "L1"', "L1 X5", "N5 L1", "M17", "RET", "SILENT", "EMPTY P3",
    )
)  # fmt: skip
ENDS = st.sampled_from(("M17", "RET", "", "X5 M17", "M30", "M17 ; END", "IF R9>5 GOTOF OUT\nM17\nOUT: RET"))
#: Variables of the main program, which subprograms do not know.
OWN_NAMES = ("COUNT", "NUM", "LEN", "LIST", "GRID", "FLAG", "TIGHT", "NAME", "SIGN")
LINES = st.one_of(
    line(),
    st.sampled_from(
        ("R9=R9+1", "X=R9", "G91", "G90", "G91 X0.1", "Y=R1+R9", "FOR R40=1 TO 3\nX=R40\nENDFOR")
    ),
)


def _knows_itself(text: str) -> bool:
    return not any(name in text for name in OWN_NAMES)


@st.composite
def files(draw: st.DrawFn) -> dict[str, str]:
    """Subprograms; some call others."""

    def body(*extra: str) -> str:
        lines = [*draw(st.lists(LINES.filter(_knows_itself), max_size=4)), *extra, draw(ENDS)]
        return "\n".join(["ANF: R9=R9+0.5", *lines, "MITTE: R9=R9+1", "ENDE: RET", ""])

    texts = {
        "L1": body(),
        "L2": body("L1", draw(CALLS)),
        "SUB": "PROC SUB\n" + body(draw(CALLS)),
        "SAVER": "PROC SAVER SAVE\n" + body("G91"),
        "GIVEN": "PROC GIVEN(REAL A,INT B=2)\nR11=A*B\nX=A\n" + body(),
        "OWN": "DEF REAL MINE=R1\nMINE=MINE+1\nX=MINE\n" + body(),
        "SELF": "R12=R12+1\nX=R12\nIF R12 MOD 5<>0\nSELF\nENDIF\nM17\n",
        "DEEP": "L2\nSUB\nX=R9\nM17\n",
        "SILENT": "PROC SILENT SBLOF DISPLOF\nX=R1\nM17\n",
        "EMPTY": "",
    }
    return {FOLDER.format(name): text for name, text in texts.items()}


@st.composite
def programs(draw: st.DrawFn) -> str:
    parts: list[str] = []
    for label in ("ANF", "MITTE", "ENDE"):
        lines = draw(st.lists(st.one_of(CALLS, CALLS, LINES), min_size=1, max_size=4))
        passes = draw(st.integers(2, 12))
        parts += draw(
            st.sampled_from(
                (
                    [f"FOR COUNT=1 TO {passes}", *lines, "ENDFOR"],
                    ["R20=0", "REPEAT", *lines, "R20=R20+1", f"UNTIL R20>={passes}"],
                    lines * 4,
                )
            )
        )
        parts.append(f"{label}: R9=R9+1")
    return HEAD + "\n".join([*parts, "M30", ""])


@settings(max_examples=examples(14), deadline=None)
@given(programs(), files())
def test_programs_that_call_give_the_same(text: str, called: dict[str, str]) -> None:
    assert differences(text, CONTROL, SETUP, files=called, block_limit=1_500) == []


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@settings(max_examples=examples(14), deadline=None)
@given(programs(), files(), st.integers(1, 400), st.sampled_from((3, 200)))
def test_calls_in_the_compiled_kernel_give_the_same_up_to_any_limit(
    text: str, called: dict[str, str], limit: int, rooms: int
) -> None:
    bulk = Bulk(fewest_lines=0, rooms=rooms, most_patience=1)
    assert differences(text, CONTROL, SETUP, bulk, files=called, block_limit=limit) == []


@settings(max_examples=examples(6), deadline=None)
@given(programs(), files(), st.integers(2, 7), st.sampled_from((40.0, 400.0)))
def test_limits_of_travel_and_room_give_the_same(
    text: str, called: dict[str, str], rooms: int, travel: float
) -> None:
    bulk = replace(PLAIN, rooms=rooms)
    assert differences(text, CONTROL, SETUP, bulk, files=called, block_limit=800, travel=travel) == []


@pytest.mark.parametrize(
    ("call", "head"),
    [
        ("L1 P2", ""),
        ("SUB P2", "PROC SUB\n"),
        ("SUB(R1,COUNT) P2", "PROC SUB(REAL A,INT B)\n"),
        ("SUB(R1) P2", "PROC SUB(REAL A,INT B=2)\nDEF REAL MINE=A*B,OTHER\nOTHER=OTHER+MINE\nX=OTHER\n"),
    ],
)
@pytest.mark.parametrize("end", ["M17", "RET", ""])
def test_the_scanner_runs_calls_by_itself(call: str, head: str, end: str) -> None:
    called = {
        FOLDER.format(
            call.split("(", maxsplit=1)[0].split(maxsplit=1)[0]
        ): f"{head}G91 X=R1\nR1=R1+0.1\nG90\n{end}\n"
    }
    text = f"{HEAD}FOR COUNT=1 TO 60\n{call}\nX=COUNT\nENDFOR\nM30\n"
    assert scanned(text, CONTROL, SETUP, files=called) > 400
    assert differences(text, CONTROL, SETUP, files=called) == []


@pytest.mark.parametrize("limit", range(300, 340, 5))
def test_a_limit_within_a_call_leaves_the_same_levels(limit: int) -> None:
    called = {
        FOLDER.format("SUB"): "PROC SUB(REAL A,INT B=2)\nDEF REAL MINE=A*B\nX=MINE+$P_SUBPAR[1]\nL1\nM17\n",
        FOLDER.format("L1"): "R5=R5+1\nX=R5\n",
    }
    text = f"{HEAD}FOR COUNT=1 TO 60\nSUB(COUNT) P2\nENDFOR\nM30\n"
    one, other = (run(text, CONTROL, SETUP, bulk, files=called, block_limit=limit) for bulk in (None, PLAIN))
    assert levels(one) == levels(other)


def levels(channel: Channel) -> list[object]:
    """Where every level of a program stands, and what its call has left."""
    return [
        (level.code.program.name, level.index, level.repeats, level.kind, level.data)
        for level in channel.stack
    ]


def own(level: Level[Any]) -> list[object]:
    """Local variables of a level."""
    assert isinstance(level.locals, list)
    return [getattr(value, "items", value) for value in level.locals]


def test_a_call_too_deep_alarms_at_the_same_block() -> None:
    called = {FOLDER.format(f"L{n}"): f"X{n}\nL{n + 1}\nM17\n" for n in range(1, 20)}
    text = f"{HEAD}FOR COUNT=1 TO 4\nL8\nENDFOR\nL1\nM30\n"
    called[FOLDER.format("L20")] = "X1\nM17\n"
    assert run(text, CONTROL, SETUP, files=called).alarms
    assert differences(text, CONTROL, SETUP, files=called) == []
