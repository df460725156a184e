from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from polycnc.session import open_session
from tests.language.sinumerik.running import alarm, run, targets, value, values

if TYPE_CHECKING:
    from pathlib import Path

COUNT = {"SUBB.SPF": "R1=R1+1\nM17", "L7.SPF": "R1=R1+10\nM17", "_N_L007_SPF": "R1=R1+100\nRET"}


def test_programs_are_called_by_name_and_by_number() -> None:
    assert value("SUBB\nL7\nL007\nSUBB_SPF\n_N_SUBB_SPF\nsubb", files=COUNT) == 114


def test_a_program_runs_in_place_of_the_cycle_whose_name_it_has() -> None:
    assert (
        value(
            "CYCLE81(5,0,1,-4)", files={"CYCLE81.SPF": "PROC CYCLE81(REAL AA,REAL BB,REAL CC,REAL DD)\nR1=DD"}
        )
        == -4
    )
    written = 'DEF INT AA\nWRITE(AA,"/_N_SPF_DIR/_N_CYCLE83_SPF","R1=7")\nCYCLE83'
    assert value(written) == 7


def test_the_cycle_of_the_host_wins_over_that_of_the_control(tmp_path: Path) -> None:
    (tmp_path / "MAIN.MPF").write_text("CYCLE83\nM30\n")
    (tmp_path / "CYCLE83.SPF").write_text("R1=8\nM17\n")
    result = open_session(tmp_path / "MAIN.MPF", control="sinumerik-840d").run()
    assert (result.alarms, result.variables["R1"]) == ([], 8)


def test_a_call_may_be_repeated() -> None:
    assert value("R2=2\nSUBB P3\nSUBB P=R2\nL7 P2", files=COUNT) == 25
    assert alarm("SUBB P0", files=COUNT)[0] == "12100"


def test_a_missing_program_alarms() -> None:
    assert alarm("NOSUCH") == ("12550", 1, 1)
    assert alarm("L99") == ("14011", 1, 1)
    assert alarm('CALL "NOSUCH"')[:2] == ("14011", 1)


def test_a_call_stands_alone_in_its_block() -> None:
    assert alarm("SUBB X10", files=COUNT)[0] == "12080"


def test_parameters_are_converted_and_may_be_left_out() -> None:
    files = {
        "SUBB.SPF": "PROC SUBB(INT AA, REAL BB, STRING[5] CC, BOOL DD)\nR1=AA R2=BB R3=STRLEN(CC) R4=DD\nRET"
    }
    assert values('SUBB(2.6,,"abc",5)', "R1", "R2", "R3", "R4", files=files) == [3, 0, 3, 1]
    assert values("SUBB()", "R1", "R4", files=files) == [0, 0]


def test_parameters_by_reference_change_what_the_caller_has() -> None:
    files = {
        "SUBB.SPF": "PROC SUBB(VAR REAL AA, VAR INT BB[,2], VAR STRING[9] CC)\n"
        'AA=AA+1\nBB[1,1]=7\nSUBC(AA)\nCC="Q"<<SUBSTR(CC,1)\nRET',
        "SUBC.SPF": "PROC SUBC(VAR REAL ZZ)\nZZ=ZZ*2\nRET",
    }
    program = (
        'DEF REAL AA=1, FF[2]\nDEF INT BB[3,2]\nDEF STRING[9] SS="abc"\nSUBB(AA,BB,SS)\nSUBB(FF[1],BB,SS)'
    )
    assert values(program, "AA", "BB[1,1]", "FF[1]", "SS", files=files) == [4, 7, 2, "Qbc"]


def test_r_parameters_may_be_handed_over_by_reference() -> None:
    assert value("R1=3\nSUBC(R1)", files={"SUBC.SPF": "PROC SUBC(VAR REAL ZZ)\nZZ=ZZ*2\nRET"}) == 6


