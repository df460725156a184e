"""Blocks of words in the form in which they run.

A block is a *signature* and *values*. The signature is everything that decides what kind of block it is: the G and M
codes, the addresses in the order typed, and how each number was written. The values are the numbers of the other
words, in the same order. Blocks of one shape share a signature; what such a block does in some modal state is worked
out once (see `control.word_address.plan`) and then only fed with values.

A key of the signature is a code (`G1`, `G54.1`, `M30`) or an address and how its number was written:

    `X`   no decimal point           `X.`  up to three decimals
    `X:`  four decimals              `X;`  more decimals, which a control may cut off
    `X#`  from an expression         (a vacant variable leaves the word out)
    `X"`  a text                     `<NAME>`  the name of a program that the block calls
    `M3.` an M code with a point     `M#`  one from an expression that is not a whole number

An address is a letter, `,R`, or a letter with an index (`X1`, where the control writes `X1=50.`).
"""

from __future__ import annotations

from functools import lru_cache

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.shapes import with_values

if TYPE_CHECKING:
    from types import FunctionType

    from polycnc.channel.channel import Channel

#: The characters that end a key and say how its number was written.
FORMS = '.:;#"'


@lru_cache(maxsize=1024)
def code_key(letter: str, number: str) -> str:
    """The signature key of a G or M code: `G01` is `G1`, `G54.10` is `G54.10`, `M03` is `M3`.

    The point of an M code stays: a control may refuse it, and as an argument of a macro M is a number like any other.
    """
    whole, point, fraction = number.partition(".")
    tail = point + fraction if letter == "M" or fraction.strip("0") else ""
    return letter + (whole.lstrip("0") or "0") + tail


def word_key(letter: str, number: str) -> str:
    """The signature key of any other word: its address and how its number was written."""
    point = number.find(".")
    if point < 0:
        return letter
    decimals = len(number) - point - 1
    if decimals <= 3:
        return letter + "."
    return letter + (":" if decimals == 4 else ";")


class WordBlock:
    """A block whose words are all numbers."""

    __slots__ = ("signature", "values")

    def __init__(self, signature: tuple[str, ...], values: list[float]) -> None:
        self.signature = signature
        self.values = values

    def with_numbers(self, numbers: tuple[float, ...]) -> WordBlock:
        """The block with other numbers."""
        return WordBlock(self.signature, list(numbers))

    def __call__(self, channel: Channel) -> None:
        """Run the block."""
        mode = channel.mode
        plan = mode.plans.get(self.signature)
        if plan is None:
            plan = channel.control.plan(channel, self.signature)
        channel.mode = plan.mode
        channel.takes_back = plan.takes_back
        values = self.values
        for step in plan.steps:
            step(channel, values)


class ExpressionBlock:
    """A block in which some words hold variables or expressions.

    Args:
        keys: As a signature; for a code from an expression only `G` or `M`.
        evaluate: Gives the values from the memory, one for each key that is not a fixed code; None for a vacant
            variable.
    """

    __slots__ = ("_computes_codes", "_evaluate", "keys")

    def __init__(self, keys: tuple[str, ...], evaluate: FunctionType) -> None:
        self.keys = keys
        self._evaluate = evaluate
        self._computes_codes = "G" in keys or "M" in keys

    def with_numbers(self, numbers: tuple[float, ...]) -> ExpressionBlock:
        """The block with other numbers."""
        return ExpressionBlock(self.keys, with_values(self._evaluate, numbers))

    def __call__(self, channel: Channel) -> None:
        """Run the block."""
        values: list[Any] = self._evaluate(channel.memory)
        keys = self.keys
        if self._computes_codes or None in values:
            keys, values = self._shape(values)
        plan = channel.mode.plans.get(keys)
        if plan is None:
            plan = channel.control.plan(channel, keys)
        channel.mode = plan.mode
        channel.takes_back = plan.takes_back
        for step in plan.steps:
            step(channel, values)

    def _shape(self, values: list[Any]) -> tuple[tuple[str, ...], list[float]]:
        """The signature of this run: computed codes in their place, words of vacant variables left out."""
        numbers = iter(values)
        signature: list[str] = []
        present: list[float] = []
        for key in self.keys:
            if is_fixed_code(key):
                signature.append(key)
                continue
            value = next(numbers)
            if value is None:
                continue
            if key == "G" or (key == "M" and value >= 0.0 and value == int(value)):
                signature.append(code_key(key, f"{round(value, 1):g}"))
            elif key == "M":
                signature.append("M#")
                present.append(value)
            else:
                signature.append(key)
                present.append(value)
        return tuple(signature), present


def is_fixed_code(key: str) -> bool:
    """Whether a signature key has no value: a G or M code with its number, or a program name."""
    return (key[0] in "GM" and len(key) > 1 and key[1].isdigit()) or key[0] == "<"
