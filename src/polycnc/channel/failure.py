"""How a block that alarms has done nothing, and one that must wait nothing yet; the alarm in the log and the table."""

from __future__ import annotations

import re

from polycnc.deferred.contexts import suppress
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import Alarm, AlarmError
from polycnc.program.heads import after_head
from polycnc.toolpath.events import Raised

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.program import Program


def take_back(channel: Channel, *, found_ahead: bool = False) -> None:
    """The block that alarms does nothing: its rows vanish, the channel stands where it stood before.

    Moves that a stage holds back belong to blocks in front and are still made, unless the stage itself has found
    the mistake in one of them (`found_ahead`): then the motion ends in front of that one.
    """
    if channel.path.head is not None:
        with suppress(AlarmError):
            if found_ahead:
                channel.path.flush_checked()
            else:
                channel.path.flush()
        channel.path.clear()
        stand_at_last_row(channel)
    elif len(channel.toolpath.chunk) > channel.mark:
        channel.toolpath.truncate(channel.mark)
        stand_at_last_row(channel)


def begin_again(channel: Channel) -> None:
    """The running block waits for the main run and begins again then: what it has written so far vanishes."""
    channel.level.index = channel.level.current
    if channel.path.head is None and len(channel.toolpath.chunk) > channel.mark:
        channel.toolpath.truncate(channel.mark)
        channel.coordinates.arrive_machine(channel.stands_at)


def stand_at_last_row(channel: Channel) -> None:
    """The channel knows itself where its last row has led it, or else where the run began."""
    c, toolpath = channel.coordinates, channel.toolpath
    context, end = toolpath.last_context(), toolpath.last_end()
    if not end:
        c.arrive_machine(channel.stands_at)
        return
    if context is not None and (
        context.frame != c.zero
        or context.offsets != tuple(c.offsets)
        or context.transformation is not toolpath.contexts[channel.context_number()].transformation
    ):
        # Offsets or the transformation have changed behind that row: the axes stand, what is displayed follows.
        c.arrive_machine(toolpath.to_machine(end, context, c.geometry))
        return
    if channel.path.leads_axes and c.transformation is not None:
        end = c.transformation.to_work(end)
    c.arrive(end)


def end_run(channel: Channel, error: AlarmError) -> None:
    """End a channel's run with an alarm, at the block that runs unless the error names another place."""
    alarm = _alarm(channel, error)
    channel.alarms.append(alarm)
    raised = Raised(alarm.code, alarm.line, alarm.column, alarm.program)
    toolpath = channel.toolpath
    number = channel.level.program_number if channel.stack else toolpath.program_number("")
    context = channel.context_number()
    toolpath.append_event(raised, number, alarm.line, context, channel.coordinates.position)
    channel.path.clear()
    channel.finished = True


def _alarm(channel: Channel, error: AlarmError) -> Alarm:
    level = channel.stack[-1] if channel.stack else None
    program = level.code.program if level else None
    name = program.name if program else ""
    if error.program is not None:
        name = channel.toolpath.programs[error.program]
        program = next((each for each in channel.programs if each.name == name), program)
    line = error.line or (level.code.line(level.current) if level else 0)
    return Alarm(
        control=channel.control.id,
        code=error.code,
        program=name,
        line=line,
        column=error.column or _column(level, program, line, error),
        args=dict(error.args_by_name),
        hint=error.hint,
        detail=error.detail,
        file=str(program.path or "") if program else "",
        call_chain=tuple((lv.code.program.name, lv.code.line(lv.current)) for lv in channel.stack[:-1]),
        channel=channel.number,
    )


def _column(level: Level | None, program: Program | None, line: int, error: AlarmError) -> int:
    """Where an alarm points: at the word that it names, at a value that it quotes, else at the head of the block."""
    if level and error.address and not error.line:
        column: int = level.code.column(level.current, error.address)
        if column:
            return column
    index = line - program.first_line if program else -1
    if program is None or not 0 <= index < len(program.lines):
        return 0
    block = program.lines[index]
    for value in error.args_by_name.values():
        quoted = str(value)
        # An address is quoted without its number.
        end = r"(?![A-Z_])" if len(quoted) == 1 else r"(?!\w)"
        found = re.search(rf"(?<![\w$]){re.escape(quoted)}{end}", block, re.IGNORECASE) if quoted else None
        if found:
            return found.start() + 1
    head = after_head(block)
    return head + 1 if head < len(block) else 0
