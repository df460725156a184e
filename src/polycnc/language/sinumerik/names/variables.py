"""User variables: what DEF declares, and where values lie while a program runs (job planning 1.1.5, 1.1.12).

Local variables (LUD, PUD) lie in the list `level.locals`, each in the slot that its declaration has; global
ones (GUD) in a list of their own. An array is an `Array` in its slot, a parameter by reference (VAR) a
`Reference`.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import MAX_STRING, Type
from polycnc.language.sinumerik.runtime import fitting, limited

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.stack import Level


@dataclass(slots=True, eq=False)
class Variable:
    """The declaration of a user variable.

    Attributes:
        name: Upper case.
        type: Data type.
        dims: Sizes of an array's dimensions (0 for an open one of a parameter), empty for a single value.
        length: Greatest length of a STRING.
        low: Lower limit (LLI).
        high: Upper limit (ULI).
        slot: Place among the local variables, or in `store`.
        store: Where a global variable lies; None for a local one.
        by_reference: A VAR parameter: the slot holds a `Reference` to a single value.
        stops: Reading or writing waits for the main run (SYNR, SYNW): letters R and W.
        unit: Physical unit (PHU).
        rights: Access rights by keyword (APRP, APWP, APRB, APWB).
        init_time: INIPO, INIRE, INICF or PRLOC, empty for none.
        first: The value of the definition file, where an init time may bring it back.
        range: NCK for one that all channels share, CHAN or empty for one of its own in each channel.
    """

    name: str
    type: Type
    dims: tuple[int, ...] = ()
    length: int = MAX_STRING
    low: float | None = None
    high: float | None = None
    slot: int = 0
    store: list[Any] | None = None
    by_reference: bool = False
    stops: str = ""
    unit: int = 0
    rights: dict[str, int] = field(default_factory=dict)
    init_time: str = ""
    range: str = ""
    first: Any = None

    @property
    def is_plain(self) -> bool:
        """Whether a value that has the type can be stored without a further check."""
        return self.low is None and self.high is None and self.type is not Type.STRING

    def checked(self, value: Any) -> Any:
        """A value of the type that is to be stored; alarms 12210, 17080, 17090."""
        if self.type is Type.STRING:
            return fitting(value, self.length)
        return limited(value, self.low, self.high, self.name)


class Array:
    """The elements of an array in one list, last index fastest."""

    __slots__ = ("dims", "items", "variable")

    def __init__(self, variable: Variable, items: list[Any], dims: tuple[int, ...] | None = None) -> None:
        self.variable = variable
        self.items = items
        self.dims = variable.dims if dims is None else dims


class Reference:
    """A single value that a subprogram or a procedure may change: a place in a list."""

    __slots__ = ("key", "store", "variable")

    def __init__(self, store: list[Any], key: int, variable: Variable) -> None:
        self.store = store
        self.key = key
        self.variable = variable

    @property
    def value(self) -> Any:
        """The value now."""
        return self.store[self.key]

    @value.setter
    def value(self, value: Any) -> None:
        self.store[self.key] = self.variable.checked(value)


def locals_of(level: Level) -> list[Any]:
    """The local variables of a level, each in its slot; a new list where it has none yet."""
    if not isinstance(level.locals, list):
        level.locals = []
    return level.locals


def define(level: Level, slot: int, value: Any) -> None:
    """Give a local variable of the running level its first value."""
    local = locals_of(level)
    if slot < len(local):
        local[slot] = value
    else:
        local.extend([None] * (slot - len(local)))
        local.append(value)


def element_count(dims: Sequence[int]) -> int:
    """How many elements an array has."""
    count = 1
    for size in dims:
        count *= size
    return count


R_PARAMETER = Variable("R", Type.REAL)
