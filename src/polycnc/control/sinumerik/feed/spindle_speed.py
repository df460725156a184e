"""Constant cutting speed: what G96 needs, and the speed that G97 keeps.

Source: Fundamentals (G96, G961, G962, G97, G971, G972, LIMS, SCC; FPR, FPRAON, FPRAOF).
"""

from __future__ import annotations

from math import pi

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.tables import MM_PER_M
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle
    from polycnc.control.sinumerik.memory import Memory

#: Setting data of spindles: lowest speed (G25 S), highest speed (G26 S), highest under constant cutting speed (LIMS).
LOWEST, HIGHEST = "$SA_SPIND_MIN_VELO_G25", "$SA_SPIND_MAX_VELO_G26"
SURFACE_LIMIT = "$SA_SPIND_MAX_VELO_LIMS"
DATA = frozenset((LOWEST, HIGHEST, SURFACE_LIMIT))
#: Feed types under which LIMS acts.
SURFACE_LIMITED = frozenset(("G96", "G961", "G962", "G97", "G971", "G972"))
_SPINDLE = regex(r"S\d+")
KEEPS_SPEED = frozenset(("G97", "G971", "G972", "G973"))


@dataclass(slots=True)
class ReferenceAxis(State, lifetime=Lifetime.RESET):
    """Column of the axis that SCC has made the reference of the cutting speed, -1 for the transverse axis."""

    column: int = -1


def reference_axis(channel: SinumerikChannel, args: Arguments) -> None:
    """SCC[axis]: the geometry axis whose position the cutting speed is worked out from, before or with G96.

    Raises:
        AlarmError: 10870 for an axis that is none of the geometry, PC0001 for its second and third.
    """
    if len(args) != 1:
        raise AlarmError("14020", text="SCC")
    column = arguments.column(channel, args[0])
    geometry = channel.coordinates.geometry
    if column not in geometry:
        raise AlarmError("10870")
    if column != geometry[0]:
        raise not_supported(f"SCC[{channel.axes[column]}]")
    ReferenceAxis.of(channel).column = column


def _reference(channel: SinumerikChannel) -> int:
    column = ReferenceAxis.of(channel).column
    return channel.memory.transverse if column < 0 else column


def change_of_feed_type(channel: SinumerikChannel, surface_speed: bool, code: str) -> None:
    """Enter or leave constant cutting speed; alarm 10870 without a transverse axis, or another that SCC has named."""
    memory = channel.memory
    if surface_speed and _reference(channel) < 0:
        raise AlarmError("10870")
    spindle = memory.spindles.all.get(memory.spindles.master)
    if spindle is not None and code in KEEPS_SPEED and spindle.cutting_speed:
        limit = highest(memory, spindle, "G96")
        spindle.speed = speed_at(channel, spindle.cutting_speed, limit)


def set_limit(channel: SinumerikChannel, datum: str, spindle: Spindle, speed: float) -> None:
    """G25 S, G26 S, LIMS: write the setting datum of a spindle."""
    channel.memory.data.write(datum, (f"S{spindle.number}",), speed)
    channel.context_changed()


def highest(memory: Memory, spindle: Spindle, feed: str) -> float:
    """The highest speed of a spindle under a function of group 15, and at which axes can follow it, rpm."""
    name = f"S{spindle.number}"
    limit = memory.data.number(HIGHEST, name)
    if feed in SURFACE_LIMITED:
        limit = min(limit, memory.data.number(SURFACE_LIMIT, name) or limit)
    return min(limit, spindle.most)


def turning_speed(memory: Memory, spindle: Spindle, feed: str) -> float:
    """What a spindle turns with: its programmed speed by OVRA, within the limits; 0 stays 0."""
    lowest, speed = memory.data.number(LOWEST, f"S{spindle.number}"), spindle.speed * spindle.override
    return min(max(speed, lowest), highest(memory, spindle, feed)) if speed > 0.0 else 0.0


def is_in_force(channel: SinumerikChannel, surface_speed: bool, code: str) -> bool:
    """Whether the kind of feed that is in force would change nothing and not alarm when it is written again.

    S words under G97 do not change a cutting speed, so what holds stays.
    """
    memory = channel.memory
    if surface_speed:
        return _reference(channel) >= 0
    spindle = memory.spindles.all.get(memory.spindles.master)
    return code not in KEEPS_SPEED or spindle is None or not spindle.cutting_speed


def speed_at(channel: SinumerikChannel, cutting_speed: float, limit: float) -> float:
    """Speed (rpm) for a cutting speed (m/min) where the reference axis stands, at most the limit."""
    diameter = 2.0 * abs(channel.coordinates.position[_reference(channel)])
    return min(limit, MM_PER_M * cutting_speed / (pi * diameter)) if diameter > 0.0 else limit


# ---- feed per revolution


def feed_source(channel: SinumerikChannel, args: Arguments) -> None:
    """FPR(spindle): the spindle that a feed per revolution follows; FPR() for the master spindle again.

    Of an axis whose gear a spindle leads it is what that turns the axis (job planning 9.4.5).

    Raises:
        AlarmError: PC0001 for another axis.
    """
    feed = PathFeed.of(channel)
    feed.spindle, feed.axis = 0, -1
    if args and isinstance(args[0], Axis) and args[0].name in channel.memory.columns:
        column = channel.memory.column(args[0].name)
        if column in ActionAxes.of(channel).geared:
            feed.axis = column
            channel.context_changed()
            return
    if args:
        feed.spindle = channel.memory.spindles.get(_source(args[0])).number
    channel.context_changed()


def axis_feed_source(channel: SinumerikChannel, args: Arguments) -> None:
    """FPRAON(axis, spindle, …): feeds of positioning axes per revolution of a spindle (SD43300).

    12330 for an axis without its spindle.
    """
    if len(args) % 2:
        raise AlarmError("12330", text="FPRAON")
    for axis, source in zip(args[::2], args[1::2], strict=True):
        number = channel.memory.spindles.get(_source(source)).number
        name = channel.axes[arguments.column(channel, axis)]
        channel.memory.data.write("$SA_ASSIGN_FEED_PER_REV_SOURCE", (name,), number)


def axis_feed_source_off(channel: SinumerikChannel, args: Arguments) -> None:
    """FPRAOF(axis, …): their feeds are per minute again."""
    for axis in args:
        name = channel.axes[arguments.column(channel, axis)]
        channel.memory.data.write("$SA_ASSIGN_FEED_PER_REV_SOURCE", (name,), 0)


def _source(value: Any) -> int | None:
    """The spindle that an argument names; PC0001 for an axis."""
    if isinstance(value, Axis) and not _SPINDLE.fullmatch(value.name):
        raise not_supported(f"FPR({value.name})")
    return arguments.spindle(value)
