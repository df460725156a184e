"""Type variables for the two things that a control family knows better than the channel: its control and its memory.

Handlers of a family name both: `LatheChannel: TypeAlias = "Channel[LatheControl, LatheMemory]"`. Both are covariant, so
a handler of a base family takes the channels of every family that is made of it. A bare `Channel` is one of any family.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    from polycnc.channel.interface import Control

    ControlT_co = TypeVar("ControlT_co", bound=Control, covariant=True, default=Any)
    MemoryT_co = TypeVar("MemoryT_co", covariant=True, default=Any)
else:
    from typing import TypeVar

    ControlT_co = TypeVar("ControlT_co", covariant=True)
    MemoryT_co = TypeVar("MemoryT_co", covariant=True)
