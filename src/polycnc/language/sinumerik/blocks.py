"""One block, compiled to a step: its statement, or its assignments, or its words."""

from __future__ import annotations

from functools import cached_property

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.code import Code, constant, quoted, sequence
from polycnc.language.sinumerik import keywords, runtime
from polycnc.language.sinumerik.actions.block import action, fine_offset_of_block
from polycnc.language.sinumerik.emitter import Emitter, provide
from polycnc.language.sinumerik.errors import NcSyntaxError, not_supported, syntax
from polycnc.language.sinumerik.expressions import ExpressionReader
from polycnc.language.sinumerik.lexer import Token, prefix_of, tokenize
from polycnc.language.sinumerik.names import vocabulary
from polycnc.language.sinumerik.names.places import SystemPlace
from polycnc.language.sinumerik.names.values import INT_MAX, INT_MIN, Type
from polycnc.language.sinumerik.names.variables import Array, Reference, define
from polycnc.language.sinumerik.nc_words import WordReader
from polycnc.language.sinumerik.statements import calls, definitions, files, flow, redefinitions
from polycnc.language.sinumerik.words import WordShape, block_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.names.places import Place
    from polycnc.language.sinumerik.names.scope import Scope

_SKIPPED = "if channel.control.skipped(channel, {0}): channel.off_path = channel.attention; return"


class CompiledBlock(NamedTuple):
    """A step, the code it came from, and the columns of its words."""

    step: Step
    emitter: Emitter
    columns: tuple[int, ...]


class BlockCompiler(ExpressionReader):
    """Compiles the tokens of one block.

    Attributes:
        program: The program of the block.
        index: Its step.
        channel: The channel that has reached it.
        marked: The block has a label or a skip mark, which blocks of control structures must not have.
    """

    def __init__(self, tokens: list[Token], program: SinumerikProgram, index: int, channel: Channel) -> None:
        scope = program.scope_of(channel)
        super().__init__(tokens, scope, Emitter(scope.control.shapes))
        self.program = program
        self.index = index
        self.channel = channel
        self.marked = False

    @cached_property
    def words(self) -> WordReader:
        """What reads the words of the block; a block of another kind has none."""
        return WordReader(self)

    @property
    def columns(self) -> tuple[int, ...]:
        """Column of every word, from 1."""
        return self.words.columns if "words" in vars(self) else ()

    def statement(self) -> None:
        """Read the whole block."""
        token = self.token
        if token.kind == "end":
            return
        if self.scope.memory.refused:
            self.scope.check_available(self.tokens)
        handler = _STATEMENTS.get(token.text) if token.kind == "name" else None
        if handler is not None and self.scope.find(token.text) is None:
            handler(self)
        elif self._calls_program(token):
            calls.program_call(self)
        else:
            self._mixed()
        if self.token.kind != "end":
            raise self.error()

    def _calls_program(self, token: Token) -> bool:
        """Whether a name that begins the block is that of a program: no variable, no word; or `L123`."""
        name = token.text
        if token.kind == "word":
            return token.letter == "L" and not _assigns(self.ahead())
        if token.kind != "name":
            return False
        if name[0] == "$" or self.scope.find(name) is not None or name in self.scope.memory.axes:
            return False
        if name in keywords.CYCLES:
            return True
        return len(name) > 1 and not is_word(name, self.scope) and not _assigns(self.ahead())

    def _mixed(self) -> None:
        """Assignments, or words and procedures: the two do not mix (12080, 1.25.2.6); G functions go with both."""
        assigned: Token | None = None
        worded = False
        self.emitter.can_join = True
        while self.token.kind != "end":
            token = self.token
            if self.scope.is_place(token):
                assigned = assigned or token
                self.assignment()
            else:
                functions = len(self.words.functions)
                self.words.read()
                worded = worded or len(self.words.functions) == functions
            if assigned is not None and worded:
                raise syntax(assigned.column, f"{assigned.text}=")
        if assigned is not None and self.words.functions:
            self.emitter.can_join = False
            self.words.dynamic = True
        self.words.finish()

    # ---- assignments ---------------------------------------------------------------------------------------

    def assignment(self) -> None:
        """`variable=expression`, `=SET(…)`, `=REP(…)`."""
        token = self.take()
        place = self.scope.place(self, token)
        self.expect("=")
        fill = self.token
        if fill.text in ("SET", "REP") and fill.kind == "name" and self.ahead().text == "(":
            self.take()
            self.fill(place, fill)
            return
        place.write(self, self.assigned(place.type))

    def assigned(self, type_: Type) -> Code:
        """Code of an expression that is stored as a type; INT results are checked for their range."""
        token = self.token
        value = self.expression()
        code = self.converted(value, type_, token)
        if type_ is Type.INT and value.type is Type.INT:
            first, again = self.emitter.twice(code)
            if first != again:
                written = "{1} if {2} <= {0} <= {3} else checked_int({1})"
                return quoted(written, first, again, INT_MIN, INT_MAX)
        return code

    def fill(self, place: Place, token: Token) -> None:
        """SET and REP at run time (1.1.12)."""
        if token.text == "SET":
            values = [place.stored(self, value) for value in self.value_list(place.type)]
            if isinstance(place, SystemPlace):
                self._system_fill(place, sequence(values))
            else:
                items, start = place.elements(self, token)
                self.emitter.run(quoted("set_elements({0}, {1}, {2})", items, start, sequence(values)))
            return
        value, count = self.repeated(place.type)
        value = place.stored(self, value)
        if isinstance(place, SystemPlace):
            if count is None:
                count = quoted("elements_left(channel, {0}, {1})", place.code, place.indices)
            self._system_fill(place, quoted("({0},) * {1}", value, count))
        else:
            items, start = place.elements(self, token)
            self.emitter.run(quoted("repeat_element({0}, {1}, {2}, {3})", items, start, value, count))

    def _system_fill(self, place: SystemPlace, values: Code) -> None:
        place.prepare_write(self)
        written = "set_system_elements(channel, {0}, {1}, {2})"
        self.emitter.run(quoted(written, place.code, place.indices, values))

    def value_list(self, type_: Type) -> list[Code]:
        """Codes of `(v1,v2,,v4)`; a gap is the type's zero, for AXIS an error."""
        zero = constant(runtime.default_value(type_, self.scope.memory) if type_.is_number else "")
        codes: list[Code] = []
        self.expect("(")
        while True:
            if self.at(",") or self.at(")"):
                if type_ in (Type.AXIS, Type.FRAME):
                    raise self.error()
                codes.append(zero)
            else:
                codes.append(self.assigned(type_))
            if not self.accept(","):
                break
        self.expect(")")
        return codes

    def repeated(self, type_: Type) -> tuple[Code, Code | None]:
        """Codes of `(value[,count])`."""
        self.expect("(")
        value = self.assigned(type_)
        count = self.value(Type.INT) if self.accept(",") else None
        self.expect(")")
        return value, count

    # ---- procedures ----------------------------------------------------------------------------------------

    def procedure(self, token: Token, letters: str) -> None:
        """A predefined procedure; its name has been read."""
        self.scope.check_word(token)
        arguments = self.scope.arguments(self, token, letters)
        self.call_procedure(token, arguments)

    def call_procedure(self, token: Token, arguments: Code) -> None:
        """Add the call of a procedure of the control; its block runs alone, as it may do anything."""
        self.emitter.knows_place = self.emitter.is_block = True
        self.emitter.can_join = False
        column = self.emitter.object(token.column)
        written = "channel.control.procedure(channel, {0}, {1}, {2})"
        self.emitter.run(quoted(written, token.text, arguments, column))

    def text(self) -> Code:
        """Code of a text: a string, a STRING variable or an expression."""
        return self.value(Type.STRING)

    def integer(self) -> Code:
        """Code of an INT."""
        return self.value(Type.INT)


