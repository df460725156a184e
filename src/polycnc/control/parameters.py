"""The parameters of a control: their list (a TOML file), and their values as attributes by mnemonic.

The list says of every parameter its number, name, unit, delivered value and meaning. `parameter_module` writes a module
of two classes from it, one for the parameters of the control and one for those that every axis has. So a handler reads
`parameters.CLR` or `parameters.of("X").DIA`; a name that is not in the list is no attribute, for a type checker too.
A value is looked up in the setup once, and is an attribute of the object from then on.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Generic, Literal, TypeAlias, TypeVar, overload

from polycnc.machine.setup.values import ParameterKey, Parameters, parameter_key

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Self

    from polycnc.machine.setup.values import Value

#: A value that only the machine knows, where the setup does not say it.
MACHINE: Literal["machine"] = "machine"
#: How handlers read a parameter, unless the list says otherwise.
BY_NAME = "by name"


# ---- the list --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class KnownParameter:
    """A parameter of the list.

    Attributes:
        number: Number, with `#bit` for a bit.
        name: Mnemonic of the control, in capitals; where it has none, a name of polycnc's own in small letters.
        texts: Meaning by language.
        unit: Unit of the value, empty for bits and whole numbers.
        delivered: Value that a control has without a setup; None where it depends on the machine.
        by_axis: Every axis has its own value.
        whole: The value is a whole number; as a rule one without a unit is.
        count: How many numbers it takes from `number` on, with a value each.
        read: `by name` as an attribute; `by number` in what several controls share; `not yet` where it is only listed.
    """

    number: str
    name: str
    texts: dict[str, str]
    unit: str
    delivered: float | None
    by_axis: bool
    read: str
    whole: bool
    count: int = 1

    @property
    def key(self) -> ParameterKey:
        """The parameter as setups name it, without an axis."""
        return parameter_key(self.number)

    @property
    def keys(self) -> tuple[ParameterKey, ...]:
        """The parameter as setups name it, and those of the numbers behind it that it takes."""
        first = self.key
        if isinstance(first.id, str):
            return (first,)
        return tuple(first._replace(id=first.id + place) for place in range(self.count))

    @property
    def numbers(self) -> str:
        """Its number, or the first and the last one."""
        return self.number if self.count == 1 else f"{self.number}-{self.keys[-1].id}"

    @property
    def mnemonic(self) -> str:
        """What the control calls it; empty where polycnc alone has given it a name."""
        return self.name if self.name.isupper() else ""


def known_parameters(control: object) -> tuple[KnownParameter, ...]:
    """The parameters of a control, in the order of their numbers; none where polycnc has no list."""
    return load_parameters(getattr(control, "parameter_file", ""))


@cache
def load_parameters(name: str) -> tuple[KnownParameter, ...]:
    """The list in a file of the package `control`; none for an empty name."""
    if not name:
        return ()
    content = files("polycnc.control").joinpath(name).read_text(encoding="utf-8")
    found = []
    for number, entry in tomllib.loads(content).items():
        delivered, unit = entry.get("delivered", 0), entry.get("unit", "")
        found.append(
            KnownParameter(
                number,
                entry["name"],
                {"en": entry["en"], "zh-TW": entry["zh-TW"]},
                unit,
                None if delivered == MACHINE else delivered,
                by_axis=entry.get("axis", False),
                read=entry.get("read", BY_NAME),
                whole=entry.get("whole", not unit),
                count=entry.get("count", 1),
            )
        )
    return tuple(found)


# ---- values by name --------------------------------------------------------------------------------------------

V_co = TypeVar("V_co", covariant=True)
#: The delivered value: one of the same kind, or None where it depends on the machine.
D = TypeVar("D")


class Parameter(Generic[V_co]):
    """A parameter as an attribute of the values; of their class, it is the parameter itself.

    Args:
        number: Number, or name where the control has names.
        bit: Bit of the number; None for the whole value.
    """

    __slots__ = ("key", "name")

    def __init__(self, number: int | str, bit: int | None = None) -> None:
        self.key = ParameterKey(number, bit)
        self.name = ""

    def __set_name__(self, _owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, values: None, owner: type) -> Self: ...
    @overload
    def __get__(self, values: Values, owner: type) -> V_co: ...
    def __get__(self, values: Values | None, owner: type) -> Self | V_co:
        if values is None:
            return self
        # The attribute of the object is found before this one from now on.
        value = values.__dict__[self.name] = self.read(values.given, values.axis)
        return value

    def read(self, given: Parameters, axis: str | None) -> V_co:
        """The value that a setup gives, else the delivered one."""
        raise NotImplementedError


class Bit(Parameter[bool | D]):
    """A bit of a number."""

    __slots__ = ("_bit", "delivered")

    def __init__(self, number: int | str, bit: int, *, delivered: D) -> None:
        super().__init__(number, bit)
        self._bit = bit
        self.delivered = delivered

    def read(self, given: Parameters, axis: str | None) -> bool | D:
        """The bit itself, else that of the whole number, else the delivered one."""
        value = given.bit(self.key.id, self._bit, axis, default=-1)
        return self.delivered if value < 0 else bool(value)


class Whole(Parameter[int | D]):
    """A whole number: a code, the number of an axis, a count."""

    __slots__ = ("delivered",)

    def __init__(self, number: int | str, *, delivered: D) -> None:
        super().__init__(number)
        self.delivered = delivered

    def read(self, given: Parameters, axis: str | None) -> int | D:
        """The value without its fraction, else the delivered one. Text and lists count as not given."""
        value = given.get(self.key.id, axis)
        return int(value) if isinstance(value, int | float) else self.delivered


class Number(Parameter[float | D]):
    """A number with a unit."""

    __slots__ = ("delivered",)

    def __init__(self, number: int | str, *, delivered: D) -> None:
        super().__init__(number)
        self.delivered = delivered

    def read(self, given: Parameters, axis: str | None) -> float | D:
        """The value, else the delivered one. Text and lists count as not given."""
        value = given.get(self.key.id, axis)
        return float(value) if isinstance(value, int | float) else self.delivered


class WholeRun(Parameter[tuple[int | D, ...]]):
    """Whole numbers under numbers that follow each other: one for each axis, or a list."""

    __slots__ = ("_values", "delivered", "numbers")

    def __init__(self, number: int, count: int, *, delivered: D) -> None:
        super().__init__(number)
        self.numbers = range(number, number + count)
        self._values = [Whole(each, delivered=delivered) for each in self.numbers]
        self.delivered = delivered

    def read(self, given: Parameters, axis: str | None) -> tuple[int | D, ...]:
        """The value of each number, else the delivered one."""
        return tuple(value.read(given, axis) for value in self._values)


class AxisParameters:
    """Values of the parameters that an axis has, by their names.

    Args:
        given: What the setup gives.
        axis: Name of the axis.
    """

    def __init__(self, given: Parameters, axis: str) -> None:
        self.given = given
        self.axis: str | None = axis


A_co = TypeVar("A_co", bound=AxisParameters, covariant=True)


class ControlParameters(Parameters, Generic[A_co]):
    """The parameters of a setup, with the values of those that the control knows as attributes. They do not change.

    Attributes:
        axis_class: The class of the parameters of an axis.
    """

    axis_class: type[A_co]
    axis: None = None

    def __init__(self, values: Mapping[ParameterKey, Value] | None = None) -> None:
        super().__init__(values)
        self._of_axis: dict[str, A_co] = {}

    @classmethod
    def naming(cls, given: Parameters) -> Self:
        """The parameters of a setup with their names; the very same ones where they have them already."""
        return given if isinstance(given, cls) else cls(dict(given.items()))

    @property
    def given(self) -> Parameters:
        """What the setup gives."""
        return self

    def of(self, axis: str) -> A_co:
        """The parameters of an axis, by its name."""
        found = self._of_axis.get(axis)
        if found is None:
            found = self._of_axis[axis] = self.axis_class(self, axis)
        return found

    def value(self, parameter: Parameter[V_co]) -> V_co:
        """The value of a parameter that a table names: `value(LatheParameters.CLR)`."""
        return parameter.read(self, None)


#: What has parameters as attributes.
Values: TypeAlias = ControlParameters[AxisParameters] | AxisParameters
