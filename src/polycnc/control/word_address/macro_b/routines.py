"""Subprograms, macros and loops of custom macro B, for the scanner: what their lines do, and what a call leaves."""

from __future__ import annotations

from array import array
from math import isnan

from polycnc.channel.stack import LevelKind
from polycnc.control.word_address.macro_b.variables import LOCALS
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.formulas.postfix import OtherError, Postfix
from polycnc.language.bulk.layout import Operation
from polycnc.language.bulk.routines.kept import MOST_LINES
from polycnc.language.bulk.routines.layout import NO_LOOP, LineKind
from polycnc.language.bulk.routines.statements import BLOCK, NOTHING, REFUSED, Statement
from polycnc.language.word_address.executable import SkippedBlock, empty_block
from polycnc.language.word_address.patterns import MEMORIES
from polycnc.language.word_address.statements import (
    Assignment,
    ConditionalJump,
    Jump,
    LoopBegin,
    LoopEnd,
    NumberedAssignment,
)
from polycnc.language.word_address.words import ExpressionBlock, WordBlock
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.stack import Level
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.language.word_address.executable import WordAddressProgram
    from polycnc.program import Program

#: Longer numbers hold how often a program runs, or are a matter of a parameter.
_LAST_PROGRAM = 9_999


class MacroRoutines:
    """What the scanner asks of routines on a control with custom macro B."""

    def most_frames(self, channel: MacroChannel) -> int:
        """How many programs may be called within each other from here on, of whatever kind."""
        try:
            for kind in (LevelKind.SUBPROGRAM, LevelKind.MACRO):
                channel.control.check_nesting(channel, kind)
        except AlarmError:
            return 0  # the interpreter comes to the call and raises it
        macros = sum(level.kind in channel.control.MACRO_KINDS for level in channel.stack)
        others = len(channel.stack) - 1 - macros
        most_macros, most_others, most = channel.control.CALL_LEVELS
        return min(most_macros - macros, most_others - others, most - macros - others)

    def program_called(self, channel: MacroChannel, number: int) -> Program | None:
        """The program of a number, None for one that the interpreter calls."""
        if number > _LAST_PROGRAM:
            return None
        try:
            program: Program = channel.control.find_program(channel, number)
        except AlarmError:
            return None
        return program

    # ---- lines ---------------------------------------------------------------------------------------

    def told(self, channel: MacroChannel, code: WordAddressProgram, index: int, _is_met: bool) -> Statement:
        """What a step of a program does."""
        try:
            return _Teller(channel, code).told(code.compile(code.lines[index], index))
        except (AlarmError, OtherError):
            return REFUSED  # the interpreter comes to the same line and raises it

    # ---- levels of the program stack -----------------------------------------------------------------

    def enter(
        self,
        channel: MacroChannel,
        code: WordAddressProgram,
        repeats: int,
        first: int,
        variables: Sequence[float] | None,
    ) -> None:
        """Put a program on the stack: a macro with local variables, or a subprogram, which shares the caller's."""
        if variables is None:
            kind, values = LevelKind.SUBPROGRAM, channel.level.locals
        else:
            kind, values = LevelKind.MACRO, [None, *map(_value, variables[1:LOCALS])]
            channel.memory.locals = values
        channel.push(code.program, kind=kind, repeats=repeats, index=first, local=values)

    def take_locals(self, channel: MacroChannel, before: Sequence[float], after: Sequence[float]) -> None:
        """Local variables of the running level that have changed."""
        _take(channel.memory.locals, before, after, range(1, LOCALS))

    def take_common(self, channel: MacroChannel, before: Sequence[float], after: Sequence[float]) -> None:
        """Common variables that have changed."""
        memory = channel.memory
        _take(memory.common, before, after, MEMORIES["common"])
        _take(memory.kept, before, after, MEMORIES["kept"])

    def put_loops(self, level: Level[WordAddressProgram], loops: Sequence[int]) -> list[int]:
        """By their numbers the steps behind those that have opened the loops of a level."""
        return [
            loop.start + 1 if (loop := level.data.get(number)) is not None else NO_LOOP
            for number in range(len(loops))
        ]

    def take_loops(
        self, level: Level[WordAddressProgram], before: Sequence[int], after: Sequence[int]
    ) -> None:
        """Loops of a level that have been opened or have ended."""
        for number, (old, new) in enumerate(zip(before, after, strict=True)):
            if new == NO_LOOP and old != NO_LOOP:
                del level.data[number]
            elif new != old:
                opened = level.code.step(new - 1)  # kept: a loop that waits must be the one that it was
                assert isinstance(opened, LoopBegin)
                level.data[number] = opened.loop

    def loop_around(self, channel: MacroChannel) -> tuple[int, int]:
        """First step, and how many there are, of the outermost loop that the running level is in; none: 0 and 0."""
        level = channel.level
        around = [
            (loop.start, loop.end) for loop in level.data.values() if loop.start < level.index <= loop.end
        ]
        around += level.code.jumps_around(level.index)
        if not around:
            return 0, 0
        first, last = min(start for start, _ in around), max(end for _, end in around)
        return (first, last + 1 - first) if last - first < MOST_LINES else (0, 0)


