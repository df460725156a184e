"""Why a channel hands over control: it yields one of these and goes on when it is resumed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True, slots=True)
class Wait:
    """A channel that waits.

    `reason` is `stop` (M00 and the like: `code` says which), `chunk`, `preprocessing`, `single-block` behind a
    block at which that halts (`code` is the block), `block` behind any other one, or `channel` for another
    channel: then `until` is asked again and again, and true once the channel may go on. Behind blocks that were typed
    in while the program waited it is `mdi`.
    """

    reason: str
    code: str = ""
    until: Callable[[], bool] | None = None


CHUNK = Wait("chunk")
BLOCK = Wait("block")
PREPROCESSING = Wait("preprocessing")
TYPED_BLOCKS_DONE = Wait("mdi")


class PreprocessingStop(Exception):  # noqa: N818 - no mistake: the block waits, and comes again
    """The running block needs what the main run knows; raised before it has done anything."""
