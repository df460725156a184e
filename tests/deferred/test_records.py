"""Dataclasses whose methods are written later behave as those of the standard library."""

from __future__ import annotations

import ast
import copy
import dataclasses
import pickle
from dataclasses import FrozenInstanceError, field, fields, is_dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import pytest

import polycnc
from polycnc.deferred.records import _FEW, _MANY, dataclass, is_frozen, replace

if TYPE_CHECKING:
    from collections.abc import Callable


def _described(name: str) -> str:
    return f"about {name}"


def classes_by(decorator: Any) -> dict[str, Callable[..., Any]]:
    """The same classes, each finished by a decorator of dataclasses."""

    @decorator
    class Plain:
        first: int
        second: float = 1.5
        KIND: ClassVar[str] = "plain"

    @decorator(frozen=True, slots=True)
    class Point:
        """A point, with a field of every kind."""

        x: float
        names: list[str] = field(default_factory=list)
        hidden: int = field(default=3, repr=False, compare=False)
        made: dict[str, int] = field(init=False, default_factory=dict, compare=False)
        constant: int = field(init=False, default=7)

        def __post_init__(self) -> None:
            self.made["x"] = int(self.x)

    @decorator(frozen=True, slots=True)
    class Labelled(Point):
        label: str = ""

    @decorator(slots=True, eq=False)
    class Counter:
        count: int = field(init=False, default=0)

    @decorator(frozen=True)
    class Own:
        name: str

        def __repr__(self) -> str:
            return _described(self.name)

        def __hash__(self) -> int:
            return 1

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Own)

    return {each.__name__: each for each in (Plain, Point, Labelled, Counter, Own)}


OURS, THEIRS = classes_by(dataclass), classes_by(dataclasses.dataclass)
#: Arguments of objects, all of one class.
ARGUMENTS = [
    ("Plain", (1,), {}),
    ("Plain", (1, 2.5), {}),
    ("Point", (1.25,), {}),
    ("Point", (1.25, ["a"]), {"hidden": 4}),
    ("Labelled", (1.25,), {"label": "there"}),
    ("Counter", (), {}),
    ("Own", ("it",), {}),
]


def told(thing: object) -> str:
    return repr(thing).replace("classes_by.<locals>.", "")


@pytest.mark.parametrize(("name", "arguments", "named"), ARGUMENTS)
def test_objects_are_those_of_the_library(name: str, arguments: Any, named: Any) -> None:
    ours, theirs = OURS[name](*arguments, **named), THEIRS[name](*arguments, **named)
    assert [getattr(ours, each.name) for each in fields(ours)] == [
        getattr(theirs, each.name) for each in fields(theirs)
    ]
    if name != "Counter":  # its text has no address, and it is equal to itself alone
        assert told(ours) == told(theirs)
    assert (ours == OURS[name](*arguments, **named)) == (theirs == THEIRS[name](*arguments, **named))


@pytest.mark.parametrize(("name", "arguments", "named"), ARGUMENTS)
def test_many_objects_are_as_the_first(name: str, arguments: Any, named: Any) -> None:
    cls: Any = classes_by(dataclass)[name]
    made = [cls(*arguments, **named) for _ in range(2 * _FEW)]
    assert cls.__init__.__code__.co_filename == "<string>"  # written by then
    for each in fields(cls):
        assert len({repr(getattr(one, each.name)) for one in made}) == 1
        assert len({each.name in getattr(one, "__dict__", ()) for one in made}) == 1


@pytest.mark.parametrize(("name", "arguments", "named"), ARGUMENTS)
def test_what_is_compared_often_is_as_at_first(name: str, arguments: Any, named: Any) -> None:
    cls: Any = classes_by(dataclass)[name]
    theirs: Any = THEIRS[name]
    one, other = cls(*arguments, **named), cls(*arguments, **named)
    is_equal = theirs(*arguments, **named) == theirs(*arguments, **named)
    for _ in range(2 * _MANY):
        assert (one == other) is is_equal
        assert one != "another thing"
    if theirs.__hash__ is not None and name != "Counter":
        hashed = [_hash_or_error(thing) for thing in (*[one] * _MANY, other)]
        assert len(set(hashed)) == 1
    if name in {"Plain", "Point", "Labelled"}:
        assert cls.__eq__.__code__.co_filename == "<string>"  # written by then
        another = cls(2.5, *arguments[1:], **named)
        assert one != another
        assert another == cls(2.5, *arguments[1:], **named)


