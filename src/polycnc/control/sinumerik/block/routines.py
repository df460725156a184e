"""Loops, branches, assignments and calls of the NC language, for the scanner: what the lines of a program do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.language.bulk.formulas.postfix import OtherError
from polycnc.language.bulk.formulas.typed_postfix import Sort, TypedPostfix
from polycnc.language.bulk.layout import LOOPS, Operation
from polycnc.language.bulk.routines.layout import LineKind
from polycnc.language.bulk.routines.statements import NOTHING, REFUSED, UNREAD, Statement
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted, call, constant, name
from polycnc.language.sinumerik.executable import SinumerikProgram
from polycnc.language.sinumerik.lexer import prefix_of
from polycnc.language.sinumerik.statements.calls import push_program
from polycnc.language.sinumerik.statements.sections import MAX_LEVELS
from polycnc.language.sinumerik.words import WordShape
from polycnc.messages import AlarmError
from polycnc.program import Program

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.block.variables_at_hand import VariablesAtHand
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.emitter import Emitter

#: Longer programs are no routines.
_MOST_LINES = 100_000
_JUMP, _CALL, _DEFINE, _ALWAYS = name("jump"), name("call_program"), name("define"), constant(True)
_RETURN_CALL = call("channel.control.end_of_program", name("channel"))
#: M17 alone.
_END_WORD, _SUBPROGRAM_END = (WordShape("M"),), 17
_RETURN, _END = Statement(LineKind.RETURN), Statement(LineKind.END)


class SinumerikRoutines:
    """What the scanner asks of routines on a SINUMERIK control.

    Programs are called whose PROC line has no attributes and only parameters by value, unless they run already.

    Args:
        variables: The variables at hand.
    """

    def __init__(self, variables: VariablesAtHand) -> None:
        self._variables = variables
        self._left: Sequence[float] = ()

    def loop_around(self, channel: SinumerikChannel) -> tuple[int, int]:
        """The whole program: jumps lead anywhere. Not a section that is repeated, nor where signals may interrupt."""
        code = channel.level.code
        if code is not code.whole or channel.setup.switches.interrupts or len(code) > _MOST_LINES:
            return 0, 0
        return 0, _steps(code)

    def told(self, channel: SinumerikChannel, code: SinumerikProgram, index: int, is_met: bool) -> Statement:
        """What a step of a program does, as soon as the channel comes to it: names may mean something else before."""
        if index == len(code):
            return _END
        if code is not channel.level.code or not (is_met or code.is_reached(index)):
            return UNREAD
        if not code.is_repeatable(index):
            return self._definition(channel, code, index, is_met=is_met)
        try:
            emitter = code.compiled(index, channel).emitter
            special = self._call(channel, code, emitter) or _return(emitter)
            if special is not None:
                return special
            if not emitter.joins or emitter.uses_clock or prefix_of(code.text(index)).skip >= 0:
                return REFUSED
            return self._told(channel, code, index, emitter)
        except (AlarmError, OtherError):
            return REFUSED  # the interpreter comes to the same line and raises it

    def _told(
        self, channel: SinumerikChannel, code: SinumerikProgram, index: int, emitter: Emitter
    ) -> Statement:
        numbers = tuple(float(number.value) for number in emitter.numbers)
        if emitter.is_block:
            known = emitter.executes is not None
            return Statement(LineKind.BLOCK, numbers=numbers, is_known=True) if known else REFUSED
        postfix = self.postfix(channel, code, emitter)
        target = -1
        for statement in emitter.statements:
            if target >= 0:
                raise OtherError
            target = _put_statement(postfix, statement, code, index)
        branch = emitter.branch
        if branch is not None and branch.target >= 0:
            target = branch.target
            if branch.condition is not None or postfix.done:
                postfix.condition(branch.condition or _ALWAYS)
        if target < 0 and not postfix.done:
            return NOTHING
        kind = LineKind.STATEMENT if target < 0 else LineKind.JUMP
        return Statement(kind, tuple(postfix.done), numbers, max(target, 0))

    def postfix(self, channel: SinumerikChannel, code: SinumerikProgram, emitter: Emitter) -> TypedPostfix:
        """What makes operations of the code of a block that is known with its numbers."""
        located = self._variables.locate(channel, code, emitter, None)
        return TypedPostfix(lambda place: sort_of(emitter, place), int, located, emitter.objects)

    def _definition(
        self, channel: SinumerikChannel, code: SinumerikProgram, index: int, *, is_met: bool
    ) -> Statement:
        """A PROC line, or DEF of single variables in a program that runs once more."""
        if index == 0 and code.begins_with_header:
            return REFUSED if code.header(channel).attributes else NOTHING
        if not code.is_definition(index) or not code.is_reached(index):
            return REFUSED
        if not is_met:
            return UNREAD
        try:
            emitter = code.compiled(index, channel).emitter
            postfix = self.postfix(channel, code, emitter)
            for statement in emitter.statements:
                called = statement[1] if statement.kind == nodes.Expr else None
                if not isinstance(called, Code) or called.kind != nodes.Call or called[1] != _DEFINE:
                    return REFUSED
                _, slot, value = called[2] if isinstance(called[2], tuple) else ()
                postfix.handed(value, self._variables.place_of(channel, code, slot[1]))
        except (AlarmError, OtherError):
            return REFUSED
        numbers = tuple(float(number.value) for number in emitter.numbers)
        is_done = not (emitter.uses_stop or emitter.uses_main or emitter.uses_clock)
        return Statement(LineKind.STATEMENT, tuple(postfix.done), numbers) if is_done else REFUSED

    # ---- calls ---------------------------------------------------------------------------------------

    def _call(
        self, channel: SinumerikChannel, caller: SinumerikProgram, emitter: Emitter
    ) -> Statement | None:
        """`NAME(1,R2)`, `L123 P5`: the call of a program that has been run before; None for another block.

        Raises:
            OtherError: A call that is the interpreter's.
        """
        called = _called(emitter)
        if called is None:
            return None
        program, arguments, _, passes = called
        found = emitter.objects[program.place] if isinstance(program, Lifted) else None
        if not isinstance(found, Program) or emitter.uses_clock:
            raise OtherError
        if found.name not in channel.toolpath.programs:
            return UNREAD
        code = channel.executable(found).whole
        assert isinstance(code, SinumerikProgram)
        header = code.header(channel)
        parts = arguments[1]
        if header.attributes or not isinstance(parts, tuple):
            raise OtherError
        postfix = self.postfix(channel, caller, emitter)
        for parameter, value in zip(header.parameters, parts, strict=True):
            if parameter.by_reference:
                raise OtherError
            postfix.handed(value, self._variables.place_of(channel, code, parameter.slot))
        if passes.kind != nodes.Constant or not isinstance(passes[1], int):
            raise OtherError
        numbers = tuple(float(number.value) for number in emitter.numbers)
        callee = code, channel.toolpath.program_number(found.name), _steps(code)
        operations = (*postfix.done, Operation.ARGUMENT, passes[1])
        return Statement(LineKind.CALL, operations, numbers, callee=callee)

    def most_frames(self, channel: SinumerikChannel) -> int:
        """How many program levels are left."""
        return max(MAX_LEVELS + 1 - len(channel.stack), 0)

    def program_called(self, _channel: SinumerikChannel, _number: int) -> Program | None:
        """Programs have names."""
        return None

    def enter(
        self,
        channel: SinumerikChannel,
        code: SinumerikProgram,
        repeats: int,
        first: int,  # noqa: ARG002 - programs begin at their first step
        variables: Sequence[float] | None,  # noqa: ARG002 - they have places of their own
    ) -> None:
        """Put a program on the stack that is called from where the channel stands."""
        caller = channel.level.code.whole
        called = _called(caller.compiled(channel.level.current, channel).emitter)
        given = called[2][1] if called is not None else ()
        assert isinstance(given, tuple)
        handed = tuple([bool(each[1]) for each in given])
        local = self._variables.of_level(code, self._left)
        push_program(channel, code.program, tuple(local), handed, repeats + 1)

    # ---- what a scan leaves --------------------------------------------------------------------------

    def take_locals(
        self, _channel: SinumerikChannel, _before: Sequence[float], _after: Sequence[float]
    ) -> None:
        """All are taken at once."""

    def take_common(self, channel: SinumerikChannel, before: Sequence[float], after: Sequence[float]) -> None:
        """Variables that have changed."""
        self._left = after
        self._variables.take(channel, before, after)

    def put_loops(self, _level: Level[SinumerikProgram], _loops: Sequence[int]) -> list[int]:
        """Loops of the NC language are jumps."""
        return [0] * LOOPS

    def take_loops(
        self, _level: Level[SinumerikProgram], _before: Sequence[int], _after: Sequence[int]
    ) -> None:
        """There is nothing that a level keeps of them."""


def sort_of(emitter: Emitter, place: int) -> Sort:
    """What a number of a block is."""
    return Sort.WHOLE if isinstance(emitter.numbers[place].value, int) else Sort.REAL


def _put_statement(postfix: TypedPostfix, statement: Code, code: SinumerikProgram, index: int) -> int:
    """Add what a statement calculates; gives the step to which it jumps, -1 for none."""
    if statement.kind == nodes.Assign:
        postfix.assignment(statement)
        return -1
    if statement.kind == nodes.Return:
        return _target(statement, code, index)
    condition, body, otherwise = statement[1:4] if statement.kind == nodes.If else (None, (), ())
    if not isinstance(condition, Code) or not isinstance(body, tuple) or len(body) != 1 or otherwise:
        raise OtherError
    postfix.condition(condition)
    return _target(body[0], code, index)


def _target(statement: Code, code: SinumerikProgram, index: int) -> int:
    """The step to which `return jump(channel, program, word, target)` leads."""
    called = statement[1] if statement.kind == nodes.Return else None
    if not isinstance(called, Code) or called.kind != nodes.Call or called[1] != _JUMP:
        raise OtherError
    _, _, word, target = called[2] if isinstance(called[2], tuple) else ()
    if word.kind != nodes.Constant or target.kind != nodes.Constant or not isinstance(target[1], str):
        raise OtherError
    found = code.find_target(target[1], index, str(word[1]))
    if found < 0:
        raise OtherError
    return found


# ---- calls and returns -------------------------------------------------------------------------------------


def _steps(code: SinumerikProgram) -> int:
    """Steps of a program, with its end."""
    return len(code) + 1


def _called(emitter: Emitter) -> tuple[Code, Code, Code, Code] | None:
    """Program, arguments, which of them are written, and passes of a block that calls; None for another block."""
    called = _alone(emitter)
    if called is None or called[1] != _CALL or not isinstance(called[2], tuple):
        return None
    _, program, arguments, given, passes = called[2]
    return program, arguments, given, passes


def _return(emitter: Emitter) -> Statement | None:
    """RET, or M17 alone; None for another block."""
    execution = emitter.executes
    if execution is not None:
        block, values = execution
        if block.codes or block.words != _END_WORD or not isinstance(values[0], Lifted):
            return None
        return _RETURN if emitter.numbers[values[0].place].value == _SUBPROGRAM_END else None
    return _RETURN if _alone(emitter) == _RETURN_CALL else None


def _alone(emitter: Emitter) -> Code | None:
    """The only statement of a block, if it is a call."""
    if len(emitter.statements) != 1 or emitter.branch is not None or emitter.uses_stop or emitter.uses_main:
        return None
    called = emitter.statements[0][1] if emitter.statements[0].kind == nodes.Expr else None
    return called if isinstance(called, Code) and called.kind == nodes.Call else None
