"""Oscillation of an axis beside the program: G81.1 until G80, G81.2 until G80.2 (manual 2.51, 2.78, 2.79).

The way to the R point is part of the path. The strokes run beside it (`word_address/motion/oscillation.py`), so the
toolpath does not show them; on the path the axis stands at its R point, and behind the end where that has led it.
R19 is the feed override of all that, in percent; the way to R is no faster than at 100 %.
"""

from __future__ import annotations

from functools import partial
from math import nan

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.syntec.axis_groups.names import CODES, axis_of_code
from polycnc.control.syntec.motion.moves import rapid_as
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.motion.oscillation import (
    Fixed,
    Oscillator,
    Read,
    Strokes,
    speed_of_feed,
)
from polycnc.control.word_address.transformations.normal_stage import NormalStage
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.motion.oscillation import Source

OSCILLATION, OFF, SIMPLE, PRECISE = "oscillation", "G80.2", "G81.1", "G81.2"
#: R register of the feed override of oscillation, percent, and what it may hold.
OVERRIDE, PERCENTAGES = 19, (0, 150)
#: What changes the coordinates of an axis that oscillates.
FRAME_CODES = frozenset(
    {
        *(f"G{i}" for i in range(54, 60)),
        *(f"G59.{i}" for i in range(1, 10)),
        "G92",
        "G92.1",
        "G68",
        "G68.2",
        "G68.3",
    }
)


@dataclass(frozen=True, slots=True)
class Oscillation:
    """An axis that oscillates; machine positions.

    Attributes:
        axis: Its column.
        source: The data of its strokes.
        home: The R point.
    """

    axis: int
    source: Source
    home: float


@dataclass(slots=True)
class OscillationState(State, lifetime=Lifetime.POWER):
    """The axis that oscillates; `precise` by G81.2, `was_precise` that there was one, on `precise_axis`."""

    running: Oscillation | None = lasting(Lifetime.RESET, None)
    precise: bool = lasting(Lifetime.RESET, default=False)
    was_precise: bool = False
    precise_axis: int = 0


def start(channel: SyntecChannel, words: Words) -> None:
    """G81.1 Z Q R F: upper vertex (machine), from there the way to the lower one and to the R point."""
    if OscillationState.of(channel).running is not None:
        raise words.fail("oscillation_repeated", SIMPLE)
    _refuse_transformations(channel, words, SIMPLE)
    named = words.axes()
    if len(named) != 1:
        raise words.fail("argument", SIMPLE)
    axis, upper, _ = named[0]
    stroke, home = (words.way(address, rotary=channel.axis_data[axis].rotary) for address in "QR")
    if stroke is None or home is None:
        raise words.fail("argument", SIMPLE)
    strokes = Strokes((upper, upper + stroke), speed_of_feed(channel, axis))
    _begin(channel, Oscillation(axis, Fixed(strokes), upper + home))


def end(channel: SyntecChannel, _words: Words) -> None:
    """G80: a drilling cycle ends, and with it G81.1; its axis goes back to R."""
    state = OscillationState.of(channel)
    running: Oscillation | None = state.running
    if running is None:
        return
    if state.precise:
        channel.mode = channel.mode.with_code(OSCILLATION, PRECISE)
        return
    _stop(channel, running.home)


def start_precise(channel: SyntecChannel, words: Words) -> None:
    """G81.2 P Q [R] L: axis P between the vertices in registers Q and Q + 1, from R, at the speed in register L."""
    state = OscillationState.of(channel)
    memory = channel.memory
    if not memory.parameters.option_oscillation:
        raise words.fail("option", PRECISE)
    _refuse_transformations(channel, words, PRECISE)
    axis, places, speed = _axis(channel, words), words.integer("Q"), words.integer("L")
    if places is None or speed is None:
        raise words.fail("argument", "Q" if places is not None else PRECISE)
    running: Oscillation | None = state.running
    if running is not None and not (state.precise and running.axis == axis):
        raise words.fail("oscillation_repeated", PRECISE)
    told = words.way("R", rotary=channel.axis_data[axis].rotary)
    home = (
        told
        if told is not None
        else running.home
        if running is not None
        else channel.coordinates.machine[axis]
    )
    new = Oscillation(axis, Read(partial(_in_registers, memory, places, speed)), home)
    if running is not None:
        state.running = new
        Oscillator.of(channel).change(new.source, _place_of_hold(channel, new, precise=True))
        return
    _begin(channel, new, precise=True)


def _in_registers(memory: SyntecMemory, places: int, speed: int) -> Strokes:
    """Vertices in two registers, least units, and the speed in another one."""
    unit, registers = least_unit(memory.parameters), memory.globals.registers
    vertices = (registers.get(places, 0) * unit, registers.get(places + 1, 0) * unit)
    return Strokes(vertices, registers.get(speed, 0) / 60.0)


