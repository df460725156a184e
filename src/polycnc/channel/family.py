"""Type variables for what a control family knows better than the channel: its control, its memory, its programs.

Handlers of a family name all three: `LatheChannel: TypeAlias = "Channel[LatheControl, LatheMemory, LatheProgram]"`.
They are covariant, so a handler of a base family takes the channels of every family that is made of it. A bare
`Channel` is one of any family.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    from polycnc.channel.interface import Control
    from polycnc.channel.stack import Executable

    ControlT_co = TypeVar("ControlT_co", bound=Control, covariant=True, default=Any)
    MemoryT_co = TypeVar("MemoryT_co", covariant=True, default=Any)
    ProgramT_co = TypeVar("ProgramT_co", bound=Executable, covariant=True, default=Any)
else:
    from polycnc.deferred.typing import TypeVar

    ControlT_co = TypeVar("ControlT_co", covariant=True)
    MemoryT_co = TypeVar("MemoryT_co", covariant=True)
    ProgramT_co = TypeVar("ProgramT_co", covariant=True)
