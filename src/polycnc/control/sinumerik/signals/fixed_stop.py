"""Travel to a fixed stop from the program: FXS, FXST, FXSW (Fundamentals; job planning 10.4.27).

No machine of polycnc has a stop, so an axis that travels to one goes to the end of its block and alarms there.
"""

from __future__ import annotations

from polycnc.control.sinumerik.actions.fixed_stop import DATA, FixedStops
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape

#: Values of FXS.
SWITCH = (0.0, 1.0)


def select(draft: Draft, position: int, shape: WordShape) -> Step:
    """FXS[axis]: 1 selects, 0 ends it.

    Raises:
        AlarmError: 12560 for another value, 20092 for an axis that has it already, 20091 behind a block in which the
            axis has moved and no stop has come.
    """
    column = axis_column(draft, position, shape)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value, selected = number(values, position), FixedStops.of(channel).selected
        if value not in SWITCH:
            raise WordAlarm("12560", position, text="FXS")
        if value and column in selected:
            raise WordAlarm("20092", position, axis=channel.axes[column])
        if value:
            selected.add(column)
        else:
            selected.discard(column)
        FixedStops.of(channel).began[column] = channel.coordinates.position[column]

    def arrive(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        stops = FixedStops.of(channel)
        way = channel.coordinates.position[column] - stops.began.pop(column)
        if abs(way) > NO_WAY and column in stops.selected:
            channel.keep_rows()
            stops.selected.discard(column)
            raise AlarmError("20091", axis=channel.axes[column])

    draft.behind_motion.append(arrive)
    return run


def datum(draft: Draft, position: int, shape: WordShape) -> Step:
    """FXST[axis], FXSW[axis]: clamping torque in percent (SD43510), width of the window (SD43520)."""
    column = axis_column(draft, position, shape)
    factor = length_factor(draft.mode) if shape.address == "FXSW" else 1.0

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value < 0.0:
            raise WordAlarm("12560", position, text=shape.address)
        channel.memory.data.write(DATA[shape.address], (channel.axes[column],), value * factor)

    return run


WORDS = {"FXS": select, "FXST": datum, "FXSW": datum}
