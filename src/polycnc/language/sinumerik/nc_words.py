"""The words of a block: G functions, addresses with values, procedures among them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted, assigned, constant, dotted, item, quoted, sequence
from polycnc.language.expressions.operators import TIGHTEST
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.emitter import Execution, provide
from polycnc.language.sinumerik.errors import NcSyntaxError, unknown
from polycnc.language.sinumerik.names.spindles import axis_of_spindle, spindle_number
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.words import WordAlarm, WordShape, block_of
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.words import Block

#: Addresses whose numbers stay INT where they are written so; all others become REAL.
_NONE = constant(None)
_SINGLE_BLOCK = item(dotted("channel.level.data"), constant("single_block"))
#: What polynomials of the orientation stand for (6.3, 6.5.2).
_OF_ORIENTATION = frozenset({"PHI", "PSI", "THT", "XH", "YH", "ZH"})
_WHOLE_NUMBERS = frozenset({"M", "H", "T", "D", "DL"})


class WordReader:
    """Collects the words of one block and the code that runs them."""

    def __init__(self, compiler: BlockCompiler) -> None:
        self.compiler = compiler
        self.functions: list[str] = []
        self.codes: list[Code] = []
        self.shapes: list[WordShape] = []
        self.shape_codes: list[Code] = []
        self.values: list[Code] = []
        self.word_columns: list[int] = []
        self.groups: dict[int, str] = {}
        self.dynamic = False

    @property
    def columns(self) -> tuple[int, ...]:
        """Column of every word, from 1."""
        return tuple(self.word_columns)

    def read(self) -> None:
        """Read the next word, function or procedure."""
        compiler = self.compiler
        token = compiler.take()
        if token.kind == "word":
            self._number_word(token)
        elif token.kind == "name":
            self._named_word(token)
        else:
            raise compiler.error(token)

    def finish(self) -> None:
        """Add the statement that runs the words."""
        if not self.codes and not self.shapes:
            return
        emitter = self.compiler.emitter
        emitter.acts = emitter.is_block = True
        execute = emitter.object(self.compiler.scope.execute)
        if self.dynamic:
            code = quoted("block_of({0}, {1})", sequence(self.codes), sequence(self.shape_codes))
        else:
            block = self._static_block()
            emitter.execution = Execution(block, tuple(self.values))
            code = emitter.object(block)
        written = "if {0}(channel, {1}, {2}): call_modal(channel)"
        emitter.add(quoted(written, execute, code, sequence(self.values)))

    def _static_block(self) -> Block:
        try:
            return block_of(tuple(self.functions), tuple(self.shapes))
        except WordAlarm as alarm:
            alarm.column = self.word_columns[alarm.position]
            raise

    # ---- G functions ---------------------------------------------------------------------------------------

    def _g_function(self, token: Token, code: str) -> None:
        self.compiler.scope.check_word(token)
        group = self.compiler.scope.control.g_groups[code]
        if group in self.groups:
            raise NcSyntaxError("12060", token.column, token.text)
        self.groups[group] = code
        self.functions.append(code)
        self.codes.append(constant(code))

    def _indirect_g(self) -> None:
        """`G[group]=number` (1.2.1): no calculation on the right-hand side."""
        compiler = self.compiler
        compiler.expect("[")
        group = compiler.value(Type.INT)
        compiler.expect("]")
        compiler.expect("=")
        token = compiler.token
        number = compiler.converted(compiler.expression(TIGHTEST), Type.INT, token)
        self.codes.append(quoted("channel.control.g_function({0}, {1})", group, number))
        self.dynamic = True

    # ---- words ---------------------------------------------------------------------------------------------

    def _number_word(self, token: Token) -> None:
        """A letter with a number: `X10`, `G1`, or an extended address `S2=`."""
        letter, scope = token.letter, self.compiler.scope
        if self._assigned():
            if token.text in scope.memory.axes or token.text in keywords.ADDRESSES:
                self._word(token, token.text, None, _NONE)
            elif letter in "SMTDHF" and isinstance(token.value, int):
                self._word(token, letter, token.value, constant(token.value))
            else:
                raise unknown(token.column, token.text)
        elif letter == "G":
            code = f"G{token.value}"
            if code not in scope.control.g_groups:
                raise NcSyntaxError("12470", token.column, token.text, hint="hint.builder-g")
            self._g_function(token, code)
        elif letter in scope.memory.axes or letter in keywords.ADDRESSES:
            self._add(token, letter, None, _NONE, "", self._literal(letter, token))
        else:
            raise self.compiler.error(token)

    def _named_word(self, token: Token) -> None:
        if token.text in keywords.SPELLINGS:
            token = token._replace(text=keywords.SPELLINGS[token.text])
        compiler, name = self.compiler, token.text
        scope = compiler.scope
        if name in keywords.OWN_BLOCK and not self._assigned():
            self._own_block(token)
            return
        if name in scope.memory.axes:
            self._addressed(token)
        elif name == "G" and compiler.at("["):
            self._indirect_g()
        elif name in scope.control.g_groups and not self._assigned():
            self._g_function(token, name)
        elif name in keywords.BRACKETED and compiler.at("["):
            self._bracketed(token)
        elif name in keywords.PROCEDURES and not self._assigned():
            compiler.procedure(token, keywords.PROCEDURES[name])
        elif name in keywords.ADDRESSES:
            self._addressed(token)
        elif name in keywords.INDEXED_WORDS:
            index, code = self._index()
            self._add(token, name, index, code, "", constant(True))
        else:
            self._other(token)

    def _bracketed(self, token: Token) -> None:
        """`FINEA[axis]`: a procedure with its axis in brackets."""
        compiler = self.compiler
        compiler.expect("[")
        axis = compiler.value(Type.AXIS)
        compiler.expect("]")
        compiler.call_procedure(token, sequence([axis]))

    def _own_block(self, token: Token) -> None:
        """A word that stands alone; 12120 if the block has others."""
        compiler, name = self.compiler, token.text
        is_first = token is compiler.tokens[0]
        if name in keywords.SINGLE_BLOCK:
            compiler.emitter.can_join = False
            compiler.emitter.add(assigned(_SINGLE_BLOCK, constant(name == "SBLON")))
        else:
            compiler.procedure(token, keywords.PROCEDURES[name])
        if not is_first or compiler.token.kind != "end":
            raise NcSyntaxError("12120", token.column, name)

    def _other(self, token: Token) -> None:
        """Words that are handled by the language itself, or that do not exist."""
        compiler, name = self.compiler, token.text
        compiler.emitter.can_join = False
        if name in keywords.FILE_PROCEDURES:
            arguments = compiler.scope.arguments(compiler, token, keywords.FILE_PROCEDURES[name])
            compiler.emitter.run(quoted("file_procedure(channel, {0}, {1})", name, arguments))
        elif name == "SETINT":
            self._set_interrupt(token)
        elif name in keywords.OPERATORS or name in keywords.PARTS or name in keywords.STRUCTURE:
            raise compiler.error(token)
        else:
            raise unknown(token.column, name)

    def _set_interrupt(self, token: Token) -> None:
        """`SETINT(n) PRIO=v NAME LIFTFAST BLSYNC` (1.14.3): arguments n, priority, name, LIFTFAST, BLSYNC."""
        compiler = self.compiler
        compiler.expect("(")
        number = compiler.integer()
        compiler.expect(")")
        priority, name, flags = constant(1), "", {"LIFTFAST": False, "BLSYNC": False}
        while compiler.token.kind != "end":
            part = compiler.take()
            if part.text == "PRIO":
                compiler.expect("=")
                priority = compiler.integer()
            elif part.text in flags:
                flags[part.text] = True
            elif part.kind in ("name", "word") and not name:
                name = part.text
            else:
                raise compiler.error(part)
        constants = [constant(name), *map(constant, flags.values())]
        compiler.call_procedure(token, sequence([number, priority, *constants]))

    def _assigned(self) -> bool:
        return self.compiler.at("=")

    def _addressed(self, token: Token) -> None:
        """An address written as a name: with index, with `=` and any value, or with a number behind it."""
        compiler, name = self.compiler, token.text
        index: object = None
        code = _NONE
        if name == "PO" and compiler.at("[") and compiler.ahead().text in _OF_ORIENTATION:
            compiler.take()
            index = compiler.take().text
            compiler.expect("]")
            code = constant(index)
        elif compiler.at("["):
            index, code = self._index()
        elif name == "PO" and compiler.accept("("):  # the denominator, in the newer spelling
            listed = self._list()
            compiler.expect(")")
            self._add(token, name, "", constant(""), "", listed)
            return
        if self._assigned():
            self._word(token, name, index, code)
            return
        if len(name) > 1 or index is not None:
            raise compiler.error()
        self._add(token, name, None, _NONE, "", self._number(name))

    def _index(self) -> tuple[object, Code]:
        """The index in brackets: its value where it is known now, and its code."""
        compiler = self.compiler
        compiler.expect("[")
        if compiler.accept("]"):
            return "", constant("")
        token = compiler.token
        axis = compiler.scope.memory.axes.get(token.text)
        if axis is not None and compiler.ahead().text == "]" and compiler.scope.find(token.text) is None:
            compiler.take()
            compiler.expect("]")
            return axis, compiler.emitter.object(axis)
        if token.kind == "number" and isinstance(token.value, int) and compiler.ahead().text == "]":
            compiler.take()
            compiler.expect("]")
            return token.value, constant(token.value)
        codes = [self._index_part()]
        while compiler.accept(","):
            codes.append(self._index_part())
        compiler.expect("]")
        self.dynamic = True
        return _RUNNING, codes[0] if len(codes) == 1 else sequence(codes)

    def _index_part(self) -> Code:
        value = self.compiler.expression()
        return quoted("round_half_up({0})", value.code) if value.type is Type.REAL else value.code

    def _word(self, token: Token, address: str, index: object, index_code: Code) -> None:
        """A word whose value stands behind `=`."""
        compiler = self.compiler
        compiler.expect("=")
        value = compiler.token
        modifier = ""
        if value.text in keywords.MODIFIERS and compiler.ahead().text == "(" and value.kind == "name":
            compiler.take()
            modifier = value.text
            if modifier == "GP":
                return self._general_position(token, address, index, index_code)
            compiler.expect("(")
            if modifier == "PO" and compiler.token.text in _ENDS and compiler.ahead().text == "(":
                self._relative_polynomial(token, address)
                compiler.expect(")")
                return None
            code = self._list() if modifier in ("FPO", "PO") or address == "PO" else self._value(address)
            compiler.expect(")")
        elif value.text == "PO" and value.kind == "name" and compiler.ahead().text in _ENDS:
            compiler.take()
            return self._relative_polynomial(token, address)
        elif value.text == "(" and address in keywords.LIST_ADDRESSES:
            compiler.take()
            code = self._list()
            compiler.expect(")")
        else:
            code = self._value(address)
        return self._add(token, address, index, index_code, modifier, code)

    def _relative_polynomial(self, token: Token, address: str) -> None:
        """`axis=PO IC(end,a2,…)`, `axis=PO(IC(end),a2,…)`: as `PO[axis]=IC(end,a2,…)` (4.5)."""
        compiler = self.compiler
        axis = compiler.scope.memory.axes.get(address)
        if axis is None:
            raise compiler.error(token)
        modifier = compiler.take().text
        compiler.expect("(")
        parts = self._values()
        compiler.expect(")")
        if compiler.accept(","):
            parts += self._values()
        self._add(token, "PO", axis, compiler.emitter.object(axis), modifier, sequence(parts))

    def _general_position(self, token: Token, address: str, index: object, index_code: Code) -> None:
        """`=GP(position,attribute)`: the attribute is a keyword or a number (1.2.2)."""
        compiler = self.compiler
        compiler.expect("(")
        code = self._value(address)
        compiler.expect(",")
        if compiler.token.text in keywords.POSITION_ATTRIBUTES:
            keyword = compiler.take()
            modifier = keyword.text
            if modifier in keywords.CODED_POSITIONS and address not in _POSITIONING:
                raise NcSyntaxError("12560", keyword.column, modifier)
            compiler.expect(")")
            self._add(token, address, index, index_code, modifier, code)
            return
        attribute = quoted("position_attribute({0}, {1})", compiler.integer(), address)
        compiler.expect(")")
        self.dynamic = True
        self._add(token, address, index, index_code, "", code, attribute)

    def _value(self, address: str) -> Code:
        """Code of a word's value: numbers as REAL but for whole-number addresses, else as they are."""
        value = self.compiler.expression()
        if value.type is Type.CHAR:
            return quoted("chr({0})", value.code)
        if value.type is Type.REAL and not _is_written(value.code):
            return quoted("finite({0})", value.code)
        if value.type is Type.INT and address not in _WHOLE_NUMBERS:
            return self.compiler.emitter.as_real(value.code)
        return value.code

    def _list(self) -> Code:
        return sequence(self._values())

    def _values(self) -> list[Code]:
        compiler = self.compiler
        codes: list[Code] = []
        while not compiler.at(")"):
            value = compiler.expression()
            codes.append(value.code)
            if not compiler.accept(","):
                break
        return codes

    def _literal(self, address: str, token: Token) -> Code:
        """The number of a word such as `X10`."""
        value = token.value if address in _WHOLE_NUMBERS else float(token.value)
        return self.compiler.emitter.number(value, token._replace(start=token.start + 1))

    def _number(self, address: str) -> Code:
        """The number behind an address that stands apart from it or has a sign."""
        compiler = self.compiler
        first = compiler.take()
        sign = 1
        token = first
        if first.text in ("-", "+") and first.kind == "op":
            sign = -1 if first.text == "-" else 1
            token = compiler.take()
        if token.kind != "number":
            raise compiler.error(token if token.kind != "end" else compiler.tokens[compiler.place - 1])
        value = sign * (token.value if address in _WHOLE_NUMBERS else float(token.value))
        return compiler.emitter.number(value, token._replace(start=first.start))

    def _add(
        self,
        token: Token,
        address: str,
        index: object,
        index_code: Code,
        modifier: str,
        value: Code,
        attribute: Code | None = None,
    ) -> None:
        indirect = address == "AX" and not isinstance(index, Axis)
        if address == "AX":
            if isinstance(index, Axis):
                address, index = axis_address(self.compiler.channel, index)
                index_code = _NONE if index is None else index_code
            elif index is None:
                raise self.compiler.error()
        shape = WordShape(address, index, modifier)
        self.shapes.append(shape)
        last = constant(modifier) if attribute is None else attribute
        if indirect:
            code = quoted("WordShape(*axis_address(channel, {0}), {1})", index_code, last)
        else:
            code = quoted("WordShape({0}, {1}, {2})", address, index_code, last)
        self.shape_codes.append(code)
        self.values.append(value)
        self.word_columns.append(token.column)


