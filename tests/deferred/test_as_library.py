"""Dataclasses and named tuples of any fields behave as those that the standard library makes of the same body."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import json
import pickle
import subprocess
import sys
import threading
import typing
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pydantic
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from polycnc.deferred import named_tuples, records
from polycnc.deferred.records import _FEW

if TYPE_CHECKING:
    from collections.abc import Callable

NAMES = ("a", "b", "self", "cls", "_set", "_LATER")
#: What a class says of a field; `make` is what a factory gives.
SAID: dict[str, dict[str, Any] | None] = {
    "nothing": None,
    "default": {"default": 5},
    "factory": {"default_factory": list},
    "hidden": {"repr": False, "compare": False},
    "hashed": {"default": 6, "compare": False, "hash": True},
    "not hashed": {"default": 7, "hash": False},
    "constant": {"init": False, "default": 8},
    "made": {"init": False, "default_factory": dict},
    "unset": {"init": False},
}
FIELDS = st.lists(
    st.tuples(st.sampled_from(NAMES), st.sampled_from(sorted(SAID))),
    max_size=4,
    unique_by=lambda each: each[0],
)
OPTIONS = st.fixed_dictionaries({"frozen": st.booleans(), "slots": st.booleans(), "eq": st.booleans()})
CALLS = st.lists(
    st.tuples(
        st.lists(st.integers(0, 3), max_size=4),
        st.dictionaries(st.sampled_from((*NAMES, "z")), st.integers(0, 3), max_size=3),
    ),
    min_size=1,
    max_size=5,
)


def outcome(act: Callable[[], object]) -> tuple[str, Any]:
    """What a function gives, or the kind and text of its error."""
    try:
        return "gives", act()
    except (TypeError, ValueError, AttributeError) as error:
        text = str(error)
        if "follows default argument" in text:  # Python 3.12 and later name both
            text = "follows"
        return type(error).__name__, text


def record_by(
    decorator: Any, fields: Any, options: Any, bases: tuple[type, ...] = (), *, is_stated: bool = False
) -> Any:
    """A class of these fields, finished by a decorator of dataclasses, which may stand above a class statement."""
    values = {name: dataclasses.field(**told) for name, said in fields if (told := SAID[said]) is not None}
    if is_stated:
        lines = ["@decorator(**options)", "class Made(*bases):", "    __qualname__ = 'Made'"]
        lines += [
            f"    {name}: int" + (f" = values[{name!r}]" if name in values else "") for name, _ in fields
        ]
        scope = {"decorator": decorator, "options": options, "bases": bases, "values": values}
        exec("\n".join(lines), scope)
        return scope["Made"]
    body: dict[str, Any] = {"__annotations__": dict.fromkeys([name for name, _ in fields], "int")}
    return decorator(**options)(type("Made", bases, body | values | {"__qualname__": "Made"}))


def described(thing: Any) -> list[object]:
    """What can be told of an object of a dataclass, or of a class."""
    cls: Any = type(thing)
    names = [each.name for each in dataclasses.fields(thing)]
    # In a frozen class with slots that of Python 3.11 looks for other attributes in the class it has replaced.
    set_too = names if "__slots__" in type(thing).__dict__ else [*names, "other"]
    return [
        outcome(lambda: repr(thing)) if cls.__eq__ is not object.__eq__ else "",
        [outcome(lambda name=name: getattr(thing, name)) for name in names],  # type: ignore[misc]
        [each.name in getattr(thing, "__dict__", ()) for each in dataclasses.fields(thing)],
        outcome(lambda: hash(thing)) if cls.__hash__ is not object.__hash__ else "",
        outcome(lambda: dataclasses.astuple(thing)),
        outcome(lambda: dataclasses.asdict(copy.copy(thing))),
        outcome(lambda: thing == copy.deepcopy(thing)),
        [outcome(lambda name=name: setattr(thing, name, 9)) for name in set_too],  # type: ignore[misc]
        [outcome(lambda name=name: delattr(thing, name)) for name in set_too],  # type: ignore[misc]
    ]


def calls_tell(cls: Any, calls: Any) -> list[object]:
    """What calls of a class do, as the first objects and when all methods are written."""
    told: list[object] = []
    for _ in range(2):
        for arguments, named in calls:
            act, thing = outcome(lambda: cls(*arguments, **named))  # noqa: B023
            told.append(described(thing) if act == "gives" else (act, thing))
            if act == "gives":
                told.append(outcome(lambda: described(dataclasses.replace(thing, **named))))  # noqa: B023
                told.append(thing == cls(*arguments, **named))
        for _ in range(_FEW):
            outcome(lambda: cls(*calls[0][0], **calls[0][1]))
    told += [inspect.signature(cls), cls.__match_args__, cls.__dict__.get("__slots__")]
    told += [[(each.name, each.type, each.init, each.hash) for each in dataclasses.fields(cls)]]
    return told


def assert_same(ours: Callable[[], Any], theirs: Callable[[], Any], calls: Any) -> None:
    """Two makers of a class make the same, or refuse it; an order of fields ours refuse with their first object."""
    expected = outcome(lambda: calls_tell(theirs(), calls))
    found = outcome(lambda: calls_tell(ours(), calls))
    if expected == ("TypeError", "follows"):
        arguments, named = calls[0]
        assert outcome(lambda: ours()(*arguments, **named))[0] == "TypeError"
        return
    assert repr(found) == repr(expected)


@settings(max_examples=150, deadline=None)
@given(FIELDS, OPTIONS, CALLS, st.booleans())
def test_a_dataclass_does_what_that_of_the_library_does(
    fields: Any, options: Any, calls: Any, is_stated: bool
) -> None:
    assert_same(
        lambda: record_by(records.dataclass, fields, options, is_stated=is_stated),
        lambda: record_by(dataclasses.dataclass, fields, options),
        calls,
    )


@settings(max_examples=150, deadline=None)
@given(FIELDS, FIELDS, OPTIONS, OPTIONS, CALLS, st.permutations(["ours", "ours", "theirs"]), st.booleans())
def test_one_inherits_from_ours_or_from_the_librarys(
    fields: Any, more: Any, options: Any, own: Any, calls: Any, who: list[str], is_stated: bool
) -> None:
    def made(base: str, child: str) -> Any:
        by = {"ours": records.dataclass, "theirs": dataclasses.dataclass}
        inherited = record_by(by[base], fields, options, is_stated=is_stated)
        return record_by(by[child], more, own, (inherited,), is_stated=is_stated)

    # Else ours would refuse no object of the class that inherits, but those of the other.
    assume(outcome(lambda: record_by(dataclasses.dataclass, fields, options))[0] == "gives")
    assert_same(lambda: made(*who[:2]), lambda: made("theirs", "theirs"), calls)


# ---- named tuples ---------------------------------------------------------------------------------------------------


def tuple_by(base: Any, names: list[str], defaults: int) -> Any:
    """A named tuple of fields of which the last ones have a default."""
    lines = [
        f"    {name}: int" + (f" = {at}" if at >= len(names) - defaults else "")
        for at, name in enumerate(names)
    ]
    scope: dict[str, Any] = {"Base": base, "__name__": __name__}
    exec("\n".join(["class Made(Base):", "    '''Made.'''", *lines]), scope)
    return scope["Made"]


def tuples_tell(cls: Any, calls: Any) -> list[object]:
    """What calls of a named tuple do, as the first objects and when its method is written."""
    told: list[object] = []
    for _ in range(2):
        for arguments, named in calls:
            act, thing = outcome(lambda: cls(*arguments, **named))  # noqa: B023
            told += [act, thing, outcome(lambda: cls._make(arguments))]  # noqa: B023
            if act == "gives":
                told += [outcome(lambda: thing._replace(**named)), thing._asdict(), hash(thing)]  # noqa: B023
                told += [
                    copy.deepcopy(thing),
                    thing.__getnewargs__(),
                    outcome(lambda: setattr(thing, "a", 1)),  # noqa: B023
                ]
                told += [thing.__new__(cls, *thing), thing == tuple(thing)]
        for _ in range(_FEW):
            outcome(lambda: cls(*calls[0][0], **calls[0][1]))
    told += [
        [(each.name, each.default) for each in inspect.signature(cls).parameters.values()],
        cls._fields,
        cls._field_defaults,
        cls.__match_args__,
        cls.__slots__,
    ]
    return [*told, cls.__doc__, cls.__bases__, typing.get_type_hints(cls)]


@settings(max_examples=150, deadline=None)
@given(
    st.lists(st.sampled_from([name for name in NAMES if name[0] != "_"]), unique=True),
    st.integers(0, 4),
    CALLS,
)
def test_a_named_tuple_does_what_that_of_the_library_does(
    names: list[str], defaults: int, calls: Any
) -> None:
    ours = tuples_tell(tuple_by(named_tuples.NamedTuple, names, defaults), calls)
    theirs = tuples_tell(tuple_by(typing.NamedTuple, names, defaults), calls)
    assert repr(ours) == repr(theirs)


def test_mistakes_in_a_named_tuple_are_refused() -> None:
    scope: dict[str, Any] = {"NamedTuple": named_tuples.NamedTuple}
    for text in (
        "class A(NamedTuple):\n a: int = 1\n b: int",
        "class A(NamedTuple):\n a: int\n def __new__(cls): pass",
        "class A(NamedTuple, Exception):\n a: int",
    ):
        with pytest.raises(TypeError):
            exec(text, scope)


# ---- what the library does not know ---------------------------------------------------------------------------------


@records.dataclass(frozen=True, slots=True)
class Point:
    x: int
    y: list[int] = records.field(default_factory=list)


class Pair(named_tuples.NamedTuple):
    left: int
    right: float = 1.0


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_another_process_reads_what_was_pickled(protocol: int) -> None:
    things = [Point(1), Point(2, [3]), Pair(1), Pair(1, 2.0)]
    ask = (
        "import pickle, sys\n"
        f"sys.path.insert(0, {str(Path(__file__).parents[2])!r})\n"  # wherever tests are started
        "things = pickle.loads(sys.stdin.buffer.read())\n"
        f"sys.stdout.buffer.write(pickle.dumps(things, {protocol}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", ask], input=pickle.dumps(things, protocol), capture_output=True, check=True
    )
    assert pickle.loads(done.stdout) == things


@pytest.mark.parametrize("cls", [Point, Pair])
def test_pydantic_reads_them(cls: Any) -> None:
    first = cls._fields[0] if cls is Pair else "x"
    assert pydantic.TypeAdapter(cls).validate_python({first: "3"}) == cls(3)


def test_threads_make_first_objects_at_once() -> None:
    for _ in range(20):
        record: Any = record_by(
            records.dataclass,
            [("a", "nothing"), ("b", "factory")],
            {"frozen": True, "slots": True, "eq": True},
        )
        place = tuple_by(named_tuples.NamedTuple, ["a", "b"], 1)
        made: list[Any] = []
        start = threading.Barrier(8)

        def make() -> None:
            start.wait()  # noqa: B023
            for number in range(_FEW):
                made.append((record(number), place(number)))  # noqa: B023
                assert made[0][0] == record(made[0][0].a)  # noqa: B023

        threads = [threading.Thread(target=make) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(made) == 8 * _FEW
        for one, other in made:
            assert (one.b, other) == ([], (one.a, 1))


def test_wrong_arguments_call_no_factory() -> None:
    called: list[int] = []

    def factory() -> list[int]:
        called.append(1)
        return called

    @records.dataclass
    class Made:
        a: list[int] = records.field(default_factory=factory)
        b: int = 0

    wrong: Any = Made
    for _ in range(2):
        with pytest.raises(TypeError):
            wrong(z=1)
    assert not called


def test_an_error_within_leaves_a_class_as_it_was() -> None:
    tried: list[int] = []

    @records.dataclass
    class Made:
        a: int

        def __post_init__(self) -> None:
            tried.append(self.a)
            if self.a < 0:
                raise KeyError(self.a)
            if self.a:
                Made(self.a - 1)

    for number in range(2 * _FEW):
        with pytest.raises(KeyError):
            Made(-1)
        tried.clear()
        Made(number)
        assert tried == [*range(number, -1, -1)]


# ---- all of polycnc -------------------------------------------------------------------------------------------------

DESCRIBE = """
import dataclasses, gc, importlib, inspect, json, pkgutil, re, sys, typing
from polycnc.deferred import named_tuples, records, typing as names
if sys.argv[1] == "theirs":
    for name in ("dataclass", "field", "fields", "replace", "is_dataclass", "MISSING"):
        setattr(records, name, getattr(dataclasses, name))
    named_tuples.NamedTuple = typing.NamedTuple
    for name in set(names.__all__) - {"is_class_variable"}:  # the library looks for its own `ClassVar`
        setattr(names, name, getattr(typing, name))
