"""Rules of the machine's own controller (PLC): an output follows a condition over signals.

A condition joins signals with `&`, `|` and `!`, in brackets where needed; a signal is on when it is not zero.
"""

from __future__ import annotations

import re
from functools import cache, cached_property

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.machine.tables import Latch

    Values = Callable[[str], float]
    Condition = Callable[[Values], bool]

_SIGNS = "&|!()"
_TOKEN = regex(rf"\s*(?:(?P<name>[A-Za-z_$][\w$.\[\]]*)|(?P<sign>[{_SIGNS}]))")
#: How deeply brackets and `!` may be nested.
_DEEPEST = 50


#: An M or G code, or what says that it is done, with zeros in front.
_ZEROS = regex(r"((?:FIN_)?[MG])0+(?=\d+(?:\.\d+)?$)")


def signal_name(written: str) -> str:
    """The name of a signal as a file writes it: M08 is M8, as in programs."""
    if written.removeprefix("FIN_")[1:2] != "0":
        return written
    match = _ZEROS.match(written)
    return match[1] + written[match.end() :] if match else written


class ConditionError(ValueError):
    """A text is no condition: it goes wrong at the character `at`, from 0."""

    def __init__(self, at: int) -> None:
        super().__init__(at)
        self.at = at


@cache
def condition_of(text: str) -> Condition:
    """A condition, asked with a function that gives the value of a signal.

    Raises:
        ConditionError: The text is no condition.
    """
    return _Reader(text).read()


def signals_in(text: str) -> frozenset[str]:
    """The signals that a condition names."""
    plain = text
    for sign in _SIGNS:
        plain = plain.replace(sign, " ")
    if plain.isascii() and all(name.isidentifier() for name in plain.split()):
        return frozenset(map(signal_name, plain.split()))
    return frozenset(signal_name(match["name"]) for match in _TOKEN.finditer(text) if match["name"])


@dataclass(frozen=True)
class Rule:
    """One rule.

    Attributes:
        when: The condition.
        output: The signal that it acts on.
        after_s: How long the condition must have held.
        latch: Empty: the output is on as long as the condition holds. `on`, `off`: the output is switched on or
            off, and stays. `toggle`: it changes whenever the condition begins to hold.
    """

    when: str
    output: str
    after_s: float = 0.0
    latch: Latch = ""

    def __getstate__(self) -> dict[str, object]:
        """Without the condition, a function that is made again where it is asked for: in another process too."""
        return {name: value for name, value in self.__dict__.items() if name != "condition"}

    @cached_property
    def condition(self) -> Condition:
        """The condition, asked with a function that gives the value of a signal.

        Raises:
            ConditionError: The text is no condition.
        """
        return condition_of(self.when)

    def latched(self, value: float) -> float:
        """What a latching rule makes of its output when it acts."""
        return float(self.latch == "on" or (self.latch == "toggle" and not value))


class _Reader:
    """Recursive descent over the tokens of a condition: or, and, not, signal or brackets."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._depth = 0

    def read(self) -> Condition:
        condition = self._either()
        if self._text[self._at :].strip():
            raise ConditionError(self._at)
        return condition

    def _next(self) -> re.Match[str] | None:
        return _TOKEN.match(self._text, self._at)

    def _takes(self, sign: str) -> bool:
        match = self._next()
        if match is None or match["sign"] != sign:
            return False
        self._at = match.end()
        return True

    def _either(self) -> Condition:
        parts = [self._both()]
        while self._takes("|"):
            parts.append(self._both())
        return parts[0] if len(parts) == 1 else lambda value: any(part(value) for part in parts)

    def _both(self) -> Condition:
        parts = [self._one()]
        while self._takes("&"):
            parts.append(self._one())
        return parts[0] if len(parts) == 1 else lambda value: all(part(value) for part in parts)

    def _one(self) -> Condition:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise ConditionError(self._at)
        try:
            return self._signal()
        finally:
            self._depth -= 1

    def _signal(self) -> Condition:
        if self._takes("!"):
            inner = self._one()
            return lambda value: not inner(value)
        if self._takes("("):
            inner = self._either()
            if not self._takes(")"):
                raise ConditionError(self._at)
            return inner
        match = self._next()
        if match is None or not match["name"]:
            raise ConditionError(self._at)
        self._at = match.end()
        name = signal_name(match["name"])
        return lambda value: value(name) != 0.0
