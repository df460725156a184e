"""M96 and M97: an input interrupts the running block and calls a subprogram (manual 3.2).

The block that was interrupted is read again after the return: under G90 it makes the rest of its way, under G91 its
whole increment. While M96 is active the modal state says so, so that only then motion asks for the signal.
"""

from __future__ import annotations

from math import nan

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.syntec.motion.smoothing import SmoothingState
from polycnc.control.syntec.spindles import SpindleState
from polycnc.control.word_address.auxiliary import machine_codes
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.motion import path
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.control.word_address.motion import arc_signals, skip

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.stack import Level
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import MCode, Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.motion.arc_signals import MadeArc
    from polycnc.program import Program

GROUP, ON, OFF = "interrupt", "M96", "M97"
#: Pr3600 as delivered.
DELIVERED = 96
LAST_PROGRAM, LAST_BIT, LAST_REGISTER, REGISTER_BITS = 9999, 511, 65535, 16
#: Modal states in which the signal has no effect: group and the code that is none of them (3.2.3, 10).
DEAF = {
    "polar_interpolation": "G13.1",
    "polar": "G15",
    "compensation": "G40",
    "scaling": "G50",
    "mirror": "G50.1",
}
STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}


@dataclass(slots=True)
class Interrupt:
    """What M96 has prepared.

    Attributes:
        program: The program.
        signal: The name of the signal.
        hold_s: How long it has to last before it calls.
        left_s: How long it has still to last; None while it has not come.
        rows: Rows of the toolpath behind the last move in which it has lasted.
        armed: Whether it is still awaited.
    """

    program: Program
    signal: str
    hold_s: float = 0.0
    left_s: float | None = None
    rows: int = 0
    armed: bool = True


@dataclass(slots=True)
class InterruptState(State, lifetime=Lifetime.RESET):
    """What M96 has prepared."""

    prepared: Interrupt | None = None


def interrupts_on(channel: SyntecChannel, words: Words) -> None:
    """M96 P [I Q] [R] [L]: from now on the signal calls program P."""
    number = _whole(words, "P", 1, LAST_PROGRAM)
    if number is None:
        raise words.fail("interrupt_format", "M96")
    signal = _signal(words)
    _whole(words, "R", 0, 1)
    hold_s = (_whole(words, "L", 0, 2**31 - 1) or 0) / 1000.0
    channel.flush()
    program = channel.control.find_program(channel, number)
    InterruptState.of(channel).prepared = Interrupt(program, signal, hold_s)
    channel.mode = channel.mode.with_code(GROUP, ON)


def interrupts_off(channel: SyntecChannel, _words: Words) -> None:
    """M97."""
    channel.flush()
    InterruptState.of(channel).prepared = None
    channel.mode = channel.mode.with_code(GROUP, OFF)


def m_row(builder: Builder, number: int) -> MCode | None:
    """Pr3600 is the number of M96, and that of M97 the next one (general knowledge); else both are the builder's."""
    channel: SyntecChannel = builder.channel
    on = channel.memory.parameters.interrupt_m
    if on == DELIVERED or number not in (on, on + 1, DELIVERED, DELIVERED + 1):
        return None
    if number in (on, on + 1):
        return replace(channel.control.m_codes[DELIVERED + number - on], code=number)
    return machine_codes.m_row(channel, None, number)


def _whole(words: Words, address: str, low: int, high: int) -> int | None:
    value = words.typed(address)
    if value is None:
        return None
    if value != int(value) or not low <= value <= high:
        raise words.fail("interrupt_format", address)
    return int(value)


def _signal(words: Words) -> str:
    """C49; or I 1 to 3: a bit of R (Q is register and two digits of bit), I or A."""
    family = _whole(words, "I", 1, 3)
    if family is None:
        return "C49"
    bit = _whole(words, "Q", 0, LAST_REGISTER * 100 + REGISTER_BITS - 1 if family == 1 else LAST_BIT)
    if bit is None or (family == 1 and bit % 100 >= REGISTER_BITS):
        raise words.fail("interrupt_format", "Q")
    return f"R{bit // 100}.{bit % 100}" if family == 1 else f"{'IA'[family - 2]}{bit}"


def _is_on(builder: Builder) -> bool:
    """Whether motion must ask for the signal."""
    codes = builder.mode.codes
    return codes.get(GROUP, OFF) == ON and all(codes[group] == none for group, none in DEAF.items())


