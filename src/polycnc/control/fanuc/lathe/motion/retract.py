"""G10.6: the tool retracts when the operator asks for it, and comes back (general knowledge of the 30i series).

The signal TRESC of a setup comes at a place on the way of a move. The tool leaves it there, goes the way that G10.6
has told, and halts; the next start leads it back, and the rest of the move is made. It comes once.
"""

from __future__ import annotations

from math import nan

from polycnc.control.fanuc.lathe.motion.threads import ThreadState
from polycnc.control.fanuc.lathe.states import RetractState
from polycnc.control.fanuc.lathe.tools.offsets import THREADS
from polycnc.control.word_address.motion.arc_signals import made_arc
from polycnc.control.word_address.motion.skip import fraction_at
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words

#: The signal of a setup, and what the halt is called.
SIGNAL = "TRESC"
LINES = frozenset({"G0", "G1"})
MOTIONS = LINES | {"G2", "G3"} | THREADS


def prepare(channel: LatheChannel, words: Words) -> None:
    """G10.6 X Z: where the tool retracts to, U W: how far; alone, how far 7741 says for each axis."""
    state, of = RetractState.of(channel), channel.memory.parameters.of
    state.ends = list(words.axes())
    if not state.ends:
        amounts = [of(name).retract_amount for name in channel.axes]
        state.ends = [(axis, amount, True) for axis, amount in enumerate(amounts) if amount]
    ThreadState.of(channel).retract_axes = frozenset(axis for axis, _, _ in words.axes())
    channel.modes.forget_plans()


def with_retract(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """A move that the signal may cut."""
    motion = builder.mode["motion"]
    if step is None or motion not in MOTIONS:
        return step

    def move(channel: LatheChannel, values: list[float]) -> None:
        c, mark = channel.coordinates, channel.toolpath.mark()
        start, programmed = c.position[:], c.programmed[:]
        step(channel, values)
        if not RetractState.of(channel).came:
            _cut(channel, mark, start, programmed, motion)

    return move


def _cut(channel: LatheChannel, mark: int, start: list[float], programmed: list[float], motion: str) -> None:
    """Cut the row of the block that runs where the signal comes; nothing where it does not."""
    c, state = channel.coordinates, RetractState.of(channel)
    at, end, last = channel.setup.switches.signals_at[SIGNAL], c.position[:], c.programmed[:]
    arc = made_arc(channel, start, mark)
    share = fraction_at(channel, start, end, at) if arc is None else arc.share_at(channel, at)
    if share is None or (arc is None and start == end):
        return
    chunk = channel.toolpath.chunk
    is_line = motion in LINES and len(chunk) == mark + 1 and not channel.path.changes_ends
    if arc is None and not is_line:
        raise AlarmError("PC0001", hint="hint.not-supported", code=f"G10.6 {motion}")
    state.came = True
    kind, feed = Kind(chunk.kind[-1]), chunk.feed[-1]
    channel.toolpath.truncate(mark)
    c.arrive(start, programmed)
    left = (
        [a + (b - a) * share for a, b in zip(start, end, strict=True)] if arc is None else arc.position(share)
    )
    if arc is None:
        channel.straight(kind, left[:], feed)
    elif share > 0.0:
        arc.make(channel, share)
    speed = channel.memory.parameters.of(channel.axes[0]).retract_speed / 60.0 or nan
    channel.straight(Kind.RAPID, _retracted(channel, left), speed)
    channel.stop(SIGNAL)
    channel.straight(Kind.RAPID, left[:], speed)
    if arc is None:
        channel.straight(kind, end, feed, last)
    elif share < 1.0:
        channel.curve(kind, end, feed, center=arc.center, normal=arc.normal, programmed=last)


def _retracted(channel: LatheChannel, left: list[float]) -> list[float]:
    """Where the tool retracts to from a position of the display."""
    c = channel.coordinates
    point = list(c.to_programmed(left))
    for axis, value, incremental in RetractState.of(channel).ends:
        point[axis] = point[axis] + value if incremental else value
    return list(c.to_position(point))
