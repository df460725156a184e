"""How the call of a cycle runs: as a program level of its own, whose blocks the cycle has planned.

On the control a cycle is a subprogram with SAVE, SBLOF and DISPLOF. Here it notes its blocks as lists of acts when
the first one is due, and the level runs one after the other. So a cycle may stop with M0, call what MCALL has set, or
run a contour program and plan what follows from it, and goes on behind it; what it shows is the block of its caller.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.stack import Level, LevelKind
from polycnc.control.sinumerik import auxiliary
from polycnc.control.sinumerik.block.single_block import RunningBlock
from polycnc.control.sinumerik.cycles.arguments import Arguments
from polycnc.control.sinumerik.cycles.moves import Moves
from polycnc.control.sinumerik.cycles.table import CYCLES
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion.last_move import LastMove
from polycnc.control.sinumerik.punching import block as punching
from polycnc.control.sinumerik.tools import stages
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.statements.sections import count_levels, end_of_subprogram
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.control.sinumerik.cycles.table import Cycle
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Acts of a block of a cycle that count as one block for the block limit.
ACTS_OF_A_BLOCK = 4
#: The plane of a cycle by the units of _DMODE; 0 and others: that of the caller.
PLANE_OF_DMODE = {1: "G17", 2: "G18", 3: "G19"}


class CycleProgram:
    """A running cycle as the program of its level; line and name are those of the calling block.

    Args:
        channel: The channel, with the caller as its running level.
        cycle: The row of its table.
        arguments: What it was called with.
        column: Column of the call.
    """

    def __init__(self, channel: SinumerikChannel, cycle: Cycle, arguments: Arguments, column: int) -> None:
        caller = channel.level
        self.program = caller.code.program
        self.whole = caller.code.whole
        self.steps: Sequence[Step | None] = ()
        self._line = channel.line
        self._column = column
        self._cycle = cycle
        self._arguments = arguments
        self._moves: Moves | None = None
        self._acted = False

    def step(self, index: int, *, alone: bool = False) -> Step | None:  # noqa: ARG002 - each is alone
        """A block of the cycle."""
        return partial(self._run, index)

    def line(self, index: int) -> int:  # noqa: ARG002 - DISPLOF: the calling block stands for all
        """The line of the call."""
        return self._line

    def column(self, index: int, address: str) -> int:  # noqa: ARG002 - there is no text
        """The column of the call."""
        return self._column

    def counts(self, index: int) -> bool:  # noqa: ARG002 - all are blocks
        """Every step is a block for stages that look ahead."""
        return True

    def word_columns(self, channel: Channel, position: int) -> int:  # noqa: ARG002 - there is no text
        """The column of the call."""
        return self._column

    def text(self, index: int) -> str:  # noqa: ARG002 - there is no text
        """Nothing: the blocks of a cycle have no text of their own."""
        return ""

    def _run(self, index: int, channel: SinumerikChannel) -> None:
        """One block; for single block operation the last one acts if any block of the cycle did."""
        block = RunningBlock.of(channel)
        mark = channel.toolpath.mark()
        try:
            moves = self._moves
            if moves is None:
                moves = self._moves = _planned(channel, self._cycle, self._arguments)
            for number, act in enumerate(
                moves.blocks[index], 1
            ):  # an act may plan more: of this block, and further ones
                if number % ACTS_OF_A_BLOCK == 0:
                    channel.once_more()
                act()
        except AlarmError as alarm:
            alarm.column = alarm.column or self._column
            raise
        block.acted = channel.toolpath.mark() != mark
        if index < len(moves.blocks) - 1:
            self._acted = self._acted or block.acted
        else:
            block.acted = self._acted or block.acted
            end_of_subprogram(channel)


#: Cycles that only choose how the path is run.
SETTINGS = frozenset(("CYCLE832",))


def start(channel: SinumerikChannel, name: str, values: tuple[Any, ...], column: int) -> None:
    """Begin a cycle on a level of its own; 14012 if there is none left, PC0001 for one that is not executed.

    That is none while a press strikes, but for settings: strokes belong to the blocks of programs.
    """
    cycle = CYCLES.get(name)
    if cycle is None:
        raise not_supported(name)
    if channel.mode[punching.GROUP] != punching.OFF and name not in SETTINGS:
        raise not_supported(f"{name} {channel.mode[punching.GROUP]}")
    begin(channel, name, cycle, values, column)


def begin(channel: SinumerikChannel, name: str, cycle: Cycle, values: tuple[Any, ...], column: int) -> None:
    """Begin what a row of the table says, as a program level; 14012 if there is none left."""
    arguments = Arguments(channel, name, tuple(cycle.signature.split()), values)
    count_levels(channel)
    channel.flush()
    caller = channel.level
    code = CycleProgram(channel, cycle, arguments, column)
    level = Level(code, program_number=caller.program_number, kind=LevelKind.CYCLE, locals=caller.locals)
    level.data["single_block"] = False
    level.data["sblof_in_proc"] = caller.data.get("single_block", True)
    if cycle.saves:
        level.data["saved"] = channel.control.save(channel)
    channel.stack.append(level)
    channel.level = level


def _planned(channel: SinumerikChannel, cycle: Cycle, arguments: Arguments) -> Moves:
    """The blocks of a cycle in the plane that _DMODE asks for."""
    plane = PLANE_OF_DMODE.get(arguments.digit("_DMODE", 0))
    if plane is not None and plane != channel.mode["plane"] and cycle.saves:
        channel.mode = channel.mode.with_code("plane", plane)
        stages.change_plane(channel)
        auxiliary.tool_changed(channel)
    if cycle.saves and channel.mode["compensation"] != "G40":
        raise AlarmError("61815", text=arguments.cycle)
    LastMove.of(channel).start = None
    moves = Moves(channel, arguments.integer("_AXN"))
    moves.plan(partial(cycle.plan, moves, arguments))
    return moves
