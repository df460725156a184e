"""What a block tells the path of the course of its feed (FLIN, FCUB, F=FPO)."""

from __future__ import annotations

from polycnc.channel.moves.path import PlacedEvent
from polycnc.control.sinumerik.feed.profile_stage import ProfileStage, TellsFeed
from polycnc.control.sinumerik.feed.profiles import Profile, ProgrammedFeed
from polycnc.control.sinumerik.tables import POLYNOMIAL
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Values
    from polycnc.control.sinumerik.family import SinumerikChannel


def before(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """In front of the words of the block: the feed from which its own one starts."""
    feed = ProgrammedFeed.of(channel)
    feed.before, feed.coefficients = channel.feed, None
    if channel.path.find(ProfileStage) is None:
        channel.path.put(ProfileStage(channel))


def tell(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """Behind its words: what they say of the feed goes along with the moves."""
    feed, head, level = ProgrammedFeed.of(channel), channel.path.head, channel.level
    kind = channel.mode["feed_profile"] if feed.coefficients is None else POLYNOMIAL
    profile = Profile(kind, feed.before, channel.feed, feed.coefficients or (0.0, 0.0))
    if head is not None:
        context = channel.context_number()
        head.event(PlacedEvent(TellsFeed(profile), level.program_number, channel.line, context))