def assignment_as_data(channel: MacroChannel, line: str) -> tuple[int, ...] | None:
    """What a line of text that gives a variable a value calculates; None where the interpreter must."""
    code: WordAddressProgram = channel.level.code
    try:
        step = code.compile(line, channel.level.index)
        if not isinstance(step, Assignment):
            return None
        # The variable comes first in the text, and last among the numbers of the code.
        last = len(step.statement.numbers) - 1
        literals = {last: 0} | {i: i + 1 for i in range(last)}
        postfix = Postfix(literals, within_turn=not channel.memory.angle_range_signed)
        postfix.assignment(step.statement.code)
    except (AlarmError, OtherError):
        return None
    return tuple(postfix.done)


class _Teller:
    """Tells what steps of a program do."""

    def __init__(self, channel: MacroChannel, code: WordAddressProgram) -> None:
        self._channel = channel
        self._code = code

    def told(self, step: object) -> Statement:
        """What a step does.

        Raises:
            OtherError: It is the interpreter's.
        """
        if isinstance(step, SkippedBlock):
            return self.told(step.chosen(self._channel))
        if isinstance(step, (WordBlock, ExpressionBlock)):
            return BLOCK
        if step is empty_block:
            return NOTHING
        if isinstance(step, Assignment):
            numbers = step.statement.numbers
            postfix = self.postfix(len(numbers), 0, numbers)
            postfix.assignment(step.statement.code)
            return Statement(LineKind.STATEMENT, tuple(postfix.done), numbers)
        if isinstance(step, NumberedAssignment):
            return self._told_numbered(step)
        if isinstance(step, ConditionalJump):
            return self._told_condition(step)
        if isinstance(step, Jump):
            return Statement(LineKind.JUMP, target=step.target)
        if isinstance(step, LoopBegin):
            formulas, numbers = self._condition(step)
            return Statement(LineKind.LOOP, formulas, numbers, step.loop.end + 1, step.number)
        if isinstance(step, LoopEnd):
            return self._told_end(step)
        raise OtherError

    def postfix(self, count: int, behind: int, numbers: Sequence[float]) -> Postfix:
        """For code with so many numbers, which stand behind some others."""
        within_turn = not self._channel.memory.angle_range_signed
        return Postfix({i: i + behind for i in range(count)}, numbers, within_turn=within_turn)

    def _told_numbered(self, step: NumberedAssignment) -> Statement:
        """`#[…]=…`."""
        number, value = step.number, step.value
        postfix = self.postfix(len(number.numbers), 0, number.numbers)
        postfix.value(number.code)
        behind = self.postfix(len(value.numbers), len(number.numbers), value.numbers)
        behind.numbered_assignment(value.code)
        return Statement(LineKind.STATEMENT, (*postfix.done, *behind.done), (*number.numbers, *value.numbers))

    def _told_condition(self, step: ConditionalJump) -> Statement:
        """`IF … GOTO n`, `IF … THEN #1=…`."""
        lifting, jump = step.condition.lifting, step.jump
        postfix = self.postfix(len(lifting.numbers), 0, lifting.numbers)
        postfix.condition(lifting.code)
        if isinstance(jump, Jump):
            return Statement(LineKind.JUMP, tuple(postfix.done), lifting.numbers, jump.target)
        if not isinstance(jump, Assignment):
            raise OtherError
        others = jump.statement.numbers
        behind = self.postfix(len(others), len(lifting.numbers), others)
        behind.assignment(jump.statement.code)
        done = (*postfix.done, Operation.UNLESS, 0, *behind.done)
        return Statement(LineKind.STATEMENT, done, (*lifting.numbers, *others))

    def _told_end(self, end: LoopEnd) -> Statement:
        """`END m`, by the DO that belongs to it."""
        code = self._code
        for index in range(end.index - 1, -1, -1):
            begin = code.compile(code.lines[index], index)
            if isinstance(begin, LoopBegin) and begin.number == end.number:
                if begin.loop.end != end.index:
                    break
                formulas, numbers = self._condition(begin)
                return Statement(LineKind.LOOP_END, formulas, numbers, index + 1, end.number)
        raise OtherError

    def _condition(self, begin: LoopBegin) -> tuple[tuple[int, ...], tuple[float, ...]]:
        if begin.condition is None:
            return (), ()
        lifting = begin.condition.lifting
        postfix = self.postfix(len(lifting.numbers), 0, lifting.numbers)
        postfix.condition(lifting.code)
        return tuple(postfix.done), lifting.numbers


def _value(number: float) -> float | None:
    return None if isnan(number) else number


def _take(
    target: list[float | None] | dict[int, float | None],
    before: Sequence[float],
    after: Sequence[float],
    numbers: range,
) -> None:
    """Variables of some numbers whose values have changed, if only from 0 to -0."""
    old, new = _bits(before, numbers), _bits(after, numbers)
    if old == new:
        return
    for place, number in enumerate(numbers):
        if new[place] != old[place]:
            target[number] = _value(after[number])


def _bits(variables: Sequence[float], numbers: range) -> list[int]:
    """Variables of some numbers as whole numbers, which are equal where nothing tells them apart."""
    return array("q", array("d", variables[numbers.start : numbers.stop]).tobytes()).tolist()
