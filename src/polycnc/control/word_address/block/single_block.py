"""Single block: behind which blocks a program halts.

A control declares its `halts`: rules in the order in which they are asked, of which the first that knows decides.
"""

from __future__ import annotations

from collections.abc import Callable

from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias
from polycnc.language.word_address.words import ExpressionBlock, WordBlock

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step

#: Whether a program halts behind the block that a step of a level was; None where another rule decides. The channel is
#: one of the control that declares the rule.
Halts: TypeAlias = "Callable[[Any, Level[Any], Step], bool | None]"


def behind_words(channel: Channel, level: Level, step: Step) -> bool:
    """Behind a block of words; macro statements, calls and returns do not count."""
    if channel.level is not level or channel.finished:
        return False
    if isinstance(step, WordBlock):
        return bool(step.signature)
    return isinstance(step, ExpressionBlock) and bool(step.keys)
