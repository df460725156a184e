"""Why a channel hands over control: it yields one of these and goes on when it is resumed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Wait:
    """A channel that waits. `reason` is `stop` (M00 and the like: `code` says which), `chunk`, or `preprocessing`."""

    reason: str
    code: str = ""


CHUNK = Wait("chunk")
