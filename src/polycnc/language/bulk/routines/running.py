"""Routines that a scan runs: what it must know of the channel, and where the channel stands behind it."""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.language.bulk.layout import LOCALS, LOOPS, MOST_FRAMES
from polycnc.language.bulk.routines.kept import Routines
from polycnc.language.bulk.routines.layout import NO_ROUTINE, Frame

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.stack import Level
    from polycnc.language.bulk.layout import State
    from polycnc.language.bulk.recipe import Spelling
    from polycnc.language.bulk.routines.statements import Statement
    from polycnc.language.bulk.scannable import Scannable, ScannedChannel
    from polycnc.language.bulk.shapes import Shapes
    from polycnc.program import Program


class RoutineDialect(Protocol):
    """What a control tells of programs that are called, and of loops; see `scanner.Dialect`."""

    def told(self, channel: Any, code: Any, index: int, is_met: bool) -> Statement:
        """What a step of a program does; `UNREAD` where that is not known before the channel has come to it."""

    def most_frames(self, channel: Any) -> int:
        """How many programs may be called within each other from here on."""

    def program_called(self, channel: Any, number: int) -> Program | None:
        """The program of a number, None for one that the interpreter calls."""

    def enter(
        self, channel: Any, code: Any, repeats: int, first: int, variables: Sequence[float] | None
    ) -> None:
        """Put a program on the stack that is called, with local variables of its own unless None."""

    def take_locals(self, channel: Any, before: Sequence[float], after: Sequence[float]) -> None:
        """Local variables of the running level that have changed."""

    def take_common(self, channel: Any, before: Sequence[float], after: Sequence[float]) -> None:
        """Other variables that have changed."""

    def put_loops(self, level: Level[Any], loops: Sequence[int]) -> list[int]:
        """By their numbers the steps behind those that have opened the loops of a level."""

    def take_loops(self, level: Level[Any], before: Sequence[int], after: Sequence[int]) -> None:
        """Loops of a level that have been opened or have ended."""

    def loop_around(self, channel: Any) -> tuple[int, int]:
        """First step, and how many there are, of the part of the running program that may come round again; else 0."""


class RunningRoutines:
    """The routines of a channel.

    Args:
        dialect: The control's part.
        state: What a scan carries along.
        spelling: How the control's text looks.
    """

    def __init__(self, dialect: RoutineDialect, state: State, spelling: Spelling) -> None:
        self._dialect = dialect
        self._state = state
        self._spelling = spelling
        self.known: Routines
        self._before = array("d")
        self._loops = [0] * LOOPS

    def forget(self, shapes: Shapes) -> None:
        """All routines are read anew, for new shapes."""
        self.known = Routines(shapes, self._spelling, self._dialect.told)

    # ---- in front of a scan --------------------------------------------------------------------------

    def allow_calls(self, channel: ScannedChannel) -> None:
        """Programs may be called, as deep as the control has it."""
        self._state.scan.most_frames = min(MOST_FRAMES, self._dialect.most_frames(channel))

    def begin(self) -> None:
        """The channel's variables are at hand."""
        self._before = self._state.variables[:]  # type: ignore[assignment]  # an array

    def begin_loop(self, channel: ScannedChannel) -> bool:
        """The scan runs the loop that the channel is in, from the next block on; false where it cannot."""
        level, at = channel.level, self._state.scan
        first, count = self._dialect.loop_around(channel)
        if count == 0:
            return False
        at.routine = self.known.number(channel, level.code, first, count, level.program_number)
        at.index = at.current = level.index
        self._loops = self._dialect.put_loops(level, self._state.loops)
        for number, loop in enumerate(self._loops):
            self._state.loops[number] = loop
        return True

    # ---- behind it -----------------------------------------------------------------------------------

    def learn_callee(self, channel: ScannedChannel) -> bool:
        """Keep what the program is that a block calls; false while no block has called it: the first call is run."""
        number = self._state.scan.called
        program = self._dialect.program_called(channel, number)
        if program is None:
            self.known.learn_callee(channel, number, None, 0)
            return True
        if program.name not in channel.toolpath.programs:
            return False
        code: Scannable = channel.executable(program)
        self.known.learn_callee(channel, number, code, channel.toolpath.program_number(program.name))
        return True

    def read_lines(self, channel: ScannedChannel) -> bool:
        """Read the line at which the scan has ended; false where it must be run first."""
        at = self._state.scan
        return self.known.read_lines(channel, at.routine, at.index)

    def place(self) -> tuple[Scannable, int] | None:
        """Program and step of the routine at which the scan has ended; None where it ended in the text."""
        at = self._state.scan
        return None if at.routine == NO_ROUTINE else (self.known.kept[at.routine].code, at.index)

    def take(self, channel: ScannedChannel) -> None:
        """The channel's variables, loops and levels are as the scan has left them.

        The running level is the one in which it began; the programs that it was in come on top.
        """
        state, at, level = self._state, self._state.scan, channel.level
        frames = [state.frames[Frame.SIZE * i : Frame.SIZE * (i + 1)] for i in range(at.frames)]
        variables = [
            state.saved[LOCALS * i : LOCALS * (i + 1)]
            for i, frame in enumerate(frames)
            if frame[Frame.IS_MACRO]
        ]
        variables.append(state.variables[:LOCALS])
        self._dialect.take_locals(channel, self._before, variables[0])
        self._dialect.take_common(channel, self._before, state.variables)
        loops = [list(frame[Frame.LOOPS : Frame.LOOPS + LOOPS]) for frame in frames]
        loops.append(list(state.loops))
        if (frames[0][Frame.CALLER] if frames else at.routine) != NO_ROUTINE:
            self._dialect.take_loops(level, self._loops, loops[0])
        own = iter(variables[1:])
        for i, frame in enumerate(frames):
            if frame[Frame.CALLER] != NO_ROUTINE:
                channel.level.index = frame[Frame.BACK_AT]
                channel.level.current = channel.level.index - 1
            code, first, _ = self.known.kept[frame[Frame.CALLED]]
            local = next(own) if frame[Frame.IS_MACRO] else None
            self._dialect.enter(channel, code, frame[Frame.REPEATS], first, local)
            self._dialect.take_loops(channel.level, [0] * LOOPS, loops[i + 1])
        if at.routine != NO_ROUTINE:
            channel.level.index, channel.level.current = at.index, at.current
