"""Technology cycles: subprograms that an action runs, one line in each interpolation cycle (10.5).

They are read where the action is prepared, so every mistake in them is found there. Definitions are read over, but
their writing is checked.
"""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.code import Code, quoted, sequence
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.actions.code import Cycle, CycleLine, Needs
from polycnc.language.sinumerik.actions.live import AXIS_WORDS, PROCEDURES, SPINDLE_WORDS, LiveReader
from polycnc.language.sinumerik.emitter import Emitter
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.expressions import ExpressionReader
from polycnc.language.sinumerik.lexer import prefix_of, tokenize
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.calls import find_program
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.statements.definitions import Header
    from polycnc.program import Program

_JUMPS = frozenset({"GOTO", "GOTOF", "GOTOB"})
_ENDS = frozenset({"RET", "ENDPROC"})
_END_CODES = frozenset({2, 17, 30})
#: What a file asks to tell its uses apart, and the answer in a technology cycle.
_ENVIRONMENT: dict[tuple[str, ...], bool] = {
    ("$P_TECCYCLE",): True,
    ("$P_TECCYCLE", "==", "TRUE"): True,
    ("$P_TECCYCLE", "==", "FALSE"): False,
    ("$P_TECCYCLE", "<>", "TRUE"): False,
    ("NOT", "$P_TECCYCLE"): False,
}
_NO_CYCLE = AXIS_WORDS | SPINDLE_WORDS | PROCEDURES | {"SYNFCT"}


def technology_cycle(live: LiveReader, compiler: BlockCompiler, token: Token) -> Cycle | None:
    """Read the call of a technology cycle, `NAME(1,$R1)`; None where something else stands there."""
    if token.kind not in ("name", "word") or token.text in _NO_CYCLE or token.text[0] == "$":
        return None
    if token.kind == "word" and token.letter != "L":
        return None
    if live.scope.find(token.text) is not None or token.text in keywords.PROCEDURES:
        return None
    program = find_program(compiler.channel, token.text)
    if program is None:
        return None
    live.take()
    cycle, header = read_cycle(program, compiler.channel)
    live.needs |= cycle.needs
    live.calls(cycle, _arguments(live, token, header))
    return cycle


def _arguments(live: LiveReader, token: Token, header: Header) -> Code:
    """Codes of the values of its parameters, by value; those left out as PROC says (10.5.2)."""
    codes: list[Code] = []
    if live.accept("("):
        while not live.at(")"):
            if len(codes) == len(header.parameters):
                raise NcSyntaxError("12340", live.token.column, token.text)
            if live.at(","):
                codes.append(_left_out(live, header, len(codes), token))
            else:
                codes.append(live.value(header.parameters[len(codes)].type))
            if not live.accept(","):
                break
        live.expect(")")
    codes += [_left_out(live, header, place, token) for place in range(len(codes), len(header.parameters))]
    return sequence(codes)


def _left_out(live: LiveReader, header: Header, place: int, token: Token) -> Code:
    value = header.first_values[place]
    if value is None:
        raise NcSyntaxError("14010", token.column, header.parameters[place].name)
    return live.emitter.object(value)


def read_cycle(program: Program, channel: Channel[Any, Any, Any]) -> tuple[Cycle, Header]:
    """Read a subprogram as a technology cycle."""
    code: SinumerikProgram = channel.executable(program).whole
    header = code.header(channel)
    for parameter in header.parameters:
        if parameter.by_reference or parameter.dims or parameter.type is Type.FRAME:
            raise AlarmError("12571", text=parameter.name)
    return _Reader(code, header, channel).cycle(), header


