"""What the command line offers, as data: commands, and what each of their parameters is there.

A command is a function. A parameter is annotated `Annotated[type, Option(…)]` or `Annotated[type, Argument(…)]`; one
whose type is a class (`options.Opening`) stands for the fields of that class, which are annotated so. Whoever reads
words (`plain`, and Click by way of `clicks`) knows commands from here alone.
"""

from __future__ import annotations

import sys
from functools import cache, cached_property
from types import UnionType

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from pathlib import Path

    Function = Callable[..., int | None]
else:

    class Path:
        """The type of parameters that are files or folders: that of `pathlib`, which is loaded with the first."""

        def __new__(cls, *parts):  # noqa: D102 - as that of the library
            from pathlib import Path

            return Path(*parts)


__all__ = ["REQUIRED", "Argument", "Command", "Commands", "Option", "Parameter", "Path", "without_none"]

#: The default of a parameter that must be given.
REQUIRED = object()


class Option:
    """A word with its value behind it, or a word alone where the type is `bool`.

    Args:
        text: Id of its text on the page of help.
        flags: The words; without any it is the name of the parameter.
        metavar: What the page of help calls its value.
        shows_default: Whether that page tells the default.
        values: The values that the shell offers.
        limits: Smallest and largest number.
        refusal: Why a value is none, in the words of Click; empty where it is one.
    """

    def __init__(
        self,
        text: str,
        *flags: str,
        metavar: str | None = None,
        shows_default: bool = True,
        values: Callable[[], Iterable[str]] | None = None,
        limits: tuple[float | None, float | None] = (None, None),
        refusal: Callable[[Any], str] | None = None,
    ) -> None:
        self.text = text
        self.flags = flags
        self.metavar = metavar
        self.shows_default = shows_default
        self.values = values
        self.limits = limits
        self.refusal = refusal


class Argument:
    """A word, or all of them where the type is a list.

    Args:
        text: Id of its text on the page of help; empty where its name says it all.
        metavar: What that page calls it.
        values: The values that the shell offers.
    """

    def __init__(
        self, text: str = "", *, metavar: str, values: Callable[[], Iterable[str]] | None = None
    ) -> None:
        self.text = text
        self.metavar = metavar
        self.values = values


class Parameter(NamedTuple):
    """One parameter of a command, or one field of a class that stands for several.

    Attributes:
        name: Its name in Python.
        kind: Its type, evaluated.
        role: What it is on the command line.
        default: Its value where no word gives it one, or `REQUIRED`.
    """

    name: str
    kind: Any
    role: Option | Argument
    default: object

    def taken(self, given: Mapping[str, object]) -> object:
        """Its value among those that words have given."""
        return given.get(self.name, self.default)

    @property
    def flags(self) -> tuple[str, ...]:
        """The words of an option; none of an argument."""
        if isinstance(self.role, Argument):
            return ()
        return self.role.flags or (f"--{self.name.replace('_', '-')}",)


class Command:
    """A function that the command line calls.

    Args:
        function: What it does; gives an exit status, or None for 0.
        text: Id of the text at the head of its page of help.
        name: Its name within a group.
        runs: The parameter that names the programs which it reads and plans; empty where it does not.
    """

    def __init__(self, function: Function, text: str = "", name: str = "", runs: str = "") -> None:
        self._function = function
        self.text = text
        self.name = name
        self.runs = runs

    def __call__(self, given: Mapping[str, object]) -> int | None:
        """Call the function with these values by the names of parameters, and with its defaults for the others."""
        arguments = {
            name: own.taken(given)
            if isinstance(own, Parameter)
            else own(**{each.name: each.taken(given) for each in _fields(own).values()})
            for name, own in self._own.items()
        }
        return self._function(**arguments)

    @property
    def parameters(self) -> list[Parameter]:
        """All that words can give, in the order of the page of help."""
        found: list[Parameter] = []
        for own in self._own.values():
            found += [own] if isinstance(own, Parameter) else _fields(own).values()
        return found

    @cached_property
    def _own(self) -> dict[str, Parameter | type]:
        """The parameters of the function by their names; a class where one stands for the fields of that class."""
        function = self._function
        code, defaults = function.__code__, function.__defaults__ or ()
        names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        given = dict(zip(names[code.co_argcount - len(defaults) :], defaults, strict=False))
        given |= function.__kwdefaults__ or {}
        return {name: _parameter(name, function, given.get(name, REQUIRED)) for name in names}


@cache
def _fields(cls: type) -> dict[str, Parameter]:
    return {name: _parameter(name, cls, vars(cls)[name]) for name in cls.__annotations__}


def _parameter(name: str, owner: Any, default: object) -> Any:
    """What the annotation of a parameter or of a field says, which is a text until now."""
    annotation = eval(owner.__annotations__[name], vars(sys.modules[owner.__module__]))
    if isinstance(annotation, type):
        return annotation
    return Parameter(name, annotation.__origin__, annotation.__metadata__[0], default)


def without_none(kind: Any) -> Any:
    """The type of a value that a word gives: `Path` of `Path | None`."""
    return kind.__args__[0] if isinstance(kind, UnionType) else kind


class Commands:
    """What one module of `cli.commands` offers: a command of its own, or a group of them.

    Args:
        text: Id of the text at the head of the page of help of a group; empty where the module is one command.
        alone: What a group does that is called without one of its commands.
    """

    def __init__(self, text: str = "", alone: Callable[[], None] | None = None) -> None:
        self.text = text
        self.alone = alone
        self.members: list[Command] = []

    def command(self, text: str, name: str = "", runs: str = "") -> Callable[[Function], Function]:
        """Declare a command: the id of its text on the page of help, and its name where that is not the function's.

        `runs` is the parameter with its programs (`Command`).
        """

        def declared(function: Function) -> Function:
            self.members.append(Command(function, text, name or function.__name__, runs))
            return function

        return declared
