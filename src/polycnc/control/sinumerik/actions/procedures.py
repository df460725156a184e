"""Procedures of actions: the path, other actions, wait marks, alarms, axis exchange (job planning 10.4)."""

from __future__ import annotations

from polycnc.control.sinumerik.actions import couplings, polynomials
from polycnc.control.sinumerik.actions.run import Deleted
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.channels import axis_requests
from polycnc.control.sinumerik.channels.coordination import group_of
from polycnc.control.sinumerik.oscillation.strokes import Oscillations
from polycnc.control.sinumerik.tools import online
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import Alarm, AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.actions.run import Running
    from polycnc.control.sinumerik.block.arguments import Arguments

#: SETAL: thousands of numbers that are only shown.
SHOWN_ONLY = frozenset((62, 67, 68, 69))


def hold_next(run: Running, _args: Arguments) -> None:
    """RDISABLE: the next block does not begin in this cycle."""
    run.influence.holds_next = True


def release_preparation(run: Running, _args: Arguments) -> None:
    """STOPREOF: preparation goes on when all actions of the cycle have acted."""
    run.releases = True


def delete_distance(run: Running, args: Arguments) -> None:
    """DELDTG: the rest of the block is dropped; DELDTG(axis): that of an axis beside the path."""
    channel, deleted = run.channel, Deleted.of(run.channel)
    if not args:
        deleted.path = run.clocked.drop_rest()
    for axis in args:
        column = arguments.column(channel, axis)
        commanded = run.clocked.commanded(column)
        deleted.axes[column] = commanded.left
        if not Oscillations.of(channel).break_off(column):
            commanded.stop()
    run.changed = True


def lock(run: Running, args: Arguments) -> None:
    """LOCK: the condition is not asked, technology cycles wait."""
    run.coordinate("LOCK", args)


def unlock(run: Running, args: Arguments) -> None:
    """UNLOCK."""
    run.coordinate("UNLOCK", args)


def reset(run: Running, args: Arguments) -> None:
    """RESET: technology cycles begin anew."""
    run.coordinate("RESET", args)


def set_mark(run: Running, args: Arguments) -> None:
    """SETM: wait marks of the own channel."""
    for mark in args:
        group_of(run.channel).set_mark(run.channel.number, arguments.whole(mark))


def clear_mark(run: Running, args: Arguments) -> None:
    """CLEARM."""
    for mark in args:
        group_of(run.channel).marks(run.channel.number).discard(arguments.whole(mark))


def alarm(run: Running, args: Arguments) -> None:
    """SETAL: an alarm of the user; some numbers are only shown (10.4.26)."""
    number = arguments.whole(args[0]) if args else 0
    if not 65000 <= number <= 69999:
        raise AlarmError("14020", text="SETAL")
    text = str(args[1]) if len(args) > 1 and args[1] is not None else f"SETAL({number})"
    if number // 1000 not in SHOWN_ONLY:
        raise AlarmError(str(number), detail=text)
    code = run.action.code
    run.channel.alarms.append(
        Alarm(
            run.channel.control.id,
            str(number),
            code.program,
            code.line,
            detail=text,
            channel=run.channel.number,
        )
    )
    run.action.is_done = True


def release_axes(run: Running, args: Arguments) -> None:
    """RELEASE: the axes are neutral."""
    axis_requests.release(run.channel, args)


def get_axes(run: Running, args: Arguments) -> None:
    """GET: the axes are the program's, as soon as they stand and no other channel has them."""
    axis_requests.get(run.channel, args)


def to_channel(run: Running, args: Arguments) -> None:
    """AXTOCHAN: channels ask for axes."""
    axis_requests.to_channel(run.channel, args)


def lines_at_once(run: Running, _args: Arguments) -> None:
    """ICYCOF."""
    run.at_once = True


def line_by_line(run: Running, _args: Arguments) -> None:
    """ICYCON."""
    run.at_once = False


def preset(run: Running, args: Arguments) -> None:
    """PRESETON(axis,value,…): an axis that actions move shows another machine position; it does not move (10.4.19)."""
    if not args or len(args) % 2:
        raise AlarmError("14020", text="PRESETON")
    for axis, value in zip(args[::2], args[1::2], strict=True):
        column = arguments.column(run.channel, axis)
        if run.clocked.is_on_path(column):
            raise AlarmError("20141", axis=run.channel.axes[column])
        unit = run.channel.control.unit_of(run.channel, run.channel.axes[column])
        run.clocked.commanded(column).preset(arguments.real(value) * unit)
    run.changed = True


def fine_offset(run: Running, args: Arguments) -> None:
    """FTOC(function,reference,length[,channel[,spindle]]): the wear of a wheel follows a function of a value (10.4.9).

    What the function gives is added to the wear that was there when the action acted first.
    """
    if not 3 <= len(args) <= 5 or None in args[:3]:
        raise AlarmError("14020", text="FTOC")
    value = polynomials.value(run.channel, arguments.whole(args[0]), arguments.real(args[1]))
    where = args[2:]
    way = value - run.action.offsets.get(where, 0.0)
    if way:
        online.put_fine(run.channel, (way, *where))
        run.action.offsets[where] = value
        run.changed = True


PROCEDURES: dict[str, Callable[[Running, Arguments], None]] = {
    "RDISABLE": hold_next,
    "STOPREOF": release_preparation,
    "DELDTG": delete_distance,
    "LOCK": lock,
    "UNLOCK": unlock,
    "RESET": reset,
    "SETM": set_mark,
    "CLEARM": clear_mark,
    "SETAL": alarm,
    "RELEASE": release_axes,
    "GET": get_axes,
    "AXTOCHAN": to_channel,
    "PRESETON": preset,
    "FTOC": fine_offset,
    "ICYCOF": lines_at_once,
    "ICYCON": line_by_line,
    **couplings.PROCEDURES,
}
