"""What a program takes out of the operator's hands: M73 to M76, #3004, G63, tapping.

The toolpath's context says which overrides and whether feed hold act; what runs the path obeys it.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.modes import CornerMode

with loaded_when_called():
    from polycnc.control.word_address.macro_b.variables import ControlSwitches

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel
    from polycnc.toolpath import Context

FEED, SPINDLE = "feed", "spindle"
#: Bits of #3004: no feed hold, no feed override, no exact stop.
NO_HOLD, NO_FEED_OVERRIDE, NO_EXACT_STOP = 1, 2, 4
#: Under tapping mode neither feed override nor feed hold act.
TAPPING_MODE = "G63"


@dataclass(slots=True)
class OverrideState(State, lifetime=Lifetime.RESET):
    """What of the operator's overrides does not act.

    Attributes:
        cancelled: Overrides that the program has switched off.
        tapping: A tapping cycle works.
        in_tap: It cuts, or comes back from that: a feed hold waits for its end.
    """

    cancelled: frozenset[str] = frozenset()
    tapping: bool = False
    in_tap: bool = False


def cancel_feed_override(channel: WordAddressChannel, _words: Words) -> None:
    """M73: the feed override counts 100 %."""
    _cancel(channel, FEED, cancelled=True)


def allow_feed_override(channel: WordAddressChannel, _words: Words) -> None:
    """M74."""
    _cancel(channel, FEED, cancelled=False)


def cancel_spindle_override(channel: WordAddressChannel, _words: Words) -> None:
    """M75: the spindle override counts 100 %."""
    _cancel(channel, SPINDLE, cancelled=True)


def allow_spindle_override(channel: WordAddressChannel, _words: Words) -> None:
    """M76."""
    _cancel(channel, SPINDLE, cancelled=False)


def _cancel(channel: WordAddressChannel, name: str, *, cancelled: bool) -> None:
    state = OverrideState.of(channel)
    state.cancelled = state.cancelled | {name} if cancelled else state.cancelled - {name}
    channel.context_changed()


@contextmanager
def fixed_feed(channel: WordAddressChannel) -> Iterator[None]:
    """The moves in between run at the programmed feed, whatever the operator's override."""
    state = OverrideState.of(channel)
    before, state.cancelled = state.cancelled, state.cancelled | {FEED}
    channel.context_changed()
    try:
        yield
    finally:
        state.cancelled = before
        channel.context_changed()


def _taps(channel: WordAddressChannel) -> bool:
    """Whether G63 holds, in a block of exact stop too."""
    return channel.mode.codes.get("path") == TAPPING_MODE


def in_tapping_mode(channel: WordAddressChannel, context: Context) -> Context:
    """A context as G63 makes it: no feed override, no feed hold."""
    return replace(context, feed_override=False, feed_hold=False) if _taps(channel) else context


def overridden(channel: MacroChannel, context: Context) -> Context:
    """A context with what the operator's switches may do in it."""
    state = OverrideState.of(channel)
    switches = ControlSwitches.of(channel).values.get("cntl2", 0)
    tapping = _taps(channel)
    if not (tapping or state.tapping or switches or state.cancelled):
        return context
    return replace(
        context,
        feed_override=not (tapping or state.tapping or FEED in state.cancelled)
        and not switches & NO_FEED_OVERRIDE,
        spindle_override=not (state.tapping or SPINDLE in state.cancelled),
        feed_hold=not (tapping or state.in_tap) and not switches & NO_HOLD,
        corner_mode=CornerMode.CONTINUOUS if switches & NO_EXACT_STOP else context.corner_mode,
    )