@pytest.mark.parametrize(
    ("header", "call", "code"),
    [
        ("(VAR REAL PP)", "SUBB(AA)", "12330"),
        ("(VAR REAL PP)", "SUBB(5)", "12320"),
        ("(VAR REAL PP)", "SUBB()", "14010"),
        ("(AXIS PP)", "SUBB()", "14010"),
        ("(AXIS PP)", "SUBB(5)", "12040"),
        ("(VAR INT PP[2])", "SUBB(AA)", "12360"),
        ("(VAR INT PP)", "SUBB(BB)", "12360"),
        ("(VAR INT PP[,])", "SUBB(BB)", "12360"),
        ("(REAL PP)", "SUBB(1,2)", "12340"),
        ("", "SUBB(1)", "12340"),
        ("(REAL PP)", 'SUBB("a")', "12150"),
        ("(STRING[2] PP)", 'SUBB("abc")', "12210"),
    ],
)
def test_arguments_must_fit_the_parameters(header: str, call: str, code: str) -> None:
    files = {"SUBB.SPF": f"PROC SUBB{header}\nRET"}
    assert alarm(f"DEF INT AA, BB[2]\n{call}", files=files)[:2] == (code, 2)


def test_a_level_has_variables_of_its_own() -> None:
    files = {"SUBB.SPF": "PROC SUBB(INT NN)\nDEF INT II\nII=NN\nIF NN>0\nSUBB(NN-1)\nENDIF\nR1=R1+II\nRET"}
    assert value("SUBB(4)", files=files) == 10


def test_the_sixteenth_subprogram_level_alarms() -> None:
    files = {"SUBB.SPF": "PROC SUBB(INT NN)\nR1=NN\nSUBB(NN+1)\nRET"}
    result = run("SUBB(1)", files=files)
    assert (result.alarms[0].code, result.variables["R1"]) == ("14012", 15)


def test_whether_a_parameter_was_written_can_be_asked() -> None:
    files = {"SUBB.SPF": "PROC SUBB(REAL AA, REAL BB)\nR1=$P_SUBPAR[1] R2=$P_SUBPAR[2] R3=$P_STACK\nRET"}
    assert values("SUBB(,0)", "R1", "R2", "R3", files=files) == [0, 1, 1]


def test_calls_by_text_and_by_path() -> None:
    files = {
        "/_N_WKS_DIR/_N_OTHER_WPD/_N_PART_SPF": "PROC PART(REAL AA)\nR1=R1+AA\nR2=1\nRET",
        "SUBB.SPF": "R3=1\nRET",
    }
    program = (
        'DEF STRING[60] PP="/_N_WKS_DIR/_N_OTHER_WPD/_N_PART_SPF"\n'
        'PCALL/_N_WKS_DIR/_N_OTHER_WPD/PART(5)\nCALL PP\nCALL "SU"<<"BB"'
    )
    assert values(program, "R1", "R2", "R3", files=files) == [5, 1, 1]


def test_a_part_of_a_program_is_called_between_two_labels() -> None:
    files = {"SUBB.SPF": "R1=1\nAA1: R2=1\nR3=1\nAA2: R4=1\nR5=1\nM17"}
    assert values('CALL "SUBB" BLOCK AA1 TO AA2', "R1", "R2", "R3", "R4", "R5", files=files) == [
        0,
        1,
        1,
        1,
        0,
    ]
    assert values("CALL BLOCK AA1 TO AA2\nM30\nAA1: R1=1\nAA2: R2=1\nR3=1", "R1", "R2", "R3") == [1, 1, 0]
    assert alarm('CALL "SUBB" BLOCK AA1 TO NOWHERE', files=files)[0] == "14082"


def test_a_modal_call_follows_every_block_with_path_motion() -> None:
    program = "G0 X1\nMCALL SUBB\nX2\nR2=1\nY2\nMCALL\nX3"
    assert value(program, files=COUNT) == 2


