from __future__ import annotations

import pytest

from tests.language.sinumerik.running import alarm, run, targets, value, values

GUD = {"_N_MGUD_DEF": "%_N_MGUD_DEF\n;$PATH=/_N_DEF_DIR\nDEF CHAN REAL LLI 0 ULI 10 GG1=2.5, GG2\nM30\n"}


def test_variables_have_their_first_values() -> None:
    program = 'DEF INT AA, BB=3\nDEF STRING[9] SS="abc"\nDEF BOOL CC=TRUE\nDEF AXIS DD=Y\nDEF CHAR EE="A"'
    assert values(program, "AA", "BB", "SS", "CC", "DD", "EE") == [0, 3, "abc", 1, "Y", 65]


def test_without_a_value_the_limit_nearest_to_zero_is_taken() -> None:
    assert values("DEF REAL LLI 5 AA\nDEF REAL ULI -5 BB", "AA", "BB") == [5, -5]


def test_limits_hold_for_assignments() -> None:
    assert alarm("DEF INT LLI 0 ULI 5 AA=3\nAA=6")[:2] == ("17090", 2)
    assert alarm("DEF INT LLI 0 ULI 5 AA=3\nAA=-1")[:2] == ("17080", 2)


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("DEF", "12080"),
        ("DEF INT", "12080"),
        ("DEF FOO AA", "12080"),
        ("DEF INT AA BB", "12080"),
        ("DEF INT A", "12080"),
        ("DEF INT IF", "12170"),
        ("DEF INT TRANS", "12170"),
        ("DEF REAL AX1", "12170"),
        ("DEF INT AA, AA", "12170"),
        ("DEF INT " + "A" * 32, "12420"),
        ("DEF INT AA[0]", "12370"),
        ("DEF INT AA[2,2,2,2]", "12190"),
        ("DEF INT AA[R1]", "12080"),
        ("DEF REAL AA[60000,60000]", "14070"),
        ("DEF STRING[2] AA[2,2,2]", "12190"),
        ("DEF STRING[0] AA", "12210"),
        ('DEF STRING[2] AA="abc"', "12210"),
        ("DEF INT AA[2]=(1,2,3)", "12260"),
        ("DEF AXIS AA[2]=(X,,)", "12080"),
        ("DEF FRAME FF=CTRANS(X,1)", "12261"),
        ("DEF BOOL LLI 0 AA", "12150"),
        ("DEF NCK INT AA", "12500"),
    ],
)
def test_a_wrong_definition_alarms(line: str, code: str) -> None:
    assert alarm(line)[:2] == (code, 1)


def test_definitions_come_before_everything_else() -> None:
    assert alarm("G0 X1\nDEF INT AA") == ("14500", 2, 1)
    assert alarm("R1=1\nPROC AA") == ("14500", 2, 1)


def test_arrays_are_filled_row_by_row_and_gaps_are_zero() -> None:
    program = (
        "DEF INT AA[2,3]=REP(9)\nAA[0,1]=SET(1,,3)\nR1=AA[0,0] R2=AA[0,1] R3=AA[0,2] R4=AA[1,0] R5=AA[1,1]"
    )
    assert values(program, "R1", "R2", "R3", "R4", "R5") == [9, 1, 0, 3, 9]


def test_repetition_at_a_definition_leaves_the_rest_zero() -> None:
    assert values("DEF REAL AA[3]=REP(5,2)", "AA[0]", "AA[1]", "AA[2]") == [5, 5, 0]
    assert values("DEF REAL AA[3]=REP(5)\nAA[1]=REP(7,1)\nAA[0]=REP(1,0)", "AA[0]", "AA[1]") == [5, 7]


def test_sets_longer_than_the_array_alarm() -> None:
    assert alarm("DEF INT AA[3]\nAA[2]=SET(1,2)")[:2] == ("12260", 2)
    assert alarm("DEF INT AA[3]\nAA[1]=REP(1,3)")[:2] == ("12260", 2)


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("AA[2,0]=1", "17020"),
        ("AA[0,3]=1", "17030"),
        ("AA[-1,0]=1", "17020"),
        ("AA[0]=1", "12400"),
        ("AA[0,0,0]=1", "12400"),
        ("AA=1", "12400"),
        ("BB[0]=1", "12400"),
    ],
)
def test_an_element_that_does_not_exist_alarms(line: str, code: str) -> None:
    assert alarm(f"DEF INT AA[2,3], BB\n{line}")[:2] == (code, 2)


