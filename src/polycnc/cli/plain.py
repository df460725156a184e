"""Plain words: those of most calls, read without Click, which takes longer to load than a short program to run.

Plain is the name of a command that stands for itself, with options in full, each once and with its value in a word
of its own, and arguments. Whatever else there is (help, groups, numbers, abbreviations, completion of the shell), and
whatever is wrong, Click reads, which knows how to say it.
"""

from __future__ import annotations

import os
from types import GenericAlias

from polycnc.cli.commands import COMMANDS, call, commands_of
from polycnc.cli.declaration import REQUIRED, Argument, Path, without_none
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from polycnc.cli.declaration import Command

#: With this variable of the environment the shell asks how a line may go on.
COMPLETION = "_POLYCNC_COMPLETE"


class _NotPlainError(Exception):
    """Words that Click has to read."""


def read(words: Sequence[str]) -> Callable[[], int | None] | None:
    """What the words of the command line ask for; None where they are not plain."""
    if not words or words[0] not in COMMANDS or COMPLETION in os.environ:
        return None
    offered = commands_of(words[0])
    if offered.text:
        return None
    command = offered.members[0]
    try:
        given = _given(command, iter(words[1:]))
    except _NotPlainError:
        return None
    return lambda: call(command, given)


def _given(command: Command, words: Iterator[str]) -> dict[str, object]:
    """The values that words give to parameters."""
    flags = {flag: each for each in command.parameters for flag in each.flags}
    given: dict[str, object] = {}
    rest: list[str] = []
    for word in words:
        option = flags.get(word)
        if option is None:
            rest.append(word)
        elif option.name in given:
            raise _NotPlainError
        else:
            given[option.name] = option.kind is bool or _value(option.kind, next(words, ""))
    for argument in command.parameters:
        if isinstance(argument.role, Argument) and rest:
            given[argument.name] = _value_of_all(argument.kind, rest)
            rest = []
    if rest or any(each.default is REQUIRED and each.name not in given for each in command.parameters):
        raise _NotPlainError
    return given


def _value_of_all(kind: Any, words: list[str]) -> object:
    """What an argument takes: all words where its type is a list, else one."""
    kind = without_none(kind)
    if isinstance(kind, GenericAlias):
        return [_value(kind.__args__[0], word) for word in words]
    if len(words) > 1:
        raise _NotPlainError
    return _value(kind, words[0])


def _value(kind: Any, word: str) -> object:
    """A word as a value of this type."""
    kind = without_none(kind)
    if not word or (word != "-" and word.startswith("-")):
        raise _NotPlainError
    if not (isinstance(kind, type) and issubclass(kind, (str, Path))):
        raise _NotPlainError
    if issubclass(kind, Path) and os.access(word, os.F_OK) and not os.access(word, os.R_OK):
        raise _NotPlainError  # Click refuses it
    try:
        return kind(word)
    except ValueError as error:  # none of the words of an enumeration
        raise _NotPlainError from error