def test_motion_of_a_modal_program_does_not_call_it_again() -> None:
    files = {"SUBB.SPF": "Z=IC(1)\nR1=R1+1\nM17"}
    assert value("G0 X1\nMCALL SUBB\nX2\nX3", files=files) == 2


def test_parameters_of_a_modal_call_are_handed_over_once() -> None:
    files = {"SUBB.SPF": "PROC SUBB(REAL AA)\nR1=R1+AA\nRET"}
    assert value("R5=3\nMCALL SUBB(R5)\nR5=100\nG0 X1\nX2", files=files) == 6


def test_a_search_path_comes_before_the_cycle_directories() -> None:
    files = {
        "/_N_WKS_DIR/_N_MY_WPD/_N_PART_SPF": "R1=R1+1\nRET",
        "/_N_CUS_DIR/_N_PART_SPF": "R1=R1+10\nRET",
    }
    program = "FOR R2=1 TO 3\nPART\nIF R2==2 GOTOF SET1\nGOTOF ON1\n"
    program += 'SET1: CALLPATH("/_N_WKS_DIR/_N_MY_WPD")\nON1:\nENDFOR'
    assert value(program + "\nCALLPATH()\nPART", files=files) == 31
    assert alarm('CALLPATH("/_N_NO_DIR")')[0] == "14009"


def test_a_call_that_was_missing_is_found_once_it_was_written() -> None:
    program = 'DEF INT EE\nFOR R2=1 TO 3\nWRITE(EE,"SUBC_SPF","R1=R1+1")\nSUBC\nENDFOR'
    assert value(program) == 6


def test_return_goes_on_at_a_label_a_number_or_a_text() -> None:
    main = "SUBB\nR1=1\nN50 R2=1\nLAB1: R3=1\nAXISNAME=5\nR4=1"
    define = "DEF INT AXISNAME\n"
    for target, expected in (("N50", [0, 1, 1]), ("lab1", [0, 0, 1]), ("AXISNAME", [0, 0, 0])):
        files = {"SUBB.SPF": f'RET("{target}")'}
        assert values(define + main, "R1", "R2", "R3", files=files) == expected
    assert values(main.replace("AXISNAME=5", ""), "R2", "R3", files={"SUBB.SPF": 'RET("N50",1)'}) == [0, 1]
    assert alarm(main.replace("AXISNAME=5", ""), files={"SUBB.SPF": 'RET("NOWHERE")'})[0] == "14080"


def test_return_over_several_levels() -> None:
    files = {"SUBA.SPF": "SUBB\nR1=1\nRET", "SUBB.SPF": "RET(,,2)"}
    assert values("SUBA\nR2=1", "R1", "R2", files=files) == [0, 1]
    assert alarm("SUBA", files={**files, "SUBB.SPF": "RET(,,3)"})[0] == "14091"


def test_a_return_with_levels_counts_repeated_sections() -> None:
    files = {"SUBB.SPF": "AA: R1=R1+1\nIF R1>=2 GOTOF OUT\nREPEAT AA OUT P=5\nR2=1\nOUT: RET(,,$P_STACK)"}
    assert values("SUBB\nR3=1", "R1", "R2", "R3", files=files) == [2, 0, 1]


def test_save_brings_back_modal_functions() -> None:
    files = {"SUBB.SPF": "PROC SUBB SAVE\nG91\nM17"}
    assert targets("G0 G90 X10\nSUBB\nX5", files=files)[-1]["X"] == 5
    assert targets("G0 G90 X10\nSUBB\nX5", files={"SUBB.SPF": "G91\nM17"})[-1]["X"] == 15


def test_an_alarm_under_displof_stands_at_the_call() -> None:
    program = "R1=1\nSUBB"
    hidden = run(
        program, files={"SUBB.SPF": "PROC SUBB DISPLOF\nSUBC\nRET", "SUBC.SPF": "R1=FOO\nRET"}
    ).alarms[0]
    assert (hidden.program, hidden.line) == ("_N_MAIN_MPF", 2)
    shown = run(program, files={"SUBB.SPF": "PROC SUBB DISPLOF ACTBLOCNO\nR1=FOO\nRET"}).alarms[0]
    assert (shown.program, shown.line) == ("_N_SUBB_SPF", 2)


