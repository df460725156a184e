"""What a channel asks of those around it: its control, what scans plain blocks, the main run, what limits moves."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.travel import Travel, Wall
    from polycnc.channel.stack import Executable, Level
    from polycnc.channel.steps import Step
    from polycnc.messages import AlarmError
    from polycnc.program import Program
    from polycnc.toolpath import Context


class Control(Protocol):
    """What a channel asks of a control family."""

    id: str

    def compile(self, program: Program) -> Executable:
        """Make a program ready to run."""

    def start_position(self, channel: Channel, shown: list[float]) -> list[float]:
        """Where the axes stand at power-on, in internal units; the memory is not made yet."""

    def start(self, channel: Channel) -> None:
        """Bring a channel into the state of power-on and program start; sets `mode` and `memory`."""

    def begin(self, channel: Channel) -> None:
        """A main program begins in the state that the channel is in; its level is the running one."""

    def end_of_program(self, channel: Channel) -> None:
        """A level has run out of blocks."""

    def context(self, channel: Channel) -> Context:
        """The context that holds now."""

    def over_travel(self, axis: str, direction: int) -> AlarmError:
        """The alarm for a target beyond a limit of an axis; direction is 1 or -1."""

    def halts(self, channel: Channel, level: Level, step: Step) -> bool:
        """Whether single block operation halts behind the block that `step` of `level` was."""

    def block_limit(self) -> AlarmError:
        """The alarm for a program that has run more blocks than allowed."""

    def arithmetic_alarm(self, error: ArithmeticError) -> AlarmError:
        """The alarm for a division by zero or an overflow in an expression."""


class Scanner(Protocol):
    """What works off the plain blocks of a channel without running them one by one."""

    def lead(self, channel: Channel) -> range:
        """Work off plain blocks; gives as many numbers as blocks are the interpreter's before the next try."""

    def turn(self, channel: Channel) -> int:
        """Work off the loop that the channel is in, from the running block on; gives how many blocks were counted."""


class Bulk(Protocol):
    """Whether and how plain blocks are scanned (`language/bulk/`)."""

    def pays(self, lines: int) -> bool:
        """Whether a program of so many lines is long enough, or a loop that has run so many blocks."""

    def scanner(self, channel: Channel) -> Scanner | None:
        """What scans for a channel; None where every block is interpreted."""


class MainRun(Protocol):
    """What executes the channel's rows, if anything does while the channel runs.

    Attributes:
        one_block: The operator halts it behind every block.
    """

    one_block: bool

    def end_held_block(self) -> None:
        """The rows written last end a block that a stage has held back: what is written next is of another one."""

    @property
    def has_caught_up(self) -> bool:
        """Whether everything that the channel has written is executed."""


class Boundary(Protocol):
    """What moves must keep to beside the machine's travel: forbidden zones, limits of setup and program."""

    def check(self, channel: Channel, travel: Travel) -> None:
        """Raise the control's alarm where the way of a move is forbidden."""

    def walls(self, channel: Channel, context: Context) -> Iterable[Wall]:
        """What of it straight moves of a context keep to at every point, if they do at their ends."""

    def comes_near(self, channel: Channel, start: list[float], end: list[float], distance: float) -> bool:
        """Whether a straight way comes nearer than a distance, mm, to anything else that is forbidden.

        The way is one of machine positions.
        """
