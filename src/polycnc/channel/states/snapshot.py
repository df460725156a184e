"""A snapshot of a channel, or of a group of channels, between two blocks: restored in place, as often as one likes.

From its root a snapshot follows every reference to objects that can change and notes the contents of each one, not
deep: which objects a list or a field refers to. To restore is to put these contents back into the very same objects.
So whatever refers to them stays right: closures, bound methods, a stage that knows its channel, a second name for one
list. Objects made since are simply no longer referred to. Only the states of
features stay the same objects also then: a cache may have them at hand.

Where it ends is said here and by `unchanging`: values; what is only worked out once and kept (plans, compiled
programs); and what is outside of the channel (its control, its machine, the main run). `UNFOLLOWED` of a class names
fields whose objects belong to another one that does not change. A class whose contents are not to be copied as they
lie has a method `memento`, which gives what brings an object back: a toolpath only grows.

What runs cannot be noted: a generator in flight on the way is a `SnapshotError`.

`contents` goes the same way and gives what it finds as values that can be compared.
"""

from __future__ import annotations

import enum
import re
import types
import weakref
from array import array
from collections import deque
from collections.abc import Sized
from fractions import Fraction
from functools import partial
from pathlib import PurePath
from random import Random

from polycnc.channel.mode import Mode
from polycnc.channel.states.state import State, States
from polycnc.channel.states.unchanging import UNCHANGING
from polycnc.deferred.records import is_frozen
from polycnc.deferred.regexes import Regex
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias
from polycnc.geometry.frames import Frame
from polycnc.machine.model import Machine
from polycnc.machine.setup.values import Parameters, Setup
from polycnc.program import Program
from polycnc.toolpath import Toolpath

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


#: What brings an object back to what it was.
Undo: TypeAlias = "Callable[[], None]"
#: How objects of a class are noted: gives what they refer to, and adds what brings them back.
Walker: TypeAlias = "Callable[[Any, list[Undo]], Iterable[object]]"

_MISSING = object()
#: Classes of objects that never change, or are none of a snapshot's: they are not followed.
_ATOMS: set[type] = {
    type(None), type(_MISSING), type(Ellipsis), bool, int, float, complex, str, bytes, range, slice, memoryview,
    Fraction, re.Pattern, Regex, re.Match, property, classmethod, staticmethod, weakref.ReferenceType,
    types.ModuleType, types.CodeType, types.MappingProxyType, types.MemberDescriptorType,
    types.GetSetDescriptorType, types.WrapperDescriptorType, types.MethodDescriptorType,
}  # fmt: skip
_METHODS = (types.MethodType, types.BuiltinMethodType, types.MethodWrapperType)
_RUNNING = (types.GeneratorType, types.CoroutineType, types.AsyncGeneratorType)
_WALKERS: dict[type, Walker] = {}
UNCHANGING.update((Frame, Mode, Machine, Parameters, Setup, Program, PurePath))


class SnapshotError(Exception):
    """No snapshot can be taken here."""


class Snapshot:
    """The state of a channel, with all that it shares with its group.

    Args:
        root: What is followed: a channel, a group, or what runs them.
        beside: Objects that it leaves alone, with all that only they refer to.

    Raises:
        SnapshotError: Something is running that cannot be noted.
    """

    def __init__(self, root: object, beside: Iterable[object] = ()) -> None:
        self._undo: list[Undo] = []
        self._states: list[tuple[States, frozenset[type[State]]]] = []
        atoms, walkers, undo = _ATOMS, _WALKERS, self._undo
        seen: dict[int, object] = {id(thing): thing for thing in beside}
        ahead: list[object] = [root]
        while ahead:
            thing = ahead.pop()
            cls = type(thing)
            if cls in atoms or id(thing) in seen:
                continue
            seen[id(thing)] = thing
            if isinstance(thing, States):
                self._states.append((thing, frozenset(thing)))
            walker = walkers.get(cls) or _walker_of(cls)
            if walker is not None:
                ahead.extend([each for each in walker(thing, undo) if type(each) not in atoms])

    def restore(self) -> None:
        """Put everything back as it was. The snapshot stays good for another time."""
        for undo in self._undo:
            undo()
        for states, there in self._states:
            states.begin_anew(there)


