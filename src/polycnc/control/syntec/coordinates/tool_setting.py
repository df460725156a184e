"""Automatic tool presetting G37, G37.2, G37.3 on a sensor of known place (manual 2.24 to 2.26)."""

from __future__ import annotations

from math import nan

from polycnc.control.syntec.coordinates.systems import WORK_SYSTEMS
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.memory import EXTERNAL
from polycnc.control.word_address.motion import skip
from polycnc.control.word_address.states import LengthState
from polycnc.control.word_address.tools import length
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words

#: Parameters that stand in for length words.
STAND_INS = {"R": SyntecParameters.setting_distance, "D": SyntecParameters.setting_tolerance}
REFERENCES = (1, 2, 3, 4)
BLOW_ON, BLOW_OFF = 90, 91
BACK_MM, SECOND_FEED_MM_S = 3.0, 50.0 / 60.0


def measure_length(channel: SyntecChannel, words: Words) -> None:
    """G37 Z [R] [D] [F] [P]: the signal must come within Z ± D; the length of H gets what lies between it and Z."""
    state = LengthState.of(channel)
    memory, c = channel.memory, channel.coordinates
    z = c.geometry[2]
    place = next((value for axis, value, _ in words.axes() if axis == z), None)
    if place is None:
        raise words.fail("setting_place", "G37")
    if c.programmed[z] <= place:
        raise words.fail("setting_start", "Z")
    if not state.number:
        raise words.fail("setting_without_length", "G37")
    distance, tolerance = _length(channel, words, "R"), _length(channel, words, "D")
    feed = _feed(channel, words)
    _go_to_reference(channel, words)
    _to(channel, Kind.RAPID, place + distance, nan)
    if _probe(channel, place + tolerance, feed) is not None:
        raise words.fail("setting_too_early", "G37")
    found = _probe(channel, place - tolerance, feed)
    if found is None:
        raise words.fail("setting_no_signal", "G37")
    tool = memory.offset_number(state.number)
    tool.length = found - place + ZeroState.of(channel).length[z]
    length.renew_length(channel)


def measure_into_work_system(channel: SyntecChannel, words: Words) -> None:
    """G37.2 K [Z] [R] [F] [P] [Q]: the signal's machine position becomes Z of work system K; 0 is the external one."""
    memory = channel.memory
    if not memory.tool.number:
        raise words.fail("setting_place", "G37.2")
    number = words.typed("K")
    if number is None or number != int(number) or not 0 <= number <= len(WORK_SYSTEMS):
        raise words.fail("setting_start", "K" if number is not None else "G37.2")
    found = _measure_twice(channel, words)
    name = WORK_SYSTEMS[int(number) - 1] if number else EXTERNAL
    memory.work_offset(name)[channel.coordinates.geometry[2]] = found
    refresh_zero(channel)


def measure_into_length(channel: SyntecChannel, words: Words) -> None:
    """G37.3 [Z] [H] [R] [F] [P] [Q] [T]: the machine position of the signal becomes the length of H."""
    state = LengthState.of(channel)
    memory = channel.memory
    if "T" in words:
        functions.change_tool(channel, words)
    if not memory.tool.number:
        raise words.fail("setting_place", "G37.3")
    number = words.integer("H")
    state.number = state.number if number is None else number
    number = state.number or memory.tool.number
    if not number:
        raise words.fail("setting_without_length", "G37.3")
    found = _measure_twice(channel, words)
    memory.offset_number(number).length = found
    length.renew_length(channel)


def _measure_twice(channel: SyntecChannel, words: Words) -> float:
    """Over the sensor, blow it clean, probe, back, probe slowly, up again; gives the machine position of the signal."""
    c = channel.coordinates
    z = c.geometry[2]
    parameters = channel.memory.parameters
    place = next(
        (value for axis, value, _ in words.axes() if axis == z),
        parameters.setting_place * least_unit(parameters),
    )
    safe = words.length("Q") or 0.0
    distance, feed = _length(channel, words, "R"), _feed(channel, words)
    _to_machine(channel, safe)
    _go_to_reference(channel, words)
    channel.event(Auxiliary(BLOW_ON))
    _to_machine(channel, place + distance)
    channel.event(Auxiliary(BLOW_OFF))
    down = place - c.machine[z] + c.position[z]
    found = _probe(channel, down, feed)
    if found is not None:
        _to(channel, Kind.FEED, found + BACK_MM, feed)
        found = _probe(channel, down, SECOND_FEED_MM_S)
    if found is None:
        raise words.fail("setting_no_signal")
    machine: float = c.machine[z]
    _to_machine(channel, safe)
    return machine


def _length(channel: SyntecChannel, words: Words, address: str) -> float:
    """A length word, or the parameter that stands in for it (least units), mm."""
    value = words.length(address)
    if value is not None:
        return value
    parameters = channel.memory.parameters
    return parameters.value(STAND_INS[address]) * least_unit(parameters)


def _feed(channel: SyntecChannel, words: Words) -> float:
    """F of the block, of Pr4057, or the one in force, mm/s."""
    value = words.typed("F")
    if value is None:
        return channel.memory.parameters.setting_feed / 60.0 or channel.feed
    return value * (INCH_MM if words.plan.inch else 1.0) / 60.0


def _go_to_reference(channel: SyntecChannel, words: Words) -> None:
    """X and Y to the reference point that P or Pr4058 names; nowhere without one."""
    c = channel.coordinates
    number = words.typed("P")
    number = channel.memory.parameters.setting_reference if number is None else number
    if number not in REFERENCES:
        return
    machine = c.machine
    for axis in c.geometry[:2]:
        machine[axis] = channel.control.reference_point(channel, axis, int(number))
    channel.straight(Kind.REF, c.from_machine(machine), nan)


def _to(channel: SyntecChannel, kind: Kind, level: float, feed: float) -> None:
    """Z to a level of the work display."""
    c = channel.coordinates
    end = c.position[:]
    end[c.geometry[2]] = level
    channel.straight(kind, end, feed)


def _to_machine(channel: SyntecChannel, level: float) -> None:
    """Z to a machine position at rapid."""
    c = channel.coordinates
    machine = c.machine
    machine[c.geometry[2]] = level
    channel.straight(Kind.RAPID, c.from_machine(machine), nan)


def _probe(channel: SyntecChannel, level: float, feed: float) -> float | None:
    """Z towards a level until the signal comes; where that was on the work display, or None."""
    c = channel.coordinates
    z = c.geometry[2]
    end = c.position[:]
    end[z] = level
    switches = channel.setup.switches
    at = dict(switches.measure_signal_at or switches.skip_signal_at)
    stopped = skip.signal_position(channel, c.position, end, at)
    channel.straight(Kind.SKIP, end if stopped is None else stopped, feed)
    return None if stopped is None else stopped[z]
