"""Settings of single axes: when one counts as arrived (FINEA, IPOBRKA, ADISPOSA), SCPARA (job planning 4.11, 4.12)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.variables.row import RowWithStop
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape


#: $AA_MOTEND for each criterion; without one it is that of exact stop fine.
MOTION_ENDS = {"FINEA": 1, "COARSEA": 2, "IPOENDA": 3, "IPOBRKA": 4}
#: ADISPOSA: no window, one about the set position, one about the actual position.
WINDOW_MODES = (0, 1, 2)
PARAMETER_SETS = range(1, 7)
#: Axes that learn at the same time at most.
MOST_LEARNING = 4


@dataclass(slots=True)
class AxisSettings(State, lifetime=Lifetime.POWER):
    """What a program has set for single axes, by column.

    Attributes:
        motion_end: When it counts as arrived, as `MOTION_ENDS`.
        window: Mode of ADISPOSA.
        parameter_set: SCPARA.
        acceleration: BRISKA, SOFTA, DRIVEA or JERKA.
        learns: Columns of axes whose drives learn what friction does to them (QECLRNON).
    """

    motion_end: dict[int, int] = field(default_factory=dict)
    window: dict[int, int] = field(default_factory=dict)
    parameter_set: dict[int, int] = field(default_factory=dict)
    acceleration: dict[int, str] = field(default_factory=dict)
    learns: set[int] = field(default_factory=set)


def motion_end(name: str) -> Procedure:
    """FINEA, COARSEA, IPOENDA, IPOBRKA: when a positioning axis counts as arrived."""

    def run(channel: SinumerikChannel, args: Arguments) -> None:
        # IPOBRKA takes an axis and a percentage, the others take axes.
        axes = args[:1] if name == "IPOBRKA" else args
        if not axes:
            raise AlarmError("12040", text=name)
        for axis in axes:
            AxisSettings.of(channel).motion_end[arguments.column(channel, axis)] = MOTION_ENDS[name]
        if name == "IPOBRKA" and len(args) > 1:
            _set_braking_share(channel, axes[0], args[1])

    return run


def _set_braking_share(channel: SinumerikChannel, axis: Axis, value: Any) -> None:
    """IPOBRKA(axis, percent): where in the braking ramp the block changes; 100 is its beginning (SD43600)."""
    percent = arguments.real(value)
    if not 0.0 <= percent <= 100.0:
        raise AlarmError("12560", text="IPOBRKA")
    channel.memory.data.write("$SA_IPOBRAKE_BLOCK_EXCHANGE", (axis,), percent)


def end_window(draft: Draft, position: int, shape: WordShape) -> Step:
    """ADISPOSA[axis]=(mode,size): with IPOBRKA, the axis must also be within a window of its end (SD43610)."""
    column = axis_column(draft, position, shape)

    def run(channel: SinumerikChannel, values: Values) -> None:
        listed = values[position]
        if not isinstance(listed, tuple) or not 1 <= len(listed) <= 2 or listed[0] not in WINDOW_MODES:
            raise WordAlarm("12560", position, text="ADISPOSA")
        AxisSettings.of(channel).window[column] = int(listed[0])
        if len(listed) > 1:
            channel.memory.data.write("$SA_ADISPOSA_VALUE", (channel.axes[column],), float(listed[1]))

    return run


def learn_friction(channel: SinumerikChannel, args: Arguments) -> None:
    """QECLRNON(axis, …): up to four axes learn (job planning 14.6); axes without friction have nothing to learn.

    Raises:
        AlarmError: 14020 for no axis, or more than four.
    """
    if not 1 <= len(args) <= MOST_LEARNING:
        raise AlarmError("14020", text="QECLRNON")
    AxisSettings.of(channel).learns.update(arguments.column(channel, axis) for axis in args)


def end_learning(channel: SinumerikChannel, args: Arguments) -> None:
    """QECLRNOF: no axis learns any more."""
    if args:
        raise AlarmError("14020", text="QECLRNOF")
    AxisSettings.of(channel).learns.clear()


def _motion_end(channel: SinumerikChannel, indices: Arguments) -> int:
    """$AA_MOTEND: 5 and 6 where IPOBRKA has a window as well."""
    settings, column = AxisSettings.of(channel), axis_of(channel, "$AA_MOTEND", indices)
    end = settings.motion_end.get(column, MOTION_ENDS["FINEA"])
    return end + settings.window.get(column, 0) if end == MOTION_ENDS["IPOBRKA"] else end


def _parameter_set(channel: SinumerikChannel, indices: Arguments) -> int:
    """$AA_SCPAR."""
    return AxisSettings.of(channel).parameter_set.get(axis_of(channel, "$AA_SCPAR", indices), 1)


def parameter_set(draft: Draft, position: int, shape: WordShape) -> Step:
    """SCPARA[axis]: servo parameter set 1 to 6."""
    column = axis_column(draft, position, shape)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value not in PARAMETER_SETS:
            raise WordAlarm("12560", position, text="SCPARA")
        AxisSettings.of(channel).parameter_set[column] = int(value)

    return run


def axis_of(channel: SinumerikChannel, name: str, indices: Arguments) -> int:
    """The column of the axis that is the index of a variable; 12400 where there is none."""
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text=name)
    return channel.memory.column(indices[0].name)


AXIS_VARIABLES: dict[str, RowWithStop] = {
    "$AA_MOTEND": (Type.INT, _motion_end, None, True),
    "$AA_SCPAR": (Type.INT, _parameter_set, None, True),
}
