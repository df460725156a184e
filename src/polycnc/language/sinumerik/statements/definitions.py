"""Definitions: DEF, REDEF, PROC, EXTERN, DEFINE … AS (job planning 1.1.5 to 1.1.12, 1.25.2, 1.26)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.language.expressions.code import Code, assigned, quoted, sequence
from polycnc.language.expressions.code import constant as literal
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.emitter import Emitter
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.names import units
from polycnc.language.sinumerik.names.places import SinglePlace
from polycnc.language.sinumerik.names.values import MAX_STRING, Type
from polycnc.language.sinumerik.names.variables import Variable, element_count
from polycnc.language.sinumerik.runtime import default_value
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.blocks import BlockCompiler
    from polycnc.language.sinumerik.expressions import ExpressionReader
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.names.scope import Scope

MAX_DIMENSION = 65535
_NOWHERE = literal(None)
MAX_ELEMENTS = 4_000_000
MAX_NAME = 31
MAX_PARAMETERS = 127
_TYPES = {type_.value for type_ in Type}
_RIGHTS = frozenset({"APR", "APW", "APRP", "APWP", "APRB", "APWB", "APX"})
_INIT_TIMES = frozenset({"INIPO", "INIRE", "INICF", "PRLOC"})
_STOPS = {"SYNR": "R", "SYNW": "W", "SYNRW": "RW"}
_RANGES = frozenset({"NCK", "CHAN"})
#: Names that a variable cannot have: they would change what every block means. Names of functions it may have, as the
#: manual's own examples (BLOCK in 1.2.3, MINVAL in 9.2.6).
_RESERVED = keywords.STRUCTURE | keywords.OPERATORS | keywords.DEFINITIONS | _TYPES | {"TRUE", "FALSE"}


def constant(reader: ExpressionReader, type_: Type, channel: Channel) -> Any:
    """The value of an expression that must be known now (array sizes, limits)."""
    kept, reader.emitter = reader.emitter, Emitter(reader.scope.control.shapes)
    result: list[Any] = []
    code = reader.value(type_)
    reader.emitter.run(quoted("{0}.append({1})", reader.emitter.object(result), code))
    step = reader.emitter.step()
    reader.emitter = kept
    step(channel)
    return result[0]


@dataclass(slots=True)
class Attributes:
    """What stands between DEF and the names."""

    type: Type | None = None
    length: int = MAX_STRING
    low: float | None = None
    high: float | None = None
    stops: str = ""
    unit: int = 0
    init_time: str = ""
    range: str = ""
    rights: dict[str, int] | None = None


def read_attributes(compiler: BlockCompiler) -> Attributes:
    """Read what stands between DEF and the first name, or behind the name of REDEF."""
    found = Attributes(rights={})
    channel = compiler.channel
    while True:
        token = compiler.token
        name = token.text if token.kind == "name" else ""
        if name in _TYPES and found.type is None:
            compiler.take()
            found.type = Type[name]
            if found.type is Type.STRING:
                found.length = _string_length(compiler, channel)
        elif name in ("LLI", "ULI"):
            compiler.take()
            value = constant(compiler, Type.REAL, channel)
            found.low, found.high = (value, found.high) if name == "LLI" else (found.low, value)
        elif name == "PHU":
            compiler.take()
            found.unit = _unit(compiler, channel)
        elif name in _RIGHTS:
            compiler.take()
            if not compiler.program.is_definition_file:
                raise NcSyntaxError("12500", token.column, name)
            assert found.rights is not None
            found.rights[name] = _level(compiler, channel)
        elif name in _INIT_TIMES or name in _STOPS or name in _RANGES:
            compiler.take()
            _flag(compiler, found, name, token)
        else:
            return found


def _flag(compiler: BlockCompiler, found: Attributes, name: str, token: Token) -> None:
    if not compiler.program.is_definition_file:
        raise NcSyntaxError("12500", token.column, name)
    if name in _INIT_TIMES:
        found.init_time = name
    elif name in _STOPS:
        found.stops = _STOPS[name]
    else:
        found.range = name


def _unit(compiler: BlockCompiler, channel: Channel) -> int:
    token = compiler.token
    unit: int = constant(compiler, Type.INT, channel)
    if unit not in units.KNOWN:
        raise NcSyntaxError("12160", token.column, f"PHU {unit}")
    return unit


def _level(compiler: BlockCompiler, channel: Channel) -> int:
    token = compiler.token
    level: int = constant(compiler, Type.INT, channel)
    if not 0 <= level <= 17:
        raise NcSyntaxError("12490", token.column, str(level))
    return level


def _string_length(compiler: BlockCompiler, channel: Channel) -> int:
    if not compiler.accept("["):
        return MAX_STRING
    token = compiler.token
    length: int = constant(compiler, Type.INT, channel)
    compiler.expect("]")
    if not 1 <= length <= MAX_STRING:
        raise NcSyntaxError("12210", token.column, str(length))
    return length


def define_variables(compiler: BlockCompiler) -> None:
    """DEF: attributes, then names with sizes and first values (1.1.5)."""
    start = compiler.take()
    compiler.emitter.knows_place = True
    if not compiler.program.in_definitions(compiler.index):
        raise NcSyntaxError("14500", start.column, "DEF")
    attributes = read_attributes(compiler)
    if attributes.type is None:
        raise compiler.error()
    if attributes.range == "NCK" and attributes.init_time not in ("", "INIPO"):
        raise NcSyntaxError("12500", start.column, attributes.init_time)  # 1.1.7: at power-on alone
    if attributes.unit and attributes.type not in (Type.INT, Type.REAL):
        raise NcSyntaxError("12150", start.column, "PHU")
    names: set[str] = set()
    while True:
        name = _define_one(compiler, attributes, attributes.type)
        if name.text in names:
            raise NcSyntaxError("12170", name.column, name.text)
        names.add(name.text)
        if not compiler.accept(","):
            return


def _define_one(compiler: BlockCompiler, attributes: Attributes, type_: Type) -> Token:
    token = compiler.take()
    _check_name(token, compiler)
    limits = type_ in (Type.INT, Type.REAL, Type.CHAR)
    if not limits and (attributes.low is not None or attributes.high is not None):
        raise NcSyntaxError("12150", token.column, token.text)
    dims = _dimensions(compiler, compiler.channel) if compiler.at("[") else ()
    if type_ is Type.STRING and len(dims) > 2:
        raise NcSyntaxError("12190", token.column, token.text)
    variable = Variable(
        token.text,
        type_,
        dims,
        attributes.length,
        attributes.low,
        attributes.high,
        stops=attributes.stops,
        unit=attributes.unit,
        rights=dict(attributes.rights or {}),
        init_time=attributes.init_time,
        range=attributes.range,
    )
    if dims:
        values = _first_array(compiler, variable, has_values=compiler.accept("="))
        _declare(compiler, variable, token)
        store(compiler, variable, values)
    elif compiler.accept("="):
        if type_ is Type.FRAME:
            raise NcSyntaxError("12261", token.column, token.text)
        value = checked(compiler, variable, compiler.assigned(type_))  # in which the name means nothing yet
        _declare(compiler, variable, token)
        store(compiler, variable, value)
    else:
        _declare(compiler, variable, token)
        store(compiler, variable, compiler.emitter.object(_first_value(variable, compiler.scope)))
    return token


def _check_name(token: Token, compiler: BlockCompiler) -> None:
    if token.kind != "name" or len(token.text) < 2 or token.text[0] == "$":
        raise compiler.error(token)
    if len(token.text) > MAX_NAME:
        raise NcSyntaxError("12420", token.column, token.text)
    scope = compiler.scope
    if token.text in _RESERVED or token.text in scope.memory.axes or token.text in scope.control.g_groups:
        raise NcSyntaxError("12170", token.column, token.text)


def _declare(compiler: BlockCompiler, variable: Variable, token: Token) -> None:
    if compiler.program.is_definition_file:
        variable.store = [None]
        compiler.scope.memory.global_variables[variable.name] = variable
    elif compiler.program.declared.get(variable.name) == compiler.index:
        variable.slot = compiler.scope.variables[variable.name].slot
        compiler.scope.variables[variable.name] = variable
    else:
        compiler.scope.add(variable, token)
        compiler.program.declared[variable.name] = compiler.index


def _dimensions(reader: ExpressionReader, channel: Channel) -> tuple[int, ...]:
    token = reader.expect("[")
    dims = []
    while True:
        at = reader.token
        if reader.scope.is_place(at):
            raise reader.error(at)  # sizes are constants (1.2)
        size = constant(reader, Type.INT, channel)
        if not 1 <= size <= MAX_DIMENSION:
            raise NcSyntaxError("12370", at.column, str(size))
        dims.append(size)
        if not reader.accept(","):
            break
    reader.expect("]")
    if len(dims) > 3:
        raise NcSyntaxError("12190", token.column, str(len(dims)))
    if element_count(dims) > MAX_ELEMENTS:
        raise NcSyntaxError("14070", token.column, str(element_count(dims)))
    return tuple(dims)


def _first_value(variable: Variable, scope: Scope) -> Any:
    """The value without a programmed one: zero, or the limit that zero is beyond (1.1.8)."""
    value = default_value(variable.type, scope.memory)
    if variable.low is not None and value < variable.low:
        value = variable.low
    if variable.high is not None and value > variable.high:
        value = variable.high
    return int(value) if variable.type in (Type.INT, Type.CHAR) else value


def checked(compiler: BlockCompiler, variable: Variable, code: Code) -> Code:
    """Code of a first value as it is kept."""
    return SinglePlace(variable, _NOWHERE, _NOWHERE).stored(compiler, code)


def store(compiler: BlockCompiler, variable: Variable, code: Code) -> None:
    """Add the statement that gives a variable its first value."""
    if variable.store is not None:
        compiler.emitter.add(assigned(quoted("{0}[0]", compiler.emitter.object(variable.store)), code))
    else:
        compiler.emitter.run(quoted("define(channel.level, {0}, {1})", variable.slot, code))


def _first_array(compiler: BlockCompiler, variable: Variable, *, has_values: bool) -> Code:
    """Code of an array with its first values (1.1.12)."""
    emitter = compiler.emitter
    first = emitter.object(_first_value(variable, compiler.scope))
    items = quoted("items")
    emitter.add(assigned(items, quoted("[{0}] * {1}", first, element_count(variable.dims))))
    if has_values:
        values = first_values(compiler, variable.type)
        if values.is_repeated:
            repeated = checked(compiler, variable, values.codes[0])
            emitter.run(quoted("repeat_element(items, 0, {0}, {1})", repeated, values.times))
        else:
            if len(values.codes) > element_count(variable.dims):
                raise NcSyntaxError("12260", values.column, variable.name)
            kept = [checked(compiler, variable, code) for code in values.codes]
            emitter.run(quoted("set_elements(items, 0, {0})", sequence(kept)))
    return quoted("Array({0}, items)", emitter.object(variable))


class FirstValueCodes(NamedTuple):
    """First values as they are written.

    Attributes:
        codes: Codes of the values, of a repeated one that alone.
        is_repeated: They are `REP(value[,count])`.
        times: Code of how often it is repeated; None for all elements.
        column: Where they begin.
    """

    codes: list[Code]
    is_repeated: bool
    times: Code | None
    column: int


def first_values(compiler: BlockCompiler, type_: Type) -> FirstValueCodes:
    """Read `SET(…)`, `(…)`, `REP(v[,n])`, or one value, which is that of the first element (1.1.12)."""
    token = compiler.token
    if type_ is Type.FRAME:
        raise NcSyntaxError("12261", token.column, token.text)
    if compiler.accept("REP"):
        value, count = compiler.repeated(type_)
        return FirstValueCodes([value], is_repeated=True, times=count, column=token.column)
    listed = compiler.accept("SET") or compiler.at("(")
    codes = compiler.value_list(type_) if listed else [compiler.assigned(type_)]
    return FirstValueCodes(codes, is_repeated=False, times=None, column=token.column)


def give_first_value(compiler: BlockCompiler, variable: Variable) -> None:
    """Read the first values of a variable and add the statement that stores them."""
    if variable.dims:
        store(compiler, variable, _first_array(compiler, variable, has_values=True))
        return
    values = first_values(compiler, variable.type)
    if len(values.codes) > 1:
        raise NcSyntaxError("12260", values.column, variable.name)
    store(compiler, variable, checked(compiler, variable, values.codes[0]))


# ---- programs and macros -----------------------------------------------------------------------------------


@dataclass(slots=True)
class Header:
    """The PROC line of a program.

    Attributes:
        name: Name as written, upper case; empty without PROC.
        parameters: Formal parameters in order; their slots are 0, 1, 2, …
        attributes: SAVE, SBLOF, DISPLOF, DISPLON, ACTBLOCNO, PREPRO.
        first_values: Values of parameters that a call may leave out, None for those that it may not.
    """

    name: str
    parameters: tuple[Variable, ...]
    attributes: frozenset[str]
    first_values: tuple[Any, ...]

    def arguments_left_out(self) -> tuple[Any, ...]:
        """The values of a call that writes no parameter; alarm 14010 for one that must be written."""
        for parameter, value in zip(self.parameters, self.first_values, strict=True):
            if value is None:
                raise AlarmError("14010", text=parameter.name)
        return self.first_values


NO_HEADER = Header("", (), frozenset(), ())
_HEADER_WORDS = frozenset({"SAVE", "SBLOF", "SBLON", "DISPLOF", "DISPLON", "ACTBLOCNO", "PREPRO"})


def read_header(reader: ExpressionReader, channel: Channel) -> Header:
    """Read `PROC name(parameters) attributes`; the parameters become variables of the program."""
    reader.expect("PROC")
    name = reader.take()
    if name.kind not in ("name", "word"):
        raise reader.error(name)
    parameters: list[Variable] = []
    values: list[Any] = []
    if reader.accept("("):
        while not reader.at(")"):
            if parameters:
                reader.expect(",")
            variable, value = _parameter(reader, channel)
            parameters.append(variable)
            values.append(value)
        reader.expect(")")
    if len(parameters) > MAX_PARAMETERS:
        raise NcSyntaxError("12440", name.column, name.text)
    attributes = set()
    while reader.token.kind != "end":
        token = reader.take()
        if token.text not in _HEADER_WORDS:
            raise reader.error(token)
        attributes.add(token.text)
    return Header(name.text, tuple(parameters), frozenset(attributes), tuple(values))


def _parameter(reader: ExpressionReader, channel: Channel) -> tuple[Variable, Any]:
    by_reference = reader.accept("VAR")
    type_, length = _type(reader, channel)
    token = reader.take()
    if token.kind != "name" or token.text[0] == "$":
        raise reader.error(token)
    dims: tuple[int, ...] = ()
    if reader.accept("["):
        dims = _open_dimensions(reader, channel)
    variable = Variable(token.text, type_, dims, length, by_reference=by_reference and not dims)
    reader.scope.add(variable, token)
    value = None
    if not by_reference and not dims and type_ is not Type.AXIS:
        value = default_value(type_, reader.scope.memory)
    if reader.accept("="):
        value = constant(reader, type_, channel)
    return variable, value


def _type(reader: ExpressionReader, channel: Channel) -> tuple[Type, int]:
    token = reader.take()
    if token.text not in _TYPES or token.kind != "name":
        raise reader.error(token)
    type_, length = Type[token.text], MAX_STRING
    if type_ is Type.STRING and reader.accept("["):
        length = constant(reader, Type.INT, channel)
        reader.expect("]")
    return type_, length


def _open_dimensions(reader: ExpressionReader, channel: Channel) -> tuple[int, ...]:
    """Sizes of an array parameter; an open one counts as 0."""
    dims = []
    while True:
        dims.append(0 if reader.at(",") or reader.at("]") else constant(reader, Type.INT, channel))
        if not reader.accept(","):
            break
    reader.expect("]")
    return tuple(dims)


def procedure_line(compiler: BlockCompiler) -> None:
    """PROC has done its work when the program was called; it must be the first block."""
    token = compiler.token
    if not compiler.program.is_first_statement(compiler.index):
        raise NcSyntaxError("14500", token.column, "PROC")
    compiler.place = len(compiler.tokens) - 1


def external(compiler: BlockCompiler) -> None:
    """EXTERN: a subprogram with parameters; its own PROC line is what a call follows (1.25.3.2)."""
    compiler.take()
    name = compiler.take()
    if name.kind not in ("name", "word"):
        raise compiler.error(name)
    types: list[tuple[bool, Type]] = []
    if compiler.accept("("):
        while not compiler.at(")"):
            if types:
                compiler.expect(",")
            by_reference = compiler.accept("VAR")
            types.append((by_reference, _type(compiler, compiler.channel)[0]))
            if compiler.token.kind == "name":
                compiler.take()
            if compiler.accept("["):
                _open_dimensions(compiler, compiler.channel)
        compiler.expect(")")
    compiler.scope.externals[name.text] = tuple(types)


def define_macro(compiler: BlockCompiler) -> None:
    """DEFINE … AS: the text behind AS replaces the name (1.26)."""
    start = compiler.take()
    if not compiler.program.in_definitions(compiler.index):
        raise NcSyntaxError("14500", start.column, "DEFINE")
    token = compiler.take()
    name = f"{token.letter}{token.value}" if token.kind == "word" else token.text
    if token.kind not in ("name", "word"):
        raise compiler.error(token)
    if token.kind == "name" and name in keywords.RESERVED:
        raise NcSyntaxError("12270", token.column, name)
    if name[0] == "G" and name[1:].isdecimal() and not compiler.program.is_definition_file:
        raise NcSyntaxError("12500", token.column, name)  # 1.26: for the whole control, in macro files alone
    compiler.expect("AS")
    first = compiler.token
    if first.kind == "end":
        raise compiler.error(first)
    text = compiler.program.text(compiler.index)[first.start : compiler.tokens[-1].start].rstrip()
    macros = compiler.scope.memory.macros if compiler.program.is_definition_file else compiler.scope.macros
    macros[name] = text
    compiler.program.forget_shapes()
    compiler.place = len(compiler.tokens) - 1


STATEMENTS: dict[str, Callable[[BlockCompiler], None]] = {
    "DEF": define_variables,
    "PROC": procedure_line,
    "EXTERN": external,
    "DEFINE": define_macro,
}
