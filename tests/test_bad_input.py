"""Whatever comes in: an alarm or a table comes out, never a traceback."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

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
