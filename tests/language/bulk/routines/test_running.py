"""Subprograms, macros and loops give the same whether the scanner runs them or the interpreter."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.channel.states import standstill
from polycnc.language.bulk.compiled import LIBRARY
from polycnc.language.bulk.settings import Bulk
from polycnc.session import open_session
from tests.language.bulk.both_ways import PLAIN, differences, run, scanned, variables

HEAD = "O0001\nG21 G90 G54 G0 X0 Y0 Z5.\nG1 F500.\n#1=1.5\n#2=-0.01\n#7=0\n#100=33.3333\n#500=7.0005\n"
SETUP = {"work_offsets": {"G54": {"X": 10, "Y": -3.3}}}

VALUES = st.sampled_from(
    (
        "#1", "#2", "#3", "#100", "#500", "#7", "1", "2.5", "0", "#33", "[#1+#100]", "[#2*3-#7]", "[#1/2.]", "[#1/#7]",
        "SIN[#1]", "-#2", "#0", "[#3]", "#5001", "ROUND[#1]", "ABS[#2]", "FIX[#100]", "[1.+#4]", "[#150]", "-[#7*#2]",
        "#[#7+1]", "1E5", "[#1MOD2]", "#[#1]", "[#[100]*2]", "ATAN[#1]/[#2]", "ASIN[#2]", "[#100AND12]",
        "[#1OR#2]", "TAN[#100]",
    )
)  # fmt: skip
TARGETS = st.sampled_from(
    (
        "#1",
        "#2",
        "#3",
        "#4",
        "#7",
        "#100",
        "#101",
        "#500",
        "#33",
        "#0",
        "#5001",
        "#[5]",
        "#[#1+2]",
        "#[#7]",
        "#1000",
    )
)
COMPARISONS = st.sampled_from(("EQ", "NE", "GT", "GE", "LT", "LE"))


@st.composite
def statement(draw: st.DrawFn) -> str:
    return f"{draw(TARGETS)}={draw(VALUES)}"


@st.composite
def condition(draw: st.DrawFn) -> str:
    return f"[{draw(VALUES)}{draw(COMPARISONS)}{draw(VALUES)}]"


BLOCKS = st.sampled_from(
    (
        "X#1", "Y[#1+0.5]Z#2", "G1X[#1*2]F[#100*10]", "G91", "G90", "G90G1X1.", "X1.Y2.", "G0Z#7", "G2X1.Y0.I0.5",
        "M3S500", "", "(A COMMENT)", ";", "G4X0.1", "/X5.", "N5X3.", "X#3", "Y#33", "M8", "G54", "G55", "F300", "S100",
        "G20", "G21", "X1000.", "G2I5.", "X5.;Y6.", "X[#4+1]", "M1", "G41D1X9.", "G40G1X0", "x1.",
    )
)  # fmt: skip
CALLS = st.sampled_from(
    (
        "M98P2", "M98P2L3", "M98P3", "G65P3A1.B2.", "G65P3A1B#1C[#1+1]", "G65P3L2A#3", "M98P4", "G65P4D3.", "M98P20002",
        "M98P2.", "M98P9999", "G65P3", "G65P3X1.Y2I1.J2.K3.I4.", "G65P3F5M3", "M98P#7", "M98P2Q7", "G66P3A1.", "G67",
        "M98 P2 L0", "G65P2A1.G90", "M98P-2", "G1X5.M98P2", "G65P3H2.S3", "M99", "M99P7",
    )
)  # fmt: skip


@st.composite
def line(draw: st.DrawFn, *, calls: bool = True) -> str:
    kind = draw(st.integers(0, 9 if calls else 6))
    if kind < 3:
        return draw(BLOCKS)
    if kind < 5:
        return draw(statement())
    if kind == 5:
        return f"IF{draw(condition())}THEN{draw(statement())}"
    if kind == 6:
        return f"IF{draw(condition())}GOTO{draw(st.sampled_from((7, 8, 9999)))}"
    return draw(CALLS)


@st.composite
def loop(draw: st.DrawFn, number: int = 1, *, calls: bool = True) -> list[str]:
    """A loop that counts up one of the variables, with others in it."""
    counter = f"#{20 + number}"
    body = draw(st.lists(line(calls=calls), max_size=5))
    if number < 3 and draw(st.booleans()):
        body += draw(loop(number + 1, calls=calls))
    body.append(f"{counter}={counter}+1")
    body += draw(st.lists(line(calls=calls), max_size=2))
    passes = draw(st.integers(1, 12))
    begin = draw(st.sampled_from((f"WHILE[{counter}LT{passes}]DO{number}", f"DO{number}")))
    leave = [f"IF[{counter}GE{passes}]GOTO{draw(st.sampled_from((7, 8)))}"] if begin[0] == "D" else []
    return [f"{counter}=0", begin, *body, *leave, f"END{number}"]


@st.composite
def programs(draw: st.DrawFn) -> str:
    parts: list[str] = []
    for _ in range(draw(st.integers(1, 3))):
        parts += draw(
            st.one_of(loop(), st.lists(line(), min_size=1, max_size=3).map(lambda lines: lines * 4))
        )
        parts.append(draw(st.sampled_from(("", "N7", "N8", "N7X1."))))
    sub = draw(st.lists(line(calls=False), max_size=4))
    macro = draw(st.one_of(loop(calls=False), st.lists(line(), max_size=4)))
    third = draw(st.lists(line(), max_size=2))
    ends = draw(st.sampled_from(("M99", "M99", "M99", "N7M99", "M99L2", "", "G90M99")))
    text = [
        "N8",
        "G40G1X0.",
        "N9999M30",
        "O0002",
        *sub,
        "M99",
        "O0003",
        *macro,
        ends,
        "O0004",
        *third,
        "M98P2",
        "M99",
    ]
    return HEAD + "\n".join([*parts, *text, ""])


@settings(max_examples=50, deadline=None)
@given(programs(), st.sampled_from(("fanuc-m", "meldas-m", "fanuc-m")))
def test_programs_that_call_and_loop_give_the_same(text: str, control_id: str) -> None:
    assert differences(text, control_id, SETUP, block_limit=3_000) == []


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@settings(max_examples=40, deadline=None)
@given(programs(), st.integers(1, 400), st.sampled_from((3, 200)))
def test_the_compiled_kernel_gives_the_same_up_to_any_limit(text: str, limit: int, rooms: int) -> None:
    bulk = Bulk(fewest_lines=0, rooms=rooms, most_patience=1)
    assert differences(text, "fanuc-m", SETUP, bulk, block_limit=limit) == []


@settings(max_examples=25, deadline=None)
@given(programs(), st.integers(1, 400), st.integers(2, 7), st.sampled_from((40.0, 400.0)))
def test_limits_of_blocks_and_travel_give_the_same(text: str, limit: int, rooms: int, travel: float) -> None:
    bulk = replace(PLAIN, rooms=rooms)
    assert differences(text, "fanuc-m", SETUP, bulk, block_limit=limit, travel=travel) == []


CALLED = "M30\nO0002\nG91X0.1\nG90\nM99\nO0003\nX[#1+#2]Y#3\n#100=#100+1\nM99\n"


def text_of(body: str) -> str:
    return f"{HEAD}#3=1\n#21=0\n{body}\n{CALLED}"


@pytest.mark.parametrize(
    ("body", "blocks"),
    [
        ("M98P2\n" * 50, 250),
        ("G65P3A1.B2.5C#21\n" * 50, 250),
        ("WHILE[#21LT50]DO1\nX#21\nM98P2L2\n#21=#21+1\nEND1", 550),
        ("WHILE[#21LT50]DO1\n#21=#21+1\nIF[#21EQ7]THEN#100=0\nIF[#21GT20]GOTO5\nX#21\nN5END1", 220),
        ("DO1\n#21=#21+1\n#22=0\nDO2\n#22=#22+1\nIF[#22GE3]GOTO6\nEND2\nN6IF[#21GE20]GOTO7\nEND1\nN7", 240),
    ],
)
def test_the_scanner_runs_hot_routines_by_itself(body: str, blocks: int) -> None:
    assert scanned(text_of(body), "fanuc-m", SETUP) > 0.8 * blocks
    assert differences(text_of(body), "fanuc-m", SETUP) == []


@pytest.mark.parametrize(
    "body",
    [
        "M98P2.\n" * 20,
        "M98P2M3\n" * 20,
        "G65P3M3\n" * 20,
        "M98P<NAME>\n" * 20,
        "M98P20002\n" * 20,
        "M98P2Q7\n" * 20,
    ],
)
def test_other_calls_are_the_interpreters(body: str) -> None:
    assert differences(text_of(body), "fanuc-m", SETUP) == []


def test_a_call_too_deep_alarms_at_the_same_block() -> None:
    deep = "".join(f"O{n:04d}\nX{n}.\nM98P{n + 1}\nM99\n" for n in range(2, 20))
    head = "O1\nG90G1F100.\n" + "X1.\n" * 20
    text = f"{head}M98P15\nM98P15\nM98P15\nM98P2\nM30\n{deep}O0020\nM99\n"
    assert [alarm.code for alarm in run(text, "fanuc-m").alarms] == ["PS0077"]
    assert differences(text, "fanuc-m") == []


def test_a_macro_leaves_the_variables_of_its_caller_alone() -> None:
    text = text_of("G65P3A7.\n" * 30).replace("#100=#100+1", "#100=#100+#1\n#1=99\n#33=5")
    told = variables(run(text, "fanuc-m", SETUP, PLAIN))
    assert (told["#1"], told["#100"], "#33" in told) == ("1.5", repr(33.3333 + sum([7.0] * 30)), False)


@pytest.mark.parametrize("body", ["#7=-#7", "#7=[#7*-1]", "#500=0\n#500=-#500", "#100=-0\n#100=-#100"])
def test_zero_keeps_its_sign(body: str) -> None:
    text = text_of(f"WHILE[#21LT51]DO1\n#21=#21+1\n{body}\nEND1")
    assert differences(text, "fanuc-m", SETUP) == []


WAITING = "#101=#101+1\nIF[#101LT30]GOTO9\nWHILE[1EQ1]DO1\nEND1\nN9M99\n"


@pytest.mark.parametrize("call", ["M98P2", "G65P2"])
def test_a_routine_that_waits_for_ever_is_found(call: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(standstill, "PATIENCE", 2_000)
    text = f"O0001\nG90G1F500.\n#101=0\n{f'{call} X3. X4. '.replace(' ', chr(10)) * 60}M30\nO0002\n{WAITING}"
    session = open_session(text, control="fanuc-m", block_limit=500_000)
    session.channel.bulk = PLAIN
    (alarm,) = session.run().alarms
    assert (alarm.code, alarm.program) == ("PC0013", "O0002")


def test_the_shape_of_a_finishing_cycle_calls_nothing() -> None:
    shape = "N5 G0 X10.\nG1 Z-5.\nM98P2\nN6 X50.\n"
    text = f"O1\nG98 G1 F100.\nX50. Z5.\nM98P2\nM98P2\nG70 P5 Q6\nM30\n{shape}M30\nO2\nW-1.\nM99\n"
    assert run(text, "fanuc-0i-tf").alarms
    assert differences(text, "fanuc-0i-tf") == []


def test_a_program_that_a_called_program_calls_is_known_from_its_second_call_on() -> None:
    calls = "M98P2\n" * 60
    text = f"{HEAD}{calls}M30\nO2\nX1.\nM98P3\nX2.\nG65P4A1.\nM99\nO3\nY1.\nY2.\nM99\nO4\nX[#1+#2]\nM99\n"
    assert scanned(text, "fanuc-m") >= 60 * 9 - 60
    assert differences(text, "fanuc-m") == []


GOTO_LOOPS = {
    "while": "N10 IF[#7GE400]GOTO20\nX[#7*0.5]Y#1\n#7=#7+1\nGOTO10\nN20 Y5.\n",
    "until": "N10 X[#7*0.5]Y#1\n#7=#7+1\nIF[#7LT400]GOTO10\n",
    "around a block that is the interpreter's": "N10 X#7\nG4X0.1\n#7=#7+1\nIF[#7LT400]GOTO10\n",
    "within each other": "N10 #3=0\nN20 X#3 Y#7\n#3=#3+1\nIF[#3LT20]GOTO20\n#7=#7+1\nIF[#7LT30]GOTO10\n",
    "around another": "N10 #3=0\nWHILE[#3LT9]DO1\nX#3 Y#7\n#3=#3+1\nEND1\n#7=#7+1\nIF[#7LT60]GOTO10\n",
    "out of another": "N10 #3=0\nWHILE[#3LT9]DO1\n#3=#3+1\nIF[#3EQ#7]GOTO30\nX#3\nEND1\nN30 #7=#7+1\n"
    "IF[#7LT60]GOTO10\n",
    "with a call": "N10 M98P2\n#7=#7+1\nIF[#7LT200]GOTO10\n",
    "by a number": "WHILE[#7LT400]DO1\n#[100+#7MOD9]=#7*2\nX#[100+#7MOD9]\n#7=#7+1\nEND1\n",
    "by a vacant number": "WHILE[#7LT400]DO1\n#[100+#7MOD9]=#33\nX[#[100+#7MOD9]+#7]\n#7=#7+1\nEND1\n",
}


@pytest.mark.parametrize("loop", GOTO_LOOPS.values(), ids=GOTO_LOOPS)
@pytest.mark.parametrize("filled", ["", "Z1.\n" * 300])
def test_what_comes_round_by_jumps_is_run_by_the_scanner(loop: str, filled: str) -> None:
    text = f"{HEAD}{loop}{filled}M30\nO2\nX1.\nX2.\nM99\n"
    bulk = Bulk(fewest_lines=100, scan=PLAIN.scan)
    assert scanned(text, "fanuc-m", bulk=bulk) >= (1 if "G4" in loop else 300 + len(filled) // 4)
    assert differences(text, "fanuc-m", bulk=bulk) == []
    assert differences(text, "fanuc-m", bulk=bulk, block_limit=777) == []


def test_blocks_of_routines_that_are_marked_for_block_skip() -> None:
    text = HEAD + "M98P2\n" * 60 + "M30\nO2\n/X1.\nX2.\n/2 Y#1\n/#1=#1+1\nM99\n"
    for on in (False, True, [2]):
        assert differences(text, "fanuc-m", {"switches": {"block_skip": on}}) == []
    assert scanned(text, "fanuc-m") >= 300