def test_an_iso_program_runs_as_it_is_unless_a_dialect_is_set_up() -> None:
    program = 'DEF STRING[5] NAME="SUBB"\nISOCALL NAME'
    assert value(program, files=COUNT) == 1
    assert alarm(program, files=COUNT, setup={"parameters": {"18800": 1}})[0] == "PC0001"


def test_a_declaration_must_fit_the_program() -> None:
    files = {"SUBB.SPF": "PROC SUBB(REAL AA, VAR INT BB[2])\nRET"}
    program = "EXTERN SUBB({})\nDEF INT BB[2]\nSUBB(1,BB)"
    assert run(program.format("REAL, VAR INT[,]"), files).alarms == []
    assert alarm(program.format("REAL, INT"), files=files)[:2] == ("12330", 3)
    assert alarm(program.format("REAL"), files=files)[:2] == ("12330", 3)


@pytest.mark.parametrize(
    "line",
    ["GOTOF AA", "IF R1 GOTOB AA", "LOOP", "WHILE R1", "FOR R1=1 TO 2", "REPEAT AA", "CASE R1 OF 1 GOTOF AA"],
)
def test_an_external_program_cannot_jump(line: str) -> None:
    files = {"external:/_N_WKS_DIR/_N_OUT_SPF": f"AA: R1=0\n{line}\nENDLOOP\nENDWHILE\nENDFOR\nM17"}
    found = run('EXTCALL("/_N_WKS_DIR/_N_OUT_SPF")', files).alarms[0]
    assert (found.code, found.line) == ("12500", 2)


def test_an_external_program_may_branch_and_call() -> None:
    files = {**COUNT, "external:/_N_WKS_DIR/_N_OUT_SPF": "IF TRUE\nSUBB\nELSE\nR1=9\nENDIF\nR2=1\nM17"}
    assert values('EXTCALL("/_N_WKS_DIR/_N_OUT_SPF")', "R1", "R2", files=files) == [1, 1]


def test_a_part_of_a_program_has_the_variables_and_parameters_of_the_whole() -> None:
    files = {"SUBB.SPF": "PROC SUBB(INT PP)\nDEF INT AA=5\nR1=1\nAA1: R2=AA R3=PP\nAA2: R4=1\nM17"}
    assert values('SUBB(7)\nCALL "SUBB" BLOCK AA1 TO AA2', "R2", "R3", files=files) == [5, 0]
    assert alarm('CALL "SUBB"', files={"SUBB.SPF": "PROC SUBB(VAR INT PP)\nPP=1\nRET"})[0] == "14010"


def test_the_main_program_may_have_parameters_that_nobody_writes() -> None:
    assert value("PROC MAIN(REAL AA, STRING[5] BB)\nR1=AA+STRLEN(BB)+1") == 1
    assert alarm("PROC MAIN(VAR REAL AA)\nR1=AA")[0] == "14010"


def test_a_subprogram_number_has_seven_digits() -> None:
    assert alarm("L12345678", files={"L12345678.SPF": "M17"})[0] == "12080"


@pytest.mark.parametrize("block", ["X1 SBLOF", "WAITM(1) X1", "SETM(1) M8"])
def test_words_that_stand_alone_alarm_beside_others(block: str) -> None:
    assert alarm(f"G0\n{block}")[:2] == ("12120", 2)


def test_a_loop_that_makes_a_new_text_each_time_keeps_a_bounded_number_of_them() -> None:
    result = run('DEF INT COUNT\nFOR COUNT=1 TO 1500\nEXECSTRING("R1="<<COUNT)\nENDFOR')
    assert result.variables["R1"] == 1500
    code: Any = result.channel.stack[0].code
    assert len(code._texts) <= 1024
