from __future__ import annotations

import pytest

from tests.language.sinumerik.running import alarm, run, value, values


def test_goto_searches_forward_first_then_back() -> None:
    assert values("GOTO AA\nR1=1\nAA: R2=1", "R1", "R2") == [0, 1]
    assert value("AA: R1=R1+1\nIF R1<3 GOTO AA") == 3


def test_gotof_does_not_find_what_lies_behind_it_and_gotob_not_what_lies_ahead() -> None:
    assert alarm("AA: R1=1\nGOTOF AA")[:2] == ("14080", 2)
    assert alarm("GOTOB AA\nAA: R1=1")[:2] == ("14080", 1)


def test_gotoc_goes_on_where_there_is_no_target() -> None:
    assert value("GOTOC NOWHERE\nR1=1") == 1


@pytest.mark.parametrize("target", ["N30", "N030", ":40", '"N30"', "TARGET", '"N"<<R9', "label"])
def test_targets_are_labels_numbers_and_texts(target: str) -> None:
    program = f'DEF STRING[9] TARGET="label"\nR9=30\nGOTOF {target}\nR1=1\nN30 LABEL: R2=1\n:40 R3=1'
    assert values(program, "R1", "R3") == [0, 1]


def test_several_conditional_jumps_of_a_block_are_tried_in_order() -> None:
    program = "R1=2\nIF R1==1 GOTOF AA IF R1==2 GOTOF BB IF R1>0 GOTOF AA\nAA: R2=1\nBB: R3=1"
    assert values(program, "R2", "R3") == [0, 1]


def test_a_missing_target_alarms_only_when_the_jump_is_made() -> None:
    assert value("IF R1 GOTOF NOWHERE\nR1=7") == 7


def test_an_unconditional_jump_stands_alone() -> None:
    assert alarm("GOTOF AA R1=5\nAA:")[0] == "12080"


@pytest.mark.parametrize(("choice", "expected"), [(1, 1), (3, 2), (9, 3)])
def test_case_chooses_by_value(choice: int, expected: int) -> None:
    program = (
        f"R1={choice}\nCASE R1+0 OF 1 GOTOF AA 3 GOTOF BB DEFAULT GOTOF CC\nAA: R2=1\nGOTOF EE\nBB: R2=2"
    )
    assert value(program + "\nGOTOF EE\nCC: R2=3\nEE: M30", "R2") == expected


def test_case_without_default_goes_on() -> None:
    assert value("CASE(5) OF 1 GOTOF AA\nR1=1\nAA: M30") == 1


def test_if_else_endif() -> None:
    program = "IF {}\nR1=1\nELSE\nR1=2\nENDIF"
    assert value(program.format("TRUE")) == 1
    assert value(program.format("R1")) == 2


def test_loops_nest() -> None:
    program = "DEF INT II\nFOR II=1 TO 3\nFOR R2=1 TO 4\nR1=R1+1\nENDFOR\nENDFOR"
    assert value(program) == 12


def test_for_makes_no_pass_when_the_start_is_beyond_the_end() -> None:
    assert value("FOR R2=5 TO 1\nR1=1\nENDFOR") == 0


def test_while_may_make_no_pass_and_repeat_makes_one() -> None:
    assert values("WHILE R9\nR1=1\nENDWHILE\nREPEAT\nR2=R2+1\nUNTIL TRUE", "R1", "R2") == [0, 1]


def test_loop_ends_by_a_jump() -> None:
    assert value("LOOP\nR1=R1+1\nIF R1>=5 GOTOF EE\nENDLOOP\nEE: M30") == 5


@pytest.mark.parametrize(
    ("program", "code", "line"),
    [
        ("IF R1\nR1=1", "12640", 1),
        ("ENDIF", "12640", 1),
        ("ELSE", "12640", 1),
        ("LOOP\nIF TRUE\nENDLOOP", "12640", 2),
        ("AA: IF TRUE\nENDIF", "12630", 1),
        ("IF TRUE\nBB: ENDIF", "12630", 2),
        ("\n".join(["IF TRUE"] * 17 + ["ENDIF"] * 17), "12641", 17),
        ("FOR X=1 TO 5\nENDFOR", "12080", 1),
        ("ENDFOR R1", "12640", 1),
    ],
)
def test_a_structure_that_does_not_fit_alarms(program: str, code: str, line: int) -> None:
    assert alarm(program)[:2] == (code, line)


