"""`dataclass` as that of the standard library, with methods that are written when they are first called.

The library's own compiles up to seven functions for a class where the class is defined. For the classes of a control
that is more work than a short program, which makes objects of few of them and compares fewer. This one notes the
annotated names, makes the slots, and puts in the place of each method a function that, when it is called, writes the
method and leaves its place to it. The library itself, which loads a dozen modules, describes a class when somebody asks
it to: its `fields`, `replace` and `is_dataclass` work on these classes. `field`, `fields` and `replace` of this module
say the same and need no library.

What nothing here uses is left out: `InitVar`, `kw_only`, `order` and `unsafe_hash`.
"""

from __future__ import annotations

import sys
from operator import attrgetter
from reprlib import recursive_repr
from types import MappingProxyType, MemberDescriptorType
from typing import TYPE_CHECKING, Any, ClassVar, get_origin

from polycnc.deferred.class_statements import ClassStatement, body_of, lead_super

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from dataclasses import MISSING, dataclass, field, fields, is_dataclass, replace
    from typing import TypeAlias

    _Steps: TypeAlias = tuple[list[tuple[str, bool, object, Any]], Callable[[Any, str, object], None], bool]
else:

    def dataclass(cls=None, /, *, frozen=False, slots=False, eq=True):
        """A class whose annotated names are its fields; see `dataclasses.dataclass`."""
        if cls is not None:
            return _dataclass(cls, frozen=frozen, slots=slots, eq=eq)
        if not slots:
            return lambda cls: _dataclass(cls, frozen=frozen, slots=False, eq=eq)

        def made(name, bases, body, **named):
            like = bases[0] if bases else object
            return _with_slots(type, name, bases, body, named, like, frozen=frozen, eq=eq)

        def decorator(cls):
            statement.end()
            return cls if _NOTED in cls.__dict__ else _dataclass(cls, frozen=frozen, slots=True, eq=eq)

        statement = ClassStatement(made)
        return decorator

    def field(**told):
        """What is to be known of a field; see `dataclasses.field`."""
        return Field(**told)

    def fields(of):
        """The fields of a dataclass or of an object of one, in order; see `dataclasses.fields`."""
        cls = of if isinstance(of, type) else type(of)
        for each in cls.__mro__:
            if _NOTED in each.__dict__:
                return _fields_of(each)
            if _OF_LIBRARY in each.__dict__:
                import dataclasses

                return dataclasses.fields(each)
        raise TypeError("must be called with a dataclass type or instance")

    def is_dataclass(of):
        """Whether it is a dataclass or an object of one; see `dataclasses.is_dataclass`."""
        cls = of if isinstance(of, type) else type(of)
        return any(_OF_LIBRARY in each.__dict__ for each in cls.__mro__)

    def replace(thing, /, **changes):
        """An object like another one but for some fields; see `dataclasses.replace`."""
        cls = type(thing)
        names, values, others = cls.__dict__.get(_GIVEN) or _given(thing)
        for name in others:
            if name in changes:
                raise ValueError(
                    f"field {name} is declared with init=False, it cannot be specified with replace()"
                )
        return cls(**{**dict(zip(names, values(thing), strict=True)), **changes})

    class MISSING:
        """What stands for no default."""


__all__ = ["MISSING", "dataclass", "field", "fields", "is_dataclass", "is_frozen", "replace"]
#: So many objects of a class are made field by field before an `__init__` is written for it.
_FEW = 32
#: Where a class keeps its own annotated names with what was assigned to them; where its fields, when asked for.
_NOTED, _FIELDS = "__noted_fields__", "__described_fields__"
#: Where a class keeps what `replace` takes over.
_GIVEN = "__given_fields__"
#: So many calls of a method look fields up before it is written out for a class, which takes as long as some hundred.
_MANY = 512
#: Where a class keeps what `_put_values` does for its objects.
_STEPS = "__steps_of_init__"
#: Where the library keeps its fields.
_OF_LIBRARY = "__dataclass_fields__"
#: How the annotations of what is no field begin.
_CLASS_VARIABLES = "ClassVar", "typing.ClassVar"


class _Later:
    """What a parameter holds whose value comes from a `default_factory`."""

    def __repr__(self) -> str:
        return "<factory>"


_LATER = _Later()
#: What a class says of fields that is no dataclass.
_NOTHING: dict[str, Any] = {}


def is_frozen(cls: type) -> bool:
    """Whether fields of objects of a dataclass never change; False for other classes."""
    return getattr(cls, "__frozen__", False)


