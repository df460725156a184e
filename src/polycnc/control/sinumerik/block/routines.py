"""Loops, branches and assignments of the NC language, for the scanner: what the lines of a program do."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from polycnc.language.bulk.formulas.postfix import OtherError
from polycnc.language.bulk.formulas.typed_postfix import Sort, TypedPostfix
from polycnc.language.bulk.layout import LOOPS
from polycnc.language.bulk.routines.layout import LineKind
from polycnc.language.bulk.routines.statements import NOTHING, REFUSED, UNREAD, Statement
from polycnc.language.expressions.code import Code, constant, name
from polycnc.language.sinumerik.lexer import prefix_of
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.block.variables_at_hand import VariablesAtHand
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.program import Program

#: Longer programs are no routines.
_MOST_LINES = 100_000
_JUMP, _ALWAYS = name("jump"), constant(True)


class SinumerikRoutines:
    """What the scanner asks of routines on a SINUMERIK control. Calls are the interpreter's.

    Args:
        variables: The variables at hand.
    """

    def __init__(self, variables: VariablesAtHand) -> None:
        self._variables = variables

    def loop_around(self, channel: SinumerikChannel) -> tuple[int, int]:
        """The whole program: jumps lead anywhere. Not a section that is repeated, nor where signals may interrupt."""
        code = channel.level.code
        if code is not code.whole or channel.setup.switches.interrupts or len(code) > _MOST_LINES:
            return 0, 0
        return 0, len(code)

    def told(self, channel: SinumerikChannel, code: SinumerikProgram, index: int, is_met: bool) -> Statement:
        """What a step of a program does, as soon as the channel comes to it: names may mean something else before."""
        if not (is_met or code.is_reached(index)):
            return UNREAD
        if not code.is_repeatable(index):
            return REFUSED
        try:
            emitter = code.compiled(index, channel).emitter
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
        return TypedPostfix(lambda place: sort_of(emitter, place), int, located)

    # ---- calls are the interpreter's -----------------------------------------------------------------

    def most_frames(self, _channel: SinumerikChannel) -> int:
        """None may be called."""
        return 0

    def program_called(self, _channel: SinumerikChannel, _number: int) -> Program | None:
        """Programs have names."""
        return None

    def enter(
        self,
        channel: SinumerikChannel,
        code: SinumerikProgram,
        repeats: int,
        first: int,
        variables: Sequence[float] | None,
    ) -> None:
        """None has been called."""
        raise NotImplementedError

    # ---- what a scan leaves --------------------------------------------------------------------------

    def take_locals(
        self, _channel: SinumerikChannel, _before: Sequence[float], _after: Sequence[float]
    ) -> None:
        """All are taken at once."""

    def take_common(self, channel: SinumerikChannel, before: Sequence[float], after: Sequence[float]) -> None:
        """Variables that have changed."""
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
    if statement.kind is ast.Assign:
        postfix.assignment(statement)
        return -1
    if statement.kind is ast.Return:
        return _target(statement, code, index)
    condition, body, otherwise = statement[1:4] if statement.kind is ast.If else (None, (), ())
    if not isinstance(condition, Code) or not isinstance(body, tuple) or len(body) != 1 or otherwise:
        raise OtherError
    postfix.condition(condition)
    return _target(body[0], code, index)


def _target(statement: Code, code: SinumerikProgram, index: int) -> int:
    """The step to which `return jump(channel, program, word, target)` leads."""
    called = statement[1] if statement.kind is ast.Return else None
    if not isinstance(called, Code) or called.kind is not ast.Call or called[1] != _JUMP:
        raise OtherError
    _, _, word, target = called[2] if isinstance(called[2], tuple) else ()
    if word.kind is not ast.Constant or target.kind is not ast.Constant or not isinstance(target[1], str):
        raise OtherError
    found = code.find_target(target[1], index, str(word[1]))
    if found < 0:
        raise OtherError
    return found
