"""Small codes of the lathe: dwell, surface speed, spindle watch, rigid tapping, largest increment."""

from __future__ import annotations

from functools import partial

from polycnc.control.fanuc.dwell import dwell as seconds_or_revolutions
from polycnc.control.fanuc.lathe.cycles.modal import GRINDING
from polycnc.control.fanuc.lathe.states import DrawingState
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.block.plan import NOT_YET
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words


def output_while_moving(_channel: LatheChannel, _words: Words) -> None:
    """G50.9: auxiliary functions at a point of the way; not executed yet."""
    raise AlarmError(NOT_YET, address="G50.9", hint="hint.not-supported", code="G50.9")


def dwell(channel: LatheChannel, words: Words) -> None:
    """G04 X, U (seconds) or P (milliseconds); spindle revolutions under G99 with 3405#1 DWL.

    Behind a line whose end lies in the next block (II.4.9) it waits for that line.
    """
    line = DrawingState.of(channel).open_line
    if line is None:
        seconds_or_revolutions(channel, words)
    else:
        line.behind.append((channel.level.current, partial(seconds_or_revolutions, channel, words)))


def wait_for_blocks(channel: LatheChannel, _words: Words) -> None:
    """G04.1: blocks behind are taken in when those in front have ended."""
    channel.flush()
    channel.synchronise()


def plan_second_auxiliary(builder: Builder) -> Step | None:
    """B: second auxiliary function; in a grinding cycle it is a word of the cycle."""
    if builder.mode["motion"] in GRINDING:
        return None
    return functions.plan_second_auxiliary(builder)


def surface_speed(channel: LatheChannel, words: Words) -> None:
    """G96 S [P]: P is the controlled axis whose work coordinate is the diameter, 0 for that of 3770.

    Beside an M code, or with 3703#3 MPP, P names the spindle instead.
    """
    names_spindle = words.plan.m_codes or channel.memory.parameters.MPP
    if "P" in words and not names_spindle:
        axis = words.integer("P") or 0
        if not 0 <= axis <= len(channel.axes):
            raise words.fail("surface_axis", "P")
    channel.context_changed()


def note_fluctuation(_channel: LatheChannel, _words: Words) -> None:
    """G26 P Q R I: the spindle's speed is watched; an ideal spindle never leaves the window."""
