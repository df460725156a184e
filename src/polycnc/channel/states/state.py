"""State that features own, with its lifetime: what a reset, the end of a program or power-on bring back.

A feature declares its state beside its handlers, and says how long it lives:

    @dataclass(slots=True)
    class PolarState(State, lifetime=Lifetime.RESET):
        plane: PolarPlane | None = None
        entries: int = lasting(Lifetime.POWER, 0)  # one field that lives longer than the others

    PolarState.of(channel).plane = ...

A field that is to last beyond power-off is a table of the channel's retained memory:

    offsets: dict[int, ToolOffset] = retained(TOOL_OFFSETS)

A channel has one object of every class, made when somebody first asks for it and never replaced: `end_of` puts first
values back into it. So a handler that runs for every block may keep the object at hand. First values that depend on
the channel (one number for each axis) come from `first`.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, overload

from polycnc.deferred.records import MISSING, dataclass, field, fields, is_dataclass
from polycnc.machine.setup.values import Parameters

if TYPE_CHECKING:
    from collections.abc import Callable, Collection
    from typing import Self

    from polycnc.channel.channel import Channel

_T = TypeVar("_T")
_LIFETIME, _TABLE = "lifetime", "table"


class Lifetime(IntEnum):
    """How long a value lives: up to the named event. Each event ends the shorter lifetimes as well."""

    BLOCK = 1
    """To the end of the block. A control that has such says itself when that is: no event comes after every block."""
    PROGRAM = 2
    """To the end of the program, or the start of another one."""
    RESET = 3
    """To a reset, by its key or where the control's end of program (M02, M30) is one."""
    POWER = 4
    """As long as the power is on."""
    RETAINED = 5
    """For ever. Such fields are tables of the channel's retained memory; see `retained`."""


@overload
def lasting(lifetime: Lifetime, default: _T) -> _T: ...
@overload
def lasting(lifetime: Lifetime, *, factory: Callable[[], _T]) -> _T: ...
def lasting(lifetime: Lifetime, default: Any = MISSING, *, factory: Any = MISSING) -> Any:
    """A field of a `State` whose lifetime is not that of the class. What outlives the power is `retained`."""
    if lifetime is Lifetime.RETAINED:
        raise ValueError("a field that is retained is a table")
    metadata = {_LIFETIME: lifetime}
    if factory is not MISSING:
        return field(default_factory=factory, metadata=metadata)
    return field(default=default, metadata=metadata)


@dataclass(frozen=True, slots=True)
class Table:
    """Which table of retained memory a field is: by name, of the channel or of the whole control."""

    name: str
    of_control: bool = False

    def of(self, channel: Channel) -> dict[Any, Any]:
        """The table, for a channel."""
        return channel.retained.table(self.name, 0 if self.of_control else channel.number)


def retained(table: str, *, of_control: bool = False) -> Any:
    """A field of a `State` that is a table of retained memory: of the channel, or of the whole control."""
    return field(metadata={_LIFETIME: Lifetime.RETAINED, _TABLE: Table(table, of_control)})


class State:
    """Base of the states of features; each is a dataclass whose fields all have defaults, unless it has a `first`.

    Class keywords:
        lifetime: How long its fields live, where a field does not say otherwise by `lasting`.
    """

    __slots__ = ()
    #: Every class of states by its full name.
    CLASSES: ClassVar[dict[str, type[State]]] = {}
    lifetime: ClassVar[Lifetime]

    def __init_subclass__(cls, *, lifetime: Lifetime | None = None) -> None:
        if lifetime is not None:
            cls.lifetime = lifetime
        # Where a dataclass with slots is made twice, the second class counts, and has the lifetime of the first.
        State.CLASSES[f"{cls.__module__}.{cls.__qualname__}"] = cls

    @classmethod
    def of(cls, channel: Channel) -> Self:
        """The one of a channel."""
        state = channel.states.get(cls)
        if state is None:
            state = channel.states.make(cls)
        return state  # type: ignore[return-value]  # the key says the class

    @classmethod
    def first(cls, channel: Channel) -> Self:
        """One with the values that it begins with."""
        return cls(**{name: table.of(channel) for name, table in tables(cls).items()})

    def compared(self) -> object:
        """The fields as plain values, as far as a program can tell them apart."""
        return plain(self)

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """An event has come: fields that lived up to it begin anew. A feature adds what hangs on parameters."""
        cls = type(self)
        ended = [name for name, lives in lifetimes(cls).items() if lives <= lifetime]
        if ended:
            fresh = cls.first(channel)
            for name in ended:
                setattr(self, name, getattr(fresh, name))


