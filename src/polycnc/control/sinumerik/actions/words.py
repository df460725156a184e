"""Words of actions: axes, spindles, auxiliary functions (job planning 10.4.2, 10.4.12 to 10.4.16, 10.4.20)."""

from __future__ import annotations

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions import fixed_stop
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block.positions import Dimension, is_diameter
from polycnc.control.sinumerik.m_functions import DIRECTIONS
from polycnc.control.sinumerik.signals import measuring_actions
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.units import INCH_MM
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Auxiliary, HFunction, SpindleSpeed

with loaded_when_called():
    from polycnc.control.sinumerik.actions import axes as action_axes
    from polycnc.control.sinumerik.axes import spindles as spindle_axes
    from polycnc.control.sinumerik.block import arguments
    from polycnc.control.sinumerik.motion import indexing
    from polycnc.control.sinumerik.variables import in_force

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.actions.run import Running

#: M functions that no action puts out (10.4.2).
REFUSED_M = frozenset({0, 1, 2, 6, 17, 30})


def position(run: Running, index: Any, modifier: str, value: float) -> None:
    """POS: an axis goes to a position of the work, beside the program."""
    column = _commandable(run, index)
    channel, clocked = run.channel, run.clocked
    axis = channel.axis_data[column]
    if not axis.rotary:
        value *= INCH_MM if run.unit in ("G70", "G700") else 1.0
        way = Dimension.INCREMENTAL if modifier == "IC" else Dimension.ABSOLUTE
        if is_diameter(channel.mode, way, column, channel.memory.transverse):
            value *= 0.5
    here = clocked.machine(column)
    if modifier == "IC":
        target = here + value
    else:
        offset = channel.actual.machine[column] - channel.actual.work[column]
        target = _rotary(run, column, here, value + offset, modifier)
    action_axes.check_target(channel, column, target)
    run.targets[column] = target
    run.directions.pop(column, None)


def _rotary(run: Running, column: int, here: float, target: float, modifier: str) -> float:
    """A modulo axis goes within its turn, or the way that DC, ACP, ACN ask for."""
    if not run.channel.axis_data[column].modulo:
        return target
    if modifier not in ("DC", "ACP", "ACN"):
        return here - here % tables.TURN + target % tables.TURN
    return here + _way(here, target, modifier)


def _way(here: float, target: float, modifier: str) -> float:
    """To an angle by the shorter way (DC), or in a direction (ACP, ACN), degrees."""
    way = (target - here) % tables.TURN
    if modifier == "ACN" or (modifier != "ACP" and way > tables.TURN / 2.0):
        way -= tables.TURN if way else 0.0
    return way


def endless(run: Running, index: Any, _modifier: str, value: float) -> None:
    """MOV: an axis goes on without end; 0 stops it, an indexing axis at its next position."""
    column = _commandable(run, index)
    run.targets.pop(column, None)
    if not value:
        left, speed = run.clocked.commanded(column).left, action_axes.speed_of(run.channel, column)
        stop = indexing.stop_of(run.channel, column, run.clocked.machine(column), left, speed)
        if stop is not None:
            run.targets[column] = stop
            run.directions.pop(column, None)
            return
    run.directions[column] = (value > 0) - (value < 0)


def feed(run: Running, index: Any, _modifier: str, value: float) -> None:
    """FA: modal; it acts on a motion that runs."""
    column = arguments.column(run.channel, index)
    if value <= 0.0:
        raise AlarmError("14810" if value < 0.0 else "10861", axis=run.channel.axes[column])
    inch = INCH_MM if run.unit == "G700" and not run.channel.axis_data[column].rotary else 1.0
    ActionAxes.of(run.channel).speeds[column] = value * inch / tables.MINUTE
    run.speeds.add(column)


def _commandable(run: Running, index: Any) -> int:
    """Column of an axis that may be commanded; 20141 for one that the path moves, or that another channel has."""
    column = arguments.column(run.channel, index)
    _check_commandable(run, column)
    return column


def _check_commandable(run: Running, column: int) -> None:
    if run.clocked.is_on_path(column) or action_axes.is_elsewhere(run.channel, column):
        raise AlarmError("20141", axis=run.channel.axes[column])


def auxiliary_function(run: Running, index: Any, _modifier: str, value: float) -> None:
    """M: put out at once; the spindle follows M3, M4, M5."""
    code, channel = int(value), run.channel
    if code in REFUSED_M or code == channel.memory.data.integer("$MC_TOOL_CHANGE_M_CODE"):
        raise AlarmError("12571", text=f"M{code}")
    if code in DIRECTIONS:
        spindle = channel.memory.spindles.get(arguments.spindle(index))
        spindle.direction = DIRECTIONS[code]
        channel.context_changed()
        in_force.refresh(channel)
    run.clocked.put_out(
        Auxiliary(code) if index is None else Auxiliary(code, spindle=arguments.spindle(index))
    )
    run.changed = True


def h_function(run: Running, _index: Any, _modifier: str, value: float) -> None:
    """H: put out at once."""
    run.clocked.put_out(HFunction(value))
    run.changed = True


def spindle_speed(run: Running, index: Any, _modifier: str, value: float) -> None:
    """S: the speed of a spindle, beside the program; the last command counts (10.4.20)."""
    spindle = run.channel.memory.spindles.get(arguments.spindle(index))
    if value < 0.0:
        raise AlarmError("16763", axis=f"S{spindle.number}")
    run.changed = run.changed or spindle.speed != value
    spindle.speed = float(value)
    run.channel.context_changed()
    in_force.refresh(run.channel)
    run.clocked.put_out(SpindleSpeed(speed=float(value), spindle=spindle.number))


def spindle_position(run: Running, index: Any, modifier: str, value: float) -> None:
    """SPOS: the spindle stands at an angle, beside the program; the axis that it is goes there, as by POS."""
    spindle = run.channel.memory.spindles.get(arguments.spindle(index))
    column = spindle_axes.axis_of(run.channel, spindle.number)
    if column >= 0:
        _check_commandable(run, column)
        here = run.clocked.machine(column)
        if spindle.direction == 0:
            spindle.position = here % tables.TURN
        way = value if modifier == "IC" else _way(here, value, modifier or "DC")
        action_axes.check_target(run.channel, column, here + way)
        run.targets[column] = here + way
        run.directions.pop(column, None)
    place = spindle.position + value if modifier == "IC" else value
    run.changed = run.changed or spindle.direction != 0 or spindle.position != place % tables.TURN
    spindle.position, spindle.direction, spindle.controlled = place % tables.TURN, 0, True
    run.channel.context_changed()
    in_force.refresh(run.channel)


WORDS: dict[str, Callable[[Running, Any, str, Any], None]] = {
    "POS": position,
    "MOV": endless,
    "FA": feed,
    "M": auxiliary_function,
    "H": h_function,
    "S": spindle_speed,
    "SPOS": spindle_position,
    "FXS": fixed_stop.select,
    "FXST": fixed_stop.datum("FXST"),
    "FXSW": fixed_stop.datum("FXSW"),
    "FOCON": fixed_stop.limit_torque(on=True),
    "FOCOF": fixed_stop.limit_torque(on=False),
    **{word: measuring_actions.start(word) for word in measuring_actions.WORDS},
}
