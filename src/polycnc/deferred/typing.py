"""Names of `typing`, which a program that runs needs for nothing but its annotations.

Annotations are texts that nobody reads while polycnc runs, but the heads of its modules name what they are made of, and
`typing` with all that it imports took more time than to run a short program. A type checker sees the library's names
here; at run time those below stand in for them, and any other comes from the library as soon as it is asked for.

Modules that have annotations evaluated by others (pydantic) import `typing` itself.
"""

from __future__ import annotations

import sys

#: What type checkers take for true, whatever it says.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import (
        IO,
        Annotated,
        Any,
        ClassVar,
        Final,
        Generic,
        Literal,
        Never,
        NoReturn,
        NotRequired,
        ParamSpec,
        Protocol,
        Self,
        TypeAlias,
        TypedDict,
        TypeVar,
        Union,
        cast,
        overload,
    )
else:

    class _Hint:
        """What stands in an annotation alone: it may be subscribed and joined, and stays what it is."""

        __slots__ = ()

        def __getitem__(self, _: object) -> _Hint:
            return self

        def __or__(self, _: object) -> _Hint:
            return self

        __ror__ = __or__

    IO = Any = ClassVar = Final = Literal = Never = NoReturn = Self = TypeAlias = Union = _Hint()

    class Generic:
        """The base of a class that has parameters for a type checker."""

        __slots__ = ()

        def __class_getitem__(cls, _: object) -> type:
            return cls

    class Protocol(Generic):
        """What some objects have in common; nothing is ever made of it."""

        __slots__ = ()

    class Annotated:
        """A type, and what is said of it: `Annotated[type, said, …]`, with the names that the library's has.

        Attributes:
            __origin__: The type.
            __metadata__: What is said.
        """

        __slots__ = ("__metadata__", "__origin__")

        def __class_getitem__(cls, given: tuple[object, ...]) -> Annotated:
            self = object.__new__(cls)
            self.__origin__, *said = given
            self.__metadata__ = (*said,)
            return self

    def TypeVar(*_: object, **__: object) -> _Hint:  # noqa: N802 - as the library's
        """A type that a type checker finds out."""
        return Any

    def cast(_: object, value: object) -> object:
        """The value, of the type that a type checker takes it for."""
        return value

    def overload(function: object) -> object:
        """One of the ways to call a function, for a type checker."""
        return function

    def __getattr__(name: str) -> object:
        if name.startswith("__"):  # which imports ask every module for
            raise AttributeError(name)
        import typing

        return getattr(typing, name)


def is_class_variable(hint: object) -> bool:
    """Whether an annotation says `ClassVar`: as a text, or as the library's own where it has been evaluated."""
    if isinstance(hint, str):
        return hint.startswith(("ClassVar", "typing.ClassVar"))
    library = sys.modules.get("typing")  # which whoever evaluates annotations has loaded
    return library is not None and library.ClassVar in (hint, library.get_origin(hint))


__all__ = [
    "IO",
    "TYPE_CHECKING",
    "Annotated",
    "Any",
    "ClassVar",
    "Final",
    "Generic",
    "Literal",
    "Never",
    "NoReturn",
    "NotRequired",
    "ParamSpec",
    "Protocol",
    "Self",
    "TypeAlias",
    "TypeVar",
    "TypedDict",
    "Union",
    "cast",
    "is_class_variable",
    "overload",
]
