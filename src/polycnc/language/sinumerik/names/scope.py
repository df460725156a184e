"""Names of a program: user variables, R parameters, system variables, axes."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.code import Code, constant, item, quoted, sequence
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.errors import NcSyntaxError, unknown
from polycnc.language.sinumerik.expressions import Expr
from polycnc.language.sinumerik.lexer import JUMPS
from polycnc.language.sinumerik.names.level_variables import LEVEL_VARIABLES
from polycnc.language.sinumerik.names.places import (
    CharPlace,
    ComponentPlace,
    ElementPlace,
    Place,
    RPlace,
    SinglePlace,
    SystemPlace,
)
from polycnc.language.sinumerik.names.rights import LOWEST
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.names.variables import locals_of
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.expressions import ExpressionReader
    from polycnc.language.sinumerik.interface import LanguageControl, LanguageMemory, SystemVariable
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.names.variables import Variable


class Scope:
    """What names mean in one program.

    Attributes:
        variables: Local variables and parameters of the program, upper case.
        macros: Texts of DEFINE … AS of the program.
        main: The main program's scope, where its variables are known here too (MD11120).
        own_level: Protection level that the program has by itself, 0 the highest.
    """

    def __init__(self, memory: LanguageMemory, control: LanguageControl, main: Scope | None = None) -> None:
        self.memory = memory
        self.control = control
        self.main = main
        self.variables: dict[str, Variable] = {}
        self.macros: dict[str, str] = {}
        self.externals: dict[str, tuple[tuple[bool, Type], ...]] = {}
        self.execute = control.execute
        self.slots = 0
        self.own_level = 0

    @property
    def level(self) -> int:
        """Protection level of the program now: its own, or that of the operator if that is higher."""
        return min(self.memory.access_level, self.own_level)

    def find(self, name: str) -> Variable | None:
        """The user variable of this name."""
        variable = self.variables.get(name)
        if variable is None and self.main is not None:
            variable = self.main.variables.get(name)
        if variable is None:
            variable = self.memory.global_variables.get(name)
        return variable

    def macro(self, name: str) -> str | None:
        """The text of a macro."""
        text = self.macros.get(name)
        return self.memory.macros.get(name) if text is None else text

    def add(self, variable: Variable, token: Token) -> None:
        """Declare a local variable; 12170 if the program has one of this name."""
        if variable.name in self.variables:
            raise NcSyntaxError("12170", token.column, token.text)
        variable.slot = self.slots
        self.slots += 1
        self.variables[variable.name] = variable
        self.memory.programs.generation += 1

    def check_word(self, token: Token) -> None:
        """Raise PC0006 for a function, procedure or cycle that the program may not execute (APX)."""
        rights = self.memory.rights.get(token.text)
        if rights and self.level > rights.get("APX", LOWEST):
            raise NcSyntaxError("PC0006", token.column, token.text)

    def check_available(self, tokens: Sequence[Token]) -> None:
        """12550 for a word that this variant of the control does without; names of one's own and of labels are none."""
        before = ""
        for token in tokens:
            own = before in JUMPS or self.find(token.text) is not None
            if token.kind == "name" and token.text in self.memory.refused and not own:
                raise unknown(token.column, token.text)
            before = token.text

    def is_place(self, token: Token) -> bool:
        """Whether a token begins something that can be assigned to."""
        if token.kind == "word":
            return token.letter == "R" and isinstance(token.value, int)
        return token.kind == "name" and (
            token.text[0] == "$" or token.text == "R" or self.find(token.text) is not None
        )

    def place(self, reader: ExpressionReader, token: Token) -> Place:
        """The place that a name and the indices behind it mean; the name has been read."""
        if token.kind == "word":
            return RPlace.numbered(reader, token)
        name = token.text
        if name == "R" or name == "$R":
            return RPlace.indexed(reader, token)
        if name.startswith("$"):
            if name.startswith("$R") and name[2:].isdecimal():
                return RPlace.numbered(reader, token._replace(text=name[1:], value=int(name[2:])))
            return SystemPlace.read_indices(reader, token, self._system_variable(token))
        variable = self.find(name)
        if variable is None:
            raise unknown(token.column, name)
        return self._user_place(reader, token, variable)

    def _user_place(self, reader: ExpressionReader, token: Token, variable: Variable) -> Place:
        if variable.stops:
            reader.emitter.uses_stop = True
        container, slot = self.container(reader, variable), reader.emitter.object(variable.slot)
        if not variable.dims:
            single = SinglePlace(variable, container, slot)
            if not reader.at("["):
                return single
            if variable.type is Type.STRING:
                if variable.by_reference:  # 1.9.8: single characters only of what the program itself has
                    raise reader.error()
                return CharPlace.read_index(reader, single)
            if variable.type is Type.FRAME:
                return ComponentPlace.read_index(reader, single)
            raise NcSyntaxError("12400", token.column, token.text)
        return ElementPlace.read_indices(reader, token, variable, item(container, slot))

    def container(self, reader: ExpressionReader, variable: Variable) -> Code:
        """Code of the list in which a variable lies."""
        if variable.store is not None:
            return reader.emitter.object(variable.store)
        if self.variables.get(variable.name) is variable:
            return reader.emitter.local()
        return reader.emitter.main()

    def _system_variable(self, token: Token) -> SystemVariable:
        name = token.text
        if len(name) < 3:
            raise unknown(token.column, name)
        try:
            return LEVEL_VARIABLES.get(name) or self.control.system_variable(name)
        except AlarmError as alarm:
            alarm.column = alarm.column or token.column
            raise

    def value_of(self, variable: Variable, channel: Channel) -> Any:
        """What lies in a variable's slot now."""
        if variable.store is not None:
            return variable.store[0]
        level = channel.level if self.variables.get(variable.name) is variable else channel.stack[0]
        return locals_of(level)[variable.slot]

    def word_operand(self, reader: ExpressionReader, token: Token) -> Expr:
        """A letter with a number as an operand: an R parameter, or an axis or spindle name."""
        if token.letter == "R" and isinstance(token.value, int):
            return RPlace.numbered(reader, token).read(reader)
        axis = self.memory.axes.get(token.text)
        if axis is not None:
            return Expr(reader.emitter.object(axis), Type.AXIS)
        raise NcSyntaxError("12080", token.column, token.text)

    def named_operand(self, reader: ExpressionReader, token: Token) -> Expr:
        """An axis, or a function that needs the control or the language's files."""
        axis = self.memory.default_axis if token.text == "NO_AXIS" else self.memory.axes.get(token.text)
        if axis is not None:
            return Expr(reader.emitter.object(axis), Type.AXIS)
        for caller, functions in _FUNCTION_CALLERS:
            function = functions.get(token.text)
            if function is not None:
                self.check_word(token)
                arguments = self.arguments(reader, token, function.arguments)
                reader.emitter.knows_place = True
                column = reader.emitter.object(token.column)
                return Expr(quoted(caller, token.text, arguments, column), function.result)
        if is_known(token.text, self.control):
            raise NcSyntaxError("12080", token.column, token.text)
        raise unknown(token.column, token.text)

    def arguments(self, reader: ExpressionReader, token: Token, letters: str) -> Code:
        """Code of the tuple of arguments in brackets; None for each one left out."""
        codes: list[Code] = []
        opening, closing = "()" if token.text not in keywords.SQUARE or not reader.at("[") else "[]"
        if reader.accept(opening):
            while not reader.at(closing):
                letter = "*" if letters == "*" else letters[len(codes)] if len(codes) < len(letters) else ""
                if not letter:
                    raise NcSyntaxError("12340", reader.token.column, token.text)
                codes.append(self._argument(reader, letter))
                if not reader.at(closing):
                    reader.expect(",")
                    if reader.at(closing):
                        codes.append(constant(None))
            reader.expect(closing)
        if letters != "*":
            missing = letters[len(codes) :]
            if any(letter.isupper() or letter == "[" for letter in missing) and missing[0] != "?":
                raise NcSyntaxError("14020", token.column, token.text)
            codes += [constant(None)] * (len(letters) - len(codes))
        return sequence(codes)

    def _argument(self, reader: ExpressionReader, letter: str) -> Code:
        if reader.at(","):
            return constant(None)
        if letter in "Vv[":
            token = reader.take()
            if not self.is_place(token):
                raise NcSyntaxError("12320", token.column, token.text)
            return reader.reference(token)
        if letter == "W":
            return self._row(reader)
        if letter == "j":
            return self._place_or_value(reader)
        if letter in "*?":
            return self._any(reader)
        return reader.value(keywords.TYPE_LETTERS[letter.upper()])

    def _place_or_value(self, reader: ExpressionReader) -> Code:
        """A variable that the function may change, or a whole number."""
        token = reader.token
        if self.is_place(token) and not token.text.startswith("$"):
            return self.place(reader, reader.take()).reference(reader)
        return reader.value(Type.INT)

    def _row(self, reader: ExpressionReader) -> Code:
        """`TABLE[row]`: the table and the number of the row."""
        token = reader.take()
        variable = self.find(token.text) if token.kind == "name" else None
        if variable is None or len(variable.dims) != 2:
            raise NcSyntaxError("12320", token.column, token.text)
        table = item(self.container(reader, variable), reader.emitter.object(variable.slot))
        reader.expect("[")
        row = reader.value(Type.INT)
        reader.expect("]")
        return sequence([table, row])

    @staticmethod
    def _any(reader: ExpressionReader) -> Code:
        literal = reader.literal()  # most arguments of cycles
        if literal is not None:
            return literal
        value = reader.expression()
        return quoted("chr({0})", value.code) if value.type is Type.CHAR else value.code