def _hash_or_error(thing: object) -> object:
    try:
        return hash(thing)
    except TypeError as error:  # it holds a list
        return str(error)


@pytest.mark.parametrize("by", [dataclass, dataclasses.dataclass])
def test_an_object_like_another_one_has_all_that_is_not_changed(by: Any) -> None:
    made = classes_by(by)
    point: Any = made["Labelled"](1.25, ["a"], hidden=4, label="there")
    for _ in range(2):  # what is taken over is kept for the second
        like: Any = replace(point, x=2.0)
        assert (like.x, like.names, like.hidden, like.label) == (2.0, ["a"], 4, "there")
        assert like.made == {"x": 2}
        with pytest.raises(ValueError, match="constant is declared with init=False"):
            replace(point, constant=8)
        with pytest.raises(TypeError):
            replace(point, other=8)
        with pytest.raises(TypeError, match="dataclass instances"):
            replace(type(point), x=2.0)  # type: ignore[type-var]
    assert replace(made["Point"](1.0), x=3.0) == made["Point"](3.0)


@pytest.mark.parametrize("name", OURS)
def test_classes_are_described_as_by_the_library(name: str) -> None:
    ours: Any = OURS[name]
    theirs: Any = THEIRS[name]
    assert is_dataclass(OURS[name])
    assert [(each.name, each.init, each.compare) for each in fields(ours)] == [
        (each.name, each.init, each.compare) for each in fields(theirs)
    ]
    assert getattr(ours, "__slots__", None) == getattr(theirs, "__slots__", None)
    assert ours.__match_args__ == theirs.__match_args__
    assert (ours.__hash__ is None) == (theirs.__hash__ is None)
    assert is_frozen(ours) == theirs.__dataclass_params__.frozen


def test_wrong_arguments_are_refused() -> None:
    with pytest.raises(
        TypeError, match=r"Plain.__init__\(\) missing 1 required positional argument: 'first'"
    ):
        OURS["Plain"]()


@dataclass(frozen=True, slots=True)
class Pair:
    left: int
    right: int = 2


@dataclass(slots=True)
class Base:
    value: int

    def doubled(self) -> int:
        return 2 * self.value

    @classmethod
    def of(cls, value: int) -> Base:
        return cls(value)


@dataclass(slots=True)
class Child(Base):
    def doubled(self) -> int:
        return super().doubled() + 1


@dataclass(slots=True)
class Made(Base):
    @classmethod
    def of(cls, value: int) -> Base:
        return super().of(value + 1)


def test_a_class_of_the_library_may_inherit() -> None:
    theirs: Any = dataclasses.dataclass(frozen=True)(
        type("More", (Pair,), {"__annotations__": {"more": "int"}, "more": 3})
    )
    assert [each.name for each in fields(theirs)] == ["left", "right", "more"]
    assert dataclasses.asdict(theirs(1)) == {"left": 1, "right": 2, "more": 3}


def test_a_frozen_object_never_changes() -> None:
    pair = Pair(1)
    with pytest.raises(FrozenInstanceError):
        pair.left = 2  # type: ignore[misc]
    with pytest.raises(FrozenInstanceError):
        del pair.left
    assert pair == Pair(1, 2)
    assert hash(pair) == hash((1, 2))


def test_super_means_the_class_with_slots() -> None:
    assert Child(3).doubled() == 7
    assert Made.of(3) == Made(4)


def test_objects_can_be_copied_pickled_and_replaced() -> None:
    pair = Pair(1, 5)
    assert copy.deepcopy(pair) == pickle.loads(pickle.dumps(pair)) == pair
    assert replace(pair, right=6) == Pair(1, 6)


def test_an_object_that_came_by_pickle_is_compared_before_one_was_made() -> None:
    made: Any = Pair.__new__(Pair)
    made.__setstate__([1, 2])
    assert repr(made) == "Pair(left=1, right=2)"
    assert made == Pair(1)


def test_everything_in_polycnc_uses_this_decorator() -> None:
    """The library's own is correct as well, but takes half a millisecond for a class, and some to be loaded."""
    folder = Path(polycnc.__file__).parent
    for path in folder.rglob("*.py"):
        if path.parent.name == "deferred":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module == "dataclasses":
                taken = {alias.name for alias in node.names}
                assert not taken & {"dataclass", "field", "fields", "is_dataclass", "replace"}, path
