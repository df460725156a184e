"""What a program must be for the scanner, and what a control tells it. For type checkers: no run needs this."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from polycnc.channel.stack import Executable

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.kernels.layout import Floats
    from polycnc.language.bulk.recipe import Drilled, Recipe, Spelling
    from polycnc.language.bulk.routines.running import RoutineDialect
    from polycnc.language.bulk.scanner import LastMoves


class Scannable(Executable, Protocol):
    """A program whose steps are lines of text."""

    def line_of_step(self, index: int) -> int:
        """Index of a step's line in the program's text."""

    def step_of_line(self, line: int) -> int:
        """The first step at or behind a line of the text."""

    def scannable_to(self, line: int) -> int:
        """The line behind those that may be read as one block each, from a line of the text on."""


#: A channel whose programs are such.
ScannedChannel: TypeAlias = "Channel[Any, Any, Scannable]"


class Dialect(Protocol):
    """What a control tells of its plain blocks; its `plain_blocks(channel)` gives one, or None.

    Attributes:
        spelling: How its text looks.
    """

    spelling: Spelling

    @property
    def routines(self) -> RoutineDialect | None:
        """What it tells of programs that are called and of loops; None where these are the interpreter's.

        A program that has none of them does not ask.
        """

    def ready(self, channel: Channel) -> bool:
        """Whether plain blocks may be scanned now: nothing watches single blocks or holds moves back."""

    def generation(self, channel: Channel) -> Hashable:
        """Something that changes when recipes given before no longer hold."""

    def state(self, channel: Channel) -> Hashable:
        """The modal state that holds."""

    def enter(self, channel: Channel, state: Any) -> None:
        """Bring the modal state about that blocks have left."""

    def recipe(self, channel: Channel, keys: Sequence[int], line: str) -> Recipe | None:
        """What a block of a shape does in the channel's modal state; None for one that is not plain."""

    def owes(self, channel: Channel) -> bool:
        """Whether incremental words are still owed something."""

    def limits(self, channel: Channel) -> Sequence[tuple[float, float]]:
        """Machine positions of every axis beyond which the interpreter decides; nothing where none has a limit."""

    def tolerance(self, channel: Channel) -> float:
        """Allowed difference between the radii at an arc's start and end, mm."""

    def recipe_of_step(self, channel: Channel, code: Any, step: int, keys: Sequence[int]) -> Recipe | None:
        """As `recipe`, for a block of a routine."""

    def numbered(self, channel: Channel) -> int:
        """Variables below this number may be named by their numbers in text."""

    def put_variables(self, channel: Channel, variables: Floats) -> None:
        """Give the kernel the variables that formulas may read, by number; not a number for a vacant one."""

    def tool(self, channel: Channel) -> Sequence[float]:
        """What must be known to stand the tool along a direction; nothing where no block names one."""

    def drilled(self, channel: Channel) -> Drilled | None:
        """The strokes of the next hole; None where the interpreter drills."""

    def turned(self, channel: Channel, start: list[float], end: list[float]) -> None:
        """Blocks have stood the tool along directions, the last one between two positions."""

    def moved(self, channel: Channel, last: LastMoves) -> None:
        """Blocks have moved the channel; for controls that remember how."""
