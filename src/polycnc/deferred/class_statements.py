"""A class statement whose decorator sees the body before there is a class.

A decorator is given a class that has been made. One that makes another class of the same body, as slots need it, makes
each twice, and to make a class is most of what its statement costs. `ClassStatement` stands in the place of what
Python makes classes by from the call of the decorator on, up to the statement below it. Where Python does not come to
that statement by the shortest way, the class is made as usual, and the decorator has to make its own of it.
"""

from __future__ import annotations

import builtins
import sys
from functools import cached_property
from types import FunctionType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ClassStatement", "body_of", "lead_super"]
#: Where members of a class that are no functions have theirs.
_BEHIND: dict[type, str] = {
    classmethod: "__func__",
    staticmethod: "__func__",
    property: "fget",
    cached_property: "func",
}


class ClassStatement:
    """The statement whose first decorator is called by the function that calls who makes this object."""

    __slots__ = ("_code", "_line", "_make", "before")

    def __init__(self, make: Callable[..., type]) -> None:
        """Wait for it.

        Args:
            make: Makes the class of its name, its bases and its body, as `type` does. A class of several bases, or
                of another metaclass, is made as usual.
        """
        caller = sys._getframe(2)  # noqa: SLF001 - where the statement stands
        self._code, self._line, self._make = caller.f_code, caller.f_lineno, make
        before: Any = builtins.__build_class__
        #: By what classes are made otherwise.
        self.before: Any = before.before if type(before) is ClassStatement else before
        builtins.__build_class__ = self

    def __call__(self, body: Any, name: str, /, *bases: Any, **named: Any) -> Any:
        """Make a class: another one as usual, this one by `make`."""
        # The body begins at its first decorator, whoever runs it.
        if body.__code__.co_firstlineno != self._line or sys._getframe(1).f_code is not self._code:  # noqa: SLF001
            return self.before(body, name, *bases, **named)
        self.end()
        if len(bases) > 1 or "metaclass" in named or any(type(base) is not type for base in bases):
            return self.before(body, name, *bases, **named)
        return self.before(body, name, *bases, metaclass=self._make, **named)

    def end(self) -> None:
        """Wait no longer."""
        if builtins.__build_class__ is self:
            builtins.__build_class__ = self.before


# ---- classes that are made twice -------------------------------------------------------------------------------


def body_of(cls: type) -> dict[str, Any]:
    """What a class can be made of once more."""
    body = {**cls.__dict__, "__qualname__": cls.__qualname__}
    for each in ("__dict__", "__weakref__"):
        body.pop(each, None)
    return body


def lead_super(made: type, cls: type) -> None:
    """Let `super()` in the methods of a class mean the one that was made of it."""
    for member in cls.__dict__.values():
        behind = _BEHIND.get(type(member))
        function = getattr(member, behind) if behind else member
        if type(function) is FunctionType and function.__closure__ is not None:
            free = function.__code__.co_freevars
            if "__class__" in free:  # a cell that all methods share
                function.__closure__[free.index("__class__")].cell_contents = made
                return
