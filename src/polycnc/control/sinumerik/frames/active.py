"""Active frames and the tool in the coordinates of a channel: the way from the work display to the machine."""

from __future__ import annotations

from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING

with loaded_when_called():
    from polycnc.control.sinumerik.tools import stages

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel


def apply(channel: SinumerikChannel, suppression: str = "", *, travelled: bool = False) -> None:
    """Bring the active frames and the tool into the channel's coordinates; the machine does not move.

    Args:
        channel: The channel.
        suppression: G53, G153 or SUPA while their block runs.
        travelled: The next incremental word of an axis travels the change as well.
    """
    seat.stand(channel, channel.memory.frames.total(suppression), travelled=travelled)


def is_in_force(channel: SinumerikChannel) -> bool:
    """Whether a zero offset that is in force would change nothing now: G500, G54 ... once more."""
    frames = channel.memory.frames
    return frames.is_in_force and seat.is_in_place(channel, frames.total())


def changed(channel: SinumerikChannel) -> None:
    """A frame has changed: it acts at once; incremental words travel the change if SD42440 says so."""
    memory, linear = channel.memory, seat.frame_in_front(channel).m
    apply(channel, travelled=bool(memory.data.number("$SC_FRAME_OFFSET_INCR_PROG")))
    if channel.path.head is not None:
        if seat.frame_in_front(channel).m != linear:
            stages.turned_frame(channel)
        stages.changed_frame(channel)
