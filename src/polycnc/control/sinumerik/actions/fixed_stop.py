"""Travel to fixed stop and torque from actions: FXS, FXST, FXSW, FOCON, FOCOF, these two from programs too (10.4.27).

No machine of polycnc has a fixed stop: the selection is kept with its torque and window, and the stop never comes.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments
    from polycnc.control.sinumerik.variables import in_force

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.actions.run import Running
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

#: `$AA_FXS`: not selected; selected, the stop has not come.
OFF, SELECTED = 0, 3
DATA = {"FXST": "$SA_FIXED_STOP_TORQUE", "FXSW": "$SA_FIXED_STOP_WINDOW"}


@dataclass(slots=True)
class FixedStops(State, lifetime=Lifetime.RESET):
    """Axes that travel to a fixed stop.

    Attributes:
        selected: Their columns.
        limited: Columns of axes whose torque is limited.
        began: Where an axis of the running block was when the block began, by column.
    """

    selected: set[int] = field(default_factory=set)
    limited: set[int] = field(default_factory=set)
    began: dict[int, float] = field(default_factory=dict)


def select(run: Running, index: Any, _modifier: str, value: float) -> None:
    """FXS: 1 selects, 0 ends it; 20092 for an axis that has it already."""
    column, selected = arguments.column(run.channel, index), FixedStops.of(run.channel).selected
    if value and column in selected:
        raise AlarmError("20092", axis=run.channel.axes[column])
    run.changed = True
    if value:
        selected.add(column)
    else:
        selected.discard(column)
    in_force.refresh(run.channel)


def datum(name: str) -> Callable[[Running, Any, str, Any], None]:
    """FXST, FXSW: clamping torque in percent, width of the window, as setting data."""

    def write(run: Running, index: Any, _modifier: str, value: float) -> None:
        arguments.column(run.channel, index)
        run.channel.memory.data.write(DATA[name], (index,), float(value))

    return write


def limit_torque(*, on: bool) -> Callable[[Running, Any, str, Any], None]:
    """FOCON, FOCOF: the torque of an axis is limited, or no more."""

    def switch(run: Running, index: Any, _modifier: str, _value: Any) -> None:
        _limit(run.channel, index, on=on)
        in_force.refresh(run.channel)

    return switch


def limit_torque_of_program(*, on: bool) -> Procedure:
    """FOCON[axis], FOCOF[axis] of a program: nothing of the path changes, for no machine presses against anything."""

    def switch(channel: SinumerikChannel, args: Arguments) -> None:
        if len(args) != 1:
            raise AlarmError("14020", text="FOCON" if on else "FOCOF")
        _limit(channel, args[0], on=on)

    return switch


def _limit(channel: SinumerikChannel, axis: Any, *, on: bool) -> None:
    column, limited = arguments.column(channel, axis), FixedStops.of(channel).limited
    if on:
        limited.add(column)
    else:
        limited.discard(column)


def _state(channel: SinumerikChannel, indices: Indices) -> int:
    column = arguments.column(channel, indices[0] if indices else None)
    return SELECTED if column in FixedStops.of(channel).selected else OFF


def _limited(channel: SinumerikChannel, indices: Indices) -> int:
    return int(arguments.column(channel, indices[0] if indices else None) in FixedStops.of(channel).limited)


FIXED_STOP_VARIABLES: dict[str, RowWithStop] = {
    "$AA_FXS": (Type.INT, _state, None, True),
    "$AA_FOC": (Type.INT, _limited, None, True),
}
PROCEDURES: dict[str, Procedure] = {
    "FOCON": limit_torque_of_program(on=True),
    "FOCOF": limit_torque_of_program(on=False),
}
