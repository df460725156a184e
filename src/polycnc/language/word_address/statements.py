"""Macro statements: assignments, IF, WHILE, GOTO, DO/END, printing. Each parser gives a step.

A statement stands alone in its block (after N and /). Steps that jump set `channel.level.index`; loops keep their DO
steps in `channel.level.data`, so that a jump into a loop is found out at its END.
"""

from __future__ import annotations

import re

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.language.expressions.code import assigned
from polycnc.language.expressions.shapes import with_values
from polycnc.language.word_address.functions import round_half_away
from polycnc.language.word_address.macro_b import Lifting
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FunctionType

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.expressions.code import Code
    from polycnc.language.word_address.macro_b import Evaluate, Reader

KEYWORD = regex(
    r"IF|WHILE|WH(?=\s*\[)|GOTO|GO(?=\s*[\d#\[])|DO|END|POPEN|PCLOS|DPRNT|BPRNT|SETVN|#|\[(?=#_?[A-Z])"
)
_INTEGER = regex(r"\d+")
_PRINT_FORMAT = regex(r"#\s*(\[[^\]]*\]|\d+)\s*\[\s*(\d)\s*(\d)?\s*\]")
MAX_SEQUENCE_NUMBER = 99_999_999


class StatementProgram(Protocol):
    """What statements ask of the program that they stand in."""

    @property
    def may_jump(self) -> bool:
        """Whether jumps and loops may stand in it."""

    @property
    def last_loop(self) -> int:
        """The largest number of a loop."""

    def find_sequence(self, number: int, index: int) -> int:
        """The step of `N number`, looked for from step `index` on."""

    def loop_end(self, index: int, number: int) -> int:
        """The step of the END that belongs to the DO in step `index`."""


def parse_statement(reader: Reader, keyword: str, program: StatementProgram, index: int) -> Step:
    """The step of the macro statement that begins with `keyword` (already read)."""
    parser = _PARSERS[keyword]
    step = parser(reader, program, index)
    if reader.peek():
        raise reader.fail("nc_and_macro" if reader.peek().isalpha() else "expression")
    return step


# ---- assignments ----------------------------------------------------------------------------------------------------


