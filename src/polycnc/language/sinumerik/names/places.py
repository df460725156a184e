"""Places of values: variables, elements, characters, components, R parameters, system variables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

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

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Add the statement that stores a value of the place's type."""

    def reference(self, reader: ExpressionReader) -> str:
        """Code of the `Reference` or `Array` that a VAR parameter gets."""

    def stored(self, reader: ExpressionReader, code: str) -> str:
        """Code of a value as it is kept: in metric units, within its limits."""

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[str, str]:
        """Code of the list and of the index at which SET and REP begin; 12080 for a single value."""


def _read(variable: Variable | None, code: str, type_: Type) -> Expr:
    """A kept value as the program reads it."""
    factor = units.FACTORS.get(variable.unit) if variable is not None else None
    if factor is None:
        return Expr(code, type_)
    read = f"shown(channel, {code}, {factor})"
    return Expr(f"round_half_up({read})" if type_ is Type.INT else read, type_)


def _stored(reader: ExpressionReader, variable: Variable | None, code: str) -> str:
    """A value of the program as it is kept: in metric units, within the limits of its variable."""
    if variable is None:
        return code
    factor = units.FACTORS.get(variable.unit)
    if factor is not None:
        code = f"kept(channel, {code}, {factor})"
    return code if variable.is_plain else f"{reader.emitter.object(variable)}.checked({code})"


def checked_index(reader: ExpressionReader, code: str, size: str, name: str, dimension: int = 1) -> str:
    """Code of an index that must be within a dimension."""
    first, again = reader.emitter.twice(code)
    return f"({again} if 0 <= {first} < {size} else out_of_range({name!r}, {dimension}, {again}))"


class SinglePlace:
    """A variable that is no array."""

    def __init__(self, variable: Variable, container: str) -> None:
        self.variable = variable
        self.type = variable.type
        self.container = container
        self.code = f"{container}[{variable.slot}]"

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the value."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.READ)
        if self.variable.by_reference:
            return Expr(self.code + ".value", self.type)
        return _read(self.variable, self.code, self.type)

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Store; a parameter by reference checks by the rules of the caller's variable."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        if self.variable.by_reference:
            reader.emitter.line(f"{self.code}.value = {code}")
        else:
            reader.emitter.line(f"{self.code} = {self.stored(reader, code)}")

    def stored(self, reader: ExpressionReader, code: str) -> str:
        """Code of a value as it is kept."""
        return _stored(reader, self.variable, code)

    def reference(self, reader: ExpressionReader) -> str:
        """A reference; one that came from further out is handed on."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        if self.variable.by_reference:
            return self.code
        return f"Reference({self.container}, {self.variable.slot}, {reader.emitter.object(self.variable)})"

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[str, str]:
        """A single value has none."""
        raise reader.error(token)


class ElementPlace:
    """An element of an array, or the whole array where no index is written."""

    def __init__(self, variable: Variable, container: str, offset: str) -> None:
        self.variable = variable
        self.type = variable.type
        self.array = f"{container}[{variable.slot}]"
        self.offset = offset
        self.code = f"{self.array}.items[{offset}]"

    @classmethod
    def read_indices(
        cls, reader: ExpressionReader, token: Token, variable: Variable, container: str
    ) -> Place:
        """The element whose indices come next; a further index of a STRING is a character of it."""
        array = f"{container}[{variable.slot}]"
        if not reader.accept("["):
            return cls(variable, container, "")
        offset = ""
        for dimension, size in enumerate(variable.dims):
            if dimension:
                reader.expect(",")
            extent = str(size) if size else f"{array}.dims[{dimension}]"
            index = checked_index(reader, reader.value(Type.INT), extent, variable.name, dimension + 1)
            offset = f"{offset} * {extent} + {index}" if offset else index
            if dimension + 1 < len(variable.dims):
                offset = f"({offset})" if dimension else offset
            if reader.at("]") and dimension + 1 < len(variable.dims):
                raise NcSyntaxError("12400", token.column, token.text)
        element = cls(variable, container, offset)
        if variable.type is Type.STRING and reader.at(","):
            return CharPlace.read_index(reader, element)
        if variable.type is Type.FRAME and reader.at(","):
            return ComponentPlace.read_index(reader, element)
        if reader.at(","):
            raise NcSyntaxError("12400", token.column, token.text)
        reader.expect("]")
        return element

    def _need_index(self) -> None:
        if not self.offset:
            raise NcSyntaxError("12400", 0, self.variable.name)

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the element."""
        self._need_index()
        rights.check(reader, self.variable.name, self.variable.rights, rights.READ)
        return _read(self.variable, self.code, self.type)

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Store the element."""
        self._need_index()
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        reader.emitter.line(f"{self.code} = {self.stored(reader, code)}")

    def stored(self, reader: ExpressionReader, code: str) -> str:
        """Code of a value as it is kept."""
        return _stored(reader, self.variable, code)

    def reference(self, reader: ExpressionReader) -> str:
        """The array itself, or a reference to one element."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        if not self.offset:
            return self.array
        return f"Reference({self.array}.items, {self.offset}, {reader.emitter.object(self.variable)})"

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[str, str]:  # noqa: ARG002
        """From this element on."""
        rights.check(reader, self.variable.name, self.variable.rights, rights.WRITE)
        return f"{self.array}.items", self.offset or "0"


