"""Why a channel hands over control: it yields one of these and goes on when it is resumed."""

from __future__ import annotations

from enum import StrEnum

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


class Why(StrEnum):
    """Why a channel waits."""

    STOP = "stop"
    """M00 and the like."""
    CHUNK = "chunk"
    """A chunk of the toolpath is full."""
    PREPROCESSING = "preprocessing"
    """The main run must catch up."""
    SINGLE_BLOCK = "single-block"
    """Behind a block at which single block halts."""
    BLOCK = "block"
    """Behind any other block."""
    CHANNEL = "channel"
    """For another channel."""
    TYPED_IN = "mdi"
    """Behind blocks that were typed in while the program waited."""
    CLOCK = "clock"
    """For a main run: the program needs to be executed in time."""


@dataclass(frozen=True, slots=True)
class Wait:
    """A channel that waits.

    Attributes:
        reason: Why.
        code: The code of a stop, or the block at which single block halts.
        until: Asked again and again while a channel waits for another one; true once it may go on.
    """

    reason: Why
    code: str = ""
    until: Callable[[], bool] | None = None


CHUNK = Wait(Why.CHUNK)
BLOCK = Wait(Why.BLOCK)
PREPROCESSING = Wait(Why.PREPROCESSING)
TIME_SLICE = Wait(Why.PREPROCESSING, "slice")
CLOCK = Wait(Why.CLOCK)
TYPED_BLOCKS_DONE = Wait(Why.TYPED_IN)


class PreprocessingStop(Exception):  # noqa: N818 - no mistake: the block waits, and comes again
    """The running block needs what the main run knows, or what `wait` waits for; raised before it has done anything."""