def test_sixteen_structures_nest() -> None:
    assert value("\n".join(["IF TRUE"] * 16 + ["R1=1"] + ["ENDIF"] * 16)) == 1


def test_repeat_ends_before_itself_at_the_end_label_or_at_endlabel() -> None:
    body = "AA: R1=R1+1\nR2=R2+1\nBB: R3=R3+1\n"
    assert values(body + "REPEAT AA P=2", "R1", "R2", "R3") == [3, 3, 3]
    assert values(body + "R2=R2\nREPEAT AA BB P=2\n", "R1", "R2", "R3") == [3, 3, 3]
    assert values("AA: R1=R1+1\nENDLABEL: R2=R2+1\nR3=R3+1\nREPEAT AA", "R1", "R2", "R3") == [2, 2, 1]
    assert values(body + "REPEATB AA P3", "R1", "R2", "R3") == [4, 1, 1]


def test_repeat_finds_a_section_ahead_and_comes_back() -> None:
    program = "REPEAT AA P=2\nM30\nAA: R1=R1+1\nENDLABEL: R2=R2+1\nR3=1"
    assert values(program, "R1", "R2", "R3") == [2, 2, 0]


def test_a_section_between_two_labels_is_not_looked_for_ahead() -> None:
    assert alarm("REPEAT AA BB P=2\nM30\nAA: R1=R1+1\nBB: R2=R2+1")[:2] == ("14082", 1)


def test_a_pass_ends_where_it_comes_to_its_own_repeat() -> None:
    branch = "AA: R1=R1+1\nIF R1==9\nR2=R2+1\nENDIF\nREPEAT AA P=2"
    assert values(branch, "R1", "R2") == [3, 0]
    assert values("AA: R1=R1+1\nREPEAT AA BB P=2\nBB: R2=R2+1", "R1", "R2") == [3, 1]


def test_a_return_inside_a_repetition_ends_it() -> None:
    files = {
        "SUBB.SPF": "AA: R1=R1+1\nIF R1>=3 GOTOF OUT\nGOTOF ON\nOUT: M17\nON: R3=1\nREPEAT AA P=9\nR2=1\nM17"
    }
    assert values("SUBB\nR4=1", "R1", "R2", "R4", files=files) == [3, 1, 1]


def test_a_section_without_its_label_alarms() -> None:
    assert alarm("REPEAT NOWHERE P=2")[:2] == ("14082", 1)
    assert alarm("AA: R1=1\nREPEAT AA NOWHERE")[:2] == ("14082", 2)


def test_gotos_goes_back_behind_the_definitions_if_the_plc_wants_it() -> None:
    program = "DEF INT AA=5\nAA=AA+1\nR1=R1+1\nIF R1>2 GOTOF EE\nGOTOS\nEE: R2=AA"
    plc = {"switches": {"plc": {"DB21.DBX384.0": 1}}}
    assert values(program, "R1", "R2") == [1, 6]
    assert values(program, "R1", "R2", setup=plc) == [3, 8]


def test_a_string_runs_as_a_block() -> None:
    assert values('DEF STRING[20] BB="R1=5"\nEXECSTRING(BB<<" R2=6")', "R1", "R2") == [5, 6]
    assert alarm('EXECSTRING("DEF INT AA")')[0] == "14500"
    assert alarm('R1=1\nEXECSTRING("R1=")')[:2] == ("12080", 2)
    assert value('EXECSTRING("GOTOF AA")\nR1=1\nAA: M30') == 0


def test_an_endless_loop_ends_with_an_alarm() -> None:
    assert len(run("LOOP\nR1=R1+1\nENDLOOP").alarms) == 1