def _with_interrupt(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A motion that ends where the signal comes and calls the subprogram there."""
    if step is None or not _is_on(builder):
        return step
    kind = STRAIGHT.get(builder.mode["motion"])

    def move(channel: SyntecChannel, values: list[float]) -> None:
        interrupt = InterruptState.of(channel).prepared
        at = channel.setup.switches.signals_at.get(interrupt.signal) if interrupt else None
        if interrupt is None or not interrupt.armed or not at or _is_deaf(channel):
            step(channel, values)
            return
        if kind is None or interrupt.hold_s:
            _cut(channel, step, values, interrupt, at)
            return
        c = channel.coordinates
        end = c.to_position(path.target(channel, plan.axis_words, values))
        stopped = skip.signal_position(channel, c.position, end, at)
        if stopped is None:
            step(channel, values)
            return
        interrupt.armed = False
        channel.straight(kind, stopped, nan if kind is Kind.RAPID else channel.feed)
        _call(channel, interrupt.program)

    return move


def _cut(
    channel: SyntecChannel, step: Step, values: list[float], interrupt: Interrupt, at: Mapping[str, float]
) -> None:
    """A move whose row is made first, and cut where the signal comes, or has lasted for the time of L.

    After the return its block is read from there: I, J and K count from the new start, as the manual warns (3.2.3, 7).
    """
    c, mark = channel.coordinates, channel.toolpath.mark()
    start, programmed = c.position[:], c.programmed[:]
    step(channel, values)
    if channel.toolpath.mark() == mark and c.position == start:
        return  # the first half of G02.4, a block without a way
    row = _made_row(channel, start, mark)
    if row is None:
        raise channel.control.not_yet(f"M96 {channel.mode['motion']}")
    share = _share_of_call(channel, row, mark, interrupt, at)
    if share is None:
        return
    interrupt.armed = False
    channel.toolpath.truncate(mark)
    c.arrive(start, programmed)
    if share > 0.0:
        row.make(channel, share)
    _call(channel, interrupt.program)


class MadeLine(NamedTuple):
    """A straight move whose row stands in the toolpath: its kind and feed, where it begins and ends (display)."""

    kind: Kind
    feed: float
    start: list[float]
    end: list[float]

    def share_at(self, channel: SyntecChannel, at: Mapping[str, float]) -> float | None:
        """The share of the way after which a signal comes."""
        return skip.fraction_at(channel, self.start, self.end, at)

    def make(self, channel: SyntecChannel, share: float) -> None:
        """The move up to a share of its way."""
        end = [a + (b - a) * share for a, b in zip(self.start, self.end, strict=True)]
        channel.straight(self.kind, end, self.feed)


def _made_row(channel: SyntecChannel, start: list[float], mark: int) -> MadeArc | MadeLine | None:
    """The move that is all that a block has made since a mark; None where it is something else."""
    chunk = channel.toolpath.chunk
    if len(chunk) == mark + 1 and chunk.kind[-1] in STRAIGHT.values() and not channel.path.changes_ends:
        return MadeLine(Kind(chunk.kind[-1]), chunk.feed[-1], start, channel.coordinates.position[:])
    return arc_signals.made_arc(channel, start, mark)


def _share_of_call(
    channel: SyntecChannel, row: MadeArc | MadeLine, mark: int, interrupt: Interrupt, at: Mapping[str, float]
) -> float | None:
    """The share of a made move after which the program is called; None where that is not in it.

    The time that the signal has to last goes on in the moves behind the one in which it came. Where something else has
    taken time between them, or a clock runs, it is not known.
    """
    came, left_s = 0.0, interrupt.left_s
    if left_s is None:
        share = row.share_at(channel, at)
        if share is None or not interrupt.hold_s:
            return share
        came, left_s = share, interrupt.hold_s
    elif len(channel.toolpath) - 1 != interrupt.rows:
        raise channel.control.not_yet("M96 L", "L")
    if channel.move_times is None:
        raise channel.control.not_yet("M96 L", "L")
    share, interrupt.left_s = channel.move_times.later_on_row(channel, mark, row.start, came, left_s)
    interrupt.rows = len(channel.toolpath)
    return share


def _is_deaf(channel: SyntecChannel) -> bool:
    """Whether spindles are in step, or G05 or G05.1 bends the path: the signal has no effect then."""
    return bool(SpindleState.of(channel).pairs) or SmoothingState.of(channel).tolerance > 0.0


def _call(channel: SyntecChannel, program: Program) -> None:
    """Call the subprogram; the block that runs will be read again."""
    caller = channel.level
    caller.index = caller.current
    channel.control.check_nesting(channel, LevelKind.INTERRUPT)
    level = channel.push(program, kind=LevelKind.INTERRUPT, local=caller.locals)
    level.data["break"] = channel.coordinates.position[:]


def go_back(channel: SyntecChannel, ended: Level) -> None:
    """M99 of the interrupt subprogram: rapid to where the block was interrupted."""
    if ended.kind is LevelKind.INTERRUPT:
        channel.straight(Kind.RAPID, ended.data["break"][:], nan)


def check_off(channel: SyntecChannel) -> None:
    """COR-117: the main program ends without M97."""
    if channel.mode.codes.get(GROUP, OFF) == ON:
        raise channel.control.fail("interrupt_left_on")


#: What an interrupt cuts.
RULE = Rule("interrupts", modes={GROUP: (ON,)}, in_cycles=False, wrap=_with_interrupt)
