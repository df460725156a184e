from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from polycnc.channel.intervention import NOTHING_BACK
from polycnc.language.syntec.executable import IsoProgram, MacroProgram, executable, iso_grammar
from polycnc.language.syntec.values import VACANT
from polycnc.messages import AlarmError
from polycnc.program import Program


class Recorder:
    """Stands for a channel: runs steps and notes the blocks of words."""

    def __init__(self, text: str, *, macro: bool = True) -> None:
        self.code = executable(Program("TEST", text.split("\n")), iso_grammar(), macro=macro)
        self.blocks: list[tuple[tuple[str, ...], list[float]]] = []
        self.memory: Any = SimpleNamespace(locals={}, functions={})
        self.memory.variable = lambda index: self.memory.locals.get(index, VACANT)
        self.memory.set_variable = self.memory.locals.__setitem__
        self.level = SimpleNamespace(index=0, current=0, code=self.code)
        self.mode = SimpleNamespace(plans={})
        self.control = self
        self.skip_levels = 0
        self.finished = self.attention = False

    def plan(self, _channel: Any, signature: tuple[str, ...]) -> Any:
        step = lambda _channel, values: self.blocks.append((signature, values))  # noqa: E731
        return SimpleNamespace(mode=self.mode, steps=(step,), takes_back=NOTHING_BACK)

    def run(self) -> Recorder:
        for _ in range(10_000):
            step = self.code.step(self.level.index)
            if step is None:
                return self
            self.level.current = self.level.index
            self.level.index += 1
            step(self)  # type: ignore[arg-type]
        raise AssertionError("endless")


def test_words_with_numbers_keep_how_they_were_written() -> None:
    blocks = Recorder("N10 G01 X5 Y5. Z5.1234 G54.10 M03;").run().blocks
    assert blocks == [(("G1", "X", "Y.", "Z:", "G54.10", "M3"), [5.0, 5.0, 5.1234])]


def test_words_with_values_are_written_as_the_type_of_the_value() -> None:
    blocks = Recorder('#1 := 3; #2 := 3.; X#1 Y#2 Z#3 P"ABC" G(50+4) X1=#1;').run().blocks
    assert blocks == [(("X", "Y.", 'P"', "G54", "X1"), [3, 3.0, "ABC", 3])]


def test_minus_zero_keeps_its_sign() -> None:
    ((_, values),) = Recorder("Y-0;").run().blocks
    assert str(values[0]) == "-0.0"


def test_a_block_ends_where_the_next_line_begins_a_new_one() -> None:
    blocks = Recorder("G01 X1\n,R5\nY2\nM30;").run().blocks
    assert [signature for signature, _ in blocks] == [("G1", "X", ",R"), ("Y",), ("M30",)]


def test_statements_without_semicolon_are_counted() -> None:
    code = Recorder("#1 := 1\nG0 X1;\nIF 1 THEN\nEND_IF\nM30;").code
    assert isinstance(code, MacroProgram)
    assert list(code.unclosed) == [1, 4]


def test_all_mistakes_of_a_file_are_found_at_once() -> None:
    code = Recorder("#1 = ;\nG0 X1;\nIF 1\nG0 X2;\nEND_IF;\nEND_FOR;\nWHILE 1 DO\n").code
    assert isinstance(code, MacroProgram)
    assert [(error.code, error.line) for error in code.mistakes] == [
        ("COM-003", 1),
        ("COM-019", 4),
        ("COM-013", 6),
        ("COM-018", 7),
    ]


def test_a_mistake_alarms_only_when_it_is_reached() -> None:
    recorder = Recorder("G0 X1;\nIF 1 THAN\nM30;")
    with pytest.raises(AlarmError, match="COM-0"):
        recorder.run()
    assert recorder.blocks == [(("G0", "X"), [1.0])]


def test_every_statement_names_its_line() -> None:
    code = Recorder("\n#1 := 1;\n\nIF #1 THEN\n  G0 X1;\nEND_IF;").code
    assert [code.line(index) for index in range(3)] == [2, 4, 5]
    assert code.line(3) == 5


def test_of_equal_sequence_numbers_the_first_counts() -> None:
    code = Recorder("N5 G0 X1;\nN5 G0 X2;\nN6;").code
    assert code.find_sequence(5) == 0
    assert code.find_sequence(6) == 2
    with pytest.raises(AlarmError, match="COR-017"):
        code.find_sequence(7)


def test_lines_are_found_for_returns() -> None:
    code = Recorder("G0 X1;\n// note\nG0 X2;").code
    assert code.find_line(2) == code.find_line(3) == 1
    with pytest.raises(AlarmError, match="COR-018"):
        code.find_line(9)


def test_iso_text_gives_one_step_a_line() -> None:
    recorder = Recorder("O0001 (TEST)\nN1 G0X1 Y2.\n\nG01 X5; Y6 // end\n#1 := 5", macro=False)
    assert isinstance(recorder.code, IsoProgram)
    recorder.run()
    assert recorder.blocks == [
        (("G0", "X", "Y."), [1.0, 2.0]),
        (("G1", "X"), [5.0]),
        (("Y",), [6.0]),
    ]
    assert recorder.memory.locals == {1: 5}


def test_skipped_blocks_depend_on_the_switch_of_their_level() -> None:
    recorder = Recorder("/G0 X1;\n/2 G0 X2;\nG0 X3;")
    recorder.skip_levels = 1 << 2
    recorder.run()
    assert [values for _, values in recorder.blocks] == [[1.0], [3.0]]


def test_loops_may_be_left_and_entered_again_by_goto() -> None:
    recorder = Recorder(
        "FOR #1 := 1 TO 3 DO\n#2 := #2 + 1;\nIF #2 = 2 THEN GOTO 9; END_IF;\nEND_FOR;\nGOTO 8;\n"
        "N9 #3 := #1;\nN8;"
    ).run()
    assert recorder.memory.locals[2] == 2
    assert recorder.memory.locals[3] == 2


@pytest.mark.parametrize(
    "text", ["G0 X1 / 2 / ;", ";;;", "(* *)", "N1N2G0;", "X=;", "#[1;", "CASE", "FOR", "@ := 1;"]
)
def test_odd_text_never_breaks_the_reader(text: str) -> None:
    Recorder(text)


def test_five_hundred_groups_of_one_kind_are_enough() -> None:
    code = Recorder("IF 1 THEN END_IF;\n" * 513).code
    assert isinstance(code, MacroProgram)
    assert [error.code for error in code.mistakes] == ["COM-030"]