class _Reader:
    """Reads the lines of one technology cycle."""

    def __init__(self, code: SinumerikProgram, header: Header, channel: Channel[Any, Any, Any]) -> None:
        self._code, self._channel = code, channel
        self._parameters = {
            parameter.name: replace(parameter, slot=slot) for slot, parameter in enumerate(header.parameters)
        }
        self._needs = Needs()
        self._open: list[int] = []
        self._left_out = 0  # how many structures of a branch of the program are open
        self._known: list[bool] = []  # of every open IF: what it asks is known
        self._lines: list[CycleLine] = []
        self._places: list[int] = []
        self._targets: dict[int, tuple[str, str, int]] = {}

    def cycle(self) -> Cycle:
        """All lines; every mistake is told with its line."""
        started = False
        for index in range(len(self._code)):
            self._places.append(len(self._lines))
            try:
                started = self._line(index, started=started)
            except AlarmError as error:
                error.line = error.line or self._code.line(index)
                error.program = self._channel.toolpath.program_number(self._code.program.name)
                raise
        self._places.append(len(self._lines))
        self._lines.append(CycleLine("end", self._code.line(len(self._code) - 1) if len(self._code) else 0))
        self._resolve()
        return Cycle(self._code.program.name, tuple(self._lines), self._needs)

    def _line(self, index: int, *, started: bool) -> bool:
        """Read a line; whether a statement has been read so far."""
        text = self._code.text(index)
        tokens = tokenize(text, prefix_of(text).end)
        first = tokens[0]
        scope = self._code.scope_of(self._channel)
        if scope.memory.refused:
            scope.check_available(tokens)
        if self._leaves_out(tokens):
            return True
        if first.kind == "end" or first.text in ("PROC", "ENDPROC"):
            return started
        if first.text in ("DEF", "DEFINE"):
            if started:
                raise NcSyntaxError("14500", first.column, first.text)
            self._definition(index, first)
            return False
        block = ExpressionReader(tokens, scope, Emitter(self._code.control.shapes))
        self._statement(LiveReader(block, self._parameters), self._code.line(index), index)
        return True

    def _leaves_out(self, tokens: list[Token]) -> bool:
        """Whether a line is of the program alone: a file may ask by $P_TECCYCLE what it is run as (10.5.1)."""
        words = [token.text for token in tokens[:-1]]
        word = words[0] if words else ""
        if self._left_out:
            ends = self._left_out == 1 and word in ("ELSE", "ENDIF")
            self._left_out += (word == "IF" and not _JUMPS & set(words)) - (word == "ENDIF" or ends)
            if ends and word == "ENDIF":
                self._known.pop()
            return True
        if word == "IF" and not _JUMPS & set(words):
            asked = _ENVIRONMENT.get(tuple(words[1:]))
            self._known.append(asked is not None)
            self._left_out = int(asked is False)
            return asked is not None
        if word in ("ELSE", "ENDIF") and self._known and self._known[-1]:
            self._left_out = int(word == "ELSE")
            if word == "ENDIF":
                self._known.pop()
            return True
        if word == "ENDIF" and self._known:
            self._known.pop()
        return False

    def _definition(self, index: int, first: Token) -> None:
        """A definition is only checked (10.5): an axis that nobody has is 12080."""
        scope = self._code.scope_of(self._channel)
        variables, slots, declared = dict(scope.variables), scope.slots, dict(self._code.declared)
        try:
            self._code.compiled(index, self._channel)
        except AlarmError as error:
            if error.code in ("12550", "12040"):
                raise NcSyntaxError("12080", error.column or first.column, first.text) from None
            raise
        finally:
            scope.variables, scope.slots, self._code.declared = variables, slots, declared

    def _statement(self, live: LiveReader, line: int, index: int) -> None:
        word = live.token.text
        if word in _ENDS or (
            live.token.kind == "word" and live.token.letter == "M" and live.token.value in (2, 17, 30)
        ):
            live.take()
            self._lines.append(CycleLine("end", line))
        elif word == "IF":
            self._branch(live, line, index)
        elif word == "ELSE":
            live.take()
            self._close("ELSE", live, line)
        elif word == "ENDIF":
            live.take()
            self._close("ENDIF", live, line)
        elif word in _JUMPS:
            self._jump(live, line, index, None)
        elif word in keywords.STRUCTURE or word in keywords.CALLS:
            raise live.refused(live.token)
        else:
            while live.token.kind != "end":
                live.effect()
            self._add(live, CycleLine("do", line, effect=live.compiled_effect()))
        if live.token.kind != "end":
            raise live.error()

    def _branch(self, live: LiveReader, line: int, index: int) -> None:
        live.take()
        condition = live.compiled_condition()
        if live.token.text in _JUMPS:
            self._jump(live, line, index, condition)
            return
        self._open.append(len(self._lines))
        self._add(live, CycleLine("if", line, condition))

    def _close(self, word: str, live: LiveReader, line: int) -> None:
        """ELSE and ENDIF: a condition that does not hold goes on behind them."""
        if not self._open:
            raise NcSyntaxError("12640", live.token.column, word)
        start = self._open.pop()
        if word == "ELSE":
            self._open.append(len(self._lines))
            self._lines.append(CycleLine("jump", line))
        self._lines[start] = replace(self._lines[start], target=len(self._lines))

    def _jump(self, live: LiveReader, line: int, index: int, condition: Any) -> None:
        """A jump to a label or block number, constants (10.5.8)."""
        word = live.take().text
        target = live.take()
        text = f":{live.take().value}" if target.text == ":" else target.text
        self._targets[len(self._lines)] = (word, text, index)
        self._add(live, CycleLine("jump", line, condition))

    def _add(self, live: LiveReader, line: CycleLine) -> None:
        self._needs |= live.needs
        frozen: list[Any] = []
        if live.frozen:
            emitter = live.block.emitter
            emitter.run(quoted("{0}.extend({1})", emitter.object(frozen), sequence(live.frozen)))
            emitter.is_block = True
            emitter.step()(self._channel)
        self._lines.append(replace(line, frozen=tuple(frozen)))

    def _resolve(self) -> None:
        if self._open:
            raise AlarmError("12640", text=self._code.program.name)
        for place, (word, text, index) in self._targets.items():
            found = self._code.find_target(text, index, word)
            if found < 0:
                raise AlarmError("14080", text=text)
            self._lines[place] = replace(self._lines[place], target=self._places[found])
