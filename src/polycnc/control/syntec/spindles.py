"""Spindles of SYNTEC: S words, G96 and G97, polygon turning G51.2, synchronisation G114.1 and G114.3.

Sources: manual 2.66, 2.84 to 2.86, chapter 6. A pair of spindles is in step as soon as it is commanded; the phase
(R) moves nothing that a path shows.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Note, declare
from polycnc.toolpath.events import SpindleSpeed

with loaded_when_called():
    from polycnc.transformation.couplings.coupled import Coupled
    from polycnc.transformation.couplings.laws import Ratio

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.control.word_address.block.codes import Planner, Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words

GEOMETRY_AXES = 3
#: Axis name codes (Pr321): the hundreds are the letter, the last two digits the index, 0 for none.
AXIS_LETTERS = "XYZABCUVW"
#: R register with the number of the active spindle.
ACTIVE_SPINDLE = 791
SPINDLES = range(1, 7)
#: Those that S1= to S10= name; spindles have no places that are X, Y or Z.
NAMED_SPINDLES, NO_GEOMETRY = range(1, 11), (-1, -1, -1)
#: Pr of base and sync spindle of each group K.
PAIRS = (1, 2, 3)
LARGEST_RATIO = 999


@dataclass(slots=True)
class SpindleState(State, lifetime=Lifetime.POWER):
    """The spindles.

    Attributes:
        speeds: Own S of each spindle; `reported` the speed last recorded.
        pairs: Spindles in step, by group K.
        surface_axis: Reference axis of G96.
    """

    speeds: dict[int, float] = field(default_factory=dict)
    reported: dict[int, float] = field(default_factory=dict)
    pairs: dict[int, SpindlePair] = field(default_factory=dict)
    surface_axis: int = 0


# ---- S --------------------------------------------------------------------------------------------------------


def plan_speed(builder: Builder) -> Step:
    """S: speed of the active spindle (R791, else 1); surface speed under G96."""
    slot = builder.slots["S"][0]

    def set_speed(channel: SyntecChannel, values: list[float]) -> None:
        active = channel.memory.globals.registers.get(ACTIVE_SPINDLE, 0) or 1
        command_speed(channel, active, values[slot], active=True)

    return declare(set_speed, Note(slot))


def plan_named_speed(spindle: int) -> Planner:
    """`S1=150`, `S2=2000`: the speed of a spindle by its number."""

    def plan(builder: Builder) -> Step:
        slot = builder.slots[f"S{spindle}"][0]

        def set_speed(channel: SyntecChannel, values: list[float]) -> None:
            active = channel.memory.globals.registers.get(ACTIVE_SPINDLE, 0) or 1
            command_speed(channel, spindle, values[slot], active=spindle == active)

        return set_speed

    return plan


def command_speed(channel: SyntecChannel, spindle: int, speed: float, *, active: bool) -> None:
    """A spindle's own S, and what follows from it for spindles in step with it."""
    state = SpindleState.of(channel)
    memory: SyntecMemory = channel.memory
    state.speeds[spindle] = speed
    if active:
        memory.spindle.speed = speed
        channel.context_changed()
    _report(channel, spindle)
    for pair in state.pairs.values():
        if pair.base == spindle:
            _report(channel, pair.sync)


def speed_of(memory: SyntecMemory, spindle: int) -> float:
    """The speed at which a spindle turns: its own, or what its pair makes of the base spindle's."""
    state = SpindleState.of(memory.channel)
    if not state.pairs:
        return state.speeds.get(spindle, 0.0)
    own = [state.speeds.get(number, 0.0) for number in NAMED_SPINDLES]
    for pair in state.pairs.values():
        if not pair.adds:
            own[pair.sync - 1] = 0.0
    laws = {pair.sync - 1: (Ratio(pair.base - 1, pair.ratio),) for pair in state.pairs.values()}
    return Coupled.of(laws, NO_GEOMETRY).to_machine(own)[spindle - 1]


def _report(channel: SyntecChannel, spindle: int) -> None:
    """Record a spindle's speed if it is another than before."""
    state = SpindleState.of(channel)
    memory: SyntecMemory = channel.memory
    speed = speed_of(memory, spindle)
    pair_speed = any(pair.sync == spindle for pair in state.pairs.values())
    if pair_speed and state.reported.get(spindle) == speed:
        return
    state.reported[spindle] = speed
    channel.event(SpindleSpeed(speed=int(speed) if speed == int(speed) else speed, spindle=spindle))