def _assigns(token: Token) -> bool:
    return token.text == "=" and token.kind == "op"


def is_word(name: str, scope: Scope) -> bool:
    """Whether a name has a meaning in a block of words."""
    return (
        name in scope.control.g_groups
        or name in keywords.SPELLINGS
        or name in keywords.ADDRESSES
        or name in keywords.PROCEDURES
        or name in keywords.INDEXED_WORDS
        or name in keywords.FILE_PROCEDURES
        or name in keywords.SINGLE_BLOCK
        or name in ("G", "R", "SETINT")
    )


def expanded(tokens: list[Token], scope: Scope) -> list[Token]:
    """The tokens with macros replaced by their texts, at the macro's place; macros do not nest."""
    if not scope.macros and not scope.memory.macros:
        return tokens
    if tokens[0].text == "DEFINE":
        return tokens
    result: list[Token] = []
    for token in tokens:
        name = token.text
        if token.kind == "word" and isinstance(token.value, int):
            name = f"{token.letter}{token.value}"
        text = scope.macro(name) if token.kind in ("name", "word") else None
        if text is None:
            result.append(token)
        else:
            inner = tokenize(text)[:-1]
            result += [each._replace(start=token.start, end=token.end) for each in inner]
    return result


def compile_block(
    program: SinumerikProgram, index: int, channel: Channel, text: str | None = None
) -> CompiledBlock:
    """Compile the block of a step; `text` where other words than those of its line mean it."""
    line = program.text(index) if text is None else text
    prefix = prefix_of(line)
    scope = program.scope_of(channel)
    tokens = expanded(tokenize(line, prefix.end), scope)
    compiler = BlockCompiler(tokens, program, index, channel)
    compiler.marked = prefix.skip >= 0 or bool(prefix.label)
    if prefix.skip >= 0:
        compiler.emitter.add(quoted(_SKIPPED, prefix.skip))
    compiler.statement()
    return CompiledBlock(compiler.emitter.step(), compiler.emitter, compiler.columns)


def compile_text(text: str, program: SinumerikProgram, index: int, channel: Channel) -> Step:
    """Compile a text as a block of a program (EXECSTRING): everything but definitions (1.2.3)."""
    prefix = prefix_of(text)
    tokens = expanded(tokenize(text, prefix.end), program.scope_of(channel))
    if tokens[0].text in keywords.DEFINITIONS:
        raise NcSyntaxError("14500", 0, tokens[0].text)
    compiler = BlockCompiler(tokens, program, index, channel)
    compiler.statement()
    return compiler.emitter.step()


def _not_yet(compiler: BlockCompiler) -> None:
    token = compiler.token
    raise not_supported(token.column, token.text)


def _alone(compiler: BlockCompiler) -> None:
    """Words that only stand behind others."""
    raise compiler.error()


_STATEMENTS: dict[str, Callable[[BlockCompiler], None]] = {
    **flow.STATEMENTS,
    **definitions.STATEMENTS,
    **redefinitions.STATEMENTS,
    **calls.STATEMENTS,
    **dict.fromkeys(keywords.SYNCHRONOUS, action),
    "PUTFTOCF": fine_offset_of_block,
    **dict.fromkeys(keywords.NOT_EXECUTED, _not_yet),
    **dict.fromkeys(keywords.PARTS | keywords.OPERATORS, _alone),
}

provide(
    Array=Array,
    Reference=Reference,
    WordShape=WordShape,
    block_of=block_of,
    define=define,
    file_procedure=files.file_procedure,
    file_function=files.file_function,
    name_function=vocabulary.name_function,
)
