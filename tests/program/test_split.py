from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.program import Form, Program, split_channels, split_programs
from polycnc.program.split import Source
from polycnc.program.text import split_lines


def split(text: str, default: Form = Form.WORD_ADDRESS, name: str = "PART.NC") -> tuple[Program, ...]:
    return split_programs(split_lines(text), Source(name), default)


def summary(programs: tuple[Program, ...]) -> list[tuple[str, int, list[str]]]:
    return [(program.name, program.first_line, list(program.lines)) for program in programs]


# --- tapes -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("%\nO0001\nM30\n%", [("O0001", 2, ["O0001", "M30"])]),
        ("O0001\nM30", [("O0001", 1, ["O0001", "M30"])]),
        ("M30\n%", [("PART.NC", 1, ["M30"])]),
        ("%\nN10 G0 X1\nM30\n%", [("PART.NC", 2, ["N10 G0 X1", "M30"])]),
        (":0097\nM99", [("O0097", 1, [":0097", "M99"])]),
        ("o12 (SUB)\nM99", [("O0012", 1, ["o12 (SUB)", "M99"])]),
        ("  O12345678;\nM99", [("O12345678", 1, ["  O12345678;", "M99"])]),
        ("%\n<FIXTURE-1>(A)\nM99\n%", [("FIXTURE-1", 2, ["<FIXTURE-1>(A)", "M99"])]),
        ("%O0005 (X)\nM30\n%", [("O0005", 1, [" O0005 (X)", "M30"])]),
        ("%\nO1\nM30\n%\n%\nO2\nM99\n%", [("O0001", 2, ["O1", "M30"]), ("O0002", 6, ["O2", "M99"])]),
        ("O1\nM98 P2\nM30\nO2\nM99", [("O0001", 1, ["O1", "M98 P2", "M30"]), ("O0002", 4, ["O2", "M99"])]),
        (
            "G0 X1\nM98 P2\nM30\nO2\nM99",
            [("PART.NC", 1, ["G0 X1", "M98 P2", "M30"]), ("O0002", 4, ["O2", "M99"])],
        ),
        ("(TITLE)\n\nO2\nM99", [("O0002", 3, ["O2", "M99"])]),
        ("PART 4711 REV B\n%\nO2\nM99\n%\nend of mail", [("O0002", 3, ["O2", "M99"])]),
        ("", [("PART.NC", 1, [])]),
        ("%", [("PART.NC", 1, [])]),
        ("(ONLY A COMMENT)", [("PART.NC", 1, ["(ONLY A COMMENT)"])]),
        ("#1=5\nO2\nM99", [("PART.NC", 1, ["#1=5"]), ("O0002", 2, ["O2", "M99"])]),
        ("IF[#1EQ0]GOTO5\nO2", [("PART.NC", 1, ["IF[#1EQ0]GOTO5"]), ("O0002", 2, ["O2"])]),
    ],
)
def test_a_tape_holds_these_programs(text: str, expected: list[tuple[str, int, list[str]]]) -> None:
    assert summary(split(text)) == expected


@pytest.mark.parametrize(
    "line",
    [
        "(O1234 OLD NUMBER)",
        "; O12",
        "N10 (O7)",
        "M98 P1234",
        "G65 <PROBE>",
        "N5 O9",
        "O#1",
        "O1.5",
        "OR",
        "/O0009",
    ],
)
def test_what_is_no_heading_starts_no_program(line: str) -> None:
    assert summary(split(f"O0001\n{line}\nM30")) == [("O0001", 1, ["O0001", line, "M30"])]


def test_a_program_number_is_a_number() -> None:
    assert [program.number for program in split(":0097\nM99\n<NAME>\nM99")] == [97, None]


@given(st.lists(st.integers(0, 99_999_999), min_size=1, max_size=6, unique=True), st.data())
def test_lines_of_every_program_are_where_the_file_has_them(numbers: list[int], data: st.DataObject) -> None:
    block = st.sampled_from(["G0 X1", "", "(O5)", "N10 M98 P7", "%"])
    lines = []
    for number in numbers:
        lines += [f"O{number}", *data.draw(st.lists(block, max_size=4))]
    programs = split("\n".join(lines))
    assert [program.number for program in programs] == numbers
    for program in programs:
        for index, text in enumerate(program.lines):
            assert lines[program.line_number(index) - 1] == text