# ---- pairs ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class SpindlePair:
    """Two spindles in step: the base leads the sync spindle by `ratio`, to whose own speed that `adds`."""

    base: int
    sync: int
    ratio: float = 1.0
    adds: bool = False


def polygon_on(channel: SyntecChannel, words: Words) -> None:
    """G51.2 P Q R K: the sync spindle turns Q/P times as fast as the base spindle (2.84)."""
    p, q = _ratio_part(words, "P"), _ratio_part(words, "Q")
    _couple(channel, words, q / p)


def synchronise(channel: SyntecChannel, words: Words) -> None:
    """G114.1 R K: the sync spindle follows the base spindle 1:1 (2.85)."""
    _couple(channel, words, 1.0)


def superimpose(channel: SyntecChannel, words: Words) -> None:
    """G114.3 K: the sync spindle's own speed is added to that of the base spindle (2.86)."""
    _couple(channel, words, 1.0, adds=True)


def release(channel: SyntecChannel, words: Words) -> None:
    """G50.2, G113 [K]: a pair, or without K every pair, is no longer in step."""
    state = SpindleState.of(channel)
    groups = [_group(words)] if "K" in words else list(state.pairs)
    for group in groups:
        state.pairs.pop(group, None)


def _ratio_part(words: Words, address: str) -> int:
    value = words.typed(address)
    value = 1 if value is None else value
    if value != int(value) or not 1 <= value <= LARGEST_RATIO:
        raise words.fail("argument", address)
    return int(value)


def _group(words: Words) -> int:
    group = words.typed("K")
    group = 1 if group is None else group
    if group not in PAIRS:
        raise words.fail("spindle_group", "K")
    return int(group)


def _couple(channel: SyntecChannel, words: Words, ratio: float, *, adds: bool = False) -> None:
    state = SpindleState.of(channel)
    memory: SyntecMemory = channel.memory
    group = _group(words)
    base, sync = memory.parameters.spindle_pairs[2 * group - 2 : 2 * group]
    if base not in SPINDLES:
        raise words.fail("base_spindle")
    if sync not in SPINDLES or sync == base:
        raise words.fail("sync_spindle")
    used_as_sync = {pair.sync for pair in state.pairs.values()}
    used_as_base = {pair.base for pair in state.pairs.values()}
    if group in state.pairs or sync in used_as_sync | used_as_base or base in used_as_sync:
        raise words.fail("spindle_repeated")
    state.pairs[group] = SpindlePair(base, sync, ratio, adds)
    if state.speeds.get(base):
        _report(channel, sync)


# ---- G96, G97 -------------------------------------------------------------------------------------------------


def axis_name(code: int) -> str:
    """The axis name of a name code: 100 is X, 101 X1, 302 Z2; empty for none."""
    letter, index = divmod(code, 100)
    if not 1 <= letter <= len(AXIS_LETTERS):
        return ""
    return AXIS_LETTERS[letter - 1] + (str(index) if index else "")


def constant_surface_speed(channel: SyntecChannel, words: Words) -> None:
    """G96 S P: surface speed in m/min or feet/min; P names the axis whose position is the diameter."""
    state = SpindleState.of(channel)
    reference = words.typed("P")
    if reference is not None:
        state.surface_axis = _reference_axis(channel, words, reference)
    axis = state.surface_axis
    if channel.axis_data[axis].rotary:
        raise words.fail("surface_axis", "P")
    channel.context_changed()


def _reference_axis(channel: SyntecChannel, words: Words, reference: float) -> int:
    """P 1 to 3 a geometry axis, 0 the first axis, 100 to 999 an axis name code."""
    if reference != int(reference) or reference < 0:
        raise words.fail("surface_axis", "P")
    if reference == 0:
        return 0
    if reference <= GEOMETRY_AXES:
        axis = channel.coordinates.geometry[int(reference) - 1]
    else:
        axis = channel.axis_index.get(axis_name(int(reference)), -1)
    if axis < 0:
        raise words.fail("surface_axis", "P")
    return axis


def end_surface_speed(channel: SyntecChannel, _words: Words) -> None:
    """G97 S: revolutions per minute again; without S the speed that ran last holds."""
    channel.context_changed()
