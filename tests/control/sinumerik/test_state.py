"""Power-on, program end, SAVE, and that nothing leaks from one run into the next."""

from __future__ import annotations

from polycnc.channel.channel import Channel
from polycnc.control.registry import control
from polycnc.control.sinumerik.gcodes import INTERNAL_CODES, START_CODES
from polycnc.machine import load_machine, parse_setup
from polycnc.memory.retained import InMemoryStore
from polycnc.program import Form, ProgramStore
from polycnc.session import open_session
from tests.control.sinumerik.support import moves, run


def test_a_program_starts_with_the_delivered_functions() -> None:
    channel = run("R1=1").channel
    assert channel.mode.codes == {**START_CODES, **INTERNAL_CODES}


def test_a_lathe_without_y_starts_in_its_own_plane() -> None:
    assert run("R1=$P_GG[6]", machine="lathe2").variables["R1"] == 2


def test_nothing_leaks_from_one_run_into_the_next() -> None:
    lines = ("R1=$P_GG[14] R2=R5 R3=$P_PFRAME[X,TR] R4=$P_TOOLNO", "G0 X1")
    first = run(*lines)
    run("G91 G19", "R5=9", "TRANS X5", "$TC_DP1[1,1]=120", "T1", "RNDM=3", "$P_UIFR[1]=CTRANS(X,9)")
    again = run(*lines)
    assert [first.variables[f"R{n}"] for n in (1, 2, 3, 4)] == [
        again.variables[f"R{n}"] for n in (1, 2, 3, 4)
    ]
    assert moves(first) == moves(again)


def test_variables_of_the_setup_are_there_at_the_start() -> None:
    result = run("R2=R1*2", variables={"R1": 21})
    assert result.variables["R2"] == 42


def test_local_variables_can_be_read_after_the_end() -> None:
    result = run(
        "DEF REAL DEPTH=2.5", "DEF INT FIELD[3]=SET(1,2,3)", "DEF AXIS AXVAR=Y", "DEF BOOL FLAG=TRUE"
    )
    assert result.variables["DEPTH"] == 2.5
    assert result.variables["FIELD[2]"] == 3
    assert result.variables["AXVAR"] == "Y"
    assert result.variables["FLAG"] == 1
    assert "NOSUCHNAME" not in result.variables


def test_the_same_program_gives_the_same_rows_twice() -> None:
    text = "T1 D1 F100\nG41 G1 X10 Y0\nY20 RND=3\nX40\nG3 X50 Y10 CR=10\nG40 X80\nM30\n"
    setup = {"tools": {1: {"length": 0, "radius": 2}}}
    runs = [open_session(text, control="sinumerik-840d", setup=setup).run().rows for _ in range(2)]
    assert runs[0] == runs[1]
    assert len(runs[0]) == 8


def test_r_parameters_and_settable_frames_outlive_the_channel() -> None:
    store = InMemoryStore()
    program = "R1=R1+1\n$P_UIFR[1,X,TR]=$P_UIFR[1,X,TR]+1\nM30\n"
    for times in (1, 2):
        chosen, programs = control("sinumerik-840d"), ProgramStore(form=Form.SINUMERIK)
        main = programs.add_text("/_N_MPF_DIR/MAIN", program)
        setup = parse_setup({"work_offsets": {"G54": {"X": 5.0}}, "variables": {"R1": 7, "R2": 3}})
        channel = Channel(chosen, load_machine("mill3"), setup, programs, retained=store)
        for _ in channel.run(main):
            pass
        assert not channel.alarms
        values = [chosen.read_variable(channel, name) for name in ("R1", "R2", "$P_UIFR[1,X,TR]")]
        assert values == [7.0 + times, 3.0, 5.0 + times]
