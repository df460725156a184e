"""`NamedTuple` as that of `typing`, with methods that are made when they are first called.

`typing` compiles the annotation of every field, and `collections.namedtuple` the method `__new__`: a tenth of a
millisecond for a class, of which a control has many and a short program uses few. This one makes the fields, and puts
in the place of each method a function that, when it is called, leaves its place to the method: `__new__` is written as
the library writes it, the others are those of the library.

Annotations stay texts. What nothing here uses is left out: named tuples that are generic.
"""

from __future__ import annotations

from collections import namedtuple
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import NamedTuple

__all__ = ["NamedTuple", "written"]
#: What gives the value at a place of a tuple.
_getter_at: Any = type(vars(namedtuple("_Pair", "left right"))["left"])  # noqa: PYI024
_OF_LIBRARY = ("__repr__", "__getnewargs__", "_replace", "_asdict")


class _Maker(type):
    """Makes a class of tuples of a class statement that names `NamedTuple` as its base."""

    def __new__(cls, name: str, bases: tuple[type, ...], body: dict[str, Any]) -> Any:
        if not bases:
            return super().__new__(cls, name, bases, body)
        names = tuple(body.get("__annotations__", ()))
        members: dict[str, Any] = {each: _getter_at(number, each) for number, each in enumerate(names)}
        members |= {"_fields": names, "__match_args__": names, "__slots__": ()}
        members["_field_defaults"] = {each: body[each] for each in names if each in body}
        members["__new__"] = _made_later(lambda: made, "__new__", _new)
        members["_make"] = classmethod(_made_later(lambda: made, "_make", _make))
        for method in _OF_LIBRARY:
            if method not in body:
                members[method] = _made_later(lambda: made, method, _library(method))
        made = type(name, (tuple,), body | members)
        return made


def _made_later(
    made: Callable[[], type], name: str, make: Callable[[Any], Callable[..., Any]]
) -> Callable[..., Any]:
    """What stands in the place of a method until it is first called; `made` gives the class then."""

    def first_call(*arguments: object, **named: object) -> object:
        cls = made()
        method = make(cls)
        setattr(cls, name, method)
        return getattr(method, "__func__", method)(*arguments, **named)

    return first_call


def written(cls: type) -> type:
    """The class, with a `__new__` whose signature names the values: who compiles calls of it looks at that."""
    cls.__new__ = _new(cls)  # type: ignore[method-assign]
    return cls


def _new(cls: Any) -> Callable[..., Any]:
    defaults = {f"_default_{name}": value for name, value in cls._field_defaults.items()}
    taken = [f"{name}=_default_{name}" if name in cls._field_defaults else name for name in cls._fields]
    values = "".join(f"{name}, " for name in cls._fields)
    source = f"lambda {', '.join(['_cls', *taken])}: _new(_cls, ({values}))"
    method: Any = eval(source, {"_new": tuple.__new__, **defaults})  # the text comes from names of fields
    method.__name__, method.__qualname__ = "__new__", f"{cls.__qualname__}.__new__"
    return staticmethod(method)


def _make(cls: Any) -> Callable[..., Any]:
    return vars(_of_library(cls))["_make"]  # type: ignore[no-any-return]


def _library(name: str) -> Callable[[Any], Callable[..., Any]]:
    return lambda cls: vars(_of_library(cls))[name]  # type: ignore[no-any-return]


def _of_library(cls: Any) -> type:
    """A class of the library with the same fields."""
    defaults = tuple(cls._field_defaults.values())
    return namedtuple(cls.__name__, cls._fields, defaults=defaults, module=cls.__module__)  # type: ignore[misc]  # noqa: PYI024


if not TYPE_CHECKING:

    class NamedTuple(metaclass=_Maker):
        """A tuple whose annotated names are its values; see `typing.NamedTuple`."""
