"""GEOAX: other channel axes are the geometry axes (job planning 14.2).

To the path this is a transformation in which every axis goes its own way and X, Y, Z are other columns; frames and
tool take their seat in it (`transformations.seat`). The modal state tells the assignments apart, since words mean other
axes under each.
"""

from __future__ import annotations

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.limits import protection, working_area
from polycnc.control.sinumerik.motion.contour_reading import Readings
from polycnc.control.sinumerik.motion.polar import Polar
from polycnc.control.sinumerik.tools import stages
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.transformations.data_sets import native
from polycnc.control.sinumerik.transformations.selection import deselect_frames, end_contour
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row
    from polycnc.transformation.contract import Geometry

WRONG_CALL = "14414"
#: A geometry axis that no channel axis is.
NONE = -1


def exchange(channel: SinumerikChannel, args: Arguments) -> None:
    """GEOAX(n,axis,…): channel axes become geometry axes 1 to 3, with 0 they are none; GEOAX() as the machine has.

    Raises:
        AlarmError: 14414 for a wrong call or an axis that is bound, and what `_check` finds.
    """
    before = channel.coordinates.geometry
    after = _assigned(channel, args) if args else native(channel)
    changed = [place for place in range(3) if before[place] != after[place]]
    _check(channel)
    if changed:
        _check_axes(channel, before, after, changed)
        _change(channel, before, after, changed)


def _assigned(channel: SinumerikChannel, args: Arguments) -> Geometry:
    """The geometry axes behind the call, pair by pair: an axis that is one already leaves its place."""
    if len(args) % 2 or len(args) > 6:
        raise AlarmError(WRONG_CALL)
    columns, named = list(channel.coordinates.geometry), set()
    for number, axis in zip(args[::2], args[1::2], strict=True):
        place = arguments.whole(number) if number is not None else NONE
        if (
            place not in range(4)
            or not isinstance(axis, Axis)
            or axis.name not in channel.axes
            or axis in named
        ):
            raise AlarmError(WRONG_CALL)
        named.add(axis)
        column = channel.axes.index(axis.name)
        if not place and column not in columns:
            raise AlarmError(WRONG_CALL)
        columns = [NONE if held == column else held for held in columns]
        if place:
            columns[place - 1] = column
    places = [place for place in args[::2] if place]
    if len(set(places)) != len(places):
        raise AlarmError(WRONG_CALL)
    return columns[0], columns[1], columns[2]


def _check(channel: SinumerikChannel) -> None:
    """14410 under a spline, 14411 under radius compensation, 14412 under a transformation, 14413 with FTOCON."""
    mode = channel.mode
    if mode["motion"] in tables.SPLINES:
        raise AlarmError("14410")
    if mode["compensation"] != "G40":
        raise AlarmError("14411")
    if mode[seat.GROUP]:
        raise AlarmError("14412")
    if mode["fine_tool_offset"] == "FTOCON":
        raise AlarmError("14413")
    if Readings.of(channel).open:
        raise AlarmError(WRONG_CALL)


def _check_axes(channel: SinumerikChannel, before: Geometry, after: Geometry, changed: list[int]) -> None:
    """14414 for a geometry axis that has the name of a channel axis, and for an axis that moves beside the path."""
    if any(GEOMETRY_AXES[place] in channel.axes for place in changed):
        raise AlarmError(WRONG_CALL)
    clocked, away = channel.actual.clocked, ActionAxes.of(channel)
    columns = {columns[place] for columns in (before, after) for place in changed}
    if clocked is not None and any(
        column in away.held or clocked.commanded(column).moves
        for column in columns & (away.may_move | away.held)
    ):
        raise AlarmError(WRONG_CALL)


def _change(channel: SinumerikChannel, before: Geometry, after: Geometry, changed: list[int]) -> None:
    """Other geometry axes: frames, working areas, protection zones and polar coordinates are gone, nothing moves.

    A geometry axis that is new at its place owes the whole length of the tool to its next motion.
    """
    end_contour(channel)
    channel.path.take(*stages.OF_PLANE)
    memory, coordinates = channel.memory, channel.coordinates
    if not memory.data.integer("$MN_FRAME_GEOAX_CHANGE_MODE"):
        deselect_frames(channel)
    channel.mode = channel.mode.with_codes((("working_area", "WALIMOF"), ("working_area_wcs", "WALCS0")))
    protection.deselect(channel)
    polar = Polar.of(channel)
    polar.pole, polar.angle, polar.radius = (0.0, 0.0, 0.0), 0.0, 0.0
    seat.regroup(channel, None if after == native(channel) else after)
    seat.stand(channel, memory.frames.total())
    for place in changed:
        for column, length in ((before[place], 0.0), (after[place], memory.tools.lengths[place])):
            if column >= 0 and (length or column not in after):
                coordinates.pending[column] = length
    coordinates.owes = any(coordinates.pending)
    working_area.refresh(channel)
    channel.context_changed()


PROCEDURES = {"GEOAX": exchange}


def _assigned_axis(channel: SinumerikChannel, indices: Indices) -> Axis:
    """$P_ACTGEOAX[n]: the channel axis that is geometry axis n."""
    if len(indices) != 1 or not isinstance(indices[0], int):
        raise AlarmError("12400", text="$P_ACTGEOAX")
    if indices[0] not in (1, 2, 3):
        raise AlarmError("17020", text="$P_ACTGEOAX", index=indices[0])
    column = channel.coordinates.geometry[indices[0] - 1]
    return Axis(channel.axes[column] if column >= 0 else "")


GEOMETRY_VARIABLES: dict[str, Row] = {"$P_ACTGEOAX": (Type.AXIS, _assigned_axis, None)}