@given(st.text(st.sampled_from("%O:<>1N_M$PATH=/ ;(@CR\n"), max_size=60), st.sampled_from(Form))
def test_every_text_is_at_least_one_program(text: str, form: Form) -> None:
    lines = split_lines(text)
    programs = split(text, form)
    assert programs
    for program in programs:
        for index, line in enumerate(program.lines):
            assert lines[program.line_number(index) - 1].replace("%", " ") == line.replace("%", " ")


# --- SYNTEC ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("header", ["%@MACRO", "% @ MACRO", "%@macro // drilling", "\n  %@MACRO"])
def test_a_macro_header_makes_the_whole_file_one_program(header: str) -> None:
    programs = split(f"{header}\n@1 := 0;\nO0002\nM99;\n%")
    assert [program.form for program in programs] == [Form.MACRO]
    assert list(programs[0].lines) == ["@1 := 0;", "O0002", "M99;"]
    assert programs[0].first_line == header.count("\n") + 2


@pytest.mark.parametrize("text", ["%\n@MACRO", "% // @MACRO", "O1\n%@MACRO", "(%@MACRO)"])
def test_only_the_first_line_can_be_a_macro_header(text: str) -> None:
    assert split(text)[0].form is Form.WORD_ADDRESS


def test_channels_keep_the_line_numbers_of_the_file() -> None:
    (program,) = split("%@MACRO\n(BOTH)\n$1\nG0 X1\n$2 // second\nG0 Y1\n$1\nM30")
    channels = split_channels(program)
    assert list(channels) == [1, 2]
    assert list(channels[1].lines) == ["(BOTH)", "", "G0 X1", "", "", "", "M30"]
    assert list(channels[2].lines) == ["", "", "", "", "G0 Y1", "", ""]
    assert [channels[2].line_number(4), channels[2].form] == [6, Form.MACRO]


def test_a_program_without_sections_has_no_channels() -> None:
    assert split_channels(split("O1\nM30")[0]) == {}


# --- SINUMERIK -------------------------------------------------------------------------------------------

ARCHIVE = """%_N_MAIN_MPF
;$PATH=/_N_WKS_DIR/_N_WELLE_WPD
N10 SUB1
O0005
M30

%_N_SUB1_SPF
M17
%_N_init_ini
$MC_X=1
%_N_MGUD_DEF
; comment
;$PATH=/_N_DEF_DIR
"""


def test_an_archive_holds_programs_with_their_directories() -> None:
    programs = split(ARCHIVE)
    assert [(p.name, p.directory, p.first_line) for p in programs] == [
        ("_N_MAIN_MPF", "/_N_WKS_DIR/_N_WELLE_WPD", 2),
        ("_N_SUB1_SPF", "/_N_SPF_DIR", 8),
        ("_N_INIT_INI", "/_N_RAM", 10),
        ("_N_MGUD_DEF", "/_N_DEF_DIR", 12),
    ]
    assert list(programs[0].lines) == [";$PATH=/_N_WKS_DIR/_N_WELLE_WPD", "N10 SUB1", "O0005", "M30", ""]
    assert {program.form for program in programs} == {Form.SINUMERIK}


def test_a_comment_header_names_a_plain_file() -> None:
    (program,) = split("; shaft\n;%_N_WELLE_MPF\n;$PATH=/_N_WKS_DIR/_N_WELLE_WPD\nN10 G0 X0\n")
    assert (program.name, program.directory) == ("_N_WELLE_MPF", "/_N_WKS_DIR/_N_WELLE_WPD")
    assert (program.first_line, len(program.lines)) == (1, 4)


def test_a_main_block_of_sinumerik_is_no_program_number() -> None:
    text = ":10 G0 X0\nN20 X1\n:30 M30"
    assert summary(split(text, Form.SINUMERIK, "A.MPF")) == [("A.MPF", 1, text.split("\n"))]
    assert len(split(text)) == 2


def test_lone_tape_marks_around_a_sinumerik_program_are_no_text() -> None:
    assert summary(split("%\nM30\n%\n", Form.SINUMERIK)) == [("PART.NC", 2, ["M30"])]