def contents(root: object) -> list[object]:
    """Everything that a snapshot of `root` would note, as a list that is kept: two are equal where the states are.

    Objects stand for themselves by the order in which they are reached, so what was made anew with the same contents
    is the same.

    Raises:
        SnapshotError: Something is running that cannot be noted.
    """
    numbers: dict[int, tuple[int]] = {}
    reached: list[object] = [root]
    noted: list[object] = []

    def named(thing: object) -> object:
        """A value, or the number of an object."""
        cls = type(thing)
        if cls in _ATOMS or _walker(cls) is None:
            return "nan" if thing != thing else thing
        if id(thing) not in numbers:
            numbers[id(thing)] = (len(reached),)
            reached.append(thing)
        return numbers[id(thing)]

    kept: list[Iterable[object]] = []  # what is made on the way must not give its id to another one
    for thing in reached:
        cls = type(thing)
        if cls in _ATOMS or (walker := _walker(cls)) is None:
            continue
        found = _told(thing) or walker(thing, [])
        kept.append(found)
        noted += (cls, _inner(thing), tuple(map(named, found)))
    return noted


def _told(thing: object) -> list[object]:
    """What a state says itself of what a program can tell apart; nothing where it leaves that to others."""
    if isinstance(thing, State) and type(thing).compared is not State.compared:
        return [thing.compared()]
    return []


def _inner(thing: object) -> object:
    """What an object is beside the objects that it refers to."""
    if isinstance(thing, array | bytearray):
        return thing[:]
    if isinstance(thing, Random):
        return thing.getstate()
    if isinstance(thing, types.FunctionType):
        return thing.__code__
    if isinstance(thing, Toolpath):
        return thing.ways  # events and dwells say what is waited for, not what is done
    if isinstance(thing, Sized) and hasattr(thing, "memento"):
        return len(thing)  # it only grows
    return getattr(thing, "__name__", "") if isinstance(thing, _METHODS) else ""


def _walker(cls: type) -> Walker | None:
    return _WALKERS.get(cls) or _walker_of(cls)


def _walker_of(cls: type) -> Walker | None:
    """How objects of a class are noted, worked out once; None for atoms."""
    if issubclass(cls, _RUNNING):
        return _refuse
    if issubclass(cls, type | enum.Enum) or any(base in UNCHANGING for base in cls.__mro__):
        _ATOMS.add(cls)
        return None
    walker = _OF_BUILTIN.get(cls) or _object_walker(cls)
    _WALKERS[cls] = walker
    return walker


def _refuse(thing: Any, _undo: list[Undo]) -> Iterable[object]:
    raise SnapshotError(f"{thing.__qualname__} is a generator in flight")


# ---- containers ------------------------------------------------------------------------------------------------


def _list(thing: list[object], undo: list[Undo]) -> Iterable[object]:
    contents = thing.copy()
    undo.append(partial(thing.__setitem__, slice(None), contents))
    return contents


def _put_dict(thing: dict[object, object], contents: dict[object, object]) -> None:
    """Contents back into a dict, in their order."""
    thing.clear()
    thing.update(contents)


def _dict(thing: dict[object, object], undo: list[Undo]) -> Iterable[object]:
    contents = thing.copy()
    undo.append(partial(_put_dict, thing, contents))
    return (*contents.keys(), *contents.values())


def _states(thing: States, _undo: list[Undo]) -> Iterable[object]:
    return thing.values()


def _put_set(thing: set[object], contents: set[object]) -> None:
    thing.clear()
    thing.update(contents)


def _set(thing: set[object], undo: list[Undo]) -> Iterable[object]:
    contents = thing.copy()
    undo.append(partial(_put_set, thing, contents))
    return contents


def _put_deque(thing: deque[object], contents: tuple[object, ...]) -> None:
    thing.clear()
    thing.extend(contents)


def _deque(thing: deque[object], undo: list[Undo]) -> Iterable[object]:
    contents = tuple(thing)
    undo.append(partial(_put_deque, thing, contents))
    return contents


def _buffer(thing: Any, undo: list[Undo]) -> Iterable[object]:
    undo.append(partial(thing.__setitem__, slice(None), thing[:]))
    return ()


def _random(thing: Random, undo: list[Undo]) -> Iterable[object]:
    undo.append(partial(thing.setstate, thing.getstate()))
    return ()


def _tuple(thing: Iterable[object], _undo: list[Undo]) -> Iterable[object]:
    return thing


# ---- callables -------------------------------------------------------------------------------------------------


