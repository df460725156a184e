"""Blocks of words in the form in which they run.

A block is a *signature* and *values*. The signature is everything that decides what kind of block it is: the G and M
codes, the addresses in the order typed, and how each number was written. The values are the numbers of the other
words, in the same order. Blocks of one shape share a signature; what such a block does in some modal state is worked
out once (see `control.word_address.plan`) and then only fed with values.

A key of the signature is a code (`G1`, `G54.1`, `M30`) or an address and how its number was written:

    `X`   no decimal point           `X.`  up to three decimals
    `X:`  four decimals              `X;`  more decimals, which a control may cut off
    `X#`  from an expression         (a vacant variable leaves the word out)
    `X"`  a text

An address is a letter, `,R`, or a letter with an index (`X1`, where the control writes `X1=50.`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel

    Evaluate = Callable[[Channel], float | None]

#: The characters that end a key and say how its number was written.
FORMS = '.:;#"'
_code_keys: dict[str, str] = {}


def code_key(letter: str, number: str) -> str:
    """The signature key of a G or M code: `G01` is `G1`, `G54.10` is `G54.10`, `M03` is `M3`."""
    text = letter + number
    key = _code_keys.get(text)
    if key is None:
        whole, point, fraction = number.partition(".")
        key = letter + (whole.lstrip("0") or "0") + (point + fraction if fraction.strip("0") else "")
        _code_keys[text] = key
    return key


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

    def __call__(self, channel: Channel) -> None:
        mode = channel.mode
        plan = mode.plans.get(self.signature)
        if plan is None:
            plan = channel.control.plan(channel, self.signature)
        plan.run(channel, self.values)


class ExpressionBlock:
    """A block in which some words hold variables or expressions.

    Args:
        keys: As a signature; for a code from an expression only `G` or `M`.
        values: A number, or what evaluates to one, for each word that is not a fixed code.
    """

    __slots__ = ("keys", "slots")

    def __init__(self, keys: tuple[str, ...], values: list[float | Evaluate]) -> None:
        self.keys = keys
        numbers = iter(values)
        self.slots: tuple[tuple[str, float | Evaluate | None], ...] = tuple(
            (key, None if is_fixed_code(key) else next(numbers)) for key in keys
        )

    def __call__(self, channel: Channel) -> None:
        signature: list[str] = []
        values: list[float] = []
        for key, slot in self.slots:
            if slot is None:
                signature.append(key)
                continue
            value = slot(channel) if callable(slot) else slot
            if value is None:
                continue
            if key in ("G", "M"):
                signature.append(code_key(key, f"{round(value, 1):g}"))
            else:
                signature.append(key)
                values.append(value)
        shape = tuple(signature)
        plan = channel.mode.plans.get(shape)
        if plan is None:
            plan = channel.control.plan(channel, shape)
        plan.run(channel, values)


def is_fixed_code(key: str) -> bool:
    """Whether a signature key is a G or M code with its number."""
    return key[0] in "GM" and len(key) > 1 and key[1].isdigit()
