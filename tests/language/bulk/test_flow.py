# ruff: noqa: E501 - programs stand as they are written
"""The scanner and the interpreter give one result where programs jump, call, and come from large files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from polycnc.language.bulk.compiled import LIBRARY
from polycnc.language.bulk.layout import Columns, State, Tables
from polycnc.language.bulk.settings import Bulk
from polycnc.program import long_text
from polycnc.session import open_session
from tests.examples import examples
from tests.language.bulk.both_ways import PLAIN, differences, outcome, plain_scan, run
from tests.language.bulk.programs import plain, program
from tests.language.bulk.test_sinumerik import COMMENTS as SINUMERIK_COMMENTS
from tests.language.bulk.test_sinumerik import SETUP as SINUMERIK_SETUP
from tests.language.bulk.test_word_address import FANUC, FANUC_COMMENTS, LATHE, LATHE_SETUP, SETUP, SYNTEC

SETUPS: dict[str, dict[str, Any]] = {"sinumerik-840d": SINUMERIK_SETUP, "fanuc-0i-tf": LATHE_SETUP}
SUBPROGRAM = "M30\nO0002\nG91 X1.\nX2. F300.\nN77 Y1.\nG90\nX3. Z1.\nM99\n"
JUMPS = st.sampled_from(
    (
        "N77 X7.", "N77", "N78 G91 X1.", "/X9.", "/2 Y9.", "#9=#9+1", "#9=#9+1\nIF[#9LT3]GOTO77", "#9=#9+1\nIF[#9LT4]GOTO78", "M98 P2", "M98 P0002 L2", "M98 P20002",
        "#8=0\nWHILE[#8LT3]DO1\nG91 X1.\nX2. Y1.\n#8=#8+1\nEND1", "G65 P2 A1.", "#1=#5001\nX[#1+1]", "#2=#5041", "#3=#4109", "M0", "G90 G1 F500.",
        "g1 x3. y4.", "n77 x1.", "X1.;", "(N77 X5.)", "G1 F700. X#5001", "G43 H1", "G54", "G1 X5.(A) Y6.",
    )
)  # fmt: skip
FANUC_FLOW = program(
    plain("XYZ", FANUC_COMMENTS), JUMPS, st.just("GOTO 12345"), "O0001\nG90 G54 G1 F1000.", SUBPROGRAM
)
SINUMERIK_FLOW = program(
    plain("XYZ", SINUMERIK_COMMENTS, equals=True),
    st.sampled_from(
        (
            "N77 X7", "ANF: X8", "ENDE: Y1", "R9=R9+1", "R9=R9+1\nIF R9<3 GOTOB ANF", "IF R9<3 GOTOF ENDE", "FOR R8=0 TO 3\nG91 X1\nX2 Y1\nENDFOR", "REPEAT ANF ENDE P=2",
            "R1=$P_EP[X]\nX=R1+1", "R2=$AA_IM[Y]", "LOOP\nR9=R9+1\nX1\nIF R9>5\nGOTOF ENDE\nENDIF\nENDLOOP", "G90 G1 F500", "/X3", "M0", "CT X5 Y9\nG1", "X5 ; N5",
        )
    ),
    st.just("GOTOF NIRGENDS"),
    "G90 G54 G1 F1000",
    "M30",
)  # fmt: skip
SKIPS = st.sampled_from(({}, {"block_skip": True}))


@settings(max_examples=examples(40), deadline=None)
@given(FANUC_FLOW, st.sampled_from(("fanuc-m", "meldas-m")), SKIPS)
def test_jumps_and_calls_give_the_same(text: str, control_id: str, switches: dict[str, bool]) -> None:
    assert differences(text, control_id, {**SETUP, "switches": switches}, block_limit=20_000) == []


@settings(max_examples=examples(40), deadline=None)
@given(SINUMERIK_FLOW, SKIPS)
def test_sinumerik_jumps_and_structures_give_the_same(text: str, switches: dict[str, bool]) -> None:
    assert differences(text, "sinumerik-840d", {"switches": switches}, block_limit=20_000) == []


def from_file(path: Path, control_id: str, bulk: Bulk | None) -> dict[str, object]:
    session = open_session(path, control=control_id, setup=SETUPS.get(control_id, SETUP))
    session.channel.bulk = bulk
    return outcome(session.run().channel)


@pytest.mark.parametrize(
    ("control_id", "programs"),
    [
        ("fanuc-m", FANUC_FLOW), ("meldas-m", FANUC), ("fanuc-0i-tf", LATHE), ("syntec-mill", SYNTEC),
        ("sinumerik-840d", SINUMERIK_FLOW),
    ],
)  # fmt: skip
@settings(
    max_examples=examples(12), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_large_files_give_the_same_whatever_ends_their_lines(
    control_id: str, programs: st.SearchStrategy[str], data: st.DataObject, tmp_path: Path
) -> None:
    text = data.draw(programs)
    ending, tail = data.draw(st.sampled_from(("\n", "\r\n"))), data.draw(st.sampled_from(("", "\n", "\x1a")))
    encoding = data.draw(st.sampled_from(("utf-8", "cp950")))
    path = tmp_path / "part.nc"
    comment = "(粗銑外徑刀具)" if control_id != "sinumerik-840d" else ";粗銑外徑刀具"
    lines = [*text.splitlines(), comment]
    path.write_bytes((ending.join(lines) + tail).encode(encoding, "replace"))
    whole = from_file(path, control_id, None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(long_text, "LONG_FILE_BYTES", 0)
        patch.setattr(long_text, "KEPT_FILE_BYTES", data.draw(st.sampled_from((0, 1 << 20))))
        patch.setattr(long_text, "PAGE_BYTES", 300)
        patch.setattr(long_text, "MAX_LINE", 280)
        paged = from_file(path, control_id, PLAIN)
    assert [name for name in whole if whole[name] != paged[name]] == []


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@settings(max_examples=examples(20), deadline=None)
@given(FANUC)
def test_the_compiled_kernel_gives_the_same(text: str) -> None:
    assert differences(text, "fanuc-m", SETUP, Bulk(fewest_lines=0, rooms=200, most_patience=1)) == []


def test_alarms_in_a_run_of_plain_blocks_name_the_same_place() -> None:
    lines = ["G90 G1 F100.", *(f"X{i}." for i in range(50)), "X1. Q5.", *(f"X{i}." for i in range(50)), "M30"]
    session = open_session("\n".join(["O1", *lines, ""]), control="fanuc-m")
    session.channel.bulk = PLAIN
    (alarm,) = session.run().alarms
    assert (alarm.line, alarm.column) == (53, 5)
    assert differences("\n".join(["O1", *lines, ""]), "fanuc-m") == []


def test_a_target_beyond_the_travel_alarms_in_a_run_of_plain_blocks() -> None:
    text = "O1\nG90 G1 F1000.\n" + "".join(f"X{i * 100}.\n" for i in range(30)) + "M30\n"
    (alarm,) = run(text, "fanuc-m", bulk=PLAIN, travel=1000.0).alarms
    assert alarm.line == 14
    assert differences(text, "fanuc-m", travel=1000.0) == []


def test_short_programs_and_no_bulk_are_interpreted() -> None:
    text = "O1\nG90 G1 F100.\n" + "X1.\nX2.\n" * 10_000 + "M30\n"
    channel = open_session(text, control="fanuc-m", bulk=False).channel
    assert channel.bulk is None
    assert not Bulk().pays(100)


ENDLESS = {
    "while": "WHILE[1EQ1]DO1\n{body}END1\n",
    "goto": "N1\n{body}GOTO1\n",
    "if": "N1 #9=#9+1\n{body}IF[#9GT0]GOTO1\n",
    "calls": "N1 M98 P2 L3\n{body}GOTO1\n",
    "M99": "{body}M99\n",
}


@pytest.mark.parametrize("shape", ENDLESS)
@pytest.mark.parametrize("limit", [9_001, 12_345, 30_002])
def test_the_limit_of_blocks_is_exact_in_endless_loops(shape: str, limit: int) -> None:
    body = "G91 X1.\nX-1.\n#1=#1+1\nIF[#1LT0]GOTO7\n" + "X1. Y1.\nX-1. Y-1.\n" * 5 + "N7 Y0.5\nY-0.5\n"
    text = f"O1\nG90 G54 G1 F1000.\n{ENDLESS[shape].format(body=body)}{SUBPROGRAM}"
    channel = run(text, "fanuc-m", block_limit=limit)
    assert [alarm.code for alarm in channel.alarms] == ["PC0002"]
    assert channel.blocks == limit
    assert differences(text, "fanuc-m", block_limit=limit) == []


ENDLESS_SINUMERIK = {
    "loop": "LOOP\n{body}ENDLOOP\n",
    "while": "WHILE 1\n{body}ENDWHILE\n",
    "repeat": "REPEAT\n{body}UNTIL R1<0\n",
    "for": "FOR R2=0 TO 100000\n{body}ENDFOR\n",
    "goto": "ANF:\n{body}GOTOB ANF\n",
    "if": "ANF: R9=R9+1\n{body}IF R9>0 GOTOB ANF\n",
    "label": "ANF: R9=R9+1\n{body}ENDE: REPEAT ANF ENDE P=100000\n",
}
BODIES_SINUMERIK = (
    "G91 X1\nX-1\nR1=R1+1\nX1 Y1\nX-1 Y-1\n",
    "G91 X1\nX-1\nR1=R1+1\nIF R1<0\nX5\nENDIF\nIF R1>R3\nR3=R3+2\nX1\nX-1\nELSE\nX-1\nX1\nENDIF\n",
    "FOR R5=1 TO 3\nG91 X1\nX-1\nENDFOR\nR6=0\nWHILE R6<4\nR6=R6+1\nG91 Y1\nY-1\nENDWHILE\nR1=R1+1\n",
    "R6=0\nREPEAT\nR6=R6+1\nIF R6>2\nR7=R7+1\nENDIF\nUNTIL R6>5\nG91 X1\nX-1\nX1\nX-1\n",
)


@pytest.mark.parametrize("shape", ENDLESS_SINUMERIK)
@pytest.mark.parametrize(
    ("body", "limit"), [(BODIES_SINUMERIK[0], 20_002), *((body, 9_001) for body in BODIES_SINUMERIK)]
)
def test_the_limit_of_blocks_is_exact_in_endless_structures(shape: str, body: str, limit: int) -> None:
    text = f"G90 G54 G1 F1000\n{ENDLESS_SINUMERIK[shape].format(body=body)}M30\n"
    channel = run(text, "sinumerik-840d", block_limit=limit)
    assert [alarm.code for alarm in channel.alarms] == ["PC0002"]
    assert channel.blocks == limit
    assert differences(text, "sinumerik-840d", block_limit=limit) == []


def test_blocks_that_call_one_after_the_other_are_not_scanned_each() -> None:
    tries: list[int] = []

    def scan(tables: Tables, state: State, columns: Columns) -> int:
        tries.append(state.scan.line)
        return plain_scan(tables, state, columns)

    text = "O1\nG91 G1 F100.\n" + "M98 P2\n" * 2_000 + "M30\nO2\nX0.1\nM99\n"
    session = open_session(text, control="fanuc-m")
    session.channel.bulk = Bulk(fewest_lines=0, scan=scan)
    assert session.run().ok
    assert len(tries) < 50