class Field:
    """A field, with the attributes that the library's has."""

    __slots__ = ("compare", "default", "default_factory", "hash", "init", "metadata", "name", "repr", "type")
    __hash__ = None  # type: ignore[assignment]  # the library's decorator refuses it as a default

    def __init__(
        self,
        *,
        default: object = MISSING,
        default_factory: Any = MISSING,
        init: bool = True,
        repr: bool = True,  # noqa: A002 - as the library has it
        hash: bool | None = None,  # noqa: A002
        compare: bool = True,
        metadata: Mapping[str, object] | None = None,
    ) -> None:
        self.default = default
        self.default_factory = default_factory
        self.init = init
        self.repr = repr
        self.hash = hash
        self.compare = compare
        self.metadata: Mapping[str, object] = MappingProxyType(metadata or {})
        self.name = ""
        self.type: object = None

    def of_library(self) -> Any:
        """The same for the library."""
        import dataclasses

        told = {name: getattr(self, name) for name in self.__slots__ if name not in ("name", "type")}
        given = {name: value for name, value in told.items() if value is not MISSING}
        return dataclasses.field(**given)


def _dataclass(cls: Any, *, frozen: bool, slots: bool, eq: bool) -> type:
    """The dataclass of a class that has been made."""
    name, bases = cls.__name__, cls.__bases__
    like = cls if bases != (object,) else object
    if slots:
        made = _with_slots(type(cls), name, bases, body_of(cls), {}, like, frozen=frozen, eq=eq)
        lead_super(made, cls)
        return made
    noted, members = _members(lambda: cls, name, bases, cls.__dict__, like, frozen=frozen, eq=eq)
    for each, value in noted.items():
        if isinstance(value, Field):
            if value.default is MISSING:
                delattr(cls, each)
            else:
                setattr(cls, each, value.default)
    for each, value in members.items():
        setattr(cls, each, value)
    return cls  # type: ignore[no-any-return]


def _with_slots(
    kind: Callable[..., type], name: str, bases: tuple[type, ...], body: dict[str, Any],
    named: Mapping[str, Any], like: type, *, frozen: bool, eq: bool,
) -> type:  # fmt: skip
    """The dataclass of the body of a class, with a slot for every field that no base has one for.

    `kind` makes a class of name, bases, body and what is `named` beside the bases; `like` is any class that inherits
    what this one does.
    """
    noted, members = _members(lambda: made, name, bases, body, like, frozen=frozen, eq=eq)
    if frozen:  # what pickle would otherwise set by `setattr`
        body.setdefault("__getstate__", _state)
        body.setdefault("__setstate__", _put_state)
    body |= members
    inherited: set[str] = set()
    for each in like.__mro__[:-1]:
        slots = each.__dict__.get("__slots__", ())
        inherited.update((slots,) if isinstance(slots, str) else slots)
        if _OF_LIBRARY in each.__dict__:
            noted = {**dict.fromkeys(_noted(each), MISSING), **noted}
    for field_name in noted:
        body.pop(field_name, None)
    body["__slots__"] = (*[each for each in noted if each not in inherited],)
    made = kind(name, bases, body, **named)
    return made


def _members(
    made: Callable[[], type], name: str, bases: tuple[type, ...], body: Mapping[str, Any], like: type,
    *, frozen: bool, eq: bool,
) -> tuple[dict[str, object], dict[str, Any]]:  # fmt: skip
    """What the body of a class says of fields, and what its class has beside it; `made` gives it when it is used."""
    if like is not object:
        _check_bases(bases, frozen=frozen)
    take = body.get
    noted: dict[str, object] = {
        each: take(each, MISSING)
        for each, hint in take("__annotations__", _NOTHING).items()
        if not (
            hint.startswith(_CLASS_VARIABLES) if type(hint) is str else ClassVar in (hint, get_origin(hint))
        )
    }
    if like is not object:
        noted = {
            each: getattr(like, each, MISSING) if value is MISSING else value for each, value in noted.items()
        }
    if "dataclasses" in sys.modules:  # else nothing in it can be the library's
        noted = {each: _told(value) for each, value in noted.items()}
    members: dict[str, Any] = {
        _NOTED: noted, _OF_LIBRARY: _DESCRIBED, "__frozen__": frozen, "__signature__": _SIGNED,
        "__doc__": body.get("__doc__") or name,  # else the library would write down its signature
    }  # fmt: skip
    if "__match_args__" not in body:
        members["__match_args__"] = _POSITIONAL
    if "__init__" not in body:
        members["__init__"] = _first_init(made)
    if "__repr__" not in body:
        members["__repr__"] = _repr
    if eq:
        if "__eq__" not in body:
            members["__eq__"] = _made_later(made, "__eq__", _eq)
        # A class that has `__eq__` of its own and no `__hash__` has None there.
        if "__hash__" not in body or (body["__hash__"] is None and "__eq__" in body):
            members["__hash__"] = _made_later(made, "__hash__", _hash) if frozen else None
    if frozen:
        members["__setattr__"], members["__delattr__"] = _refuse_to_set, _refuse_to_delete
    return noted, members


