"""Axes that move beside the program on the lathe: G51.2, G81, G81.5, G51.4, G81.1.

Polygon turning, electronic gear box, its two pairs, synchronous control, oscillation.
"""

from __future__ import annotations

from math import nan, pi, radians, sin

from polycnc.control.fanuc.lathe.states import BesideState
from polycnc.control.word_address.motion.oscillation import Fixed, Oscillator, Strokes, speed_of_feed
from polycnc.control.word_address.motion.spindle_led import Lead, SpindleLed
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.couplings.laws import Ratio

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.transformation.couplings.laws import Law

POLYGON, POLYGON_OFF = "polygon", "G50.2"
LARGEST_RATIO = 999
#: G81.5: turns of the spindle that T may name, and how many axes may follow.
MOST_TURNS, PAIRS = 5000, 2
#: Codes whose axis words are no moves.
NO_MOVES = frozenset({"G4", "G81.5", "G80.5"})
TURN = 360.0


def _took(channel: LatheChannel, **columns: int | frozenset[int]) -> None:
    """Note which axes move beside the program from here on."""
    state = BesideState.of(channel)
    for name, column in columns.items():
        setattr(state, name, column)
    channel.modes.forget_plans()


def _rotary_axis(channel: LatheChannel, number: int) -> int:
    """Column of an axis by its number from 1; -1 where it is no rotary axis of the channel."""
    known = 1 <= number <= len(channel.axes) and channel.axis_data[number - 1].rotary
    return number - 1 if known else -1


# ---- polygon turning ---------------------------------------------------------------------------------------------


def start_polygon(channel: LatheChannel, words: Words) -> None:
    """G51.2 P Q: the tool axis turns Q times while the spindle turns P times, against it for Q below 0."""
    if BesideState.of(channel).polygon >= 0:
        raise words.fail("polygon_twice", "G51.2")
    if any(key not in ("G51.2", "G251", "P", "Q", "R") for key in words.plan.order):
        raise words.fail("polygon_company", "G51.2")
    spindle, tool = words.integer("P"), words.integer("Q")
    if (
        spindle is None
        or tool is None
        or not 1 <= spindle <= LARGEST_RATIO
        or not 1 <= abs(tool) <= LARGEST_RATIO
    ):
        raise words.fail("polygon_ratio", "G51.2")
    if "R" in words:
        raise AlarmError("PC0001", hint="hint.not-supported", address="R", code="G51.2 R")
    column = _rotary_axis(channel, channel.memory.parameters.polygon_axis)
    if column < 0:
        raise words.fail("polygon_axis", "G51.2")
    SpindleLed.of(channel).begin(column, Lead(tool / spindle))
    _took(channel, polygon=column)


def end_polygon(channel: LatheChannel, _words: Words) -> None:
    """G50.2: the tool axis comes to rest."""
    column = BesideState.of(channel).polygon
    if column >= 0:
        SpindleLed.of(channel).release(column)
        _took(channel, polygon=-1)


# ---- electronic gear box -----------------------------------------------------------------------------------------


def start_gear(channel: LatheChannel, words: Words) -> None:
    """G81 T L Q P, G81.4: the workpiece axis turns L/T times with the hob; along Z by the helix P of module Q."""
    column = _rotary_axis(channel, channel.memory.parameters.gear_axis)
    if column < 0:
        raise words.fail("gear_axis", "G81")
    if BesideState.of(channel).gear >= 0:
        raise words.fail("gear_mode", "G81")
    teeth, starts = words.integer("T"), words.integer("L") if "L" in words else 1
    module, helix = words.length("Q"), words.angle("P")
    if not teeth or not starts or (helix and not module):
        raise words.fail("gear_format", "G81")
    laws: tuple[Law, ...] = ()
    if helix and module:
        z = channel.coordinates.geometry[2]
        factor = TURN * sin(radians(helix)) / (pi * teeth * module)
        laws = (Ratio(z, factor, channel.coordinates.machine[z]),)
    SpindleLed.of(channel).begin(column, Lead(starts / teeth, laws))
    _took(channel, gear=column)


def end_gear(channel: LatheChannel, _words: object) -> None:
    """G80.4, G80: the gear opens, the workpiece axis comes to rest; an axis that oscillates goes to its R."""
    state = BesideState.of(channel)
    if state.gear >= 0:
        SpindleLed.of(channel).release(state.gear)
        _took(channel, gear=-1)
    if state.oscillating >= 0:
        oscillator = Oscillator.of(channel)
        oscillator.finish(oscillator.home)
        _took(channel, oscillating=-1)


# ---- two pairs of the gear box -----------------------------------------------------------------------------------


