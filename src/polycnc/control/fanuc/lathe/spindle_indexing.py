"""G96.1 to G96.4: a spindle is turned to an angle, or runs as a spindle again (general knowledge of the 30i series).

The order goes to the machine as an event with its words. The angle is no place of an axis of the path.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import BuilderCode, SpindleWait

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.words import Words

#: Largest angle, degrees.
WHOLE_TURN = 360.0
MASTER = 1


@dataclass(slots=True)
class IndexingState(State, lifetime=Lifetime.RESET):
    """The spindles that are on their way to an angle, for all the program knows."""

    turning: set[int] = field(default_factory=set)


def index_and_wait(channel: LatheChannel, words: Words) -> None:
    """G96.1 P R: the spindle turns to an angle, and the program waits for it."""
    _wait_for(channel, _begin(channel, words, "G96.1"))


def index(channel: LatheChannel, words: Words) -> None:
    """G96.2 P R: the spindle turns to an angle while the program goes on."""
    IndexingState.of(channel).turning.add(_begin(channel, words, "G96.2"))


def wait_for_index(channel: LatheChannel, words: Words) -> None:
    """G96.3 P: the program waits until the spindle stands at its angle."""
    spindle = _spindle(channel, words, "G96.3")
    if "R" in words:
        raise words.fail("indexing_company", "R")
    turning = IndexingState.of(channel).turning
    if spindle in turning:
        _wait_for(channel, spindle)
        turning.remove(spindle)  # behind a wait for the main run the block begins again


def turn_as_spindle(channel: LatheChannel, words: Words) -> None:
    """G96.4 P: a servo motor runs as a spindle; M03 and S turn it."""
    spindle = _spindle(channel, words, "G96.4")
    if "R" in words:
        raise words.fail("indexing_company", "R")
    _send(channel, "G96.4", {"P": float(spindle)})


def _begin(channel: LatheChannel, words: Words, code: str) -> int:
    spindle, angle = _spindle(channel, words, code), words.angle("R")
    if angle is None or abs(angle) > WHOLE_TURN:
        raise words.fail("indexing_company", "R" if angle is not None else code)
    if spindle == MASTER and channel.memory.spindle.direction:
        channel.memory.spindle.direction = 0
        channel.context_changed()
    seconds = channel.machine.spindle[spindle].orient_s
    _send(channel, code, {"P": float(spindle), "R": angle}, spindle, seconds)
    return spindle


def _spindle(channel: LatheChannel, words: Words, code: str) -> int:
    """The spindle that P names, the first without P; the code stands alone in its block."""
    if any(key not in (code, "P", "R") for key in words.plan.order):
        raise words.fail("indexing_company", code)
    number = words.integer("P") if "P" in words else MASTER
    if number is None or number not in channel.machine.spindle:
        raise words.fail("spindle_choice", "P")
    return number


def _send(
    channel: LatheChannel, code: str, values: dict[str, float], spindle: int = 0, index_s: float = 0.0
) -> None:
    channel.flush()
    channel.event(BuilderCode(code, values, spindle, index_s))


def _wait_for(channel: LatheChannel, spindle: int) -> None:
    seconds = channel.machine.spindle[spindle].orient_s
    if seconds > 0.0:
        channel.event(SpindleWait(spindle, seconds))
    channel.synchronise()