def end_precise(channel: SyntecChannel, words: Words) -> None:
    """G80.2 [Q]: the axis stops at Q, else where Pr3957 says."""
    state = OscillationState.of(channel)
    memory = channel.memory
    if not state.was_precise:
        raise words.fail("oscillation_repeated", OFF)
    running: Oscillation | None = state.running
    axis = state.precise_axis if running is None else running.axis
    place = words.way("Q", rotary=channel.axis_data[axis].rotary)
    if running is None or not state.precise:
        if running is not None:
            channel.mode = channel.mode.with_code(OSCILLATION, SIMPLE)
        elif place is not None:
            _arrive(channel, state.precise_axis, place)
        return
    if place is None and memory.parameters.oscillation_stop != 1:
        place = running.home
    _stop(channel, place)
    state.precise, state.precise_axis = False, running.axis


def check_block(builder: Builder) -> None:
    """Refuse moves and frames of an axis that oscillates."""
    state = OscillationState.of(builder.channel)
    if builder.before[OSCILLATION] == OFF or state.running is None:
        return
    axis = builder.channel.axes[state.running.axis]
    fail = builder.control.fail
    for row in builder.codes:
        if row.code in FRAME_CODES:
            raise fail("oscillation_frame", address=row.code)
    if any(row.code == "G10" for row in builder.codes) and builder.has(axis):
        raise fail("oscillation_frame", address=axis)
    if builder.has(axis) and not any(
        row.code in (SIMPLE, "G4", "G65", "G66", "G66.1") for row in builder.codes
    ):
        raise fail("oscillation_move", address=axis)


def check_frame(memory: SyntecMemory) -> None:
    """Refuse a system variable that would move the coordinates of an oscillating axis."""
    if OscillationState.of(memory.channel).running is not None:
        raise memory.channel.control.fail("oscillation_frame")


def _refuse_transformations(channel: SyntecChannel, words: Words, code: str) -> None:
    if channel.coordinates.transformation is not None or channel.path.find(NormalStage) is not None:
        raise words.fail("oscillation_kinematics", code)


def _axis(channel: SyntecChannel, words: Words) -> int:
    """P: number of an axis from 1, or the code of its name (Pr321 on)."""
    told = words.integer("P")
    axis = -1
    if told is not None:
        axis = axis_of_code(channel, told) if told in CODES else told - 1
    if 0 <= axis < len(channel.axes):
        return axis
    raise words.fail("oscillation_axis", "P" if told is not None else PRECISE)


def _begin(channel: SyntecChannel, oscillation: Oscillation, *, precise: bool = False) -> None:
    """To R at rapid; the strokes begin there."""
    channel.on_clock()
    channel.flush()
    state = OscillationState.of(channel)
    state.running = oscillation
    state.precise = precise
    state.was_precise = state.was_precise or precise
    channel.modes.forget_plans()
    _approach(channel, oscillation)
    hold = _place_of_hold(channel, oscillation, precise=precise)
    Oscillator.of(channel).begin(oscillation.axis, oscillation.source, hold, override(channel))


def _approach(channel: SyntecChannel, oscillation: Oscillation) -> None:
    """To the R point at rapid, with R19 up to 100 %."""
    c, share = channel.coordinates, override(channel)
    if share <= 0.0:  # it would never get there
        raise channel.control.not_yet("R19 = 0")
    machine = c.machine
    machine[oscillation.axis] = oscillation.home
    rapid = channel.axis_data[oscillation.axis].rapid
    with rapid_as(channel, rapid * share if share < 1.0 else nan, None) as speed:
        channel.straight(Kind.RAPID, c.from_machine(machine), speed)


def override(channel: SyntecChannel) -> float:
    """R19, 1 for 100 %; nobody has set it where it holds nothing."""
    return float(channel.memory.globals.registers.get(OVERRIDE, 100)) / 100.0


def override_set(channel: SyntecChannel) -> None:
    """R19 holds another value: every axis that oscillates goes on at it, whichever axis group has begun it."""
    group = channel.group
    assert group is not None  # a session always runs a group
    for each in group.channels:
        if OscillationState.of(each).running is not None:
            Oscillator.of(each).change_override(override(channel), channel)


def _place_of_hold(channel: SyntecChannel, oscillation: Oscillation, *, precise: bool) -> float | None:
    """Where a hold and a reset lead the axis: to R; G81.2 lets it stop where it is with Pr3957 = 1."""
    at_once = precise and channel.memory.parameters.oscillation_stop == 1
    return None if at_once else oscillation.home


def _stop(channel: SyntecChannel, place: float | None) -> None:
    """The strokes end at a place, None for where the axis can stop; it belongs to the path again."""
    Oscillator.of(channel).finish(place)
    OscillationState.of(channel).running = None
    channel.modes.forget_plans()


def _arrive(channel: SyntecChannel, axis: int, place: float) -> None:
    """The axis has gone to a machine position beside the path."""
    machine = channel.coordinates.machine
    machine[axis] = place
    channel.coordinates.arrive_machine(machine)
