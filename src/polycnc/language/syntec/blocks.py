"""Blocks of words of the SYNTEC language, in the form of the word-address blocks.

A word takes a number, a variable, a function or an expression, in brackets or bare (`X30./2.`, `G#32`).
What such a value is when the block runs decides how the word counts as written: a Long as without a
decimal point, a Double as with one; a VACANT word counts as not written. See `language.word_address.words`.
"""

from __future__ import annotations

from math import isfinite

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions.code import sequence
from polycnc.language.syntec.expressions import ABOVE_COMPARISONS, OPERATORS, Reader
from polycnc.language.syntec.tokens import Token, fault
from polycnc.language.syntec.values import DOMAIN, VACANT, Text, storable
from polycnc.language.word_address.words import WordBlock, code_key, word_key
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.expressions.code import Code
    from polycnc.language.syntec.expressions import Evaluate

WRONG_SUFFIX = "COR-034"
#: Letters that may follow a comma: chamfer, rounding, angle.
SUFFIXES = "CRA"
NEVER_INDEXED = "GMNO"
MAX_DIGITS = 18
_WORD = regex(r"([A-Z])([-+]?)([\d.]+)")
#: How a word counts as written when its value is of a type; see `language.word_address.words`.
FORMS: dict[type, str] = {int: "", float: ".", Text: '"'}


class TypedBlock:
    """A block with at least one word whose value is known only when it runs.

    Args:
        keys: Signature keys of fixed codes, else `G`, `M` or an address.
        values: Gives one value for each word that is not a fixed code.
    """

    __slots__ = ("_shapes", "keys", "values")

    def __init__(self, keys: Sequence[tuple[str, bool]], values: Evaluate) -> None:
        self.keys = tuple(keys)
        self.values = values
        #: Types of the values to the signature that follows from them; blocks with computed codes have none.
        self._shapes: dict[tuple[type, ...], tuple[str, ...]] = {}

    def __call__(self, channel: Channel) -> None:
        """Run the block with the values of this moment."""
        values = self.values(channel)
        signature = self._shapes.get(tuple(map(type, values)))
        if signature is None:
            signature, values = self._shape(values)
        elif not isfinite(sum(values)):
            raise AlarmError(DOMAIN, hint="hint.syntec.overflow")
        plan = channel.mode.plans.get(signature)
        if plan is None:
            plan = channel.control.plan(channel, signature)
        channel.mode = plan.mode
        for step in plan.steps:
            step(channel, values)

    def _shape(self, values: Sequence[Any]) -> tuple[tuple[str, ...], Sequence[Any]]:
        """Signature and numbers of this run: computed codes in their place, vacant words left out."""
        signature: list[str] = []
        numbers: list[Any] = []
        following = iter(values)
        for key, fixed in self.keys:
            if fixed:
                signature.append(key)
                continue
            value = next(following)
            if value is VACANT:
                continue
            if key in ("G", "M"):
                signature.append(code_of(key, value))
            else:
                signature.append(key + FORMS[type(value)])
                numbers.append(storable(value))
        shape = tuple(signature)
        if len(numbers) == len(values) and not any(isinstance(number, Text) for number in numbers):
            self._shapes[tuple(map(type, values))] = shape
        return shape, numbers


def code_of(letter: str, value: Any) -> str:
    """The code that a value names: 43.4 behind `G` is `G43.4`."""
    if isinstance(value, Text) or value < 0:
        raise AlarmError("COR-023", address=letter)
    return code_key(letter, f"{value:.6g}" if isinstance(value, float) else str(value))


class BlockReader(Reader):
    """A reader that knows words."""

    def plain_block(self, token: Token) -> tuple[int | None, WordBlock]:
        """N number and words of a block that holds nothing but numbers."""
        sequence: int | None = None
        signature: list[str] = []
        values: list[float] = []
        for letter, sign, number in _WORD.findall(token.text.upper()):
            if len(number) > MAX_DIGITS or (sign and letter in "GMN"):
                raise fault(token)
            if letter == "N" and not signature:
                if not number.isdigit():
                    raise fault(token)
                sequence = int(number)
            elif letter in "GM":
                signature.append(code_key(letter, number))
            else:
                signature.append(word_key(letter, number))
                values.append(float(sign + number))
        return sequence, WordBlock(tuple(signature), values)

    def block(self) -> Step:
        """The words up to the end of the block, which stays unread."""
        keys: list[tuple[str, bool]] = []
        codes: list[Code] = []
        literal_words: list[tuple[str, float]] = []
        while not self.at_end() and not (keys and self.token.first and self.token.text != ","):
            address = self.address()
            literal = self._literal_word(address)
            if literal is not None:
                key, value = literal
                keys.append((key if value is None else address, value is None))
                if value is not None:
                    literal_words.append((key, value))
                    codes.append(self.lift(_typed(key, value)))
                continue
            keys.append((address, False))
            codes.append(self.expression(ABOVE_COMPARISONS))
        if len(literal_words) == len(codes):
            self.forget_literals()
            numbers = iter(literal_words)
            signature = tuple(key if fixed else next(numbers)[0] for key, fixed in keys)
            return WordBlock(signature, [value for _, value in literal_words])
        return TypedBlock(keys, self.evaluator(sequence(codes)))

    def at_end(self) -> bool:
        """Whether nothing more of the statement comes."""
        return self.token.kind == "end" or (self.token.kind == "symbol" and self.token.text == ";")

    def address(self) -> str:
        """The address of the next word: `X`, `X1` (with `=`), `,R`."""
        token = self.take()
        if token.kind == "symbol" and token.text == ",":
            letter = self.take()
            if letter.kind != "letter" or letter.text not in SUFFIXES:
                raise fault(letter, WRONG_SUFFIX)
            return "," + letter.text
        if token.kind != "letter":
            raise fault(token)
        if self.token.kind == "number" and self.token.text.isdigit():
            equals = self.tokens[self.place + 1]
            if equals.kind == "symbol" and equals.text == "=":
                if token.text in NEVER_INDEXED:
                    raise fault(equals)
                index = self.take().text
                self.take()
                return token.text + index
        elif self.token.text == "=" and token.text not in NEVER_INDEXED:
            self.take()
        return token.text

    def _literal_word(self, address: str) -> tuple[str, float | None] | None:
        """Key and value of a word with a plain number, None as value for a code; None for an expression."""
        at = self.place
        sign = ""
        if self.token.kind == "symbol" and self.token.text in ("-", "+"):
            sign = self.take().text
        token = self.token
        following = self.tokens[self.place + 1] if token.kind == "number" else token
        if token.kind != "number" or token.text[:2] in ("0x", "0X") or self._goes_on(following):
            self.place = at
            return None
        self.take()
        if len(token.text) > MAX_DIGITS:
            raise fault(token)
        if address in ("G", "M") and not sign:
            return code_key(address, token.text), None
        if address in ("G", "M"):
            raise fault(token)
        return _word_key(address, token.text), float(sign + token.text)

    def _goes_on(self, token: Token) -> bool:
        """Whether an operator makes a number part of an expression."""
        if token.kind not in ("symbol", "name") or (token.first and token.text == "/"):
            return False
        return token.text in OPERATORS and OPERATORS[token.text].power > ABOVE_COMPARISONS


def _word_key(address: str, number: str) -> str:
    return address + word_key("", number)


def _typed(key: str, value: float) -> int | float:
    """A literal among expressions: a Long where it has no decimal point."""
    return value if key[-1] in ".:;" or (value == 0.0 and str(value)[0] == "-") else int(value)
