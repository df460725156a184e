"""`NamedTuple` as that of `typing`, without the text that the library compiles for every class.

`typing` compiles the annotation of every field, and `collections.namedtuple` the method `__new__`: a tenth of a
millisecond for a class, of which a control has many and a short program uses few. Here annotations stay texts, all
classes share their methods, and a `__new__` is written for those that make many objects.

What nothing here uses is left out: named tuples that are generic.
"""

from __future__ import annotations

from collections import namedtuple

from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import NamedTuple

__all__ = ["NamedTuple", "written"]
#: What gives the value at a place of a tuple.
_getter_at: Any = type(vars(namedtuple("_Pair", "left right"))["left"])  # noqa: PYI024
#: So many objects of a class are made before a `__new__` is written for it.
_FEW = 32


class _Maker(type):
    """Makes a class of tuples of a class statement that names `NamedTuple` as its base."""

    def __new__(cls, name: str, bases: tuple[type, ...], body: dict[str, Any]) -> Any:
        if not bases:
            return super().__new__(cls, name, bases, body)
        names = tuple(body.get("__annotations__", ()))
        members: dict[str, Any] = {each: _getter_at(number, each) for number, each in enumerate(names)}
        defaults = {each: body[each] for each in names if each in body}
        if len(bases) > 1 or "__new__" in body:
            raise TypeError(f"{name} has a `__new__` or a base that no named tuple has")
        if names[len(names) - len(defaults) :] != (*defaults,):
            raise TypeError(f"Non-default field of {name} follows a default field")
        members |= {"_fields": names, "__match_args__": names, "__slots__": ()}
        members["_field_defaults"] = defaults
        members["__new__"] = _first_new(lambda: made)
        made = type(name, (tuple,), _METHODS | body | members)
        return made


def _first_new(made: Callable[[], Any]) -> Callable[..., Any]:
    """`__new__` for the first objects of a class. When it has made `_FEW`, it leaves its place to a written one."""
    left = _FEW

    def __new__(cls: Any, /, *args: object, **named: object) -> Any:  # noqa: N807
        nonlocal left
        own = made()
        left -= 1
        if left >= 0 and not named and len(args) == len(own._fields):  # as most are made
            return tuple.__new__(cls, args)
        given = dict(zip(own._fields, args, strict=False))
        values = {**own._field_defaults, **given, **named}
        is_right = len(given) == len(args) and not given.keys() & named.keys()
        if left >= 0 and is_right and values.keys() == {*own._fields}:
            return tuple.__new__(cls, [values[name] for name in own._fields])
        written(own)
        return own.__new__(cls, *args, **named)

    return __new__


def written(cls: Any) -> type:
    """The class, with a `__new__` whose signature names the values: who compiles calls of it looks at that."""
    defaults = {f"_default_{name}": value for name, value in cls._field_defaults.items()}
    taken = [f"{name}=_default_{name}" if name in cls._field_defaults else name for name in cls._fields]
    values = "".join(f"{name}, " for name in cls._fields)
    source = f"lambda {', '.join(['_cls', *taken])}: _new(_cls, ({values}))"
    method = eval(source, {"_new": tuple.__new__, **defaults})  # the text comes from names of fields
    method.__name__, method.__qualname__ = "__new__", f"{cls.__qualname__}.__new__"
    method.__annotations__ = {**vars(cls).get("__annotations__", {})}
    cls.__new__ = staticmethod(method)
    return cls  # type: ignore[no-any-return]


class _Signed:
    """Writes `__new__` for who looks for a signature, and lets him find that of the method."""

    def __get__(self, instance: object, owner: type) -> Any:
        written(next(each for each in owner.__mro__ if "_field_defaults" in each.__dict__))
        raise AttributeError("__signature__")


# ---- methods that all have -------------------------------------------------------------------------------------


def _make(cls: Any, values: Iterable[object]) -> Any:
    """An object of its values."""
    made = tuple.__new__(cls, values)
    if len(made) != len(cls._fields):
        raise TypeError(f"Expected {len(cls._fields)} arguments, got {len(made)}")
    return made


def _replace(self: Any, /, **changes: object) -> Any:
    """The same with other values for some fields."""
    made = self._make(map(changes.pop, self._fields, self))
    if changes:
        raise ValueError(f"Got unexpected field names: {list(changes)!r}")
    return made


def _asdict(self: Any) -> dict[str, object]:
    """The values by the names of the fields."""
    return dict(zip(self._fields, self, strict=True))


def _repr(self: Any) -> str:
    shown = ", ".join(f"{name}={value!r}" for name, value in zip(self._fields, self, strict=True))
    return f"{type(self).__name__}({shown})"


def _arguments(self: Any) -> tuple[object, ...]:
    """For `pickle` and `copy`."""
    return tuple(self)


_METHODS = {
    "__repr__": _repr,
    "__getnewargs__": _arguments,
    "_make": classmethod(_make),
    "_replace": _replace,
    "_asdict": _asdict,
    "__signature__": _Signed(),
}

if not TYPE_CHECKING:

    class NamedTuple(metaclass=_Maker):
        """A tuple whose annotated names are its values; see `typing.NamedTuple`."""