class _PartPlace:
    """A part of a value that is read and replaced as a whole."""

    type: Type

    def __init__(self, base: SinglePlace | ElementPlace) -> None:
        self.base = base

    def stored(self, reader: ExpressionReader, code: str) -> str:  # noqa: ARG002
        """Parts have neither limits nor units."""
        return code

    def reference(self, reader: ExpressionReader) -> str:
        """Parts of values cannot be handed over by reference (1.9.8)."""
        raise reader.error()

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[str, str]:
        """A part is a single value."""
        raise reader.error(token)


class CharPlace(_PartPlace):
    """One character of a STRING (1.9.8)."""

    type = Type.CHAR

    def __init__(self, base: SinglePlace | ElementPlace, index: str) -> None:
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
        return Expr(f"char_at({self.base.read(reader).code}, {self.index})", Type.CHAR)

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Replace the character."""
        self.base.write(reader, f"with_char({self.base.read(reader).code}, {self.index}, {code})")


class ComponentPlace(_PartPlace):
    """One component of a FRAME variable: `FRM[X,TR]` (5.2.2)."""

    type = Type.REAL

    def __init__(self, base: SinglePlace | ElementPlace, axis: str, component: str) -> None:
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
        return Expr(
            f"frame_component({self.base.read(reader).code}, {self.axis}, {self.component!r})", Type.REAL
        )

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Replace the component."""
        frame = self.base.read(reader).code
        self.base.write(reader, f"with_component({frame}, {self.axis}, {self.component!r}, {code})")


class RPlace:
    """An R parameter: `R10`, `R[expression]`, `$R10` (the same memory, 1.1.3)."""

    type = Type.REAL

    def __init__(self, values: str, index: str) -> None:
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
        return cls(reader.emitter.object(values), str(token.value))

    @classmethod
    def indexed(cls, reader: ExpressionReader, token: Token) -> RPlace:  # noqa: ARG003
        """`R[expression]`."""
        reader.expect("[")
        index = reader.value(Type.INT)
        reader.expect("]")
        values = reader.scope.memory.r
        return cls(reader.emitter.object(values), checked_index(reader, index, str(len(values)), "R"))

    def read(self, reader: ExpressionReader) -> Expr:
        """Code of the parameter."""
        rights.check(reader, "R", reader.scope.memory.rights.get("R", {}), rights.READ)
        return _read(reader.scope.memory.user_data.get("R"), f"{self.values}[{self.index}]", Type.REAL)

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Store the parameter."""
        rights.check(reader, "R", reader.scope.memory.rights.get("R", {}), rights.WRITE)
        reader.emitter.line(f"{self.values}[{self.index}] = {self.stored(reader, code)}")

    def stored(self, reader: ExpressionReader, code: str) -> str:
        """Code of a value as it is kept."""
        return _stored(reader, reader.scope.memory.user_data.get("R"), code)

    def reference(self, reader: ExpressionReader) -> str:
        """A reference to the parameter."""
        return f"Reference({self.values}, {self.index}, {reader.emitter.object(R_PARAMETER)})"

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[str, str]:  # noqa: ARG002
        """R parameters are an array of one dimension."""
        rights.check(reader, "R", reader.scope.memory.rights.get("R", {}), rights.WRITE)
        return self.values, self.index


class SystemPlace:
    """A system variable with its indices."""

    def __init__(self, name: str, variable: SystemVariable, code: str, indices: str, type_: Type) -> None:
        self.name = name
        self.variable = variable
        self.code = code
        self.indices = indices
        self.type = type_

    @classmethod
    def read_indices(cls, reader: ExpressionReader, token: Token, variable: SystemVariable) -> SystemPlace:
        """The variable with the indices that come next; a frame with a component is a REAL."""
        codes: list[str] = []
        type_ = variable.type
        if reader.accept("["):
            while not reader.at("]"):
                if codes:
                    reader.expect(",")
                if reader.token.text in keywords.FRAME_COMPONENTS and reader.token.kind == "name":
                    codes.append(repr(reader.take().text))
                    type_ = Type.REAL
                else:
                    index = reader.expression()
                    real = index.type is Type.REAL
                    codes.append(f"round_half_up({index.code})" if real else index.code)
            reader.expect("]")
        if variable.stop:
            reader.emitter.uses_stop = True
        indices = f"({''.join(code + ', ' for code in codes)})"
        return cls(token.text, variable, reader.emitter.object(variable), indices, type_)

    def read(self, reader: ExpressionReader) -> Expr:
        """Code that asks the control."""
        rights.check(reader, self.name, reader.scope.memory.rights.get(self.name, {}), rights.READ)
        return _read(self._user_data(reader), f"{self.code}.read(channel, {self.indices})", self.type)

    def write(self, reader: ExpressionReader, code: str) -> None:
        """Code that tells the control."""
        rights.check(reader, self.name, reader.scope.memory.rights.get(self.name, {}), rights.WRITE)
        reader.emitter.acts = True
        reader.emitter.line(f"{self.code}.write(channel, {self.indices}, {self.stored(reader, code)})")

    def stored(self, reader: ExpressionReader, code: str) -> str:
        """Code of a value as it is kept."""
        return _stored(reader, self._user_data(reader), code)

    def _user_data(self, reader: ExpressionReader) -> Variable | None:
        """What REDEF has said of the variable."""
        data = reader.scope.memory.user_data.get(self.name)
        if data is not None and data.stops:
            reader.emitter.uses_stop = True
        return data

    def reference(self, reader: ExpressionReader) -> str:
        """System variables cannot be handed over by reference."""
        raise NcSyntaxError("12320", reader.token.column, reader.token.text)

    def elements(self, reader: ExpressionReader, token: Token) -> tuple[str, str]:
        """SET and REP of system variables go through `SystemPlace` itself."""
        raise reader.error(token)
