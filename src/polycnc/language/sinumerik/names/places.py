"""Places of values: variables, elements, characters, components, R parameters, system variables."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.language.expressions.code import Code, assigned, attribute, constant, item, quoted, sequence
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.expressions import Expr
from polycnc.language.sinumerik.names import rights, units
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.names.variables import R_PARAMETER, Variable

if TYPE_CHECKING:
    from polycnc.language.sinumerik.expressions import ExpressionReader
    from polycnc.language.sinumerik.interface import SystemVariable
    from polycnc.language.sinumerik.lexer import Token


class Place(Protocol):
    """A place; codes are for the block that its name was read in."""

    type: Type

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the value."""

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Add the statement that stores a value of the place's type."""

    def reference(self, reader: ExpressionReader) -> Code:
        """Code of the `Reference` or `Array` that a VAR parameter gets."""

    def stored(self, reader: ExpressionReader, code: Code) -> Code:
        """Code of a value as it is kept: in metric units, within its limits."""

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[Code, Code]:
        """Code of the list and of the index at which SET and REP begin; 12080 for a single value."""


def _read(variable: Variable | None, code: Code, type_: Type) -> Expr:
    """A kept value as the program reads it."""
    factor = units.FACTORS.get(variable.unit) if variable is not None else None
    if factor is None:
        return Expr(code, type_)
    read = quoted("shown(channel, {0}, {1})", code, factor)
    return Expr(quoted("round_half_up({0})", read) if type_ is Type.INT else read, type_)


def _stored(reader: ExpressionReader, variable: Variable | None, code: Code) -> Code:
    """A value of the program as it is kept: in metric units, within the limits of its variable."""
    if variable is None:
        return code
    factor = units.FACTORS.get(variable.unit)
    if factor is not None:
        code = quoted("kept(channel, {0}, {1})", code, factor)
    return code if variable.is_plain else quoted("{0}.checked({1})", reader.emitter.object(variable), code)


def checked_index(
    reader: ExpressionReader, code: Code, size: Code | int, name: str, dimension: int = 1
) -> Code:
    """Code of an index that must be within a dimension."""
    first, again = reader.emitter.twice(code)
    written = "{1} if 0 <= {0} < {2} else out_of_range({3}, {4}, {1})"
    return quoted(written, first, again, size, name, dimension)