#: How the end point of a polynomial may be meant.
_ENDS = ("IC", "AC")

_RUNNING = object()
"""Index that is known only when the block runs."""


#: Addresses of positioning axes: coded positions are for them alone (1.2.2).
_POSITIONING = frozenset({"POS", "POSA"})


def position_attribute(number: int, address: str) -> str:
    """The positioning attribute with a number (1.2.2); alarm 12560 for one that the address does not have."""
    attributes = keywords.POSITION_ATTRIBUTES
    if not 0 <= number < len(attributes):
        raise AlarmError("12560", text=str(number))
    if attributes[number] in keywords.CODED_POSITIONS and address not in _POSITIONING:
        raise AlarmError("12560", text=str(number))
    return attributes[number]


def axis_address(channel: Channel, index: object) -> tuple[str, Axis | None]:
    """Address and index that `AX[…]` means: those of the axis, `AX[S2]` for a spindle that is none.

    Alarm 12040 for another value.
    """
    if not isinstance(index, Axis):
        raise AlarmError("12040", text=str(index))
    axis = axis_of_spindle(channel, index)
    return ("AX", axis) if spindle_number(axis) is not None else (axis.name, None)


provide(position_attribute=position_attribute, axis_address=axis_address, Axis=Axis)


def _is_written(code: Code) -> bool:
    """Whether a value is a number of the block, with a minus or without."""
    operand = code[2] if code.kind == nodes.UnaryOp else code
    return isinstance(operand, Lifted)
