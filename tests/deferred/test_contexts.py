"""Contexts end as those of `contextlib` do."""

# ruff: noqa: BLE001, PT017 - generators that take every error
from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.deferred import contexts

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

BOTH = pytest.mark.parametrize("of", [contexts, contextlib], ids=["ours", "theirs"])
ERRORS = (KeyError("k"), StopIteration(1), RuntimeError("r"), KeyboardInterrupt(), GeneratorExit())


def lets_through(error: BaseException) -> Iterator[int]:
    yield 1


def takes_it(error: BaseException) -> Iterator[int]:
    try:
        yield 1
    except BaseException as came:
        assert came is error


def another(error: BaseException) -> Iterator[int]:
    try:
        yield 1
    finally:
        raise OSError("other")


def once_more(error: BaseException) -> Iterator[int]:
    try:
        yield 1
    except BaseException:
        yield 2


def of_it(error: BaseException) -> Iterator[int]:
    try:
        yield 1
    except BaseException as came:
        raise RuntimeError("of it") from came


def ends_itself(error: BaseException) -> Iterator[int]:
    try:
        yield 1
    except BaseException:
        raise StopIteration(2) from None


def outcome(act: Callable[[], object]) -> list[str]:
    """What comes out of a function: its value, or its error and those that came before that."""
    try:
        return [repr(act())]
    except BaseException as error:
        told: list[str] = []
        at: BaseException | None = error
        while at is not None:
            told.append(repr(at))
            at = at.__cause__ or at.__context__
        return told


def happens(error: BaseException) -> object:
    """An error, of which a type checker does not know."""
    raise error


@pytest.mark.parametrize("error", ERRORS, ids=repr)
@pytest.mark.parametrize("steps", [lets_through, takes_it, another, once_more, of_it, ends_itself])
def test_errors_go_through_a_generator(
    steps: Callable[[BaseException], Iterator[int]], error: BaseException
) -> None:
    def within(of: Any) -> str:
        with of.contextmanager(steps)(error) as number:
            assert number == 1
            happens(error)
        return "behind"

    assert outcome(lambda: within(contexts)) == outcome(lambda: within(contextlib))
    error.__context__ = error.__cause__ = None


@BOTH
def test_a_generator_yields_once(of: Any) -> None:
    def never() -> Iterator[None]:
        yield from ()

    def twice() -> Iterator[int]:
        yield 1
        yield 2

    for steps, match in ((never, "yield"), (twice, "stop")):
        with pytest.raises(RuntimeError, match=match), of.contextmanager(steps)():
            pass


@BOTH
def test_a_generator_is_called_with_its_arguments_and_keeps_its_name(of: Any) -> None:
    def pairs(first: int, *, second: int) -> Iterator[tuple[int, int]]:
        """Pairs."""
        yield first, second

    made = of.contextmanager(pairs)
    assert (made.__name__, made.__doc__) == ("pairs", "Pairs.")
    for number in range(2):
        with made(number, second=3) as pair:
            assert pair == (number, 3)


@BOTH
def test_errors_are_suppressed_by_their_kind(of: Any) -> None:
    with of.suppress(KeyError, OSError):
        happens(FileNotFoundError())
    with pytest.raises(TypeError), of.suppress(KeyError, OSError):
        happens(TypeError())
    with of.suppress(), of.nullcontext(5) as five:
        assert five == 5


@BOTH
@pytest.mark.parametrize("raised", [None, KeyError("k")], ids=repr)
def test_a_stack_leaves_all_in_reverse(of: Any, raised: BaseException | None) -> None:
    said: list[object] = []

    class Step:
        def __init__(self, name: str, ends: object = None) -> None:
            self.name, self.ends = name, ends

        def __enter__(self) -> str:
            return self.name

        def __exit__(self, kind: object, error: object, trace: object) -> object:
            said.append((self.name, error))
            if isinstance(self.ends, BaseException):
                raise self.ends
            return self.ends

    def left(*steps: Step) -> str:
        with of.ExitStack() as stack:
            assert [stack.enter_context(each) for each in steps] == [each.name for each in steps]
            stack.callback(said.append, "called")
            if raised is not None:
                raise raised
        return "behind"

    first = [repr(raised)] if raised is not None else ["'behind'"]
    assert outcome(lambda: left(Step("a"), Step("b"))) == first
    assert said == ["called", ("b", raised), ("a", raised)]
    assert outcome(lambda: left(Step("a"), Step("b", ends=True))) == ["'behind'"]
    assert said[-1:] == [("a", None)]
    other = OSError("other")
    assert outcome(lambda: left(Step("a"), Step("b", other))) == [
        "OSError('other')",
        *first[: raised is not None],
    ]
    assert said[-1:] == [("a", other)]
    assert outcome(lambda: left(Step("a", ends=True), Step("b", OSError()))) == ["'behind'"]
    assert said.count("called") == 4