class SinglePlace:
    """A variable that is no array."""

    def __init__(self, variable: Variable, container: Code, slot: Code) -> None:
        self.variable = variable
        self.type = variable.type
        self.container = container
        self.slot = slot
        self.code = item(container, slot)

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the value."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.READ)
        if self.variable.by_reference:
            return Expr(attribute(self.code, "value"), self.type)
        return _read(self.variable, self.code, self.type)

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Store; a parameter by reference checks by the rules of the caller's variable."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        if self.variable.by_reference:
            reader.emitter.add(assigned(attribute(self.code, "value"), code))
        else:
            reader.emitter.add(assigned(self.code, self.stored(reader, code)))

    def stored(self, reader: ExpressionReader, code: Code) -> Code:
        """Code of a value as it is kept."""
        return _stored(reader, self.variable, code)

    def reference(self, reader: ExpressionReader) -> Code:
        """A reference; one that came from further out is handed on."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        if self.variable.by_reference:
            return self.code
        variable = reader.emitter.object(self.variable)
        return quoted("Reference({0}, {1}, {2})", self.container, self.slot, variable)

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[Code, Code]:
        """A single value has none."""
        raise reader.error(token)


class ElementPlace:
    """An element of an array, or the whole array where no index is written."""

    def __init__(self, variable: Variable, array: Code, offset: Code | None) -> None:
        self.variable = variable
        self.type = variable.type
        self.array = array
        self.items = attribute(array, "items")
        self.offset = offset

    @classmethod
    def read_indices(cls, reader: ExpressionReader, token: Token, variable: Variable, array: Code) -> Place:
        """The element whose indices come next; a further index of a STRING is a character of it."""
        if not reader.accept("["):
            return cls(variable, array, None)
        offset: Code | None = None
        for dimension, size in enumerate(variable.dims):
            if dimension:
                reader.expect(",")
            extent = constant(size) if size else quoted("{0}.dims[{1}]", array, dimension)
            index = checked_index(reader, reader.value(Type.INT), extent, variable.name, dimension + 1)
            offset = index if offset is None else quoted("{0} * {1} + {2}", offset, extent, index)
            if reader.at("]") and dimension + 1 < len(variable.dims):
                raise NcSyntaxError("12400", token.column, token.text)
        element = cls(variable, array, offset)
        if variable.type is Type.STRING and reader.at(","):
            return CharPlace.read_index(reader, element)
        if variable.type is Type.FRAME and reader.at(","):
            return ComponentPlace.read_index(reader, element)
        if reader.at(","):
            raise NcSyntaxError("12400", token.column, token.text)
        reader.expect("]")
        return element

    def _element(self) -> Code:
        if self.offset is None:
            raise NcSyntaxError("12400", 0, self.variable.name)
        return item(self.items, self.offset)

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the element."""
        element = self._element()
        rights.check(reader, self.variable.name, self.variable.rights, rights.READ)
        return _read(self.variable, element, self.type)

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Store the element."""
        element = self._element()
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        reader.emitter.add(assigned(element, self.stored(reader, code)))

    def stored(self, reader: ExpressionReader, code: Code) -> Code:
        """Code of a value as it is kept."""
        return _stored(reader, self.variable, code)

    def reference(self, reader: ExpressionReader) -> Code:
        """The array itself, or a reference to one element."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        if self.offset is None:
            return self.array
        variable = reader.emitter.object(self.variable)
        return quoted("Reference({0}, {1}, {2})", self.items, self.offset, variable)

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[Code, Code]:  # noqa: ARG002
        """From this element on."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        return self.items, constant(0) if self.offset is None else self.offset


class _PartPlace:
    """A part of a value that is read and replaced as a whole."""

    type: Type

    def __init__(self, base: SinglePlace | ElementPlace) -> None:
        self.base = base

    def stored(self, reader: ExpressionReader, code: Code) -> Code:  # noqa: ARG002
        """Parts have neither limits nor units."""
        return code

    def reference(self, reader: ExpressionReader) -> Code:
        """Parts of values cannot be handed over by reference (1.9.8)."""
        raise reader.error()

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[Code, Code]:
        """A part is a single value."""
        raise reader.error(token)


class CharPlace(_PartPlace):
    """One character of a STRING (1.9.8)."""

    type = Type.CHAR

    def __init__(self, base: SinglePlace | ElementPlace, index: Code) -> None:
        super().__init__(base)
        self.index = index

    @classmethod
    def read_index(cls, reader: ExpressionReader, base: SinglePlace | ElementPlace) -> CharPlace:
        """The character whose index comes next, after `[` or `,`."""
        reader.take()
        place = cls(base, reader.value(Type.INT))
        reader.expect("]")
        return place

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the character."""
        return Expr(quoted("char_at({0}, {1})", self.base.read(reader).code, self.index), Type.CHAR)

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Replace the character."""
        text = self.base.read(reader).code
        self.base.write(reader, quoted("with_char({0}, {1}, {2})", text, self.index, code))


class ComponentPlace(_PartPlace):
    """One component of a FRAME variable: `FRM[X,TR]` (5.2.2)."""

    type = Type.REAL

    def __init__(self, base: SinglePlace | ElementPlace, axis: Code, component: str) -> None:
        super().__init__(base)
        self.axis = axis
        self.component = component

    @classmethod
    def read_index(cls, reader: ExpressionReader, base: SinglePlace | ElementPlace) -> ComponentPlace:
        """The component that comes next, after `[` or `,`."""
        reader.take()
        axis = reader.value(Type.AXIS)
        reader.expect(",")
        token = reader.take()
        if token.text not in keywords.FRAME_COMPONENTS:
            raise reader.error(token)
        reader.expect("]")
        return cls(base, axis, token.text)

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the component."""
        frame = self.base.read(reader).code
        code = quoted("frame_component(channel, {0}, {1}, {2})", frame, self.axis, self.component)
        return Expr(code, Type.REAL)

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Replace the component."""
        frame = self.base.read(reader).code
        written = "with_component(channel, {0}, {1}, {2}, {3})"
        changed = quoted(written, frame, self.axis, self.component, code)
        self.base.write(reader, changed)


class RPlace:
    """An R parameter: `R10`, `R[expression]`, `$R10` (the same memory, 1.1.3)."""

    type = Type.REAL

    def __init__(self, values: Code, index: Code) -> None:
        self.values = values
        self.index = index

    @classmethod
    def numbered(cls, reader: ExpressionReader, token: Token) -> RPlace:
        """`R10`; 12290 beyond the last parameter."""
        values = reader.scope.memory.r
        if not isinstance(token.value, int):
            raise reader.error(token)
        if token.value >= len(values):
            raise NcSyntaxError("12290", token.column, token.text)
        return cls(reader.emitter.object(values), reader.emitter.parameter(token.value, token))

    @classmethod
    def indexed(cls, reader: ExpressionReader, token: Token) -> RPlace:  # noqa: ARG003
        """`R[expression]`."""
        reader.expect("[")
        index = reader.value(Type.INT)
        reader.expect("]")
        values = reader.scope.memory.r
        return cls(reader.emitter.object(values), checked_index(reader, index, len(values), "R"))

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the parameter."""
        rights.check(reader, "R", reader.scope.memory.rights.get("R", {}), rights.READ)
        return _read(reader.scope.memory.user_data.get("R"), item(self.values, self.index), Type.REAL)

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Store the parameter."""
        rights.check(reader, "R", reader.scope.memory.rights.get("R", {}), rights.WRITE)
        reader.emitter.add(assigned(item(self.values, self.index), self.stored(reader, code)))

    def stored(self, reader: ExpressionReader, code: Code) -> Code:
        """Code of a value as it is kept."""
        return _stored(reader, reader.scope.memory.user_data.get("R"), code)

    def reference(self, reader: ExpressionReader) -> Code:
        """A reference to the parameter."""
        return quoted("Reference({0}, {1}, {2})", self.values, self.index, reader.emitter.object(R_PARAMETER))

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[Code, Code]:  # noqa: ARG002
        """R parameters are an array of one dimension."""
        rights.check(reader, "R", reader.scope.memory.rights.get("R", {}), rights.WRITE)
        return self.values, self.index


class SystemPlace:
    """A system variable with its indices."""

    def __init__(self, name: str, variable: SystemVariable, code: Code, indices: Code, type_: Type) -> None:
        self.name = name
        self.variable = variable
        self.code = code
        self.indices = indices
        self.type = type_

    @classmethod
    def read_indices(cls, reader: ExpressionReader, token: Token, variable: SystemVariable) -> SystemPlace:
        """The variable with the indices that come next; a frame with a component is a REAL."""
        codes: list[Code] = []
        type_ = variable.type
        if reader.accept("["):
            while not reader.at("]"):
                if codes:
                    reader.expect(",")
                if reader.token.text in keywords.FRAME_COMPONENTS and reader.token.kind == "name":
                    codes.append(constant(reader.take().text))
                    type_ = Type.REAL
                else:
                    index = reader.expression()
                    if index.type is Type.FRAME:
                        raise NcSyntaxError("12400", token.column, token.text)
                    real = index.type is Type.REAL
                    codes.append(quoted("round_half_up({0})", index.code) if real else index.code)
            reader.expect("]")
        return cls(token.text, variable, reader.emitter.object(variable), sequence(codes), type_)

    def read(self, reader: ExpressionReader) -> Expr:
        """Code that asks the control."""
        rights.check(reader, self.name, reader.scope.memory.rights.get(self.name, {}), rights.READ)
        if self.variable.stop:
            reader.emitter.uses_stop = True
        reader.emitter.uses_clock |= self.variable.timed
        written = "{0}.read(channel, {1})" if self.variable.unit is None else "read_length(channel, {0}, {1})"
        return _read(self._user_data(reader), quoted(written, self.code, self.indices), self.type)

    def write(self, reader: ExpressionReader, code: Code) -> None:
        """Code that tells the control."""
        rights.check(reader, self.name, reader.scope.memory.rights.get(self.name, {}), rights.WRITE)
        self.prepare_write(reader)
        stored = self.stored(reader, code)
        plain = self.variable.unit is None
        written = "{0}.write(channel, {1}, {2})" if plain else "write_length(channel, {0}, {1}, {2})"
        reader.emitter.run(quoted(written, self.code, self.indices, stored))

    def prepare_write(self, reader: ExpressionReader) -> None:
        """Say what writing asks for: a preprocessing stop, unless the value goes along with the path."""
        if self.variable.of_actions:
            raise NcSyntaxError("17210", reader.tokens[0].column, self.name)
        reader.emitter.acts = True
        reader.emitter.uses_clock |= self.variable.timed
        if self.variable.stop and not self.variable.goes_along:
            reader.emitter.uses_stop = True

    def stored(self, reader: ExpressionReader, code: Code) -> Code:
        """Code of a value as it is kept."""
        return _stored(reader, self._user_data(reader), code)

    def _user_data(self, reader: ExpressionReader) -> Variable | None:
        """What REDEF has said of the variable."""
        data = reader.scope.memory.user_data.get(self.name)
        if data is not None and data.stops:
            reader.emitter.uses_stop = True
        return data

    def reference(self, reader: ExpressionReader) -> Code:
        """System variables cannot be handed over by reference."""
        raise NcSyntaxError("12320", reader.token.column, reader.token.text)

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[Code, Code]:
        """SET and REP of system variables go through `SystemPlace` itself."""
        raise reader.error(token)
