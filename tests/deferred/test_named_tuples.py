"""Named tuples whose methods are made later behave as those of `typing`."""

from __future__ import annotations

import ast
import copy
import pickle
import typing
from pathlib import Path
from typing import Any

import pytest

import polycnc
from polycnc.deferred.named_tuples import _FEW, NamedTuple


class Place(NamedTuple):
    """A place, told in two numbers and a word."""

    x: float
    y: float = 2.0
    name: str | None = None

    @property
    def length(self) -> float:
        return self.x + self.y


class Told(NamedTuple):
    word: str

    def __repr__(self) -> str:
        return f"<{self.word}>"


class Nothing(NamedTuple):
    pass


class Theirs(typing.NamedTuple):
    x: float
    y: float = 2.0
    name: str | None = None


def test_objects_are_tuples_with_names() -> None:
    pairs: list[Any] = [(Place(1.0), Theirs(1.0)), (Place(1.0, name="it"), Theirs(1.0, name="it"))]
    pairs += [(Place(1.0, 2.5, name="it"), Theirs(1.0, 2.5, name="it")) for _ in range(2 * _FEW)]
    for place, theirs in pairs:
        assert place == theirs
        assert repr(place) == repr(theirs).replace("Theirs", "Place")
        assert hash(place) == hash(theirs)
        assert place._asdict() == theirs._asdict()
        assert place._replace(y=5.0) == theirs._replace(y=5.0)
        assert type(place._replace(y=5.0)) is Place
    x, y, name = Place(1.0, 3.0, "it")
    assert (x, y, name) == (1.0, 3.0, "it")
    assert Place(1.0).length == 3.0
    assert Place._make([1, 2, None]) == Place._make((1, 2, None)) == (1, 2, None)
    assert Nothing() == ()


@pytest.mark.parametrize("name", ["_fields", "_field_defaults", "__match_args__", "__slots__"])
def test_classes_are_described_as_by_the_library(name: str) -> None:
    assert getattr(Place, name) == getattr(Theirs, name, ())


def test_methods_of_a_class_are_its_own() -> None:
    assert repr(Told("this")) == repr(Told("this")) == "<this>"


def test_wrong_arguments_are_refused() -> None:
    wrong: Any = Place
    for _ in range(2):  # a refusal writes `__new__`
        with pytest.raises(TypeError, match="missing 1 required positional argument: 'x'"):
            wrong()
    for arguments, named in (((1, 2, None, 4), {}), ((1,), {"x": 1}), ((), {"x": 1, "z": 1})):
        with pytest.raises(TypeError):
            wrong(*arguments, **named)
    with pytest.raises(TypeError, match="Expected 3 arguments, got 1"):
        Place._make([1])
    with pytest.raises(ValueError, match="unexpected field names"):
        wrong(1.0)._replace(z=1)
    with pytest.raises(AttributeError):
        Place(1.0).z = 1  # type: ignore[attr-defined]


def test_objects_can_be_copied_and_pickled() -> None:
    place = Place(1.0, name="it")
    assert pickle.loads(pickle.dumps(place)) == copy.copy(place) == copy.deepcopy(place) == place
    assert type(pickle.loads(pickle.dumps(place))) is Place


def test_objects_match_patterns() -> None:
    match Place(1.0, 2.0):
        case Place(x, y, None):
            assert (x, y) == (1.0, 2.0)
        case _:
            pytest.fail("no match")


def test_everything_in_polycnc_uses_this_base() -> None:
    for path in Path(polycnc.__file__).parent.rglob("*.py"):
        if path.parent.name == "deferred":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module == "typing":
                assert "NamedTuple" not in {alias.name for alias in node.names}, path
