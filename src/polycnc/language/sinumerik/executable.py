"""A program of the NC language, ready to run: its blocks, labels and structures.

Blocks are compiled when they are reached. A block that is reached once is not kept: a CAM program of a
million lines would fill the memory with steps that never run again.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_left

from polycnc.channel.states.unchanging import unchanging
from polycnc.channel.steps import forget_steps, kept_steps
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.hot_loop import HotLoop
from polycnc.language.expressions.joined import MOST_JOINS, led_by
from polycnc.language.sinumerik import iso_dialect
from polycnc.language.sinumerik.blocks import CompiledBlock, compile_block, compile_text, expanded
from polycnc.language.sinumerik.emitter import Emitter
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.expressions import ExpressionReader
from polycnc.language.sinumerik.joining import Joiner
from polycnc.language.sinumerik.lexer import Token, prefix_of, tokenize
from polycnc.language.sinumerik.names import rights
from polycnc.language.sinumerik.names.definition_files import load_definitions
from polycnc.language.sinumerik.names.scope import Scope
from polycnc.language.sinumerik.place import fail
from polycnc.language.sinumerik.shapes import Shapes
from polycnc.language.sinumerik.statements.definitions import NO_HEADER, Header, read_header
from polycnc.language.sinumerik.statements.labels import Labels
from polycnc.language.sinumerik.statements.structures import Structure, structures_of
from polycnc.messages import AlarmError
from polycnc.program.line_runs import LineRuns
from polycnc.program.long_text import LongText
from polycnc.program.names import DEF_DIR

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.sinumerik.interface import LanguageControl, LanguageMemory, NcChannel
    from polycnc.program import Program

_DEFINITION = regex(r"[ \t]*(?:DEF|REDEF|DEFINE|PROC|EXTERN)\b", re.IGNORECASE)
#: Type of comments and of the screens of own cycles (cov.com, uc.com, 1.25.4): texts, not programs.
_COMMENT_FILE = "_COM"
#: Texts of EXECSTRING whose steps are kept.
_MOST_TEXTS = 1024
#: A line that begins with none of these is a block.
_BLANK = " \t;%\r\x00"
_EMPTY = regex(r"[ \t\r\x00]*(?:;|%|$)")


@unchanging
class SinumerikProgram:
    """One program; satisfies the channel's `Executable`.

    Args:
        program: The text.
        control: The control that runs it.

    Attributes:
        is_definition_file: It lies where GUD and macros are defined.
    """

    def __init__(self, program: Program, control: LanguageControl) -> None:
        self.program = program
        self.control = control
        self.is_definition_file = program.directory == DEF_DIR
        self.declared: dict[str, int] = {}
        self._lines = _blocks(program.lines)
        self.line = _numbering(self._lines, program.first_line)
        self.steps = kept_steps(len(self._lines))
        self._reached = bytearray(len(self._lines))
        self._scope: Scope | None = None
        self._header: Header | None = None
        self._labels: Labels | None = None
        self._structures: dict[int, Structure] | None = None
        self._first_statement: int | None = None
        self._texts: dict[str, Step] = {}
        self._singles: dict[int, Step] = {}
        self._iso_texts: dict[int, str] = {}
        self._joins: dict[int, set[int]] = {}
        self._joined_into = bytearray(len(self._reached))
        self._shapes = Shapes()
        self._iso: list[range] = []

    @property
    def whole(self) -> SinumerikProgram:
        """The program itself: only a section is a part of one."""
        return self

    # ---- steps ---------------------------------------------------------------------------------------------

    def __len__(self) -> int:
        return len(self._lines)

    def step(self, index: int, *, alone: bool = False) -> Step | None:
        """The step of a block, joined with those behind it from its second run on; None behind the last one."""
        if index >= len(self.steps):
            return None
        return self._singles.get(index, self._first_reach_alone) if alone else self._first_reach

    def counts(self, _index: int) -> bool:
        """Every step is a block for stages that look ahead."""
        return True

    def line_of_step(self, index: int) -> int:
        """Index of a step's line in the program's text; that behind the last line for no step."""
        return self._lines[index] if index < len(self._lines) else len(self.program.lines)

    def step_of_line(self, line: int) -> int:
        """The first step at or behind a line of the text."""
        return bisect_left(self._lines, line)

    def scannable_to(self, line: int) -> int:
        """The line behind those that the scanner may read, from a line of the text on: every line is a block."""
        return line if self._iso else len(self.program.lines)

    @property
    def is_open(self) -> bool:
        """Whether a block has been compiled, and with the first one all that must be there before it."""
        return self._scope is not None

    def text(self, index: int) -> str:
        """The line of a step."""
        return self.program.lines[self._lines[index]]

    def column(self, index: int, address: str) -> int:
        """The column of an address or G function in the block of a step, 0 if it is not there."""
        line = self.text(index)
        try:
            tokens = tokenize(line, prefix_of(line).end)
        except AlarmError:
            return 0
        wanted = address.upper()
        for token in tokens:
            if token.text == wanted or (token.kind == "word" and token.letter == wanted):
                return token.column
        return 0

    def word_columns(self, channel: Channel, position: int) -> int:
        """The column of a word of the running block, by compiling it once more."""
        index, text = channel.level.current, None
        if self._iso and self._is_iso(index):
            text = self._iso_texts.get(index, "")
        columns = compile_block(self, index, channel, text).columns
        return columns[position] if position < len(columns) else 0

    def is_reached(self, index: int) -> bool:
        """Whether a block has been run."""
        return bool(self._reached[index])

    def is_definition(self, index: int) -> bool:
        """Whether a block defines variables (DEF)."""
        line = self.text(index)
        end = prefix_of(line).end
        return line[end:].lstrip().upper().startswith("DEF ") and not self._iso

    def is_repeatable(self, index: int) -> bool:
        """Whether a block can be compiled again by itself: it defines nothing, and is of the language."""
        return not (self._iso or self._defines(self.text(index)) or "291" in self.text(index))

    def forget_steps(self) -> None:
        """Compile every block anew: names may mean other programs now."""
        forget_steps(self.steps)
        self._texts.clear()
        self._singles.clear()
        self._joins.clear()
        self.forget_shapes()

    def forget_shapes(self) -> None:
        """A macro has been defined: equal texts may mean other blocks now."""
        self._shapes = Shapes()
        if self._scope is not None:
            self._scope.memory.programs.generation += 1

    def _first_reach_alone(self, channel: Channel) -> None:
        self._reach(channel.level.current, channel)(channel)

    def _first_reach(self, channel: Channel) -> None:
        index = channel.level.current
        again = self._reached[index]
        step = self._reach(index, channel)
        if again and step is not _skipped:
            joined = self._joined(index, channel) or step
            self.steps[index] = joined if channel.bulk is None else HotLoop(joined, step)
        step(channel)

    def _reach(self, index: int, channel: Channel) -> Step:
        """The step of a block; kept from its second run on."""
        try:
            step = self._compiled(index, channel)
        except AlarmError as error:
            fail(error, channel)
        if self._reached[index] and step is not _skipped:
            self._singles[index] = step
        self._reached[index] = 1
        return step

    def _compiled(self, index: int, channel: Channel) -> Step:
        if self.program.name.endswith(_COMMENT_FILE):
            raise AlarmError("PC0011", text=self.program.name)
        line = self.text(index)
        if self._iso and self._is_iso(index):
            return self._iso_step(index, channel)
        if "291" in line and iso_dialect.switched(line) == "G291":
            return self._begin_iso(index, channel)
        shape = self._shapes.step(line)
        if shape is not None:
            return shape
        skip = prefix_of(line).skip
        if skip >= 0 and self.control.skipped(channel, skip):
            return _skipped
        compiled = self.compiled(index, channel)
        self._shapes.learn(line, compiled.emitter)
        return compiled.step

    # ---- ISO dialect ---------------------------------------------------------------------------------------

    def _is_iso(self, index: int) -> bool:
        """Whether a step is a block of the ISO dialect."""
        return any(self._lines[index] in lines for lines in self._iso)

    def _begin_iso(self, index: int, channel: Channel) -> Step:
        """The step of G291: lines behind it are of the ISO dialect, and what they have been taken for is forgotten."""
        step = compile_text("G290", self, index, channel)
        self.become_iso(self._lines[index] + 1)

        def run(channel: Channel) -> None:
            step(channel)
            self.control.select_iso(channel)

        return run

    def become_iso(self, first: int = 0) -> None:
        """Lines from one on, up to that with G290, are of the ISO dialect."""
        lines = iso_dialect.region(self.program.lines, first)
        if lines not in self._iso:
            self._iso.append(lines)
            self.forget_steps()

    def _iso_step(self, index: int, channel: Channel) -> Step:
        """A block of the ISO dialect, told in the control's own words for the motion that is active now."""
        line = self.text(index)
        if prefix_of(line).skip >= 0 and self.control.skipped(channel, prefix_of(line).skip):
            return _skipped

        def perform(text: str) -> None:
            self._iso_texts[index] = text
            compile_block(self, index, channel, text).step(channel)

        def run(channel: Channel) -> None:
            try:
                self.control.run_iso(channel, iso_dialect.parsed(line), perform)
            except AlarmError as error:
                fail(error, channel)

        return run

    def compiled(self, index: int, channel: Channel) -> CompiledBlock:
        """Compile the block of a step."""
        return compile_block(self, index, channel)

    def unmarked(self, index: int, channel: Channel, text: str) -> CompiledBlock:
        """As `compiled`; of a block that is marked for block skip, its text without the mark."""
        return compile_block(self, index, channel, text if prefix_of(self.text(index)).skip >= 0 else None)

    def _joined(self, index: int, channel: Channel) -> Step | None:
        """A step for the blocks from here on that have been run before; None if there is nothing to join."""
        for join in [join for join, exits in self._joins.items() if index in exits]:
            # A branch that had never been run when blocks were joined has become alive: join anew.
            del self._joins[join]
            self.steps[join] = None
        if channel.setup.switches.interrupts or self._iso:
            return None

        def source(at: int) -> Emitter | None:
            if (
                self._iso
                or at >= len(self._lines)
                or not self._reached[at]
                or prefix_of(self.text(at)).skip >= 0
            ):
                return None
            if self._joined_into[at] >= MOST_JOINS:
                return None
            self._joined_into[at] += 1
            try:
                emitter = self.compiled(at, channel).emitter
            except AlarmError:
                return None
            return emitter if emitter.joins else None

        joiner = Joiner(source, self.structures, index, self._singles[index])
        step = joiner.step(self.control.shapes)
        if step is None:
            return None
        self._joins[index] = joiner.exits
        return led_by(self._singles[index], step)

    def run_definitions(self, channel: Channel) -> None:
        """Run the blocks of the definition section for the running level, whose first block is another one."""
        for index in range(self.first_statement):
            self.compiled(index, channel).step(channel)

    def execute_text(self, channel: Channel, text: str) -> None:
        """Run a text as a block of this program (EXECSTRING)."""
        step = self._texts.get(text)
        if step is None:
            try:
                step = compile_text(text, self, channel.level.current, channel)
            except NcSyntaxError as error:
                error.column = 0
                raise
            if len(self._texts) >= _MOST_TEXTS:
                self._texts.clear()
            self._texts[text] = step
        channel.off_path = False
        step(channel)

    def tokens(self, index: int, channel: Channel) -> list[Token]:
        """The tokens of a block behind its number and label."""
        line = self.text(index)
        return expanded(tokenize(line, prefix_of(line).end), self.scope_of(channel))

    # ---- names ---------------------------------------------------------------------------------------------

    def scope_of(self, channel: NcChannel) -> Scope:
        """What names mean in this program."""
        if self._scope is None:
            memory: LanguageMemory = channel.memory.language
            main = None
            main_program = channel.stack[0].code.whole
            if memory.main_variables_everywhere and main_program is not self:
                main = main_program.scope_of(channel)
            self._scope = Scope(memory, self.control, main)
            if not self.is_definition_file:
                self._scope.own_level = memory.directory_levels.get(self.program.directory, rights.LOWEST)
            memory.programs.add(self)
            if not memory.definitions_loaded:
                memory.definitions_loaded = True
                load_definitions(channel)
            self.header(channel)
        return self._scope

    def header(self, channel: Channel) -> Header:
        """The PROC line, read when it is first asked for."""
        if self._header is None:
            scope = self.scope_of(channel)
            if self._header is None:
                self._header = self._read_header(scope, channel)
                main = channel.stack[0]
                if main.code is self and self._header.parameters:
                    main.locals = list(self._header.arguments_left_out())
        return self._header

    def _read_header(self, scope: Scope, channel: Channel) -> Header:
        if not self.begins_with_header:
            return NO_HEADER
        line = self.text(0)
        tokens = tokenize(line, prefix_of(line).end)
        try:
            return read_header(ExpressionReader(tokens, scope, Emitter(scope.control.shapes)), channel)
        except AlarmError as error:
            # It is read where the program is called: the mistake is not in the block that calls.
            error.line = error.line or self.line(0)
            error.program = channel.toolpath.program_number(self.program.name)
            raise

    @property
    def begins_with_header(self) -> bool:
        """Whether the first block is a PROC line."""
        line = self.text(0) if len(self) else ""
        end = prefix_of(line).end
        return line[end : end + 5].strip().upper().startswith("PROC")

    def is_first_statement(self, index: int) -> bool:
        """Whether a step is the first block of the program."""
        return index == 0

    @property
    def first_statement(self) -> int:
        """The first step behind the definitions."""
        if self._first_statement is None:
            self._first_statement = next(
                (i for i in range(len(self)) if not self._defines(self.text(i))), len(self)
            )
        return self._first_statement

    @staticmethod
    def _defines(line: str) -> bool:
        end = prefix_of(line).end
        return _DEFINITION.match(line, end) is not None or _EMPTY.match(line, end) is not None

    def in_definitions(self, index: int) -> bool:
        """Whether a step stands before the first executable block."""
        return self.is_definition_file or index < self.first_statement

    # ---- labels and structures -----------------------------------------------------------------------------

    @property
    def labels(self) -> Labels:
        """Labels and block numbers."""
        if self._labels is None:
            self._labels = Labels([self.text(i) for i in range(len(self))])
        return self._labels

    def find_target(self, target: str, here: int, word: str) -> int:
        """The step of a jump target; -1 if there is none in the direction of the jump."""
        return self.labels.find(target, here, word)

    def find_label(self, label: str, here: int) -> int:
        """The step of a label: first towards the start of the program, then towards its end; -1 for none."""
        return self.labels.find_back_first(label, here)

    def find_return_target(self, target: str, here: int) -> int:
        """The step at which RET goes on: a label, a block number, or a block that begins with the text."""
        return self.labels.find_return(target, here)

    def section_ends(self, start: int, last: str, here: int) -> set[int]:
        """The steps behind which a pass of a section ends (1.11); empty if the end label is missing."""
        return self.labels.section_ends(start, last, here)

    @property
    def structures(self) -> dict[int, Structure]:
        """The control structure of every step that belongs to one."""
        if self._structures is None:
            self._structures = structures_of([self.text(i) for i in range(len(self))])
        return self._structures

    def structure(self, index: int, token: Token) -> Structure:
        """The control structure that a word belongs to; 12640 or 12641 for one that does not fit."""
        structure = self.structures.get(index)
        if structure is None:
            raise NcSyntaxError("12640", token.column, token.text)
        if structure.error:
            raise NcSyntaxError(structure.error, token.column, token.text)
        return structure


def _blocks(lines: Sequence[str]) -> Sequence[int]:
    """The lines that are blocks: neither empty nor a comment alone."""
    if isinstance(lines, LongText):
        return LineRuns(lines.not_beginning(_BLANK, _is_block))
    return array("I", (i for i, line in enumerate(lines) if line[:1] not in _BLANK or _is_block(line)))


def _numbering(lines: Sequence[int], first: int) -> Callable[[int], int]:
    """What gives the line in the file of a step; behind the last one, its line.

    It is asked for every row, so it is the own method of an array where the program is no long one.
    """
    if isinstance(lines, LineRuns):
        last = len(lines) - 1
        return lambda index: first + (lines[min(index, last)] if lines else 0)
    numbers = array("I", map(first.__add__, lines))
    numbers.append(numbers[-1] if numbers else first)
    return numbers.__getitem__


def _is_block(line: str) -> bool:
    return _EMPTY.match(line) is None


def _skipped(channel: Channel) -> None:
    """A block that the operator has switched off."""
    channel.off_path = channel.attention