def parse_assignment(reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`#n = expression`, `#[expression] = …`, `#3000 = n (TEXT)`."""
    if reader.peek() == "[":
        target: Lifting | int = reader.lifting(reader.bracket())
        digits_at = -1
    else:
        digits = reader.match(_INTEGER)
        if not digits:
            raise reader.fail("expression")
        target, digits_at = int(digits), reader.pos - len(digits)
    if not reader.accept("="):
        raise reader.fail("missing_equals")
    begin = reader.pos
    value = reader.sum()
    text = reader.comment_behind(begin)
    if not isinstance(target, int):
        return NumberedAssignment(target, reader.lifting(value), reader, text)
    return _assign(target, digits_at, value, reader, text)


def parse_named_assignment(reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`[#NAME] = expression`, `[#_OFSHG[n]] = …`: a variable by its name; the bracket before it is read."""
    name, index = reader.name_and_index(reader.pos - 1)
    index_of = reader.evaluator(index)
    if not reader.accept("="):
        raise reader.fail("missing_equals")
    begin = reader.pos
    value = reader.sum()
    text, written = reader.comment_behind(begin), reader.evaluator(value)

    def assign(channel: Channel) -> None:
        memory = channel.memory
        memory.write(memory.number_of(name, index_of(channel)), written(channel), text)

    return assign


def _assign(number: int, digits_at: int, value: Code, reader: Reader, text: str) -> Step:
    """Writing to a constant variable number."""
    place = reader.place(number, digits_at)
    if place is not None:
        statement = reader.lifting(assigned(place, value))
        return Assignment(statement, reader.compiled_statement(statement))
    written = reader.evaluator(value)
    return lambda channel: channel.memory.write(number, written(channel), text)


class Assignment:
    """`#n = expression` for a local or common variable: a step, and a line of Python where several are joined.

    Args:
        statement: Its code.
        function: The same compiled, a function of the memory.
    """

    __slots__ = ("_function", "statement")

    def __init__(self, statement: Lifting, function: FunctionType) -> None:
        self.statement = statement
        self._function = function

    def with_numbers(self, numbers: tuple[float, ...]) -> Assignment:
        """The statement with other numbers."""
        return Assignment(Lifting(self.statement.code, numbers), with_values(self._function, numbers))

    def __call__(self, channel: Channel) -> None:
        """Run the statement."""
        self._function(channel.memory)


class NumberedAssignment:
    """`#[expression] = expression`: a step.

    Args:
        number: Code of the variable's number.
        value: Code of its value.
        reader: What has read them.
        text: The comment behind it.
    """

    __slots__ = ("_number_of", "_text", "_value_of", "number", "value")

    def __init__(self, number: Lifting, value: Lifting, reader: Reader, text: str) -> None:
        self.number, self.value = number, value
        self._number_of, self._value_of = reader.compiled(number), reader.compiled(value)
        self._text = text

    def __call__(self, channel: Channel) -> None:
        """Run the statement."""
        memory = channel.memory
        memory.write_indirect(self._number_of(memory), self._value_of(memory), self._text)


class ConditionalJump:
    """`IF [c] GOTO n` and `IF [c] THEN statement`."""

    __slots__ = ("condition", "jump")

    def __init__(self, condition: Condition, jump: Step) -> None:
        self.condition = condition
        self.jump = jump

    def __call__(self, channel: Channel) -> None:
        """Run the statement."""
        if self.condition(channel):
            self.jump(channel)


def parse_names(reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`SETVN n[NAME,NAME]`: names for common variables."""
    digits = reader.match(_INTEGER)
    if not digits or not reader.accept("["):
        raise reader.fail("setvn")
    names: list[str] = []
    while True:
        name = reader.match(re.compile(r"[A-Z][A-Z0-9_]*"))
        if not name:
            raise reader.fail("setvn")
        if len(name) > 8:
            raise reader.fail("long_name")
        names.append(name)
        if not reader.accept(","):
            break
    if not reader.accept("]"):
        raise reader.fail("setvn")
    first = int(digits)

    def name_variables(channel: Channel) -> None:
        for offset, name in enumerate(names):
            channel.memory.names[name] = first + offset

    return name_variables


# ---- flow -----------------------------------------------------------------------------------------------------------


def parse_goto(reader: Reader, program: StatementProgram, index: int) -> Step:
    """`GOTO n`, with a constant, a variable or an expression."""
    _check_mode(reader, program)
    if digits := reader.match(_INTEGER):
        number = int(digits)
        if not 1 <= number <= MAX_SEQUENCE_NUMBER:
            raise reader.fail("sequence_range")
        return Jump(program, number, index)
    target = reader.evaluator(reader.factor())
    out_of_range = reader.fail("sequence_range")

    def computed_jump(channel: Channel) -> None:
        number = int(round_half_away(target(channel) or 0.0))
        if not 1 <= number <= MAX_SEQUENCE_NUMBER:
            raise out_of_range
        channel.level.index = program.find_sequence(number, index)

    return computed_jump


def _check_mode(reader: Reader, program: StatementProgram) -> None:
    if not program.may_jump:
        raise reader.fail("jump_mode", 0)


class Jump:
    """`GOTO n`, n a number."""

    __slots__ = ("_found", "_index", "_number", "_program")

    def __init__(self, program: StatementProgram, number: int, index: int) -> None:
        self._program = program
        self._number = number
        self._index = index
        self._found: int | None = None

    @property
    def target(self) -> int:
        """The step to which it leads."""
        if self._found is None:
            self._found = self._program.find_sequence(self._number, self._index)
        return self._found

    def __call__(self, channel: Channel) -> None:
        """Run the statement."""
        channel.level.index = self.target


def target_of(step: object) -> int:
    """The step to which `GOTO n` or `IF [c] GOTO n` leads; below zero where there is none."""
    jump = step.jump if isinstance(step, ConditionalJump) else step
    if not isinstance(jump, Jump):
        return -1
    try:
        return jump.target
    except AlarmError:
        return -1  # who runs it raises it


def leads_back(step: object, index: int) -> bool:
    """Whether a step is a jump that leads to a step or in front of it."""
    return 0 <= target_of(step) <= index


def parse_if(reader: Reader, program: StatementProgram, index: int) -> Step:
    """`IF [c] GOTO n` and `IF [c] THEN statement`."""
    if reader.peek() != "[":
        raise reader.fail("if_format")
    condition = Condition(reader)
    if reader.accept("THEN"):
        keyword = reader.match(re.compile(r"#|\[(?=#_?[A-Z])|GOTO|POPEN|PCLOS|DPRNT|BPRNT"))
        if not keyword:
            raise reader.fail("if_format")
    elif reader.match(re.compile("GOTO|GO(?=[ \t]*[\\d#\\[])")):
        keyword = "GOTO"
    else:
        raise reader.fail("if_format")
    return ConditionalJump(condition, _PARSERS[keyword](reader, program, index))


def parse_while(reader: Reader, program: StatementProgram, index: int) -> Step:
    """`WHILE [c] DO m`."""
    _check_mode(reader, program)
    if reader.peek() != "[":
        raise reader.fail("while_format")
    condition = Condition(reader)
    if not reader.accept("DO"):
        raise reader.fail("while_format")
    return LoopBegin(program, index, _loop_number(reader, program), condition)


def parse_do(reader: Reader, program: StatementProgram, index: int) -> Step:
    """`DO m`: an endless loop."""
    _check_mode(reader, program)
    return LoopBegin(program, index, _loop_number(reader, program), None)


class LoopBegin:
    """`WHILE [c] DO m`, or `DO m` without a condition: an endless loop."""

    __slots__ = ("_program", "condition", "index", "number")

    def __init__(
        self, program: StatementProgram, index: int, number: int, condition: Condition | None
    ) -> None:
        self._program = program
        self.index = index
        self.number = number
        self.condition = condition

    @property
    def loop(self) -> Loop:
        """The loop that it opens."""
        return Loop(self.index, self._program.loop_end(self.index, self.number), self.condition)

    def __call__(self, channel: Channel) -> None:
        """Run the statement."""
        loop, level = self.loop, channel.level
        if loop.condition is None or loop.condition(channel):
            level.data[self.number] = loop
        else:
            level.data.pop(self.number, None)
            level.index = loop.end + 1


@dataclass(frozen=True, slots=True)
class Loop:
    """A DO that has been passed: its step, that of its END, and the condition of its WHILE."""

    start: int
    end: int
    condition: Condition | None


class Condition:
    """A condition that has been read, and its code for joined steps."""

    __slots__ = ("_function", "lifting")

    def __init__(self, reader: Reader) -> None:
        self.lifting: Lifting = reader.lifting(reader.condition())
        self._function = reader.compiled(self.lifting)

    def __call__(self, channel: Channel) -> bool:
        """Whether it holds."""
        return bool(self._function(channel.memory))


def parse_end(reader: Reader, program: StatementProgram, index: int) -> Step:
    """`END m`."""
    return LoopEnd(_loop_number(reader, program), index, reader.fail("missing_do", 0))


class LoopEnd:
    """`END m`: tests the condition of the DO that was passed and goes back behind it."""

    __slots__ = ("_missing", "index", "number")

    def __init__(self, number: int, index: int, missing: AlarmError) -> None:
        self.number = number
        self.index = index
        self._missing = missing

    def __call__(self, channel: Channel) -> None:
        """Run the statement."""
        level = channel.level
        loop = level.data.get(self.number)
        if loop is None or loop.end != self.index:
            raise self._missing
        if loop.condition is None or loop.condition(channel):
            level.index = loop.start + 1
        else:
            del level.data[self.number]


def _loop_number(reader: Reader, program: StatementProgram) -> int:
    digits = reader.match(_INTEGER)
    if not digits or not 1 <= int(digits) <= program.last_loop:
        raise reader.fail("loop_number")
    return int(digits)


# ---- printing -------------------------------------------------------------------------------------------------------


def _open_or_close(_channel: Channel) -> None:
    """Lines that are printed are events: nothing has to be opened for them."""


def parse_open(_reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`POPEN`."""
    return _open_or_close


def parse_close(_reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`PCLOS`."""
    return _open_or_close


def parse_print(reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`DPRNT[text#n[cd]…]`: `*` prints a blank, `#n[cd]` c digits before and d behind the point (FANUC macro B §8)."""
    if not reader.accept("["):
        raise reader.fail("print_format")
    parts: list[str | tuple[Evaluate, int, int]] = []
    while True:
        char = reader.peek()
        if char == "]":
            reader.pos += 1
            break
        if not char:
            raise reader.fail("print_format")
        if char == "#":
            if not _PRINT_FORMAT.match(reader.text, reader.pos):
                raise reader.fail("print_format")
            value = reader.evaluator(reader.variable())
            reader.expect("[", "print_format")
            digits = reader.match(_INTEGER)
            reader.expect("]", "print_format")
            whole, decimals = int(digits[0]), int(digits[1:] or 0)
            if len(digits) > 2 or whole + decimals > 8:
                raise reader.fail("print_format")
            parts.append((value, whole, decimals))
        else:
            parts.append(" " if char == "*" else char)
            reader.pos += 1

    def print_line(channel: Channel) -> None:
        channel.memory.print_line([p if isinstance(p, str) else (p[0](channel), p[1], p[2]) for p in parts])

    return print_line


def parse_binary_print(reader: Reader, _program: StatementProgram, _index: int) -> Step:
    """`BPRNT[…]`: known, not executed: its binary output has no text form in a trace."""
    raise AlarmError(
        reader.alarms["not_supported"], column=reader.pos + 1, hint="hint.not-supported", code="BPRNT"
    )


_PARSERS: dict[str, Callable[[Reader, StatementProgram, int], Step]] = {
    "#": parse_assignment,
    "[": parse_named_assignment,
    "IF": parse_if,
    "WHILE": parse_while,
    "WH": parse_while,
    "GOTO": parse_goto,
    "GO": parse_goto,
    "DO": parse_do,
    "END": parse_end,
    "POPEN": parse_open,
    "PCLOS": parse_close,
    "DPRNT": parse_print,
    "BPRNT": parse_binary_print,
    "SETVN": parse_names,
}