def test_single_characters_of_strings_are_read_and_written() -> None:
    program = 'DEF STRING[9] AA="abcd", BB[2]\nAA[1]="X"\nBB[1]="xyz"\nBB[1,0]="Q"\nR1=AA[0]\nAA[2]=0'
    assert values(program, "AA", "BB[1]", "R1") == ["aX", "Qyz", 97]
    assert alarm('DEF STRING[9] AA="ab"\nAA[2]="X"')[:2] == ("17020", 2)


def test_r_parameters_are_an_array() -> None:
    assert values("R[1+1]=5\n$R3=R2+1\nR10=REP(2.4,3)", "R2", "R3", "R12") == [5, 6, 2.4]
    assert alarm("R1=-1\nR[R1]=5")[:2] == ("17020", 2)


def test_a_variable_may_have_the_name_of_a_function() -> None:
    assert value("DEF INT NUMBER=60, MINVAL\nMINVAL=NUMBER+1\nR1=MINVAL") == 61


def test_global_variables_live_longer_than_a_subprogram() -> None:
    files = {**GUD, "SUBB.SPF": "GG1=GG1+1\nRET"}
    assert values("R1=GG1\nSUBB\nR2=GG1", "R1", "R2", "GG2", files=files) == [2.5, 3.5, 0]
    assert alarm("GG1=11", files=GUD)[0] == "17090"


def test_redefinition_of_limits_must_fit_the_value() -> None:
    files = {"_N_MGUD_DEF": "REDEF R INIPO 7\nREDEF R ULI 5\nM30\n"}
    assert alarm("R1=1", files=files)[0] == "12160"


def test_limits_of_global_user_variables_cannot_be_redefined() -> None:
    files = {"_N_MGUD_DEF": "DEF CHAN INT GG1=7\nREDEF GG1 ULI 50\nM30\n"}
    assert alarm("R1=1", files=files)[0] == "12500"


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("DEF NCK REAL INIRE GG1=7", "12500"),
        ("REDEF $SC_EXT_PROG_PATH PRLOC", "12500"),
        ("REDEF $AC_PARAM ULI 5 APWP 3", "12080"),
        ("REDEF $MN_LEN_PROTOCOL_FILE INIRE 5", "12261"),
        ("DEF CHAN REAL PHU 17 GG1", "12160"),
        ("DEF CHAN BOOL PHU 1 GG1", "12150"),
    ],
)
def test_attributes_that_a_variable_cannot_have_alarm(line: str, code: str) -> None:
    assert alarm("R1=1", files={"_N_MGUD_DEF": f"{line}\nM30\n"})[0] == code


def test_lengths_with_a_unit_are_read_in_the_measuring_system_of_the_program() -> None:
    files = {"_N_MGUD_DEF": "DEF CHAN REAL PHU 2 GG1=50.8\nDEF CHAN REAL PHU 28 GG2=50.8\nM30\n"}
    program = "G700\nR1=GG1 R2=GG2\nGG1=3\nG710\nR3=GG1"
    assert values(program, "R1", "R2", "R3", files=files) == pytest.approx([2, 50.8, 76.2])


def test_local_variables_are_unknown_elsewhere_unless_machine_data_say_so() -> None:
    files = {"SUBB.SPF": "AA=AA+1\nRET"}
    program = "DEF INT AA=1\nSUBB\nR1=AA"
    assert run(program, files).alarms[0].code == "12550"
    assert value(program, files=files, setup={"parameters": {"11120": 1}}) == 2


def test_macros_stand_for_their_text_and_do_not_nest() -> None:
    assert targets("DEFINE LINE AS G1 G94 F300\nDEFINE TWO AS 2\nLINE X=TWO*5") == [{"X": 10, "Y": 0, "Z": 0}]
    assert alarm("DEFINE AA AS BB\nDEFINE BB AS G1 X1\nAA")[:2] == ("12550", 3)
    assert alarm("DEFINE IF AS G1") == ("12270", 1, 8)


def test_a_macro_may_give_another_meaning_to_an_m_function() -> None:
    files = {"_N_UMAC_DEF": "DEFINE M6 AS L6\nM30\n", "L6.SPF": "R1=R1+1\nM17"}
    assert value("M6\nM06", files=files) == 2