def _check_bases(bases: tuple[type, ...], *, frozen: bool) -> None:
    """Refuse that some fields of an object change and others do not."""
    base: Any
    for base in bases:
        is_other: bool | None = getattr(base, "__frozen__", None)
        if is_other is None and hasattr(base, _OF_LIBRARY):
            is_other = base.__dataclass_params__.frozen
        if is_other not in (None, frozen):
            words = ("non-frozen", "frozen") if is_other else ("frozen", "non-frozen")
            raise TypeError("cannot inherit {} dataclass from a {} one".format(*words))


def _told(value: object) -> object:
    """What a class says of a field; what the library's `field` says as a `Field` of ours."""
    if type(value).__module__ != "dataclasses":
        return value
    import dataclasses

    if not isinstance(value, dataclasses.Field):
        return value
    told = {name: getattr(value, name) for name in Field.__slots__ if name not in ("name", "type")}
    return Field(**{name: each for name, each in told.items() if each is not dataclasses.MISSING})


# ---- fields ----------------------------------------------------------------------------------------------------


def _noted(base: type) -> Mapping[str, object]:
    """What a class itself says of fields, one of the library as well."""
    body = base.__dict__
    if _NOTED in body:
        return body[_NOTED]  # type: ignore[no-any-return]
    if _OF_LIBRARY in body:
        return {name: _told(value) for name, value in body[_OF_LIBRARY].items()}
    return _NOTHING


def _fields_of(cls: type) -> tuple[Field, ...]:
    """All fields of a class of ours, those of its bases first."""
    known: tuple[Field, ...] | None = cls.__dict__.get(_FIELDS)
    if known is None:
        found: dict[str, Field] = {}
        for base in reversed(cls.__mro__):
            if _OF_LIBRARY in base.__dict__:
                found |= _described(base)
        known = tuple(found.values())
        setattr(cls, _FIELDS, known)
    return known


def _described(cls: type) -> dict[str, Field]:
    """The fields that a class itself adds."""
    found: dict[str, Field] = {}
    of_library = {} if _NOTED in cls.__dict__ else cls.__dict__.get(_OF_LIBRARY, {})
    for name, value in _noted(cls).items():
        each = value if isinstance(value, Field) else Field(default=value)
        each.default = _checked(name, each.default)
        each.name = name
        each.type = of_library[name].type if of_library else cls.__annotations__[name]
        found[name] = each
    return found


def _given(thing: Any) -> tuple[tuple[str, ...], Callable[[object], tuple[object, ...]], tuple[str, ...]]:
    """What `replace` takes over: names of the fields that `__init__` takes, what gives their values, other names."""
    if isinstance(thing, type):
        raise TypeError("replace() should be called on dataclass instances")
    known = fields(thing)
    names = [each.name for each in known if each.init]
    found = (*names,), _getter(names), (*[each.name for each in known if not each.init],)
    setattr(type(thing), _GIVEN, found)
    return found


def _checked(name: str, default: object) -> object:
    """The default of a field; none is the slot of one that has none."""
    if isinstance(default, MemberDescriptorType):
        return MISSING
    if type(default).__hash__ is None:
        raise ValueError(
            f"mutable default {type(default)} for field {name} is not allowed: use default_factory"
        )
    return default


class _Described:
    """Stands where the library looks for its fields, and lets it make them when it does."""

    def __get__(self, instance: object, owner: type) -> Any:
        import dataclasses

        cls: Any = next(each for each in owner.__mro__ if _OF_LIBRARY in each.__dict__)
        known = _fields_of(cls)
        body: dict[str, Any] = {each.name: each.of_library() for each in known}
        body |= {"__annotations__": {each.name: each.type for each in known}, "__module__": cls.__module__}
        described: Any = dataclasses.dataclass(init=False, repr=False, eq=False, frozen=is_frozen(cls))(
            type(cls.__name__, (), body)
        )
        cls.__dataclass_params__ = described.__dataclass_params__
        cls.__dataclass_fields__ = described.__dataclass_fields__
        return cls.__dataclass_fields__