def start_pair(channel: LatheChannel, words: Words) -> None:
    """G81.5 T C: the axis moves so far, or with L turns so often, while the spindle makes T turns."""
    state, named = BesideState.of(channel), words.axes()
    turns, often = words.integer("T"), words.integer("L") if "L" in words else None
    if "P" in words:
        raise AlarmError("PC0001", hint="hint.not-supported", address="P", code="G81.5 P")
    if len(named) != 1 or turns is None or not 1 <= turns <= MOST_TURNS:
        raise words.fail("gear_format", "G81.5")
    column, way, _ = named[0]
    if (often is not None) == (way != 0.0) or (often is not None and not channel.axis_data[column].rotary):
        raise words.fail("gear_format", "L" if often is not None else words.plan.axis_words[0].address)
    if column in state.columns or len(state.pairs) >= PAIRS:
        raise words.fail("gear_mode", "G81.5")
    ratio = (often if often is not None else way / TURN) / turns
    SpindleLed.of(channel).begin(column, Lead(ratio))
    _took(channel, pairs=state.pairs | {column})


def end_pair(channel: LatheChannel, words: Words) -> None:
    """G80.5 C0: the pair of this axis opens, without an axis both do."""
    state = BesideState.of(channel)
    named = {column for column, _, _ in words.axes()}
    if any(value for _, value, _ in words.axes()):
        raise words.fail("gear_format", "G80.5")
    for column in sorted(state.pairs & named if named else state.pairs):
        SpindleLed.of(channel).release(column)
        _took(channel, pairs=state.pairs - {column})


# ---- synchronous control -----------------------------------------------------------------------------------------


def start_synchronous(channel: LatheChannel, words: Words) -> None:
    """G51.4 P Q: the slave Q makes every move of its master P; both by 12600, in one path."""
    if "L" in words and words.integer("L"):
        raise AlarmError("PC0001", hint="hint.not-supported", address="L", code="G51.4 L")
    state = BesideState.of(channel)
    master, slave = (_identified(channel, words, address) for address in "PQ")
    if master == slave or state.columns & {master, slave}:
        raise words.fail("synchronous_composition", "G51.4")
    sense = -1.0 if channel.memory.parameters.of(channel.axes[slave]).SMR else 1.0
    law = Ratio(master, sense, channel.coordinates.machine[master])
    SpindleLed.of(channel).begin(slave, Lead(0.0, (law,)))
    _took(channel, slaves=state.slaves | {slave})


def end_synchronous(channel: LatheChannel, words: Words) -> None:
    """G50.4 Q: the slave belongs to the program again, where it then stands."""
    slave = _identified(channel, words, "Q")
    state = BesideState.of(channel)
    if slave in state.slaves:
        SpindleLed.of(channel).release(slave)
        _took(channel, slaves=state.slaves - {slave})


def _identified(channel: LatheChannel, words: Words, address: str) -> int:
    """Column of the axis that has a number of 12600; PC0001 where another path may have it."""
    number, of = words.integer(address), channel.memory.parameters.of
    for column, name in enumerate(channel.axes):
        if number and of(name).identification == number:
            return column
    if len(channel.machine.channels) > 1:
        raise AlarmError("PC0001", hint="hint.not-supported", address=address, code=f"G51.4 {address}")
    raise words.fail("synchronous_axis", address)


# ---- oscillation -------------------------------------------------------------------------------------------------


def start_oscillation(channel: LatheChannel, words: Words) -> None:
    """G81.1 Z Q R F: to R at rapid, then between the upper dead point and the lower one, Q from it, until G80."""
    named = words.axes()
    if BesideState.of(channel).oscillating >= 0 or len(named) != 1:
        raise words.fail("oscillation_command", "G81.1")
    axis, upper, _ = named[0]
    stroke, home = (words.way(address, rotary=channel.axis_data[axis].rotary) for address in "QR")
    if not stroke or home is None:
        raise words.fail("oscillation_command", "G81.1")
    if not channel.feed > 0.0:
        raise words.fail("no_feed")
    channel.on_clock()
    c = channel.coordinates
    place = list(c.programmed)
    place[axis] = upper
    top = c.to_machine(c.to_position(place))[axis]
    machine = c.machine
    machine[axis] = top + home
    channel.flush()
    channel.straight(Kind.RAPID, c.from_machine(machine), nan)
    strokes = Strokes((top, top + stroke), speed_of_feed(channel, axis))
    Oscillator.of(channel).begin(axis, Fixed(strokes), top + home)
    _took(channel, oscillating=axis)


def check_block(builder: Builder) -> None:
    """Refuse words of an axis that moves beside the program."""
    state = BesideState.of(builder.channel)
    mistakes = {
        state.polygon: "polygon_move",
        state.gear: "gear_mode",
        state.oscillating: "oscillation_command",
        **dict.fromkeys(state.pairs, "gear_mode"),
        **dict.fromkeys(state.slaves, "synchronous_move"),
    }
    if any(row.code in NO_MOVES for row in builder.codes):
        return
    for address in builder.slots:
        target = builder.control.axis_of_address(builder.channel, address, builder)
        if target is not None and target[0] in mistakes:
            raise builder.control.fail(mistakes[target[0]], address=address)


def end_by_drilling_code(_builder: Builder, _plan: Plan) -> Step:
    """G80 ends the gear box in front of its block."""
    return end_gear
