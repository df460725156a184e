"""A loop that waits for what never comes ends with a word of polycnc; one that does anything at all goes on."""

from __future__ import annotations

import pytest

import polycnc
from polycnc.channel.states import standstill
from polycnc.channel.states.standstill import PATIENCE

#: What patience is in all tests but one: the rule compares with it, whatever it is, and so many blocks are soon run.
LITTLE = 1 << 15
LIMIT = 4 * LITTLE
NOTHING = "O1\nWHILE [#1000 EQ 0] DO1\nEND1\nM30\n"
CALLS = "O1\nN1 M98 P2\nIF [#1000 EQ 0] GOTO 1\nM30\nO2\n#5=3\nM99\n"


@pytest.fixture
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(standstill, "PATIENCE", LITTLE)


def test_so_many_blocks_are_run_before_the_word() -> None:
    assert PATIENCE > 200_000
    result = polycnc.run(NOTHING, control="fanuc-m")
    assert [alarm.code for alarm in result.alarms] == ["PC0013"]
    assert PATIENCE < result.channel.blocks < 3 * PATIENCE


@pytest.mark.usefixtures("_impatient")
@pytest.mark.parametrize(
    ("control", "program"),
    [
        ("fanuc-m", NOTHING),
        ("fanuc-m", "O1\nG1 X5. F100\nN1 IF [#1000 EQ 1] GOTO 2\n#1=7\nGOTO 1\nN2 M30\n"),
        ("fanuc-m", CALLS),
        ("meldas-m", "O1\nN1 IF [#1000 EQ 0] GOTO 1\nM30\n"),
        ("fanuc-0i-tf", "O1\nN1 #500=1-#500\nIF [#1001 EQ 0] GOTO 1\nM30\n"),
        ("syntec-mill", "%@MACRO\nWHILE #1000=0 DO\nEND_WHILE;\nM30;\n"),
        ("syntec-mill", "%@MACRO\nREPEAT\n#1 := 1;\nUNTIL (READDI(3) = 1) END_REPEAT;\nM30;\n"),
        ("sinumerik-840d", "LAB: IF $A_IN[1]==0 GOTOB LAB\nM30\n"),
        ("sinumerik-840d", "WHILE $A_IN[1]==0\nR1=5\nENDWHILE\nM30\n"),
        ("sinumerik-840d", "LOOP\nSTOPRE\nENDLOOP\nM30\n"),
        ("sinumerik-840d", "N1 G4 F1\nIF $A_IN[1]==0 GOTOB N1\nM30\n"),
        ("sinumerik-840d", 'N1 MSG("WAIT")\nIF $A_IN[1]==0 GOTOB N1\nM30\n'),
        ("sinumerik-840d", "WHILE $A_IN[1]==0\nG4 F0.1\nENDWHILE\nM30\n"),
        ("fanuc-m", "O1\nG1 X5. F100\nWHILE[#1000EQ0]DO1\nG4 P100\nM8\nEND1\nM30\n"),
        ("meldas-m", "O1\nN1 G4 P100\nIF [#1000 EQ 0] GOTO 1\nM30\n"),
        ("fanuc-0i-tf", "O1\nN1 G4 X1.\nIF [#1000 EQ 0] GOTO 1\nM30\n"),
        ("syntec-mill", "%@MACRO\nREPEAT\nG04 X1.;\nUNTIL (READDI(3) = 1) END_REPEAT;\nM30;\n"),
    ],
)
def test_a_loop_that_changes_nothing_ends_with_a_word(control: str, program: str) -> None:
    result = polycnc.run(program, control=control, block_limit=LIMIT)
    assert [alarm.code for alarm in result.alarms] == ["PC0013"]


@pytest.mark.usefixtures("_impatient")
@pytest.mark.parametrize(
    ("control", "program"),
    [
        ("fanuc-m", "O1\nM98 P2 L{count}\nM30\nO2\n#1=5\nM99\n"),
        ("fanuc-m", "O1\nWHILE [#1 LT {count}] DO1\n#1=#1+1\nEND1\nM30\n"),
        ("fanuc-0i-tf", "O1\nN1 IF [#3001 LT {count}] GOTO 1\nM30\n"),
        ("fanuc-m", "O1\nN1 G4 P1\nIF [#3001 LT {count}] GOTO 1\nM30\n"),
        ("sinumerik-840d", "FOR R1=1 TO {count}\nG4 F0.1\nENDFOR\nM30\n"),
        ("sinumerik-840d", "FOR R1=1 TO {count}\nENDFOR\nM30\n"),
        ("sinumerik-840d", "LAB: R3=1\nREPEATB LAB P=9999\nR2=R2+1\nIF R2<8 GOTOB LAB\nM30\n"),
    ],
)
def test_a_loop_that_counts_is_run_to_its_end(control: str, program: str) -> None:
    result = polycnc.run(program.format(count=2 * LITTLE), control=control)
    assert result.ok
    assert result.channel.blocks > LITTLE


@pytest.mark.usefixtures("_impatient")
def test_a_loop_that_moves_is_none() -> None:
    program = "O1\nN1 G0 X1.\nX0\nGOTO 1\n"
    result = polycnc.run(program, control="fanuc-m", block_limit=2 * LITTLE)
    assert [alarm.code for alarm in result.alarms] == ["PC0002"]


@pytest.mark.usefixtures("_impatient")
def test_an_input_that_the_setup_gives_ends_the_wait() -> None:
    program = "O1\nWHILE [#1000 EQ 0] DO1\nEND1\nM30\n"
    result = polycnc.run(program, control="fanuc-m", setup={"switches": {"UI000": 1}})
    assert result.ok


@pytest.mark.parametrize(
    ("control", "program", "signal"),
    [
        ("fanuc-m", "O1\nWHILE [#1000 EQ 0] DO1\nEND1\nM30\n", "UI000"),
        ("sinumerik-840d", "LAB: IF $A_IN[1]==0 GOTOB LAB\nM30\n", "$A_IN[1]"),
    ],
)
def test_the_virtual_control_goes_on_waiting(control: str, program: str, signal: str) -> None:
    virtual = polycnc.VirtualControl(control)
    virtual.load(program)
    virtual.cycle_start()
    virtual.step(60.0)
    assert virtual.state == "running"
    virtual.signals[signal] = 1.0
    assert virtual.run() == "ready"
    assert not virtual.alarms
