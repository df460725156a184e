"""SYNTEC programs made ready to run: macro files as a whole, ISO files line by line."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from operator import attrgetter

from polycnc.channel.states.unchanging import unchanging
from polycnc.channel.steps import several
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.blocks import TypedBlock
from polycnc.language.syntec.expressions import syntec_shapes
from polycnc.language.syntec.layout import NO_SEQUENCE
from polycnc.language.syntec.statements import StatementReader
from polycnc.language.syntec.tokens import tokenize
from polycnc.language.word_address.executable import Grammar, WordAddressProgram, empty_block
from polycnc.language.word_address.words import WordBlock
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.steps import Step
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.program import Program

NO_LINE = "COR-018"
_BLOCKS = (WordBlock, TypedBlock)
_START = attrgetter("start")
_BLANKS = str.maketrans("", "", " \t")
_HEAD = regex(r"[ \t]*[O:][ \t]*\d+", re.IGNORECASE)


@unchanging
class MacroProgram:
    """The steps of a macro file (`%@MACRO`): blocks, assignments, tests and jumps.

    Args:
        program: The text.
        shapes: Compiled code of the control.
    """

    def __init__(self, program: Program, shapes: Shapes) -> None:
        self.program = program
        tokens = tokenize(program.lines, macro=True, first_line=program.first_line)
        self._layout = StatementReader(tokens, shapes).read()
        self.steps: Sequence[Step | None] = self._layout.steps
        lines = self._layout.lines
        #: The line of the file at which a step's statement begins. Asked for every row, so it is the list's method.
        self.line = [*lines, lines[-1] if lines else program.first_line].__getitem__

    @property
    def mistakes(self) -> Sequence[AlarmError]:
        """The alarms of everything that cannot be read, in the order of the text."""
        return self._layout.mistakes

    @property
    def unclosed(self) -> Sequence[int]:
        """Lines of statements without their semicolon."""
        return self._layout.unclosed

    def step(self, index: int, *, alone: bool = False) -> Step | None:  # noqa: ARG002 - each is alone
        """A step; None behind the last one."""
        return self.steps[index] if index < len(self.steps) else None

    def column(self, index: int, address: str) -> int:
        """Column, from 1, of an address or a code in the line of a step; 0 when it is not there."""
        text = self.program.lines[self.line(index) - self.program.first_line].upper()
        return text.find(address) + 1 if address else 0

    def counts(self, index: int) -> bool:
        """Whether a step is a block for stages that look ahead: assignments, tests and jumps are none."""
        return index >= len(self.steps) or isinstance(self.steps[index], _BLOCKS)

    def line_of_step(self, index: int) -> int:
        """Index of a step's line in the program's text; that behind the last line for no step."""
        lines = self._layout.lines
        return lines[index] - self.program.first_line if index < len(lines) else len(self.program.lines)

    def step_of_line(self, line: int) -> int:
        """The first step at or behind a line of the text."""
        return bisect_left(self._layout.lines, self.program.first_line + line)

    def scannable_to(self, line: int) -> int:
        """The line behind those that are blocks and nothing else, from a line of the text on."""
        runs, number = self._layout.runs, self.program.first_line + line
        i = bisect_right(runs, number, key=_START) - 1
        return max(line, runs[i].stop - self.program.first_line) if i >= 0 else line

    def find_sequence(self, number: int, _index: int = 0) -> int:
        """The step of `N number`, the first of equal ones in the file."""
        step = self._layout.sequences.get(number)
        if step is None:
            raise AlarmError(NO_SEQUENCE, number=number)
        return step

    def sequence_at(self, index: int) -> int:
        """The last N number at or before a step; 0 where there is none."""
        before = [(step, number) for number, step in self._layout.sequences.items() if step <= index]
        return max(before)[1] if before else 0

    def find_line(self, line: int) -> int:
        """The first step of a line, or of the next line that has one."""
        return _in_file(self.program, line, bisect_left(self._layout.lines, line))


class IsoProgram(WordAddressProgram):
    """The steps of an ISO file: words, and the assignments that the control accepts there."""

    def compile(self, line: str, index: int) -> Step:
        """The step of one line. Blanks between words mean nothing."""
        return super().compile(line.translate(_BLANKS) if "/" not in line else line, index)

    def blank_comments(self, line: str) -> str:
        """The line in upper case with its comments turned into blanks of the same length."""
        line = super().blank_comments(line)
        start = line.find("//")
        return line if start < 0 else line[:start].ljust(len(line))

    def _general(self, _line: str, index: int) -> Step:
        line = self.lines[index]
        head = _HEAD.match(line)
        if head:
            line = " " * head.end() + line[head.end() :]
        tokens = tokenize([line], macro=False, first_line=self.line(index))
        steps = StatementReader(tokens, self.grammar.shapes, macro=False).read().steps
        if len(steps) <= 1:
            return steps[0] if steps else empty_block
        return several(steps)

    def find_sequence(self, number: int, _index: int = 0, mistake: str = "no_sequence") -> int:
        """The step of `N number`, the first of equal ones in the file."""
        return super().find_sequence(number, -1, mistake)

    def sequence_at(self, index: int) -> int:
        """The last N number at or before a step; 0 where there is none."""
        return self.sequence(index)

    def find_line(self, line: int) -> int:
        """The step of a line."""
        return _in_file(self.program, line, line - self.program.first_line)


#: Mistakes in ISO blocks that the shared lexer can find by itself.
_ALARMS = {
    "no_sequence": NO_SEQUENCE,
    "block_too_long": "COM-005",
    "too_many_digits": "COM-003",
    "minus": "COM-003",
}


def iso_grammar() -> Grammar:
    """How a control's ISO files are written."""
    return Grammar(_ALARMS, max_digits=18, shapes=syntec_shapes())


def executable(program: Program, grammar: Grammar, *, macro: bool) -> MacroProgram | IsoProgram:
    """A program ready to run."""
    return MacroProgram(program, grammar.shapes) if macro else IsoProgram(program, grammar)


def _in_file(program: Program, line: int, index: int) -> int:
    if not 0 < line < program.first_line + len(program.lines) or index < 0:
        raise AlarmError(NO_LINE, number=line)
    return index