def _function(thing: types.FunctionType, undo: list[Undo]) -> Iterable[object]:
    found: list[object] = [*(thing.__closure__ or ()), *(thing.__defaults__ or ())]
    if thing.__kwdefaults__:
        found += thing.__kwdefaults__.values()
    if thing.__dict__:
        fields = thing.__dict__.copy()
        found += fields.values()
        undo.append(partial(_put_fields, thing.__dict__, fields))
    return found


def _put_cell(cell: types.CellType, contents: object) -> None:
    cell.cell_contents = contents


def _cell(thing: types.CellType, undo: list[Undo]) -> Iterable[object]:
    try:
        contents = thing.cell_contents
    except ValueError:  # not filled yet
        return ()
    undo.append(partial(_put_cell, thing, contents))
    return (contents,)


def _method(thing: Any, _undo: list[Undo]) -> Iterable[object]:
    return (thing.__self__,)


def _partial(thing: partial[object], _undo: list[Undo]) -> Iterable[object]:
    return (thing.func, *thing.args, *thing.keywords.values())


_OF_BUILTIN: dict[type, Walker] = {
    list: _list, dict: _dict, set: _set, deque: _deque, array: _buffer, bytearray: _buffer, Random: _random,
    States: _states,
    tuple: _tuple, frozenset: _tuple, types.FunctionType: _function, types.CellType: _cell,
    types.MethodType: _method, types.BuiltinMethodType: _method, types.MethodWrapperType: _method,
    partial: _partial,
}  # fmt: skip


# ---- objects ---------------------------------------------------------------------------------------------------


def _object_walker(cls: type) -> Walker:
    """How objects of a class of one's own are noted: by `memento`, or slots, `__dict__` and built-in contents."""
    if hasattr(cls, "memento"):
        return _by_memento
    slots = _slots_of(cls)
    names = [slot.__name__ for slot in slots]
    inner = next((_OF_BUILTIN[base] for base in cls.__mro__ if base in _OF_BUILTIN), None)
    has_dict = bool(cls.__dictoffset__)
    if not (slots or has_dict or inner or cls.__module__.startswith("polycnc.")):
        raise SnapshotError(f"what a {cls.__module__}.{cls.__qualname__} holds is not known")
    unfollowed: frozenset[str] = getattr(cls, "UNFOLLOWED", frozenset())
    unchanging = is_frozen(cls)

    def walk(thing: Any, undo: list[Undo]) -> Iterable[object]:
        found: list[object] = list(inner(thing, undo)) if inner is not None else []
        if slots:
            contents = _in_slots(thing, slots)
            found += _followed(zip(names, contents, strict=True), unfollowed) if unfollowed else contents
            if not unchanging:
                undo.append(partial(_put_slots, thing, slots, contents))
        if has_dict:
            fields = thing.__dict__.copy()
            found += _followed(fields.items(), unfollowed) if unfollowed else fields.values()
            if not unchanging:
                undo.append(partial(_put_fields, thing.__dict__, fields))
        return found

    return walk


def _followed(fields: Iterable[tuple[str, object]], unfollowed: frozenset[str]) -> list[object]:
    return [value for name, value in fields if name not in unfollowed]


def _by_memento(thing: Any, undo: list[Undo]) -> Iterable[object]:
    undo.append(thing.memento())
    return ()


def _slots_of(cls: type) -> tuple[types.MemberDescriptorType, ...]:
    found = (value for base in cls.__mro__ for value in vars(base).values())
    slots = (value for value in found if isinstance(value, types.MemberDescriptorType))
    return tuple(slot for slot in slots if slot.__name__ != "__dict__")


def _in_slots(thing: object, slots: tuple[types.MemberDescriptorType, ...]) -> list[object]:
    try:
        return [slot.__get__(thing) for slot in slots]
    except AttributeError:  # one has no value yet
        return [getattr(thing, slot.__name__, _MISSING) for slot in slots]


def _put_slots(thing: object, slots: tuple[types.MemberDescriptorType, ...], contents: list[object]) -> None:
    for slot, value in zip(slots, contents, strict=True):
        if value is not _MISSING:
            slot.__set__(thing, value)
        elif hasattr(thing, slot.__name__):
            slot.__delete__(thing)


def _put_fields(thing: dict[str, object], fields: dict[str, object]) -> None:
    """Contents back into the `__dict__` of an object."""
    thing.update(fields)
    if len(thing) != len(fields):
        for name in thing.keys() - fields.keys():
            del thing[name]