#: How compiled code asks for the value of a function that is more than its arguments.
_FUNCTION_CALLERS = (
    ("channel.control.function(channel, {0}, {1}, {2})", keywords.CONTROL_FUNCTIONS),
    ("name_function(channel, {0}, {1})", keywords.NAME_FUNCTIONS),
    ("file_function(channel, {0}, {1})", keywords.FILE_FUNCTIONS),
)


def is_known(name: str, control: LanguageControl) -> bool:
    """Whether a name is a word of the language."""
    return any(name in table for table in _TABLES) or name in control.g_groups or name in keywords.SPELLINGS


_TABLES = (
    keywords.FUNCTIONS, keywords.SAME_TYPE_FUNCTIONS, keywords.FRAME_FUNCTIONS, keywords.CONTROL_FUNCTIONS,
    keywords.NAME_FUNCTIONS, keywords.FILE_FUNCTIONS, keywords.FILE_PROCEDURES, keywords.PROCEDURES,
    keywords.ADDRESSES,
    keywords.MODIFIERS, keywords.INDEXED_WORDS, keywords.FRAME_COMPONENTS, keywords.STRUCTURE,
    keywords.DEFINITIONS, keywords.CALLS, keywords.OPERATORS, keywords.PARTS, keywords.SYNCHRONOUS,
    keywords.NOT_EXECUTED, keywords.SINGLE_BLOCK,
)  # fmt: skip
