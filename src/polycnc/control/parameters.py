"""The parameters of a control: their list (TOML files), and their values as attributes by mnemonic.

The list says of every parameter its number, name, unit, delivered value and meaning. `parameter_module` writes a module
of two classes from it, one for the parameters of the control and one for those that every axis has. So a handler reads
`parameters.CLR` or `parameters.of("X").DIA`; a name that is not in the list is no attribute, for a type checker too.
A value is looked up in the setup once, and is an attribute of the object from then on. What several controls read has
one name in the lists of all; `word_address/parameters.py` says which these are.
"""

from __future__ import annotations

from functools import cache, cached_property

from polycnc.deferred.paths import package_path, read_text
from polycnc.deferred.records import dataclass
from polycnc.deferred.toml import loads
from polycnc.deferred.typing import TYPE_CHECKING, Generic, Literal, TypeAlias, TypeVar, overload
from polycnc.machine.setup.values import ParameterKey, Parameters, parameter_key

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.interface import Control
    from polycnc.deferred.typing import Self
    from polycnc.machine.setup.values import Value

#: A value that only the machine knows, where the setup does not say it.
MACHINE: Literal["machine"] = "machine"
#: How many bits a number has.
_BITS = 8
#: How handlers read a parameter, unless the list says otherwise.
BY_NAME = "by name"
#: Nothing acts on it; programs may read it.
NOT_YET = "not yet"


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
        count: How many numbers it takes from `number` on, with a value each; `step` lies between two of them.
        read: How handlers read it, `BY_NAME`; `NOT_YET` where it is only kept.
        has_bits: A mask: setups may also name single bits of it.
    """

    number: str
    name: str
    texts: dict[str, str]
    unit: str
    delivered: float | str | None
    by_axis: bool
    read: str
    whole: bool
    count: int = 1
    step: int = 1
    has_bits: bool = False

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
        return tuple(first._replace(id=first.id + self.step * place) for place in range(self.count))

    @property
    def numbers(self) -> str:
        """Its number, or the first and the last one."""
        return self.number if self.count == 1 else f"{self.number}-{self.keys[-1].id}"

    @property
    def mnemonic(self) -> str:
        """What the control calls it; empty where polycnc alone has given it a name."""
        return self.name if self.name.isupper() else ""

    @property
    def ids(self) -> set[int | str]:
        """Its numbers, and its name where setups may use that: data of SINUMERIK have identifiers."""
        return {key.id for key in self.keys} | ({self.name} if self.name.startswith("$") else set())


def known_parameters(control: Control) -> tuple[KnownParameter, ...]:
    """The parameters of a control, in the order of their numbers."""
    return load_parameters(*control.parameter_files)


def unheeded(control: Control, given: Parameters) -> dict[ParameterKey, bool]:
    """What a setup gives and the control does not act on: true for what is known, and kept for programs to read.

    A whole number is known by one of its bits.
    """
    if not given:
        return {}
    known = known_parameters(control)
    keys = {(id_, each.key.bit): each for each in known for id_ in each.ids}
    numbers, whole = {number for number, _ in keys}, {number for number, bit in keys if bit is None}
    found = {}
    for key in given:
        of_list = keys.get((key.id, key.bit)) or keys.get((key.id, None))
        is_known = key.id in numbers and (key.bit is None or of_list is not None or key.id in whole)
        if not is_known:
            found[key] = False
        elif of_list is not None and of_list.read == NOT_YET:
            found[key] = True
    return found


@cache
def load_parameters(*names: str) -> tuple[KnownParameter, ...]:
    """The list in files of the package `control`, in the order of the numbers; of two entries the later counts."""
    found = {}
    for name in names:
        for number, entry in loads(read_text(package_path("control", name))).items():
            delivered, unit = entry.get("delivered", 0), entry.get("unit", "")
            found[number] = KnownParameter(
                number,
                entry["name"],
                {"en": entry["en"], "zh-TW": entry["zh-TW"]},
                unit,
                None if delivered == MACHINE else delivered,
                by_axis=entry.get("axis", False),
                read=entry.get("read", BY_NAME),
                whole=entry.get("whole", not unit),
                count=entry.get("count", 1),
                step=entry.get("step", 1),
                has_bits=entry.get("mask", False),
            )
    return tuple(sorted(found.values(), key=_place))


def _place(parameter: KnownParameter) -> tuple[str, int]:
    """Where a parameter stands in its list."""
    key = parameter.key
    return str(key.id).zfill(6), -1 if key.bit is None else key.bit


# ---- values by name --------------------------------------------------------------------------------------------

V_co = TypeVar("V_co", covariant=True)
#: The delivered value: one of the same kind, or None where it depends on the machine.
D = TypeVar("D")


class Parameter(Generic[V_co]):
    """A parameter as an attribute of the values; of their class, it is the parameter itself.

    Args:
        number: Number, or name where the control has names.
        bit: Bit of the number; None for the whole value.
        delivered: Value of a control without a setup.
    """

    __slots__ = ("delivered", "key", "name")

    def __init__(self, number: int | str, bit: int | None = None, *, delivered: V_co) -> None:
        self.key = ParameterKey(number, bit)
        self.delivered = delivered
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

    @property
    def keys(self) -> tuple[ParameterKey, ...]:
        """What setups call it; several where it takes several numbers."""
        return (self.key,)


class Constant(Parameter[V_co]):
    """What another control has a parameter for, and this one has not: its value never changes."""

    __slots__ = ()

    def __init__(self, value: V_co) -> None:
        super().__init__("", delivered=value)

    def read(self, _given: Parameters, _axis: str | None) -> V_co:
        """The value."""
        return self.delivered

    @property
    def keys(self) -> tuple[ParameterKey, ...]:
        """Setups have no name for it."""
        return ()


class Bit(Parameter[bool | D]):
    """A bit of a number."""

    __slots__ = ("_bit",)

    def __init__(self, number: int | str, bit: int, *, delivered: D) -> None:
        super().__init__(number, bit, delivered=delivered)
        self._bit = bit

    def read(self, given: Parameters, axis: str | None) -> bool | D:
        """The bit itself, else that of the whole number, else the delivered one."""
        value = given.bit(self.key.id, self._bit, axis, default=-1)
        return self.delivered if value < 0 else bool(value)


class Whole(Parameter[int | D]):
    """A whole number: a code, the number of an axis, a count."""

    __slots__ = ()

    def __init__(self, number: int | str, *, delivered: D) -> None:
        super().__init__(number, delivered=delivered)

    def read(self, given: Parameters, axis: str | None) -> int | D:
        """The value without its fraction, else the delivered one. Text and lists count as not given."""
        value = given.get(self.key.id, axis)
        return int(value) if isinstance(value, int | float) else self.delivered


class Number(Parameter[float | D]):
    """A number with a unit."""

    __slots__ = ()

    def __init__(self, number: int | str, *, delivered: D) -> None:
        super().__init__(number, delivered=delivered)

    def read(self, given: Parameters, axis: str | None) -> float | D:
        """The value, else the delivered one. Text and lists count as not given."""
        value = given.get(self.key.id, axis)
        return float(value) if isinstance(value, int | float) else self.delivered


class WholeRun(Parameter[tuple[int | D, ...]]):
    """Whole numbers under several numbers, `step` apart: one for each axis, or a list."""

    __slots__ = ("_values", "numbers")

    def __init__(self, number: int, count: int, *, step: int = 1, delivered: D) -> None:
        super().__init__(number, delivered=(delivered,) * count)
        self.numbers = range(number, number + step * count, step)
        self._values = [Whole(each, delivered=delivered) for each in self.numbers]

    def read(self, given: Parameters, axis: str | None) -> tuple[int | D, ...]:
        """The value of each number, else the delivered one."""
        return tuple(value.read(given, axis) for value in self._values)

    @property
    def keys(self) -> tuple[ParameterKey, ...]:
        """Each of its numbers."""
        return tuple(value.key for value in self._values)


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

    @cached_property
    def delivered(self) -> dict[ParameterKey, float]:
        """The delivered value of every number and bit that has one; the machine says the others."""
        found: dict[ParameterKey, float] = {}
        for of in (type(self), self.axis_class):
            # What a class itself has of them, not their values.
            named = {name: each for base in reversed(of.__mro__) for name, each in vars(base).items()}
            for _, parameter in sorted(named.items()):
                if isinstance(parameter, Parameter):
                    each = parameter.delivered
                    pairs = zip(parameter.keys, each if isinstance(each, tuple) else (each,), strict=False)
                    found |= {key: float(value) for key, value in pairs if value is not None}
        return found

    def at(self, number: int, bit: int | None = None, axis: str | None = None) -> float | None:
        """The value under a number as macros read it, with what is delivered; None for no number of the control.

        A number that is known by its bits alone is made up of them.
        """
        delivered = self.delivered
        if bit is not None:
            found = self.bit(number, bit, axis, default=int(delivered.get(ParameterKey(number, bit), -1)))
            return None if found < 0 else float(found)
        value = self.get(number, axis)
        if isinstance(value, int | float):
            return float(value)
        bits = {place: self.at(number, place, axis) for place in range(_BITS)}
        if any(found is not None for found in bits.values()):
            return float(sum(1 << place for place, found in bits.items() if found))
        return delivered.get(ParameterKey(number))

    def value(self, parameter: Parameter[V_co]) -> V_co:
        """The value of a parameter that a table names: `value(LatheParameters.CLR)`."""
        return parameter.read(self, None)


#: What has parameters as attributes.
Values: TypeAlias = ControlParameters[AxisParameters] | AxisParameters
