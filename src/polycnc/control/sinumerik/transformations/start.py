"""ORIRESET: the orientation axes go to their initial positions (6.2.3)."""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.transformations import data_sets, seat
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel


def reset(channel: SinumerikChannel, args: Arguments) -> None:
    """ORIRESET(a, b, c): in the order of the transformation; what is left out comes from MD24500 and MD24600.

    Frames of rotary axes do not count. Alarms 14101 without an orientation transformation, 14130 for too many values.
    """
    state = seat.Transformations.of(channel)
    point, seated, build = seat.centre_point(channel), state.seated, state.build
    if point is None or seated is None or build is None:
        raise AlarmError("14101")
    order = data_sets.in_order(point.kinematics)
    if len(args) > len(order):
        raise AlarmError("14130")
    coordinates = channel.coordinates
    end = coordinates.position.copy()
    for i, axis in enumerate(order):
        given = args[i] if i < len(args) else None
        value = (
            data_sets.number_of(channel, f"$MC_TRAFO5_ROT_AX_OFFSET_{build.order}", i, 0.0)
            if given is None
            else arguments.real(given)
        )
        column = point.axes.index(axis)
        end[column] = value - (seated.shifts[column] if seated.shifts else 0.0)
    rapid = channel.mode["motion"] == "G0"
    feed = channel.feed if rapid else moves.checked_feed(channel.feed)
    moves.line(channel, Kind.RAPID if rapid else Kind.FEED, end, float("nan") if rapid else feed)


PROCEDURES: dict[str, Procedure] = {"ORIRESET": reset}
