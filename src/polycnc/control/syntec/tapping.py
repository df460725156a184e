"""Tapping on SYNTEC: orientation before a tap, the way out after one that broke off (manual 2.48, 2.55, 2.76)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.control.word_address.auxiliary.overrides import OverrideState
from polycnc.control.word_address.cycles.drilling import CycleState, lead_from_feed, turn_by_m_code
from polycnc.cycles.drilling.holes import Action, Stroke
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind
from polycnc.toolpath.events import SpindleSpeed
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.cycles.drilling.holes import Cycle, Hole
    from polycnc.toolpath import Context

CODES = ("G74", "G84")
RETRACT = "G84.48"
#: How far F and S of G84.48 may be from the lead that was tapped, as a part of it.
LEAD_TOLERANCE = 1e-6


@dataclass(slots=True)
class LastTap(State, lifetime=Lifetime.RETAINED):
    """The last tap: `axis`, `level` of R and `bottom` (machine, mm), `lead` in mm, `speed` in rpm, `direction`."""

    values: dict[str, float] = retained("last-tap")


def tap(channel: SyntecChannel, cycle: Cycle) -> Cycle:
    """A tapping cycle that is noted for G84.48; with Pr4007 the spindle stops at its angle over the hole first."""
    orients = channel.memory.parameters.tap_orients != 0

    def strokes(hole: Hole) -> Iterator[Stroke]:
        _note(channel, hole)
        first, *others = cycle(hole)
        yield first
        if orients:
            yield Stroke(Action.ORIENT)
            yield Stroke(Action.SPINDLE, 1.0)
        yield from others

    return strokes


def finished(channel: SyntecChannel, context: Context) -> Context:
    """A context of a tap between R and R: a hold and a reset wait for its end (2.48.3, 2.55.2)."""
    return replace(context, finishes=True) if OverrideState.of(channel).in_tap else context


def _note(channel: SyntecChannel, hole: Hole) -> None:
    c, spindle = channel.coordinates, channel.memory.spindle
    axis = CycleState.of(channel).active.axis
    values = LastTap.of(channel).values
    values.update(
        axis=axis, lead=lead_from_feed(channel), speed=spindle.speed, direction=spindle.direction or 1
    )
    for name, place in (("level", hole.r), ("bottom", hole.bottom)):
        programmed = c.programmed[:]
        programmed[axis] = place
        values[name] = c.to_machine(c.to_position(programmed))[axis]


def retract(channel: SyntecChannel, words: Words) -> None:
    """G84.48 F S: out of a hole whose tap broke off, to its R, with the spindle in step; F is per minute."""
    values = LastTap.of(channel).values
    if not values:
        raise words.fail("tap_retract", RETRACT)
    feed, speed = _feed_and_speed(words, values)
    c, axis = channel.coordinates, int(values["axis"])
    machine = c.machine
    outwards = values["level"] - values["bottom"]
    if (values["level"] - machine[axis]) * outwards <= NO_WAY:
        return
    machine[axis] = values["level"]
    spindle = channel.memory.spindle
    spindle.speed = speed
    channel.context_changed()
    channel.event(SpindleSpeed(speed=speed, spindle=1))
    turn_by_m_code(channel, -int(values["direction"]))
    per_revolution = channel.context.feed_mode is FeedMode.PER_REVOLUTION
    rate = values["lead"] if per_revolution else feed / 60.0
    parameters = (values["lead"], 0.0, 1.0, 0.0)
    channel.curve(Kind.TAP, c.from_machine(machine), rate, parameters=parameters)
    turn_by_m_code(channel, 0)


def _feed_and_speed(words: Words, values: dict[str, float]) -> tuple[float, float]:
    """Feed (mm/min) and speed of the way out: as they are written, or what the lead makes of the other one."""
    feed, speed, lead = words.typed("F"), words.typed("S"), values["lead"]
    if feed is not None:
        feed *= INCH_MM if words.plan.inch else 1.0
    for address, value in (("F", feed), ("S", speed)):
        if value is not None and not value > 0.0:
            raise words.fail("argument", address)
    if feed is None:
        speed = values["speed"] if speed is None else speed
        return speed * lead, speed
    if speed is None:
        return feed, feed / lead
    if abs(feed / speed - lead) > LEAD_TOLERANCE * lead:
        raise words.fail("tap_retract", "F")
    return feed, speed