class States(dict[type[State], State]):
    """The states of a channel: one object of a class, made when it is first asked for, and never another one."""

    def __init__(self, channel: Channel) -> None:
        super().__init__()
        self._channel = channel

    def make(self, cls: type[State]) -> State:
        """The state of a class that there is none of, with its first values."""
        state = self[cls] = cls.first(self._channel)
        return state

    def begin_anew(self, others: frozenset[type[State]]) -> None:
        """All but `others` begin anew, as the same objects: what was worked out meanwhile may hold them."""
        channel = self._channel
        if channel.memory is None:
            # Before power-on there is nothing that first values could be taken from, so nothing may hold them.
            channel.modes.forget_plans()
            for cls in self.keys() - others:
                del self[cls]
            return
        for cls, state in self.items():
            if cls not in others:
                fresh = cls.first(channel)
                for each in fields(fresh):  # type: ignore[arg-type]  # every state is a dataclass
                    setattr(state, each.name, getattr(fresh, each.name))


def lifetimes(cls: type[State]) -> dict[str, Lifetime]:
    """The lifetime of every field of a class."""
    return {each.name: each.metadata.get(_LIFETIME, cls.lifetime) for each in fields(cls)}  # type: ignore[arg-type]


def tables(cls: type[State]) -> dict[str, Table]:
    """Which table every retained field of a class is."""
    named = {each.name: each.metadata.get(_TABLE) for each in fields(cls)}  # type: ignore[arg-type]
    return {name: table for name, table in named.items() if table is not None}


def end_of(channel: Channel, lifetime: Lifetime, kept: Collection[type[State]] = ()) -> None:
    """An event has come (end of block, end or start of a program, reset, power-on): what lived up to it begins anew.

    Args:
        channel: The channel.
        lifetime: The longest lifetime that the event ends.
        kept: Classes that it does not concern this time, because a parameter of the control says so.
    """
    for cls, state in list(channel.states.items()):  # first values may ask for further states
        if cls not in kept:
            state.end(channel, lifetime)


# ---- comparing -------------------------------------------------------------------------------------------------


def plain_states(channel: Channel) -> dict[str, Any]:
    """Every state of a channel that is not as it began, as plain values that can be kept and compared."""
    found = {
        cls.__qualname__: (state.compared(), cls.first(channel).compared())
        for cls, state in channel.states.items()
    }
    return {name: now for name, (now, first) in found.items() if now != first}


def plain_tables(channel: Channel) -> dict[str, object]:
    """The tables of retained memory that states of a channel have, as plain values."""
    return {
        f"{cls.__qualname__}.{name}": plain(getattr(state, name))
        for cls, state in channel.states.items()
        for name in tables(cls)
    }


def plain(value: object) -> object:
    """A value as nested tuples that can be kept and compared; of what is no data only the kind.

    Fields that a snapshot does not follow are none of the value.
    """
    if value is None or isinstance(value, str | bytes | int | float | complex):
        return value
    if isinstance(value, Mapping | Parameters):
        return tuple((plain(key), plain(element)) for key, element in value.items())
    if isinstance(value, list | tuple):
        return tuple(map(plain, value))
    if isinstance(value, set | frozenset):
        return tuple(sorted(map(repr, value)))
    if is_dataclass(value) and not isinstance(value, type):
        others: Collection[str] = getattr(value, "UNFOLLOWED", ())
        return tuple(plain(getattr(value, each.name)) for each in fields(value) if each.name not in others)
    return type(value).__name__
