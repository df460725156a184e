"""What the execution of a channel asks of those around it."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from polycnc.mainrun.preparation.items import Block, Happening


class Machinery(Protocol):
    """What carries out the program's events on the machine."""

    def skip(self) -> None:
        """The skip input comes, and goes."""

    def perform(self, happening: Happening) -> None:
        """An event of the program."""

    def synchronise(self) -> None:
        """The program is about to read signals."""

    def enter(self, block: Block) -> None:
        """A block begins."""

    def halted(self, reason: str) -> None:
        """The run has halted of its own accord."""

    @property
    def busy(self) -> bool:
        """Whether functions are under way that the next block waits for."""

    @property
    def stands(self) -> bool:
        """Whether the axes stand for one of them."""

    @property
    def is_open(self) -> bool:
        """Whether nobody knows yet how long one of them takes."""

    @property
    def due(self) -> float:
        """When something happens on the machine next; inf where nothing will."""

    def advance(self, time: float) -> None:
        """Let happen what is due."""
