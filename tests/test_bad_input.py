"""Whatever comes in: an alarm or a table comes out, never a traceback."""

from __future__ import annotations

import json
from math import isfinite
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import polycnc
from polycnc.control import registry
from polycnc.program import decode
from tests.support import run

EXAMPLES = sorted(
    path for path in (Path(__file__).parents[1] / "examples").iterdir() if path.suffix in (".nc", ".mpf")
)
CONTROLS = registry.ids()
FEW = settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
LIMIT = 3_000
SIGNS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ#,/[]()=:;<>'$%@." + '"'
WORDS = st.lists(
    st.one_of(
        st.builds("{}{}".format, st.sampled_from(SIGNS), st.integers(-99, 199)),
        st.sampled_from(
            ["G1", "G2", "G41D1", "G40", "G65P1", "M98P1", "M99", "G68X0Y0R30.", "#1=#2/0", "IF[#1EQ#0]GOTO1", "N1",
             "WHILE[#1LT3]DO1", "END1", "R1=R1+1", "IF R1>2 GOTOF L1", "L1:", "DEF INT A", "TRANS X1", "END_IF;",
             "CYCLE81(1,2,3,4)", "#1:=1;", "IF #1=1 THEN", 'MSG("A")', "G71P1Q2", "T0101", "X=IC(1)", "F100", "\n"]
        ),
    ),
    max_size=40,
)  # fmt: skip


@pytest.mark.parametrize("control", CONTROLS)
@FEW
@given(data=st.binary(max_size=400))
def test_arbitrary_bytes(control: str, data: bytes) -> None:
    channel = run(decode(data).text + "\n", control, block_limit=LIMIT)
    assert channel.finished


@pytest.mark.parametrize("control", CONTROLS)
@FEW
@given(words=WORDS, gap=st.sampled_from(["", " ", "\n"]))
def test_random_words(control: str, words: list[str], gap: str) -> None:
    channel = run(gap.join(words) + "\n", control, block_limit=LIMIT)
    assert channel.finished


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
@settings(max_examples=25, deadline=None)
@given(cut=st.floats(0.0, 1.0), swap=st.floats(0.0, 1.0), char=st.characters(max_codepoint=127))
def test_damaged_real_programs(path: Path, cut: float, swap: float, char: str) -> None:
    text = path.read_text(encoding="utf-8")
    text = text[: int(len(text) * cut)]
    place = int(len(text) * swap)
    damaged = text[:place] + char + text[place + 1 :]
    control = max((name for name in CONTROLS if path.stem.startswith(name)), key=len)
    channel = run(damaged + "\n", control, block_limit=LIMIT)
    assert channel.finished


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(
    "digits", ["9" * 8, "9" * 20, "0" * 300 + "1", "1" * 400, "." + "3" * 50, "1.5.", "--5"]
)
def test_numbers_of_any_length(control: str, digits: str) -> None:
    assert run(f"G0 X{digits}\nM30\n", control, block_limit=LIMIT).finished


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("bracket", ["[]", "()"])
def test_brackets_nested_ten_thousand_deep(control: str, bracket: str) -> None:
    inner = bracket[0] * 10_000 + "1" + bracket[1] * 10_000
    assert run(f"#1={inner}\nR1={inner}\nM30\n", control, block_limit=LIMIT).alarms


@pytest.mark.parametrize("control", CONTROLS)
def test_brackets_nested_a_thousand_deep_in_a_short_block(control: str) -> None:
    inner = "[" * 1000 + "1" + "]" * 1000
    assert run(f"#1={inner}\nM30\n", control, block_limit=LIMIT).alarms


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "fanuc-0i-tf"])
def test_a_program_that_calls_itself(control: str) -> None:
    assert run("O1\nM98 P1\nM30\n", control, block_limit=LIMIT).alarms


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("name", ["#NOPE", "NOPE", "R", ""])
def test_a_setup_that_names_no_variable_of_the_control(control: str, name: str) -> None:
    assert run("G0 X1.\nM30\n", control, setup={"variables": {name: 3}}, block_limit=LIMIT).alarms


