"""A decorator makes the class of the statement below it at once, and no other class."""

from __future__ import annotations

import builtins
from threading import Barrier, Thread
from typing import Any, Generic, TypeVar

import pytest

from polycnc.deferred import records
from polycnc.deferred.records import dataclass

_T = TypeVar("_T")


@pytest.fixture(autouse=True)
def _python_makes_classes_as_before() -> Any:
    before = builtins.__build_class__
    yield
    assert builtins.__build_class__ is before


@pytest.fixture
def made_twice(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of classes that were made before their decorator was called."""
    names: list[str] = []
    finish = records._dataclass

    def noted(cls: type, **told: bool) -> type:
        names.append(cls.__name__)
        return finish(cls, **told)

    monkeypatch.setattr(records, "_dataclass", noted)
    return names


#: Names of the classes that inherit from `Base`, and what their statements say.
SUBCLASSES: list[tuple[str, int]] = []


class Base:
    def __init_subclass__(cls, number: int = 0) -> None:
        SUBCLASSES.append((cls.__name__, number))


def test_a_class_is_made_once(made_twice: list[str]) -> None:
    SUBCLASSES.clear()

    @dataclass(slots=True)
    class Plain:
        value: int = 1

    @dataclass(
        frozen=True,
        slots=True,
    )
    class Inheriting(Base, number=5):
        value: int
        other: int = 2

        @property
        def kind(self) -> object:
            return __class__  # type: ignore[name-defined]

    assert made_twice == []
    assert SUBCLASSES == [("Inheriting", 5)]
    assert (Plain().value, Inheriting(4).value, Inheriting(4).other) == (1, 4, 2)
    assert Inheriting(4).kind is Inheriting
    assert not hasattr(Plain(), "__dict__")
    assert Plain.__qualname__.endswith("<locals>.Plain")


def test_other_classes_are_made_as_usual(made_twice: list[str]) -> None:
    class Meta(type):
        pass

    @dataclass(slots=True)
    class OfMeta(metaclass=Meta):
        value: int = 1

    @dataclass(slots=True)
    class OfSeveral(Base, LookupError):  # noqa: N818
        value: int = 1

    @dataclass(slots=True)
    class OfGeneric(Generic[_T]):
        value: int = 1

    @(lambda cls: cls)
    @dataclass(slots=True)
    class Twice:
        value: int = 1

    assert made_twice == ["OfMeta", "OfSeveral", "OfGeneric", "Twice"]
    for cls in (OfMeta, OfSeveral, OfGeneric, Twice):
        assert cls().value == 1
        assert vars(cls)["__slots__"] == ("value",)
    assert type(OfMeta) is Meta


def test_a_decorator_may_wait_for_its_class() -> None:
    decorator = dataclass(slots=True)

    class Plain:
        value = 1

    class Record:
        value: int = 1

    assert decorator(Record)().value == 1
    assert not hasattr(Plain, "__dataclass_fields__")
    assert Plain.__dict__.get("__slots__") is None


def test_classes_within_a_class_and_in_its_decorators_are_their_own() -> None:
    def marked(_value: object) -> Any:
        class Inner:
            pass

        return lambda cls: cls

    @dataclass(slots=True)
    @marked(0)
    class Outer:
        value: int = 1

        class Kept:
            kept = 2

    assert Outer.Kept.kept == 2
    assert not hasattr(Outer.Kept, "__dataclass_fields__")
    assert Outer.__slots__ == ("value",)


def test_a_mistake_in_the_statement_leaves_no_trace() -> None:
    def none() -> type:
        raise LookupError

    def refused() -> None:
        @dataclass(slots=True)
        class Wrong(none()):  # type: ignore[misc]
            pass

    def broken() -> None:
        @dataclass(slots=True)
        class Wrong:
            value: int = 1 // 0

    with pytest.raises(ZeroDivisionError):
        broken()
    for _ in range(3):
        with pytest.raises(LookupError):
            refused()

    @dataclass(slots=True)
    class Right:
        value: int = 1

    assert Right().value == 1


def test_threads_do_not_take_the_classes_of_others() -> None:
    wrong: list[type] = []
    start = Barrier(4)

    def make(number: int) -> None:
        start.wait()
        for _ in range(200):

            @dataclass(slots=True)
            class Record:
                value: int = number

            class Plain:
                value = number

            if Record().value != number or Record.__slots__ != ("value",) or hasattr(Plain, "__slots__"):
                wrong.append(Record)

    threads = [Thread(target=make, args=(each,)) for each in range(4)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert wrong == []

    @dataclass(slots=True)
    class Last:
        value: int = 1

    assert Last().value == 1
