"""M functions, tool change, stops and program ends.

Source: Fundamentals (M functions), job planning 1.25.2.8 (M17, M30 in subprograms), 7.1 (tool data). Programs in
place of M functions are `replaced.py`.
"""

from __future__ import annotations

from polycnc.control.machine_words import refuse
from polycnc.control.sinumerik.couplings import masters, synchronous
from polycnc.control.sinumerik.couplings.spindle_pairs import turns
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import tooth_feed, wheels
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.m_functions import (
    AFTER_MOTION,
    AXIS_MODE,
    DIRECTIONS,
    GEARS,
    NEVER_CALL,
    OPTIONAL_STOP,
    ORIENT,
    STOP,
)
from polycnc.control.sinumerik.replaced import program_of
from polycnc.control.sinumerik.tools import selection
from polycnc.control.sinumerik.tools.management import adapters
from polycnc.control.sinumerik.tools.sides import FACES
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.variables import part_counts
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Auxiliary

with loaded_when_called():
    from polycnc.control import tool_change
    from polycnc.control.sinumerik.axes import spindles as spindle_axes
    from polycnc.control.sinumerik.tools import master_holder, stages
    from polycnc.control.sinumerik.tools.holders import active as carriers

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from polycnc.control.sinumerik.family import SinumerikChannel

#: What the spindle does by an M function of the machine file.
DIRECTION_OF_ACT: Mapping[str, int] = {
    "spindle_clockwise": 1,
    "spindle_counter_clockwise": -1,
    "spindle_stop": 0,
}
TOOL_CHANGE = "tool_change"


def before_motion(
    channel: SinumerikChannel, code: int, spindle_number: int | None, beside: Collection[str] = ()
) -> None:
    """Run an M function that acts before the motion of its block.

    Args:
        channel: The channel.
        code: Its number.
        spindle_number: Its extension.
        beside: The addresses of its block.

    Raises:
        AlarmError: PC0001 for a word of the block that the machine file gives to the M function: on this control words
            keep their own meaning.
    """
    if spindle_number is None and (code in AFTER_MOTION or program_of(channel, code)):
        return
    if DIRECTIONS.get(code):
        synchronous.check_speed(channel, spindle_number, beside)
    function = channel.machine.m_functions.get(code)
    if function is None:
        _put_out(channel, code, spindle_number)
        return
    taken = [address for address in function.takes or () if address in beside and address != "H"]
    if taken:
        raise not_supported(f"M{code} {taken[0]}")
    if spindle_number is not None or not _is_late(channel, code):
        _put_out(channel, code, spindle_number)


def _put_out(channel: SinumerikChannel, code: int, spindle_number: int | None) -> None:
    """An M function goes out to the machine, and acts in the control."""
    refuse(channel, f"M{code}")
    memory = channel.memory
    function = channel.machine.m_functions.get(code)
    does = function.does if function is not None else ""
    if does and does not in DIRECTION_OF_ACT and does != TOOL_CHANGE:
        raise not_supported(f"M{code} ({does})")
    if code in GEARS:
        memory.spindles.get(spindle_number)  # 16761 for one that the channel does not have
    if code in DIRECTIONS or code in (ORIENT, AXIS_MODE) or does in DIRECTION_OF_ACT:
        spindle = memory.spindles.get(spindle_number)
        direction = DIRECTION_OF_ACT[does] if does in DIRECTION_OF_ACT else DIRECTIONS.get(code, 0)
        if direction or code == ORIENT:
            seat.check_spindle(channel, spindle.number)
        before = turns(channel, spindle.number)
        spindle.direction = direction
        spindle.controlled = code in (ORIENT, AXIS_MODE)
        if code == ORIENT:
            angle = memory.data.number("$SA_M19_SPOS", f"S{spindle.number}")
            spindle_axes.orient(channel, spindle, angle)
        synchronous.overlay(channel, spindle, before)
        masters.settle(channel)
        channel.context_changed()
    if spindle_number is None:
        channel.event(Auxiliary(code))
    else:
        channel.event(Auxiliary(code, spindle=spindle_number))
    part_counts.count(channel, code)
    data = memory.data
    changes = code == data.integer("$MC_TOOL_CHANGE_M_CODE") and data.integer("$MC_TOOL_CHANGE_MODE")
    if changes or does == TOOL_CHANGE:
        if spindle_number is not None and master_holder.is_other(channel, spindle_number):
            master_holder.load(channel, spindle_number)
        else:
            load_tool(channel)


def after_motion(channel: SinumerikChannel, code: int) -> None:
    """What acts when the motion of its block is done: stops, and M functions that the machine file puts there."""
    if code == STOP:
        channel.stop("M0")
    elif code == OPTIONAL_STOP:
        if channel.optional_stop:
            channel.stop("M1")
        else:
            channel.event(Auxiliary(code))
    elif code not in AFTER_MOTION and _is_late(channel, code) and not program_of(channel, code):
        _put_out(channel, code, None)


def _is_late(channel: SinumerikChannel, code: int) -> bool:
    """Whether the machine file puts an M function behind the motion; those of the control itself stay in front."""
    function = channel.machine.m_functions.get(code)
    if function is None or function.timing != "after" or code in NEVER_CALL or code == ORIENT:
        return False
    return code != channel.memory.data.integer("$MC_TOOL_CHANGE_M_CODE")


def load_tool(channel: SinumerikChannel) -> None:
    """The selected tool comes into the spindle; PC0020 under radius compensation where a transformation acts (6.10).

    A face mill in space may be changed: its dimensions wait for G41 or G42 (7.5.3).
    """
    compensates = channel.mode["compensation"] != "G40" and channel.mode["tool_offset"] not in FACES
    if channel.mode[seat.GROUP] and compensates:
        raise AlarmError("PC0020")
    tool_change.follow(channel, tool_change.way_to_change(channel))
    memory = channel.memory
    before = memory.tools.additive
    memory.tools.load(memory.tools.selected, memory.data)
    first_location(channel, before)
    edge_selected(channel)


def first_location(channel: SinumerikChannel, before: int) -> None:
    """MD20272: the additive offset (DL) that holds with a new edge; below 0 the one that held before."""
    wanted = channel.memory.data.integer("$MC_SUMCORR_DEFAULT")
    channel.memory.tools.additive = before if wanted < 0 else wanted


def edge_selected(channel: SinumerikChannel) -> None:
    """Another tool, edge or holder: an orientable holder is worked out anew; PC0001 for a tool behind an adapter."""
    adapters.check(channel)
    carriers.follow(channel)
    tool_changed(channel)
    wheels.selected(channel)


def tool_changed(channel: SinumerikChannel) -> None:
    """Other offsets: lengths act with the next motion of their axis, the radius at once."""
    memory = channel.memory
    selection.follow(channel)
    frames.apply(channel, travelled=bool(memory.data.number("$SC_TOOL_OFFSET_INCR_PROG")))
    if channel.path.head is not None:
        stages.changed_radius(channel)
    tooth_feed.follow(channel)
    channel.context_changed()
