"""Values of retained memory as JSON text, and back.

Plain values (numbers, texts, lists) are what JSON has for them. Everything else is an object with a tag:
`{"~": "tuple", "of": [...]}`. A feature that keeps dataclasses or enums of its own names them once, where it declares
them:

    @encoded("tool offset")
    @dataclass
    class ToolOffset: ...

The name stands in files, so a class may move to another module; a field that a file lacks has its default. Classes of
lower layers have their names at the end of this module.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from math import isfinite

from polycnc.deferred.records import fields, is_dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeVar
from polycnc.machine.setup.values import ParameterKey
from polycnc.messages import Alarm
from polycnc.program.program import Form, Program

if TYPE_CHECKING:
    from collections.abc import Callable

_T = TypeVar("_T", bound=type)
_TAG, _OF = "~", "of"
_CLASSES: dict[str, type] = {}
_KINDS: dict[type, tuple[str, tuple[str, ...]]] = {}


def encoded(name: str, without: tuple[str, ...] = ()) -> Callable[[_T], _T]:
    """Give a dataclass, a named tuple or an enum the name that it has in files.

    Args:
        name: The name.
        without: Fields that are not kept; they need a default.
    """

    def register(cls: _T) -> _T:
        _CLASSES[name] = cls
        kept = tuple(each for each in _names(cls) if each not in without)
        _KINDS[cls] = name, kept
        return cls

    return register


def _names(cls: type) -> tuple[str, ...]:
    if is_dataclass(cls):
        return tuple(each.name for each in fields(cls) if each.init)
    return tuple(getattr(cls, "_fields", ()))


def encode(value: object) -> str:
    """A value as one line of JSON.

    Raises:
        TypeError: A class in it has no name; see `encoded`.
    """
    import json

    return json.dumps(_plain(value), ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def decode(line: str) -> Any:
    """The value of a line that `encode` has written.

    Raises:
        ValueError: It is none, or holds a class that this version does not know.
    """
    import json

    return _value(json.loads(line))


def _plain(value: object) -> object:
    kind = type(value)
    if value is None or kind in (bool, int, str):
        return value
    if kind is float:
        return value if isfinite(value) else {_TAG: "float", _OF: str(value)}  # type: ignore[arg-type]
    if kind is list:
        return [_plain(each) for each in value]  # type: ignore[attr-defined]
    if kind is tuple:
        return {_TAG: "tuple", _OF: [_plain(each) for each in value]}  # type: ignore[attr-defined]
    if kind is dict:
        return {_TAG: "dict", _OF: [[_plain(key), _plain(each)] for key, each in value.items()]}  # type: ignore[attr-defined]
    if kind in _KINDS:
        name, kept = _KINDS[kind]
        if isinstance(value, Enum):
            return {_TAG: name, _OF: value.name}
        return {_TAG: name, **{each: _plain(getattr(value, each)) for each in kept}}
    if isinstance(value, Mapping):
        return _plain(dict(value))
    if isinstance(value, Sequence):
        return _plain(tuple(value))
    raise TypeError(f"{kind.__module__}.{kind.__qualname__} has no name in files of retained memory")


def _value(plain: Any) -> Any:
    if isinstance(plain, list):
        return [_value(each) for each in plain]
    if not isinstance(plain, dict):
        return plain
    tag = plain.get(_TAG)
    if tag == "float":
        return float(plain[_OF])
    if tag == "tuple":
        return tuple(_value(each) for each in plain[_OF])
    if tag == "dict":
        return {_value(key): _value(each) for key, each in plain[_OF]}
    cls = _CLASSES.get(str(tag))
    if cls is None:
        raise ValueError(f"unknown kind of value: {tag}")
    if issubclass(cls, Enum):
        return cls[plain[_OF]]
    kept = _KINDS[cls][1]
    return cls(**{name: _value(plain[name]) for name in kept if name in plain})


encoded("program")(Program)
encoded("program form")(Form)
encoded("alarm", without=("catalogue",))(Alarm)
encoded("parameter")(ParameterKey)