FAR = "1" + "0" * 310
LATHE = {"machine": "lathe2", "tools": {1: {"radius": 0.5, "tip": 3, "type": 500}}}


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(
    "block",
    [
        f"G0 X{FAR}.", f"G1 X1. F{FAR}.", f"S{FAR} M3", f"G2 X1. I{FAR}. F1.", f"#1={FAR}.", f"R1={FAR}",
        "G1 X=1EX300*1EX9 F1", "G1 X1 F=1EX300*1EX9", "S=1EX300*1EX9 M3", "TRANS X=1EX300*1EX9", "G0 X1EX300",
        "R1=1EX300*1EX9 R2=R1-R1", "CYCLE81(1EX300*1EX9,0,1,2)", "G2 X1 I=1EX300 F1", f"#1={'-' * 250}1",
        f"R1={'-' * 250}1", "G68.2 J90. G53.1", "DEF INT GRP=GRP,NUM", "WRITE(,,)", "R1=EXP(1000)", "R1=1/0",
    ],
)  # fmt: skip
def test_what_no_number_can_hold_is_an_alarm_or_nothing(control: str, block: str) -> None:
    result = polycnc.run(f"{block}\nM30\n", control=control, block_limit=LIMIT)
    json.dumps([result.rows, result.final], allow_nan=False)
    assert isfinite(result.time)
    assert all(result.alarm_text(alarm) for alarm in result.alarms)


@pytest.mark.parametrize("given", range(14))
def test_a_turning_cycle_without_its_last_arguments(given: int) -> None:
    arguments = ['"A:B"', "10", "-20", "1", "0.2", "0.2", "0.2", "0.2", "0.2", "0.2", "9", "0", "0", "1"]
    for call in (arguments[:given], [*arguments[:given], *[""] * (11 - given)]):
        text = f"T1 D1 G18 S1=100 M3 F1\nCYCLE95({','.join(call)})\nM30\nA:\nG1 X10 Z0\nZ-10\nX20 Z-20\nB:\n"
        assert run(text, "sinumerik-840d", setup=LATHE, machine="lathe2", block_limit=LIMIT).finished


@pytest.mark.parametrize("control", CONTROLS)
def test_where_the_axes_stand_is_known_although_the_setup_alarms(control: str) -> None:
    result = polycnc.run("M30\n", control=control, setup={"work_offsets": {"G54.1 P48": {"X": 1}}})
    assert result.final["machine"]["X"] == 0.0


@pytest.mark.parametrize(
    ("control", "text"),
    [
        ("fanuc-m", "G81 X10. Z-5. R2. F100. K9999999"),
        ("syntec-mill", "G81 X10. Z-5. R2. F100 K99999999"),
        ("meldas-m", "G81 X10. Z-5. R2. F100. L99999999"),
        ("syntec-mill", "G83 X10. Z-500. R2. F100 Q0.00001"),
        ("syntec-mill", "G2 X10. I5. L248339 F100"),
        ("meldas-m", "G02.1 X10. I5. P248339 F100."),
        ("fanuc-0i-tf", "G0 X100. Z5.\nG75 R0.\nG75 X10. Z-100. P1 Q1 F1."),
        ("fanuc-0i-tf", "G0 X100. Z5.\nG73 U10. W1. R99999\nG73 P1 Q2 F1.\nN1 G0 X10.\nG1 Z-10.\nN2 X100."),
        ("sinumerik-840d", "F100\nMCALL CYCLE81(1,0,2,-1)\nHOLES1(0,0,0,1,1,99999999)"),
        ("sinumerik-840d", "F100\nMCALL CYCLE81(1,0,2,-1)\nCYCLE801(0,0,0,1,1,99999,99999,0)"),
        ("sinumerik-840d", "F100 M3 S100\nCYCLE83(10,0,2,-500,,,0.0001,0.0001,0,0,1,1)"),
    ],
)
def test_a_block_that_repeats_itself_counts_for_the_block_limit(control: str, text: str) -> None:
    channel = run(f"{text}\nM30\n", control, block_limit=LIMIT)
    assert channel.alarms
    assert len(channel.toolpath) < 20 * LIMIT


