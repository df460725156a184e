"""The modal functions of a channel and what they chose, noted and put back: SAVE, contours that are only read."""

from __future__ import annotations

from polycnc.control.sinumerik import gcodes, tables
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.tools import selection
from polycnc.control.sinumerik.transformations import smoothing
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.names.frame import NcFrame


@dataclass(frozen=True, slots=True)
class ModalState:
    """All modal functions, and the programmable frame (job planning 1.25.1.3, SAVE).

    Attributes:
        mode: The functions.
        programmable: The frame.
        feed: F that goes with them, internal units; NaN for none. Another F of the same kind stays.
    """

    mode: Mode
    programmable: NcFrame
    feed: float = field(compare=False)

    def restore(self, channel: SinumerikChannel) -> None:
        """Put it back, with what hangs on it: the zero offset, the feed, the lengths of the tool."""
        before, memory = channel.mode, channel.memory
        own = [
            (name, before[name]) for name in ("transformation", "segments", "geometry")
        ]  # they are no modal functions
        mode = self.mode.with_codes(own)
        channel.mode = mode
        memory.frames.programmable = self.programmable
        if mode["wcs"] != before["wcs"]:
            memory.frames.select(gcodes.number_of(mode["wcs"]) - 1)
        feed, path_feed = tables.feed_type(mode).mode, PathFeed.of(channel)
        if feed is not path_feed.mode:  # F of another kind means nothing: the one in front goes on
            channel.feed, path_feed.mode = self.feed, feed
        selection.follow(channel)
        smoothing.follow(channel)
        frames.changed(channel)
        channel.context_changed()