class _Positional:
    """Stands for the fields that `__init__` takes, in order, until a pattern asks for them."""

    def __get__(self, instance: object, owner: type) -> tuple[str, ...]:
        cls = next(each for each in owner.__mro__ if each.__dict__.get("__match_args__") is self)
        names = tuple(each.name for each in _fields_of(cls) if each.init)
        type.__setattr__(cls, "__match_args__", names)
        return names


class _Signed:
    """Writes `__init__` for who looks for a signature, and lets him find that of the method."""

    def __get__(self, instance: object, owner: type) -> Any:
        cls: Any = next(each for each in owner.__mro__ if "__init__" in each.__dict__)
        if getattr(cls.__init__, "__module__", "") == __name__:
            cls.__init__ = _init(cls)
        raise AttributeError("__signature__")


_DESCRIBED, _POSITIONAL, _SIGNED = _Described(), _Positional(), _Signed()


# ---- methods that are written ----------------------------------------------------------------------------------


def _made_later(
    made: Callable[[], type], name: str, make: Callable[[type], Callable[..., Any]]
) -> Callable[..., Any]:
    """What stands in the place of a method until it is first called."""

    def first_call(self: object, *args: object) -> object:
        cls = made()
        method = make(cls)
        setattr(cls, name, method)
        return method(self, *args)

    return first_call


def _eq(cls: type) -> Callable[..., Any]:
    names = [each.name for each in _fields_of(cls) if each.compare]
    values, left = _getter(names), _MANY

    def __eq__(self: object, other: object) -> bool:  # noqa: N807
        nonlocal left
        left -= 1
        if left == 0:
            ours, theirs = _tuple("self", names), _tuple("other", names)
            text = f"return {ours} == {theirs} if other.__class__ is self.__class__ else NotImplemented"
            cls.__eq__ = _written(cls, "__eq__(self, other)", text)  # type: ignore[method-assign]
        if other.__class__ is self.__class__:
            return values(self) == values(other)
        return NotImplemented

    return __eq__


def _hash(cls: type) -> Callable[..., Any]:
    names = [each.name for each in _fields_of(cls) if (each.compare if each.hash is None else each.hash)]
    values, left = _getter(names), _MANY

    def __hash__(self: object) -> int:  # noqa: N807
        nonlocal left
        left -= 1
        if left == 0:
            cls.__hash__ = _written(cls, "__hash__(self)", f"return hash({_tuple('self', names)})")  # type: ignore[method-assign]
        return hash(values(self))

    return __hash__


def _tuple(thing: str, names: list[str]) -> str:
    """The text of a tuple of fields."""
    return f"({''.join(f'{thing}.{name}, ' for name in names)})"


def _written(cls: type, head: str, body: str, names: dict[str, Any] | None = None) -> Callable[..., Any]:
    """A method of a class, of a text that comes from names of fields."""
    scope = {} if names is None else names
    exec(f"def {head}:\n {body}", scope)
    method: Callable[..., Any] = scope[head.partition("(")[0]]
    method.__qualname__ = f"{cls.__qualname__}.{method.__name__}"
    return method


def _getter(names: list[str]) -> Callable[[object], tuple[object, ...]]:
    """What gives the values of these fields as a tuple."""
    if not names:
        return lambda _thing: ()
    value: Callable[[object], Any] = attrgetter(*names)
    return value if len(names) > 1 else lambda thing: (value(thing),)


def _first_init(made: Callable[[], type]) -> Callable[..., None]:
    """`__init__` for the first objects of a class. When it has made `_FEW`, it leaves its place to a written one."""
    left = _FEW

    def __init__(self: object, /, *args: object, **named: object) -> None:  # noqa: N807
        nonlocal left
        cls = made()
        left -= 1
        if left < 0 or not _put_values(cls, self, args, named):
            cls.__init__ = _init(cls)  # type: ignore[misc]
            cls.__init__(self, *args, **named)  # type: ignore[misc]

    return __init__


def _put_values(cls: type, thing: object, args: tuple[object, ...], named: dict[str, object]) -> bool:
    """Do what the written `__init__` does, field by field; False where it would refuse these arguments."""
    steps, put, goes_on = cls.__dict__.get(_STEPS) or _steps_of(cls)
    values: list[tuple[str, object, Any]] = []
    given = iter(args)
    taken = 0
    for name, is_taken, default, factory in steps:
        value = next(given, MISSING) if is_taken else MISSING
        if name in named:
            if value is not MISSING or not is_taken:
                return False
            value = named[name]
            taken += 1
        elif value is MISSING:
            value = default
            if value is MISSING and factory is MISSING:
                return False
        values.append((name, value, factory))
    if taken < len(named) or next(given, MISSING) is not MISSING:
        return False
    for name, value, factory in values:
        put(thing, name, factory() if value is MISSING else value)
    if goes_on:
        thing.__post_init__()  # type: ignore[attr-defined]
    return True