BIG = "9" * 200 + "."
PRODUCTS = {
    "sinumerik-840d": ("14051", ["R1=1EX300*1EX9", "R2=1EX300\nR1=R2*R2-R2*R2", "R2=1EX-300\nR1=1/R2/R2",
        "R1=POT(1EX200)",
        "R2=1EX300\nIF R2*R2>5\nR1=7\nENDIF", "R2=1EX300\nX=R2*R2", "R1=1EX300\nLOOP\nR1=R1+R1\nENDLOOP"]),
    "fanuc-m": ("PS0111", [f"#1={BIG}*{BIG}", f"#2={BIG}\n#1=#2*#2-#2*#2", f"#2={BIG}\nIF[#2*#2GT5]GOTO9\nN9",
        f"#2={BIG}\nG0X[#2*#2]", f"#1={BIG}\nN1#1=#1+#1\nGOTO1"]),
    "meldas-m": ("P285", [f"#1={BIG}*{BIG}", f"#2={BIG}\n#1=#2/[1/#2]"]),
    "fanuc-0i-tf": ("PS0111", [f"#1={BIG}*{BIG}", f"#2={BIG}\n#1=#2/[1/#2]", f"#2={BIG}\nWHILE[#2*#2GT5]DO1\nEND1"]),
    "syntec-mill": ("COR-004", [f"%@MACRO\n#1:={BIG}*{BIG};", f"%@MACRO\n#2:={BIG};\n#1:=#2*#2-#2*#2;"]),
}  # fmt: skip


@pytest.mark.parametrize(
    ("control", "code", "program"),
    [(control, code, program) for control, (code, found) in PRODUCTS.items() for program in found],
)
def test_a_result_beyond_the_range_of_numbers_is_an_alarm(control: str, code: str, program: str) -> None:
    result = polycnc.open_session(program + "\nM30\n", control=control).run()
    assert [alarm.code for alarm in result.alarms] == [code]
    assert all(isfinite(result.variables[name]) for name in result.variables)


@pytest.mark.parametrize(
    "program",
    [
        "DEF FRAME MINE\nMINE=CTRANS(Y,1EX300):CROT(Z,90)\n$P_PFRAME=MINE\nG0 X1",
        "TRANS X1EX300\nATRANS X1EX300\nG0 X1",
        "$P_UIFR[1,Y,TR]=1EX300\n$P_UIFR[1,Z,RT]=90\nG54 G0 X1",
        "SCALE X1EX300\nASCALE X1EX300\nG0 X1",
    ],
)
def test_a_frame_that_leads_beyond_all_machines_is_an_alarm(program: str) -> None:
    result = polycnc.open_session(program + "\nM30\n", control="sinumerik-840d").run()
    assert [alarm.code for alarm in result.alarms] == ["14051"]
    assert isfinite(result.time)
    assert all(isfinite(value) for value in result.final["machine"].values())


@pytest.mark.parametrize("value", [None, 0, -1, "x"])
def test_an_acceleration_that_no_axis_has_is_not_taken(value: object) -> None:
    setup = {"parameters": {"$MA_MAX_AX_ACCEL[2,X]": value}}
    result = polycnc.open_session(
        "DYNROUGH\nG1 X100 F15000\nM30\n", control="sinumerik-840d", setup=setup
    ).run()
    assert result.time == polycnc.open_session("G1 X100 F15000\nM30\n", control="sinumerik-840d").run().time


def test_an_alarm_of_the_setup_leaves_no_variables() -> None:
    setup = {"work_offsets": {"G54.1 P48": {"X": 5}}}
    result = polycnc.open_session("G0 X1\nM30\n", control="sinumerik-840d", setup=setup).run()
    assert result.alarms
    assert list(result.variables) == []


@pytest.mark.parametrize(
    ("control", "setup", "program"),
    [
        ("sinumerik-840d", {"variables": {"$A_DBB[3]": "327<<71"}}, "R1=1"),
        ("sinumerik-840d", {"variables": {"R1": None}}, "R1=1"),
        ("sinumerik-840d", {"parameters": {"14510[3]": "abc"}}, "R1=$MN_USER_DATA_INT[3]"),
        ("sinumerik-840d", {"parameters": {"14510[3]": None}}, "R1=$MN_USER_DATA_INT[3]"),
    ],
)
def test_a_value_of_another_kind_is_an_alarm(control: str, setup: dict[str, object], program: str) -> None:
    result = polycnc.open_session(program + "\nM30\n", control=control, setup=setup).run()
    assert [alarm.code for alarm in result.alarms] == ["12150"]


def test_true_is_one_in_a_variable() -> None:
    result = polycnc.open_session(
        "%@MACRO\nG0 X#1;\nM30;\n", control="syntec-mill", setup={"variables": {"#1": True}}
    ).run()
    assert result.variables["#1"] == 1
    assert not result.alarms
