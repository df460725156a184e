"""Grinding cycles G71 to G74 where the machine has them in place of the turning cycles (5106#0; 0i-TF Plus II.4.6)."""

from __future__ import annotations

from polycnc.control.fanuc.code_calls import PROGRAM_M
from polycnc.control.fanuc.lathe.coordinates.systems import plane_axes, sense
from polycnc.control.fanuc.lathe.cycles.modal import GrindingState
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.word_address.block.numbers import length_converter
from polycnc.control.word_address.motion.skip import signal_position
from polycnc.cycles.turning.grinding import Grinding, GrindStroke, oscillate, traverse
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan

#: Inner names of the codes: they share their written names with the turning cycles.
TRAVERSE, TRAVERSE_GAUGED, OSCILLATE, OSCILLATE_GAUGED = (
    "G71 grinding",
    "G72 grinding",
    "G73 grinding",
    "G74 grinding",
)
_AXIS_PARAMETERS = {
    TRAVERSE: LatheParameters.traverse_axis,
    TRAVERSE_GAUGED: LatheParameters.traverse_gauged_axis,
    OSCILLATE: LatheParameters.oscillation_axis,
    OSCILLATE_GAUGED: LatheParameters.oscillation_gauged_axis,
}
CODES = frozenset(_AXIS_PARAMETERS)
_GAUGED = frozenset({TRAVERSE_GAUGED, OSCILLATE_GAUGED})
_OSCILLATING = frozenset({OSCILLATE, OSCILLATE_GAUGED})
#: P of a gauged cycle; another number switches the skip off.
_GAUGES = frozenset({1.0, 2.0, 3.0, 4.0})
#: Words that live on; H always, and B of the oscillating cycles, hold in their block only.
_WORDS = "ABWUIKHP"


def plan_grinding(builder: Builder, plan: Plan) -> Step | None:
    """G71 to G74 of grinding: a block takes over its words and runs the cycle, even where it is empty."""
    code, control = builder.mode["motion"], builder.control
    named = [address for address in _WORDS if builder.has(address)]
    builder.take(*named)
    infeed, along = _axes(builder, code)
    slots = {address: builder.slots[address] for address in named}
    for word in plan.axis_words:
        if word.address in named:
            continue
        if word.axis != along:
            raise control.fail("grinding_axis", address=word.address)
        # The grinding axis may be named instead of W; it is an increment all the same.
        slots["W"] = (word.slot, builder.slots[word.address][1])
    if not slots and PROGRAM_M.intersection(builder.m_codes):
        return None
    once = ("H", "P", "B") if code in _OSCILLATING else ("H", "P")

    def run(channel: LatheChannel, values: list[float]) -> None:
        words = {
            a: _value(builder, a, form, values[slot], infeed, along) for a, (slot, form) in slots.items()
        }
        data = GrindingState.of(channel).words
        data.update({a: v for a, v in words.items() if a not in once})
        if not data.get("W"):
            raise control.fail("grinding_axis", address="W")
        kept = {a: v for a, v in data.items() if a not in once}
        _run(channel, code, {**kept, **words}, infeed, along)

    return run


def _axes(builder: Builder, code: str) -> tuple[int, int]:
    """The cutting axis and the grinding axis of a cycle."""
    control, channel = builder.control, builder.channel
    infeed = plane_axes(channel)[0] if channel.memory.parameters.FXY else 0
    along = channel.memory.parameters.value(_AXIS_PARAMETERS[code]) - 1
    if along < 0:
        along = channel.axis_index.get("Z", -1)
    if not 0 <= along < len(channel.axes):
        raise control.fail("grinding_axis", address="W")
    if along == infeed:
        raise control.fail("grinding_same_axis", address="W")
    return infeed, along


def _value(builder: Builder, address: str, form: str, value: float, infeed: int, along: int) -> float:
    """A word in internal units: lengths follow the setting of their axis, U is seconds, I and K are feeds."""
    if address in "HP":
        return value
    if address == "U":
        return value / 1000.0 if form == "" else value
    if address in "IK":
        return value * (INCH_MM if builder.inch else 1.0)
    axis = along if address == "W" else infeed
    diameter = builder.control.is_diameter(builder.channel, axis)
    convert = length_converter(form, builder.rules, inch=builder.inch, diameter=diameter)
    return convert(value) if convert else value


def _run(channel: LatheChannel, code: str, words: Mapping[str, float], infeed: int, along: int) -> None:
    first = words.get("A", 0.0)
    second = words.get("B", first if code in _OSCILLATING else 0.0)
    cycle = Grinding(first, second, words["W"], words.get("U", 0.0), max(int(words.get("H", 1)), 1))
    strokes = oscillate(cycle) if code in _OSCILLATING else traverse(cycle)
    begin = channel.coordinates.position[infeed]
    unit = 60.0 if channel.mode["feed"] == "G98" else 1.0
    gauged = code in _GAUGED and words.get("P", 1.0) in _GAUGES
    back = words.get("K" if code in _OSCILLATING else "I", words.get("K", 0.0))
    for stroke in strokes:
        channel.once_more()
        if stroke.dwell_s:
            channel.dwell(seconds=stroke.dwell_s)
        elif _stroke(channel, stroke, words, (infeed, along), unit, gauged=gauged):
            end = channel.coordinates.position[:]
            end[infeed] = begin
            _move(channel, end, back / unit)
            return


def _stroke(
    channel: LatheChannel,
    stroke: GrindStroke,
    words: Mapping[str, float],
    axes: tuple[int, int],
    unit: float,
    *,
    gauged: bool,
) -> bool:
    """One stroke; whether the gauge's signal came in it. An infeed stops where the signal comes."""
    start = channel.coordinates.position
    end = start[:]
    end[axes[0]] += stroke.infeed * sense(channel, axes[0])
    end[axes[1]] += stroke.along * sense(channel, axes[1])
    at = channel.setup.switches.skip_input if gauged else None
    reached = signal_position(channel, start, end, at)
    if reached is not None and not stroke.along:
        end = reached
    _move(channel, end, words.get("I" if stroke.at_infeed_rate else "K", 0.0) / unit)
    return reached is not None


def _move(channel: LatheChannel, end: list[float], feed: float) -> None:
    if not feed > 0.0:
        raise channel.control.fail("no_feed")
    channel.straight(Kind.FEED, end, feed)
