"""Arrays that no kernel may read from the end: compiled kernels would read what lies in front of them."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar, cast

_F = TypeVar("_F", bound=Callable[..., Any])


class FromTheStart:
    """An array whose places count from its start only."""

    def __init__(self, items: array[Any]) -> None:
        self.items = items

    def __len__(self) -> int:
        return len(self.items)

    def __getitem__(self, place: int) -> Any:
        assert place >= 0, place
        return self.items[place]

    def __setitem__(self, place: int, value: Any) -> None:
        assert place >= 0, place
        self.items[place] = value


def strict(kernel: _F) -> _F:
    """A kernel as it is written, on such arrays."""

    @wraps(kernel)
    def called(*given: Any) -> Any:
        return kernel(*map(_strict, given))

    return cast("_F", called)


def _strict(given: Any) -> Any:
    if isinstance(given, array):
        return FromTheStart(given)
    return type(given)(*map(_strict, given)) if isinstance(given, tuple) else given
