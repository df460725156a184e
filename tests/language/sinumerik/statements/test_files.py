from __future__ import annotations

import pytest

from tests.language.sinumerik.running import run, value, values

LINES = {"/_N_SPF_DIR/_N_TEXT_SPF": "one\ntwo\nthree\nfour"}


def test_lines_are_written_and_read() -> None:
    program = (
        'DEF INT EE\nDEF STRING[20] SS[2]\nWRITE(EE,"LOG","first")\nWRITE(EE,"_N_LOG_MPF","second")\n'
        'READ(EE,"LOG",1,2,SS)\nR1=EE R2=ISFILE("LOG_MPF")'
    )
    assert values(program, "SS[0]", "SS[1]", "R1", "R2") == ["first", "second", 0, 1]


def test_line_0_means_the_last_lines_and_long_lines_are_cut() -> None:
    program = 'DEF INT EE\nDEF STRING[3] SS[2]\nREAD(EE,"/_N_SPF_DIR/_N_TEXT_SPF",0,2,SS)'
    assert values(program, "SS[0]", "SS[1]", "EE", files=LINES) == ["thr", "fou", 0]


@pytest.mark.parametrize(
    ("call", "error"),
    [
        ('WRITE(EE,"A B","x")', 1),
        ('WRITE(EE,"/_N_NO_DIR/AA","x")', 2),
        ('WRITE(EE,"AA_TEA","x")', 4),
        ('WRITE(EE,"MAIN","x")', 0),
        ('DELETE(EE,"MAIN")', 11),
        ('DELETE(EE,"NOSUCH")', 3),
        ('READ(EE,"NOSUCH",1,1,SS)', 3),
        ('READ(EE,"/_N_SPF_DIR/_N_TEXT_SPF",4,2,SS)', 23),
        ('READ(EE,"/_N_SPF_DIR/_N_TEXT_SPF",1,3,SS)', 22),
        ('READ(EE,"/_N_SPF_DIR/_N_TEXT_SPF",1,99999,SS)', 21),
        ('FILEINFO(EE,"/_N_SPF_DIR/_N_TEXT_SPF",SS[0])', 22),
    ],
)
def test_errors_are_reported_and_not_alarmed(call: str, error: int) -> None:
    assert value(f"DEF INT EE\nDEF STRING[9] SS[2]\n{call}", "EE", files=LINES) == error


def test_a_file_may_be_deleted_and_its_size_asked() -> None:
    program = 'DEF INT EE, SIZE\nFILESIZE(EE,"{0}",SIZE)\nDELETE(EE,"{0}")\nR1=ISFILE("{0}")'
    assert values(program.format("/_N_SPF_DIR/_N_TEXT_SPF"), "SIZE", "EE", "R1", files=LINES) == [19, 0, 0]


def test_a_full_file_takes_no_more() -> None:
    program = 'DEF INT EE\nDEF STRING[200] SS="{}"\nFOR R1=1 TO 10\nWRITE(EE,"LOG",SS)\nIF EE GOTOF OUT\nENDFOR\nOUT:'
    result = run(program.format("x" * 199), setup={"parameters": {"11420": 1}})
    assert (result.variables["EE"], result.variables["R1"]) == (10, 6)


def test_a_checksum_changes_with_every_element() -> None:
    program = (
        'DEF STRING[16] S1A, S2A, S3A\nDEF INT AA[3,2]\nR1=CHECKSUM(S1A,"AA")\nAA[2,1]=1\nR1=CHECKSUM(S2A,"AA")\n'
        'R1=CHECKSUM(S3A,"AA",0,1) R2=CHECKSUM(S3A,"BB") R3=CHECKSUM(S3A,"S1A") R4=CHECKSUM(S3A,"AA",3,3)'
    )
    program = program.replace("S1A", "SA").replace("S2A", "SB").replace("S3A", "SC")
    first, second, r2, r3, r4 = values(program, "SA", "SB", "R2", "R3", "R4")
    assert len(first) == 16
    assert first != second
    assert (r2, r3, r4) == (1, 2, 3)
