"""`dataclass` as that of the standard library, with methods that are written when they are first called.

The library's own compiles up to seven functions for a class where the class is defined. For the classes of a control
that is more work than a short program, which makes objects of few of them and compares fewer. This one lets the library
find the fields and make the slots, and puts in the place of each method a function that, when it is called, writes the
method and leaves its place to it. `fields`, `replace` and `is_dataclass` of the library work on such classes.

What nothing here uses is left out: `InitVar`, `kw_only`, `order` and `unsafe_hash`.
"""

from __future__ import annotations

import dataclasses
from dataclasses import MISSING, FrozenInstanceError, fields
from reprlib import recursive_repr
from types import FunctionType, MemberDescriptorType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from dataclasses import Field, dataclass
else:

    def dataclass(cls=None, /, *, frozen=False, slots=False, eq=True):
        """A class whose annotated names are its fields; see `dataclasses.dataclass`."""
        if cls is None:
            return lambda cls: _dataclass(cls, frozen=frozen, slots=slots, eq=eq)
        return _dataclass(cls, frozen=frozen, slots=slots, eq=eq)


__all__ = ["dataclass", "is_frozen"]
#: What a parameter holds whose value comes from a `default_factory`.
_LATER = object()


def is_frozen(cls: type) -> bool:
    """Whether fields of objects of a dataclass never change; False for other classes."""
    return getattr(cls, "__frozen__", False)


def _dataclass(cls: type, *, frozen: bool, slots: bool, eq: bool) -> type:
    if frozen and slots:  # what pickle would otherwise set by `setattr`
        _add(cls, "__getstate__", _state)
        _add(cls, "__setstate__", _put_state)
    is_hashed = cls.__dict__.get("__hash__") is not None
    cls.__doc__ = cls.__doc__ or cls.__name__  # else the library would write down its signature
    cls = dataclasses.dataclass(init=False, repr=False, eq=False, slots=slots)(cls)
    if slots:
        _lead_super(cls)
    cls.__frozen__ = frozen  # type: ignore[attr-defined]
    _add(cls, "__init__", _written_later(cls, "__init__", lambda: _init(cls, frozen=frozen, slots=slots)))
    _add(cls, "__repr__", _repr)
    if eq:
        _add(cls, "__eq__", _written_later(cls, "__eq__", lambda: _eq(cls)))
        if frozen and not is_hashed:
            cls.__hash__ = _written_later(cls, "__hash__", lambda: _hash(cls))  # type: ignore[method-assign]
        elif not is_hashed:
            cls.__hash__ = None  # type: ignore[assignment]
    if frozen:
        cls.__setattr__, cls.__delattr__ = _refusals(cls)  # type: ignore[method-assign]
    return cls


def _add(cls: type, name: str, method: Callable[..., Any]) -> None:
    """A method, unless the class has its own."""
    if name not in cls.__dict__:
        setattr(cls, name, method)


def _lead_super(cls: type) -> None:
    """Let `super()` in the methods mean the class that has slots, not the one whose body was read."""
    for member in cls.__dict__.values():
        function = getattr(
            member, "__func__", getattr(member, "fget", member)
        )  # of a classmethod, a property
        free = function.__code__.co_freevars if isinstance(function, FunctionType) else ()
        if "__class__" in free:  # a cell that all methods share
            function.__closure__[free.index("__class__")].cell_contents = cls
            return


# ---- methods that are written ----------------------------------------------------------------------------------


def _written_later(cls: type, name: str, write: Callable[[], Callable[..., Any]]) -> Callable[..., Any]:
    """What stands in the place of a method until it is first called."""

    def first_call(self: object, *args: object, **named: object) -> object:
        method = write()
        setattr(cls, name, method)
        return method(self, *args, **named)

    return first_call


def _written(cls: type, head: str, body: Iterator[str], names: dict[str, Any]) -> Callable[..., Any]:
    """The method with this head and body; `names` are values that the body uses."""
    name = head.partition("(")[0]
    lines = [f"def {head}:", *body]
    exec("\n ".join(lines), names)  # the text comes from names of fields
    method: Callable[..., Any] = names[name]
    method.__qualname__ = f"{cls.__qualname__}.{name}"
    return method


def _init(cls: type, *, frozen: bool, slots: bool) -> Callable[..., Any]:
    parameters, values, names = ["self"], {}, {"_LATER": _LATER, "_set": object.__setattr__}
    for each in fields(cls):
        names[f"_default_{each.name}"] = _default(each)
        parameter, value = _parameter_and_value(each, slots=slots)
        if parameter:
            parameters.append(parameter)
        if value:
            values[each.name] = value

    def body() -> Iterator[str]:
        for name, value in values.items():
            slot = getattr(cls, name, None)
            if not frozen:
                yield f"self.{name} = {value}"
            elif isinstance(slot, MemberDescriptorType):
                names[f"_set_{name}"] = slot.__set__
                yield f"_set_{name}(self, {value})"
            else:
                yield f"_set(self, {name!r}, {value})"
        yield "self.__post_init__()" if hasattr(cls, "__post_init__") else "pass"

    return _written(cls, f"__init__({', '.join(parameters)})", body(), names)


def _default(each: Field[Any]) -> object:
    return each.default if each.default_factory is MISSING else each.default_factory


def _parameter_and_value(each: Field[Any], *, slots: bool) -> tuple[str, str]:
    """How `__init__` declares a field and what it puts into it; empty where it does not."""
    name, default = each.name, f"_default_{each.name}"
    if each.default_factory is not MISSING:
        if not each.init:
            return "", f"{default}()"
        return f"{name}=_LATER", f"{default}() if {name} is _LATER else {name}"
    if each.init:
        return (name if each.default is MISSING else f"{name}={default}"), name
    # Without slots the class itself has the default.
    return "", default if slots and each.default is not MISSING else ""


def _eq(cls: type) -> Callable[..., Any]:
    compared = [each.name for each in fields(cls) if each.compare]

    def body() -> Iterator[str]:
        yield "if other.__class__ is self.__class__:"
        yield f" return {_tuple_of('self', compared)} == {_tuple_of('other', compared)}"
        yield "return NotImplemented"

    return _written(cls, "__eq__(self, other)", body(), {})


def _hash(cls: type) -> Callable[..., Any]:
    hashed = [each.name for each in fields(cls) if (each.compare if each.hash is None else each.hash)]
    return _written(cls, "__hash__(self)", iter([f"return hash({_tuple_of('self', hashed)})"]), {})


def _tuple_of(thing: str, names: list[str]) -> str:
    return f"({''.join(f'{thing}.{name}, ' for name in names)})"


# ---- methods that all have -------------------------------------------------------------------------------------


@recursive_repr()
def _repr(self: Any) -> str:
    shown = ", ".join(f"{each.name}={getattr(self, each.name)!r}" for each in fields(self) if each.repr)
    return f"{type(self).__qualname__}({shown})"


def _state(self: Any) -> list[object]:
    return [getattr(self, each.name) for each in fields(self)]


def _put_state(self: Any, state: list[object]) -> None:
    for each, value in zip(fields(self), state, strict=True):
        object.__setattr__(self, each.name, value)


def _refusals(cls: Any) -> tuple[Callable[..., None], Callable[..., None]]:
    """`__setattr__` and `__delattr__` of a frozen class; a class that inherits from it may have more attributes."""
    names = frozenset(each.name for each in fields(cls))

    def set_attribute(self: object, name: str, value: object) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def delete_attribute(self: object, name: str) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return set_attribute, delete_attribute
