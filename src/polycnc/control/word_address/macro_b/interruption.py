"""Interruption macros: M96 P enables a program that an input calls in the middle of a move, M97 disables it.

Where the input comes is part of the setup (`interrupts`). The move is cut there; whether the rest of it is still made
follows from what the interruption program does (FANUC macro B §6).
"""

from __future__ import annotations

from math import dist

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.block.codes import MCode
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.macro_b.variables import LOCALS
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.control.word_address.motion import skip

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.mode import Mode
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.control.word_address.motion.arc_signals import MadeArc
    from polycnc.machine.setup.values import Interrupt
    from polycnc.program import Program


@dataclass(frozen=True, slots=True)
class Interrupted:
    """What an interruption has cut off: the rest of the move, the modal state, the rows made until then.

    `arc` is the arc that the rest lies on; None where it is straight.
    """

    kind: Kind
    end: list[float]
    feed: float
    mode: Mode
    rows: int
    arc: MadeArc | None = None


@dataclass(slots=True)
class InterruptionState(State, lifetime=Lifetime.RESET):
    """The interruption program.

    Attributes:
        program: What M96 has named last.
        came: Numbers of the inputs that have come since.
        running: What has been cut and is not finished yet.
    """

    program: Program | None = None
    came: set[int] = field(default_factory=set)
    running: list[Interrupted] = field(default_factory=list)


def enable(channel: MacroChannel, words: Words) -> None:
    """M96 P: from now on an input calls this program."""
    number = words.integer("P")
    if number is None:
        raise words.fail("no_program", "M96")
    program = channel.control.find_program(channel, number)
    state = InterruptionState.of(channel)
    state.program, state.came, state.running = program, set(), []
    channel.mode = channel.mode.with_code("interruption", "M96")


def disable(channel: MacroChannel, _words: Words) -> None:
    """M97."""
    channel.mode = channel.mode.with_code("interruption", "M97")


#: The codes of the interruption macro; on machines without it they are the builder's.
M_CODES = {
    96: MCode(96, handler=enable, takes="P", silent=True),
    97: MCode(97, handler=disable, silent=True),
}


def m_row(builder: Builder, number: int) -> MCode | None:
    """M96 or M97 where 6003#7 MUS enables the interruption macro; a setup that names interrupt inputs means it."""
    channel: MacroChannel = builder.channel
    enabled = channel.memory.parameters.MUS
    if enabled is None:
        enabled = bool(channel.setup.switches.interrupts)
    return M_CODES.get(number) if enabled else None


def interruptible(builder: Builder, _plan: Plan, motion: Step | None) -> Step | None:
    """A motion that an input may cut."""
    if motion is None or builder.mode.codes.get("interruption") != "M96":
        return motion

    def move(channel: MacroChannel, values: list[float]) -> None:
        start, mark = channel.coordinates.position, channel.toolpath.mark()
        motion(channel, values)
        if not InterruptionState.of(channel).running:
            _interrupt(channel, start, mark)

    return move


def _interrupt(channel: MacroChannel, start: list[float], mark: int) -> None:
    """Look whether an input comes on the way just made, and call the program there."""
    state = InterruptionState.of(channel)
    chunk, end = channel.toolpath.chunk, channel.coordinates.position
    if state.program is None:
        return
    from polycnc.control.word_address.motion.arc_signals import made_arc  # interrupts are rare

    arc = made_arc(channel, start, mark)
    if arc is None and end == start:
        return  # a whole circle ends where it starts, too
    for number, interrupt in enumerate(channel.setup.switches.interrupts):
        if number in state.came or not _runs(channel, interrupt):
            continue
        stop = _stop(channel, start, end, arc, interrupt.at)
        if stop is None:
            continue
        plain = len(chunk) == mark + 1 and chunk.kind[-1] in (Kind.RAPID, Kind.FEED)
        if not (plain if arc is None else end != start or dist(stop, start) > NO_WAY):
            raise AlarmError("PC0001", hint="hint.not-supported", code="M96")
        state.came.add(number)
        kind, feed = Kind(chunk.kind[-1]), chunk.feed[-1]
        if not channel.memory.parameters.MIN:
            channel.toolpath.truncate(mark)
            channel.coordinates.arrive(start)
            _move(channel, kind, stop, feed, arc)
        cut = Interrupted(kind, end, feed, channel.mode, len(channel.toolpath), arc)
        state.running.append(cut)
        _call(channel, state.program)
        return


def _stop(
    channel: MacroChannel, start: list[float], end: list[float], arc: MadeArc | None, at: Mapping[str, float]
) -> list[float] | None:
    """Where on the way just made an input comes."""
    if arc is None:
        return skip.signal_position(channel, start, end, dict(at))
    share = arc.share_at(channel, at)
    return None if share is None else arc.position(share)


def _move(channel: MacroChannel, kind: Kind, end: list[float], feed: float, arc: MadeArc | None) -> None:
    """A part of the move; nothing where it has no way (a whole circle would be meant)."""
    if arc is None:
        channel.straight(kind, end, feed)
    elif dist(channel.coordinates.position, end) > NO_WAY:
        channel.curve(kind, end, feed, center=arc.center, normal=arc.normal)


def _runs(channel: MacroChannel, interrupt: Interrupt) -> bool:
    level = channel.level
    program = level.code.program.name if interrupt.program else channel.stack[0].code.program.name
    wanted = interrupt.program or program
    return level.code.program.name == wanted and level.code.line(level.current) == interrupt.line


def _call(channel: MacroChannel, program: Program) -> None:
    """6003#5 MSB = 0: with local variables of its own, as a macro; = 1 with those of the interrupted program."""
    memory = channel.memory
    if not memory.parameters.MSB:
        memory.locals = [None] * LOCALS
    channel.push(program, kind=LevelKind.INTERRUPT, local=memory.locals)


def finish(channel: MacroChannel, *, jumps: bool) -> None:
    """The interruption program is over: without NC statements in it, the rest of the cut move is made.

    Args:
        channel: The channel, on the interrupted level again.
        jumps: M99 P: it goes on elsewhere, with the modal state as the interruption left it.
    """
    state = InterruptionState.of(channel)
    cut = state.running.pop()
    if jumps:
        return
    channel.mode = cut.mode
    if len(channel.toolpath) == cut.rows:
        _move(channel, cut.kind, cut.end, cut.feed, cut.arc)


#: What an interruption macro cuts.
RULE = Rule("interruption macro", modes={"interruption": ("M96",)}, wrap=interruptible)
