"""What a SINUMERIK channel remembers beside modal codes and positions; it is `channel.memory`."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.feed.spindles import Spindles
    from polycnc.control.sinumerik.frames.memory import Frames
    from polycnc.control.sinumerik.tools.memory import Tools
    from polycnc.language.sinumerik.interface import LanguageMemory
    from polycnc.machine.model import Axis


@dataclass(slots=True, eq=False)
class Memory:
    """The state of one channel.

    Attributes:
        language: What the NC language keeps (R parameters, user variables, calls).
        data: Machine and setting data.
        frames: Stored and active frames.
        tools: Tool memory and active tool.
        spindles: Spindles and the master spindle.
        axes: The axes as words mean them: under a transformation one that turns may stand for a length.
        columns: Column of every axis by each of its names in the program (channel and geometry names).
        machine_columns: Column of every axis by the name of its machine axis.
        own_columns: The same as `columns` without a transformation, which may use axes up or name them anew.
        transverse: Column of the axis that diameter programming is for, -1 for none.
        shares_axes: Another channel can use axes of this one.
        machine_refuses_moves: The machine's controller may refuse moves.
    """

    language: LanguageMemory
    data: MachineData
    frames: Frames
    tools: Tools
    spindles: Spindles
    axes: tuple[Axis, ...]
    columns: Mapping[str, int]
    machine_columns: Mapping[str, int]
    own_columns: Mapping[str, int]
    transverse: int = -1
    shares_axes: bool = False
    machine_refuses_moves: bool = False

    def column(self, axis: str) -> int:
        """Column of an axis by any of its names.

        Raises:
            AlarmError: 12050 for an axis that the channel does not have.
        """
        for names in (self.columns, self.machine_columns, self.own_columns):
            if axis in names:
                return names[axis]
        raise AlarmError("12050", axis=axis)
