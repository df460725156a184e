"""M functions, tool change, stops and program ends.

Source: Fundamentals (M functions), job planning 1.25.2.8 (M17, M30 in subprograms), 7.1 (tool data).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.feed import tooth_feed
from polycnc.control.sinumerik.frames import memory as frames
from polycnc.control.sinumerik.tools import stages
from polycnc.control.tool_change import check_change_points
from polycnc.toolpath.events import Auxiliary

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

STOP, OPTIONAL_STOP = 0, 1
PROGRAM_ENDS = frozenset({2, 30, 17})
DIRECTIONS = {3: 1, 4: -1, 5: 0}
ORIENT, AXIS_MODE = 19, 70
#: Automatic choice of the gear stage, and stages 1 to 5.
GEARS = range(40, 46)
AFTER_MOTION = frozenset({STOP, OPTIONAL_STOP, *PROGRAM_ENDS})


def before_motion(channel: SinumerikChannel, code: int, spindle_number: int | None) -> None:
    """Run an M function that acts before the motion of its block; `spindle_number` is its extension."""
    if code in AFTER_MOTION and spindle_number is None:
        return
    memory = channel.memory
    if code in GEARS:
        memory.spindles.get(spindle_number)  # 16761 for one that the channel does not have
    if code in DIRECTIONS or code in (ORIENT, AXIS_MODE):
        spindle = memory.spindles.get(spindle_number)
        spindle.direction = DIRECTIONS.get(code, 0)
        spindle.controlled = code in (ORIENT, AXIS_MODE)
        channel.context_changed()
    if spindle_number is None:
        channel.event(Auxiliary(code))
    else:
        channel.event(Auxiliary(code, spindle=spindle_number))
    data = memory.data
    if code == data.integer("$MC_TOOL_CHANGE_M_CODE") and data.integer("$MC_TOOL_CHANGE_MODE"):
        load_tool(channel)


def after_motion(channel: SinumerikChannel, code: int) -> None:
    """Stops, which act when the motion of their block is done."""
    if code == STOP:
        channel.stop("M0")
    elif code == OPTIONAL_STOP:
        if channel.optional_stop:
            channel.stop("M1")
        else:
            channel.event(Auxiliary(code))


def load_tool(channel: SinumerikChannel) -> None:
    """The selected tool comes into the spindle."""
    check_change_points(channel)
    memory = channel.memory
    memory.tools.load(memory.tools.selected, memory.data)
    tool_changed(channel)


def tool_changed(channel: SinumerikChannel) -> None:
    """Other offsets: lengths act with the next motion of their axis, the radius at once."""
    memory = channel.memory
    memory.tools.assign_lengths(channel.mode["plane"], memory.data)
    frames.apply(channel, travelled=bool(memory.data.number("$SC_TOOL_OFFSET_INCR_PROG")))
    stages.changed_radius(channel)
    tooth_feed.follow(channel)
    channel.context_changed()
