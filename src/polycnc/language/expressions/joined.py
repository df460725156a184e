"""What code of joined steps says to the channel: the names and statements that both languages with joined steps use."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.code import Lifted, assigned, attribute, call, dotted, name

if TYPE_CHECKING:
    from polycnc.channel.steps import Step

#: How many steps are joined at the most.
MAX_JOINED = 200
#: Into so many functions a block is joined at the most. Jumps from everywhere, and stages that stop behind each block,
#: would otherwise join it anew for every block in front of it.
MOST_JOINS = 8
#: Passes of a loop between two looks at the block limit and the size of the chunk.
BURST = 256

CHANNEL, LEVEL = name("channel"), name("level")
#: The step that is running, and the one that comes next.
CURRENT, INDEX = attribute(LEVEL, "current"), attribute(LEVEL, "index")
#: Something has happened that the channel looks after.
ATTENTION = attribute(CHANNEL, "attention")
#: Blocks that have run, and up to where joined steps may run.
BLOCKS, ROOM = attribute(CHANNEL, "blocks"), attribute(CHANNEL, "joined_below")
#: Where the block's rows begin, for an alarm that takes it back.
MARK = assigned(attribute(CHANNEL, "mark"), call("len", dotted("channel.toolpath.chunk.kind")))


def lifted_object(place: int) -> Lifted:
    """An object that the code has as a parameter."""
    return Lifted("o", place)


def led_by(first: Step, joined: Step) -> Step:
    """A joined step that knows its first one: single block operation runs that alone."""
    joined.__dict__["alone"] = first
    return joined