import polycnc

for each in pkgutil.walk_packages(polycnc.__path__, "polycnc."):
    if not each.name.endswith(("__main__", "kernels.compiled")):
        importlib.import_module(each.name)

def described(cls):
    told = [(each.name, str(each.default)) for each in inspect.signature(cls).parameters.values()]
    told.append(cls.__match_args__)
    if issubclass(cls, tuple):
        return [*told, cls._fields]
    body, fields = cls.__dict__, dataclasses.fields(cls)
    told += [body.get("__slots__"), cls.__hash__ is None, cls.__dataclass_params__.frozen]
    told += [sorted(name for name in METHODS if name in body)]
    for each in fields:
        told.append([each.name, str(each.type), each.init, each.repr, each.hash, each.compare])
        told.append([each.default is dataclasses.MISSING, each.default_factory is dataclasses.MISSING])
    return told

METHODS = ("__init__", "__repr__", "__eq__", "__hash__", "__setattr__", "__delattr__", "__getstate__", "__setstate__")
found = {}
for cls in gc.get_objects():
    module = getattr(cls, "__module__", None) if isinstance(cls, type) else None
    if not isinstance(module, str) or module.partition(".")[0] != "polycnc":
        continue
    # Beside a class with slots there is the one that it was made of.
    of = f"{module}.{cls.__qualname__}"
    if "__dataclass_fields__" in cls.__dict__ and (of not in found or "__slots__" in cls.__dict__):
        found[of] = described(cls)
    elif issubclass(cls, tuple) and hasattr(cls, "_fields"):
        found[of] = described(cls)
print(re.sub(" at 0x[0-9a-f]+", "", json.dumps(found)))
"""


def test_all_classes_of_polycnc_are_those_of_the_library() -> None:
    """The library takes all of them, too, and makes the same: what it refuses does not stand in polycnc."""
    found = [
        subprocess.run([sys.executable, "-c", DESCRIBE, whose], capture_output=True, text=True, check=True)
        for whose in ("ours", "theirs")
    ]
    ours, theirs = (json.loads(each.stdout) for each in found)
    assert len(ours) > 500
    assert ours.keys() == theirs.keys()
    assert {name: told for name, told in ours.items() if told != theirs[name]} == {}