def _steps_of(cls: type) -> _Steps:
    """What is to be done for an object: its fields (name, whether an argument gives it, default, factory) in order.

    Left out are those that nobody gives and that have no default, or one that the class itself has. With them, how a
    value is put in, and whether `__post_init__` follows.
    """
    slots = "__slots__" in cls.__dict__
    noted: dict[str, object] = {}
    for base in reversed(cls.__mro__):
        if _OF_LIBRARY in base.__dict__:
            noted |= _noted(base)
    steps: list[tuple[str, bool, object, Any]] = []
    is_optional = False
    for name, value in noted.items():
        is_taken, default = True, value
        factory: Any = MISSING
        if isinstance(value, Field):
            is_taken, default, factory = value.init, value.default, value.default_factory
        default = _checked(name, default)
        if default is not MISSING or factory is not MISSING:
            is_optional |= is_taken
        elif is_taken and is_optional:
            raise TypeError(f"non-default argument {name!r} follows default argument")
        if is_taken or factory is not MISSING or (slots and default is not MISSING):
            steps.append((name, is_taken, default, factory))
    made = steps, object.__setattr__ if is_frozen(cls) else setattr, hasattr(cls, "__post_init__")
    setattr(cls, _STEPS, made)
    return made


def _init(cls: type) -> Callable[..., Any]:
    if _STEPS not in cls.__dict__:
        _steps_of(cls)  # which may refuse them
    frozen, slots = is_frozen(cls), "__slots__" in cls.__dict__
    names: dict[str, Any] = {"__LATER": _LATER, "__set": object.__setattr__}
    fields_of = _fields_of(cls)
    own = "__self" if any(each.name == "self" for each in fields_of) else "self"
    parameters, values = [own], {}
    for each in fields_of:
        names[f"__default_{each.name}"] = (
            each.default if each.default_factory is MISSING else each.default_factory
        )
        parameter, value = _parameter_and_value(each, slots=slots)
        if parameter:
            parameters.append(parameter)
        if value:
            values[each.name] = value

    def body() -> Iterator[str]:
        for name, value in values.items():
            slot = getattr(cls, name, None)
            if not frozen:
                yield f"{own}.{name} = {value}"
            elif isinstance(slot, MemberDescriptorType):
                names[f"__set_{name}"] = slot.__set__
                yield f"__set_{name}({own}, {value})"
            else:
                yield f"__set({own}, {name!r}, {value})"
        yield f"{own}.__post_init__()" if hasattr(cls, "__post_init__") else "pass"

    method = _written(cls, f"__init__({', '.join(parameters)})", "\n ".join(body()), names)
    method.__annotations__ = {each.name: each.type for each in fields_of if each.init} | {"return": None}
    return method


def _parameter_and_value(each: Field, *, slots: bool) -> tuple[str, str]:
    """How `__init__` declares a field and what it puts into it; empty where it does not."""
    name, default = each.name, f"__default_{each.name}"
    if each.default_factory is not MISSING:
        if not each.init:
            return "", f"{default}()"
        return f"{name}=__LATER", f"{default}() if {name} is __LATER else {name}"
    if each.init:
        return (name if each.default is MISSING else f"{name}={default}"), name
    # Without slots the class itself has the default.
    return "", default if slots and each.default is not MISSING else ""


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


def _refuse(thing: object, name: str, doing: str) -> None:
    """Raise `FrozenInstanceError` for a field, and for every attribute where the class itself is frozen.

    A class that inherits from a frozen one may have more attributes.
    """
    for cls in type(thing).__mro__:
        if cls.__dict__.get("__frozen__") and (
            cls is type(thing) or any(each.name == name for each in _fields_of(cls))
        ):
            from dataclasses import FrozenInstanceError

            raise FrozenInstanceError(f"cannot {doing} field {name!r}")


def _refuse_to_set(self: object, name: str, value: object) -> None:
    _refuse(self, name, "assign to")
    object.__setattr__(self, name, value)


def _refuse_to_delete(self: object, name: str) -> None:
    _refuse(self, name, "delete")
    object.__delattr__(self, name)
