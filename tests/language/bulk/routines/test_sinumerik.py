# ruff: noqa: E501 - programs stand as they are written
"""Loops, branches, jumps and expressions of the NC language give the same whether the scanner runs them or not."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.channel.states import standstill
from polycnc.language.bulk.compiled import LIBRARY
from polycnc.language.bulk.settings import Bulk
from polycnc.session import open_session
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned

CONTROL = "sinumerik-840d"
HEAD = (
    "DEF INT COUNT,NUM=3\nDEF REAL LEN=2.5,LIST[5]\nDEF BOOL FLAG\nDEF INT GRID[3,4]\nDEF REAL LLI 0 ULI 100 TIGHT\n"
    'DEF STRING[20] NAME="A"\nDEF CHAR SIGN="B"\n'
    "G90 G17 G54 G1 F1000 X1\nR1=1.5 R2=-0.01 R3=0 R5=90 R7=7\n"
)
SETUP = {"work_offsets": {"G54": {"X": 10, "Y": -3.3}, "G55": {"X": 1}}}

REALS = (
    "R1", "R2", "R3", "R5", "LEN", "LIST[2]", "LIST[NUM]", "LIST[COUNT MOD 5]", "R[NUM]", "R[COUNT+1]", "2.5", "-0.0", "0.",
    "R1*R2", "R1/R3", "(R1+R2)*3", "R1-NUM", "SIN(R5)", "COS(R7*30)", "TAN(R5)", "ASIN(R2)", "ACOS(R1)", "ATAN2(R1,R2)", "SQRT(R2)",
    "SQRT(R7)", "POT(R1)", "ABS(R2)", "TRUNC(R1*-3)", "ROUND(R2)", "ROUNDUP(R1)", "R7 DIV 2", "R7 MOD 2.5", "-R7 MOD 2", "NUM/2", "-R3",
    "MINVAL(R1,R2)", "MAXVAL(1,R2)", "LN(R1)", "EXP(R2)", "R1EX2", "1EX2*R1", "$P_EP[X]", "TIGHT", "BOUND(0,1,R1)", "R999", "R1000", "'HF'*R1",
    "LIST[7]", "R[-1]", "5", "NUM", "FLAG", "1EX299*1EX299", "R7*R7*R7*R7*R7*R7*R7*R7", "UNKNOWN", "R1 + R2 - 3 * LEN", "X",
)  # fmt: skip
WHOLES = (
    "NUM", "COUNT", "3", "0", "-2", "NUM+1", "NUM*COUNT", "NUM DIV 2", "-NUM DIV 2", "NUM MOD 2", "-7 MOD NUM", "COUNT MOD 0", "NUM DIV 0",
    "R1", "R1*2", "2147483647+NUM", "2147483647*2147483647*2147483647", "ROUND(R1)", "ABS(-NUM)", "GRID[1,2]", "GRID[NUM,1]", "FLAG", "MINVAL(NUM,2)",
    "NUM B_AND 1", "-NUM", "0*-NUM", "4000000000", "3000000000*R1", "SIGN", "STRLEN(NAME)",
)  # fmt: skip
TRUTHS = (
    "R1>R2", "R1<NUM", "R1==1.5", "R1<>R2", "R1>=R1", "R2<=-0.01", "NUM==3", "NUM<>3", "COUNT<2", "FLAG", "NOT FLAG", "TRUE", "R3", "NUM",
    "R1>0 AND R2<0", "R3==1 OR R1/R3>1", "FLAG XOR NUM>2", "R1==R1+1EX-13", "R1<R1+1EX-13", "(R1+R2)*1000>NUM", 'NAME=="A"', "R3 AND FLAG",
    "1/3*3==1", "R1*R7>10.5", "R1*R7>=10.5",
)  # fmt: skip
BLOCKS = (
    "X=R1*2", "Y=LIST[NUM] Z=-R2", "G1 X=R1+0.5 F=R7*100", "G91 X=R1", "G90", "G0 X=NUM Y5", "G2 X=R1 Y=R1 CR=R7*3", "G2 X10 Y0 I=R1 J0",
    "G90 G3 I=LEN", "G1 X5 Y-0", "N70 X7 ; A", "X=R1/R3", "F=R3", "F=-R1", "M3 S=R7*100", "M8", "G55", "G54", "G4 F0.1", "X=IC(R1)", "X=AC(1) Y=R1",
    "G41 X9", "G40 G0 X0 Y0", "TRANS X=R1", "TRANS", "T1 D1", 'MSG("A")', "X=SIN(R5)*R1 Y=COS(R5)*R1", "STOPRE", "A5", "X1 X2", "G18", "G17",
    "/X3", "X=R1000", "Z=LIST[COUNT MOD 5]", "ROT RPL=R5", "G70", "G71", "SPOS=R5", "X=R1 R1=R2", "G64", "G642", "RND=R7 X20", "X = R1 + 1", "AX[X]=5",
)  # fmt: skip
TARGETS = st.sampled_from(
    (
        "R1",
        "R2",
        "R3",
        "R7",
        "R[NUM]",
        "R[COUNT+10]",
        "R999",
        "LEN",
        "LIST[1]",
        "LIST[COUNT MOD 5]",
        "LIST[NUM+2]",
        "TIGHT",
        "R1001",
        "$P_UIFR[1,X,TR]",
    )
)
WHOLE_TARGETS = st.sampled_from(("NUM", "COUNT", "GRID[NUM,1]", "GRID[1,2]", "GRID[COUNT MOD 3,0]"))
LABELS = ("ANF", "MITTE", "ENDE")


@st.composite
def assignment(draw: st.DrawFn) -> str:
    kind = draw(st.integers(0, 5))
    if kind < 3:
        return f"{draw(TARGETS)}={draw(st.sampled_from(REALS))}"
    if kind == 3:
        return f"{draw(WHOLE_TARGETS)}={draw(st.sampled_from(WHOLES))}"
    if kind == 4:
        return f"FLAG={draw(st.sampled_from(TRUTHS))}"
    return f"R1=R1+0.25 R2={draw(st.sampled_from(REALS))}"


@st.composite
def line(draw: st.DrawFn) -> str:
    kind = draw(st.integers(0, 6))
    if kind < 3:
        return draw(st.sampled_from(BLOCKS))
    if kind < 6:
        return draw(assignment())
    word = draw(st.sampled_from(("GOTOF", "GOTOB", "GOTO", "GOTOC")))
    label = draw(st.sampled_from((*LABELS, "N70", "NIRGENDS")))
    return f"IF {draw(st.sampled_from(TRUTHS))} {word} {label}"


@st.composite
def structure(draw: st.DrawFn, depth: int = 0) -> list[str]:
    """A loop or a branch with others in it."""

    def body() -> list[str]:
        lines = draw(st.lists(line(), max_size=4))
        return [*lines, *draw(structure(depth + 1))] if depth < 2 and draw(st.booleans()) else lines

    passes = draw(st.integers(0, 9))
    kind = draw(st.integers(0, 5))
    count = f"R{20 + depth}"
    if kind == 0:
        counter = draw(st.sampled_from(("COUNT", f"R{30 + depth}")))
        return [f"FOR {counter}={draw(st.sampled_from(('0', '1.4', 'NUM')))} TO {passes}", *body(), "ENDFOR"]
    if kind == 1:
        return [f"{count}=0", f"WHILE {count}<{passes}", f"{count}={count}+1", *body(), "ENDWHILE"]
    if kind == 2:
        return [f"{count}=0", "REPEAT", f"{count}={count}+1", *body(), f"UNTIL {count}>={passes}"]
    if kind == 3:
        out = draw(st.sampled_from(LABELS))
        return [
            f"{count}=0",
            "LOOP",
            f"{count}={count}+1",
            *body(),
            f"IF {count}>{passes} GOTOF {out}",
            "ENDLOOP",
        ]
    if kind == 4:
        return [f"IF {draw(st.sampled_from(TRUTHS))}", *body(), "ELSE", *body(), "ENDIF"]
    return [f"IF {draw(st.sampled_from(TRUTHS))}", *body(), "ENDIF"]


@st.composite
def programs(draw: st.DrawFn) -> str:
    parts: list[str] = []
    for label in LABELS:
        parts += draw(
            st.one_of(structure(), st.lists(line(), min_size=1, max_size=3).map(lambda lines: lines * 4))
        )
        parts.append(f"{label}: {draw(st.sampled_from(('R9=R9+1', 'X1', 'X=R1')))}")
        if draw(st.booleans()):
            parts.append(f"IF R9<{draw(st.integers(1, 12))} GOTOB {label}")
    return HEAD + "\n".join([*parts, "M30", ""])


@settings(max_examples=examples(14), deadline=None)
@given(programs())
def test_programs_that_calculate_and_loop_give_the_same(text: str) -> None:
    assert differences(text, CONTROL, SETUP, block_limit=1_500) == []


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@settings(max_examples=examples(14), deadline=None)
@given(programs(), st.integers(1, 400), st.sampled_from((3, 200)))
def test_the_compiled_kernel_gives_the_same_up_to_any_limit(text: str, limit: int, rooms: int) -> None:
    bulk = Bulk(fewest_lines=0, rooms=rooms, most_patience=1)
    assert differences(text, CONTROL, SETUP, bulk, block_limit=limit) == []


@settings(max_examples=examples(6), deadline=None)
@given(programs(), st.integers(2, 7), st.sampled_from((40.0, 400.0)))
def test_limits_of_travel_and_room_give_the_same(text: str, rooms: int, travel: float) -> None:
    assert (
        differences(text, CONTROL, SETUP, replace(PLAIN, rooms=rooms), block_limit=800, travel=travel) == []
    )


@st.composite
def expression(draw: st.DrawFn, depth: int = 0) -> str:
    """Operands, operators, functions, brackets and blanks as they come."""
    blank = st.sampled_from(("", "", "", " "))
    parts = [draw(st.sampled_from(("", "", "", "-", "+", "- ")))]
    for place in range(draw(st.integers(1, 3))):
        if place:
            operator = draw(st.sampled_from(("+", "-", "*", "/", "*", " DIV ", " MOD ", "**", "+-")))
            parts.append(draw(blank) + operator + draw(blank))
        kind = draw(st.integers(0, 5 if depth < 2 else 3))
        if kind < 2:
            parts.append(f"R{draw(st.sampled_from((1, 2, 3, 5, 7, 12, 999, 1000)))}")
        elif kind < 4:
            parts.append(
                draw(
                    st.sampled_from(("2", "0.5", ".25", "3.", "10", "007", "1EX2", "1234567890", "0", "360"))
                )
            )
        else:
            name = draw(
                st.sampled_from(
                    ("", "", "SIN", "COS", "TAN", "ABS", "SQRT", "POT", "ROUND", "TRUNC", "ASIN", "sin", "LN")
                )
            )
            parts.append(f"{name}({draw(blank)}{draw(expression(depth + 1))}{draw(blank)})")
    return "".join(parts)


@settings(max_examples=examples(12), deadline=None)
@given(
    st.lists(
        st.tuples(
            st.sampled_from(("X=", "G1 X=", "R12=", "R1=", "Y5 X = ", "X=5 Y=", "N5R2=", "F=", "CR=")),
            expression(),
        ),
        max_size=5,
    )
)
def test_random_expressions_give_the_same(found: list[tuple[str, str]]) -> None:
    lines = "\n".join(head + value for head, value in found)
    assert differences(f"{HEAD}{lines}\nR1=R1+0.5\n{lines}\n{lines}\nM30\n", CONTROL, SETUP) == []
    assert differences(f"{HEAD}FOR R10=1 TO 3\n{lines}\nR1=R1+0.5\nENDFOR\nM30\n", CONTROL, SETUP) == []


@pytest.mark.parametrize("value", REALS)
@pytest.mark.parametrize("head", ["X=", "LEN="])
def test_every_expression_gives_the_same(head: str, value: str) -> None:
    assert differences(f"{HEAD}FOR R10=1 TO 4\n{head}{value}\nR1=R1+1\nENDFOR\nM30\n", CONTROL, SETUP) == []
    assert differences(f"{HEAD}{f'{head}{value}{chr(10)}R1=R1+1{chr(10)}' * 4}M30\n", CONTROL, SETUP) == []


@pytest.mark.parametrize("value", WHOLES)
def test_every_whole_expression_gives_the_same(value: str) -> None:
    body = f"COUNT={value}\nR[12]={value}\nGRID[2,3]={value}\nR1=R1+1\nNUM=NUM+1"
    assert differences(f"{HEAD}FOR R10=1 TO 4\n{body}\nENDFOR\nM30\n", CONTROL, SETUP) == []


@pytest.mark.parametrize("truth", TRUTHS)
def test_every_condition_gives_the_same(truth: str) -> None:
    body = f"FLAG={truth}\nIF {truth}\nX=R1\nELSE\nX=R2\nENDIF\nR1=R1+1\nR3=R3+1"
    assert differences(f"{HEAD}FOR R10=1 TO 4\n{body}\nENDFOR\nM30\n", CONTROL, SETUP) == []


@pytest.mark.parametrize(
    ("body", "blocks"),
    [
        ("FOR COUNT=0 TO 99\nX=COUNT*0.5\nENDFOR", 200),
        ("WHILE R10<100\nR10=R10+1\nX=R10 Y=SIN(R10)\nENDWHILE", 400),
        ("REPEAT\nR10=R10+1\nLIST[NUM]=R10\nX=LIST[NUM]\nUNTIL R10>=100", 400),
        ("LOOP\nR10=R10+1\nIF R10>100 GOTOF ENDE\nX=R10\nENDLOOP\nENDE: X1", 400),
        ("ANF: R10=R10+1\nIF R10 MOD 2==0\nX=R10\nELSE\nY=R10\nENDIF\nIF R10<100 GOTOB ANF", 500),
        ("R10=R10+0.1\nX=R10*2 Y=R10+R1\n" * 100, 200),
    ],
)
def test_the_scanner_runs_hot_loops_by_itself(body: str, blocks: int) -> None:
    text = f"{HEAD}{body}\nM30\n"
    assert scanned(text, CONTROL, SETUP) > 0.9 * blocks
    assert differences(text, CONTROL, SETUP) == []


def test_a_loop_that_waits_for_ever_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(standstill, "PATIENCE", 2_000)
    session = open_session(
        f"{HEAD}R1=1\nWHILE R1==1\nR2=R2\nENDWHILE\nM30\n", control=CONTROL, block_limit=500_000
    )
    session.channel.bulk = PLAIN
    (alarm,) = session.run().alarms
    assert alarm.code == "PC0013"


def test_a_line_that_fails_changes_nothing() -> None:
    text = f"{HEAD}R4=5\nLOOP\nR4=R4-1 R5=1/R4 R6=R5\nENDLOOP\nM30\n"
    channel = run(text, CONTROL, SETUP, PLAIN)
    assert [alarm.code for alarm in channel.alarms] == [
        alarm.code for alarm in run(text, CONTROL, SETUP).alarms
    ]
    assert differences(text, CONTROL, SETUP) == []


@pytest.mark.parametrize(
    "change",
    ["DEFINE R1 AS R2", "DEF REAL SIN", "DEF REAL X1LEN", "REDEF R1 ULI 5", "DEFINE COUNTS AS R1=R1+1"],
)
def test_names_that_get_another_meaning_give_the_same(change: str) -> None:
    blocks = "X=R1+1\nX=SIN(R5)\nR1=R1+0.5\n" * 6
    assert differences(f"{change}\n{HEAD}{blocks}M30\n", CONTROL, SETUP) == []
    assert differences(f"{HEAD}{blocks}{change}\n{blocks}M30\n", CONTROL, SETUP) == []
