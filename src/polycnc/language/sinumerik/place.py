"""Where an alarm of a running block is shown: its column, and the level that DISPLOF leaves visible."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, NoReturn
from polycnc.language.sinumerik.errors import arithmetic
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import NcChannel


def fail(error: Exception, channel: NcChannel) -> NoReturn:
    """Raise what a block ran into as the control's alarm, at its place."""
    alarm = error if isinstance(error, AlarmError) else arithmetic()
    if isinstance(alarm, WordAlarm) and not alarm.column:
        alarm.column = channel.level.code.word_columns(channel, alarm.position)
    hide_levels(alarm, channel)
    raise alarm from None


def hide_levels(alarm: AlarmError, channel: Channel) -> None:
    """With DISPLOF an alarm stands at the call in the last level that is shown (1.25.2.6)."""
    hidden = False
    while len(channel.stack) > 1 and channel.level.data.get("display") == "off":
        channel.pop()
        hidden = True
    if hidden:
        alarm.line = 0
        alarm.column = 0
