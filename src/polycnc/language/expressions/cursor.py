"""A place among the tokens of a text."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Generic, Protocol, TypeVar

if TYPE_CHECKING:
    from collections.abc import Sequence


class Token(Protocol):
    """A token, as far as a cursor looks at it."""

    @property
    def kind(self) -> str:
        """What it is; behind the last one comes one of kind `end`."""

    @property
    def text(self) -> str:
        """Its text in the form that is compared."""


T = TypeVar("T", bound=Token)


class Cursor(Generic[T]):
    """A place among tokens.

    Attributes:
        tokens: The text, closed by an `end` token.
        place: Index of the next token.
    """

    #: Kinds of tokens that are known by their text: keywords and signs.
    FIXED: tuple[str, ...] = ("op", "name")

    def __init__(self, tokens: Sequence[T]) -> None:
        self.tokens = tokens
        self.place = 0

    @property
    def token(self) -> T:
        """The next token."""
        return self.tokens[self.place]

    def ahead(self, count: int = 1) -> T:
        """A token behind the next one."""
        return self.tokens[min(self.place + count, len(self.tokens) - 1)]

    def take(self) -> T:
        """Read the next token; the closing one stays."""
        token = self.tokens[self.place]
        if token.kind != "end":
            self.place += 1
        return token

    def at(self, text: str) -> bool:
        """Whether the next token is this sign or keyword."""
        token = self.tokens[self.place]
        return token.text == text and token.kind in self.FIXED

    def accept(self, text: str) -> bool:
        """Read the next token if it is this sign or keyword."""
        if self.at(text):
            self.place += 1
            return True
        return False
