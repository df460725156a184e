"""Offsets that come while the tool works: fine offsets of grinding wheels (PUTFTOC), overlaid lengths (TOFFON).

The axes move by them and the programmed position stays. What TOFFOF clears moves nothing: the display changes (job
planning 7.10). Fine offsets are wear of the edge and stay there (7.4).

Source: job planning 7.4 (FTOCON, PUTFTOC), 7.10 (TOFFON, TOFFOF, `$AA_TOFF`).
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.tables import data_factor
from polycnc.control.sinumerik.tools import selection
from polycnc.control.sinumerik.tools.edges import DP_WEAR_LENGTH
from polycnc.control.sinumerik.tools.holders.active import ActiveCarrier
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.block.draft import Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

#: Bit of MD21190: `$AA_TOFF` is the offset itself, else what comes to it.
ABSOLUTE = 1
SPINDLE_OF_WHEEL = "$TC_TPG1"


@dataclass(slots=True)
class Overlay(State, lifetime=Lifetime.RESET):
    """TOFFON: offsets in the directions of the tool, mm, and where they may be changed."""

    values: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    on: list[bool] = field(default_factory=lambda: [False, False, False])

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset takes all of them away."""
        super().end(channel, lifetime)
        channel.memory.tools.overlay = (0.0, 0.0, 0.0)


def _follow(channel: SinumerikChannel, *, moves: bool) -> None:
    """Lengths have changed: the axes move by that, or the machine stays and the display changes."""
    position = list(channel.coordinates.position)
    selection.follow(channel)
    frames.apply(channel)
    if moves:
        channel.coordinates.arrive(position)
    channel.context_changed()


# ---- overlaid lengths ----------------------------------------------------------------------------------------------


def switch_on(channel: SinumerikChannel, args: Arguments) -> None:
    """TOFFON(direction[, offset]): the offset comes to what is there, and `$AA_TOFF` acts.

    Raises:
        AlarmError: PC0016 without a toolholder or a transformation that turns the tool.
    """
    if not 1 <= len(args) <= 2:
        raise AlarmError("14020", text="TOFFON")
    if not ActiveCarrier.of(channel).number and channel.coordinates.transformation is None:
        raise AlarmError("PC0016", text="TOFFON")
    i, overlay = _direction(channel, args[0]), Overlay.of(channel)
    overlay.on[i] = True
    if len(args) == 2 and args[1] is not None:
        put(channel, i, overlay.values[i] + arguments.real(args[1]) * data_factor(channel.mode))


def switch_off(channel: SinumerikChannel, args: Arguments) -> None:
    """TOFFOF(direction): the offset is gone and nothing moves; preprocessing stops."""
    if len(args) != 1:
        raise AlarmError("14020", text="TOFFOF")
    channel.flush()
    channel.synchronise()
    i, overlay = _direction(channel, args[0]), Overlay.of(channel)
    overlay.on[i] = False
    _set(channel, i, 0.0)
    _follow(channel, moves=False)


def put(channel: SinumerikChannel, i: int, value: float) -> None:
    """The offset in a direction of the tool (0 X, 1 Y, 2 Z), within SD42970."""
    limit = channel.memory.data.number("$SC_TOFF_LIMIT", i)
    _set(channel, i, min(max(value, -limit), limit))
    _follow(channel, moves=True)


def _set(channel: SinumerikChannel, i: int, value: float) -> None:
    values = Overlay.of(channel).values
    values[i] = value
    channel.memory.tools.overlay = (values[0], values[1], values[2])


def _direction(channel: SinumerikChannel, axis: object) -> int:
    column, geometry = arguments.column(channel, axis), channel.coordinates.geometry
    if column not in geometry:
        raise AlarmError("16410", axis=channel.axes[column])
    return geometry.index(column)


def _of_index(channel: SinumerikChannel, indices: Indices, name: str) -> int:
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text=name)
    return _direction(channel, indices[0])


def _overlaid(channel: SinumerikChannel, indices: Indices) -> float:
    return Overlay.of(channel).values[_of_index(channel, indices, "$AA_TOFF")]


def _overlay(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    """`$AA_TOFF[direction]`: the offset, or with bit 0 of MD21190 at 0 what comes to it; PC0016 without TOFFON."""
    i, overlay = _of_index(channel, indices, "$AA_TOFF"), Overlay.of(channel)
    if not overlay.on[i]:
        raise AlarmError("PC0016", text="$AA_TOFF")
    absolute = channel.memory.data.integer("$MC_TOFF_MODE") & ABSOLUTE
    put(channel, i, float(value) + (0.0 if absolute else overlay.values[i]))


def _no_difference(_channel: SinumerikChannel, _indices: Indices) -> float:
    """`$AA_TOFF_PREP_DIFF`: what is prepared knows the offset that acts."""
    return 0.0


OVERLAY_VARIABLES: dict[str, RowWithStop] = {
    "$AA_TOFF": (Type.REAL, _overlaid, _overlay, True),
    "$AA_TOFF_VAL": (Type.REAL, _overlaid, None, True),
    "$AA_TOFF_PREP_DIFF": (Type.REAL, _no_difference, None, True),
}


# ---- fine offsets --------------------------------------------------------------------------------------------------


def select_fine(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """FTOCON: PUTFTOC acts at once from here on; PC0017 with an orientable toolholder."""
    if channel.mode["fine_tool_offset"] == "FTOCON" and ActiveCarrier.of(channel).number:
        raise AlarmError("PC0017")


def put_fine(channel: SinumerikChannel, args: Arguments) -> None:
    """PUTFTOC(value, length[, channel[, spindle]]): more wear of a grinding wheel.

    Raises:
        AlarmError: 20203 without a wheel, 14020 for another length than 1 to 3.
    """
    value, length, number, spindle = (*args, None, None, None, None)[:4]
    if value is None or length is None or len(args) > 4 or arguments.whole(length) not in (1, 2, 3):
        raise AlarmError("14020", text="PUTFTOC")
    target = _channel(channel, number)
    edge = _wheel(target, spindle)
    more = arguments.real(value) * data_factor(channel.mode)
    edge.values[DP_WEAR_LENGTH - 1 + arguments.whole(length)] += more
    if edge is target.memory.tools.edge and target.mode["fine_tool_offset"] == "FTOCON":
        _follow(target, moves=True)


def _channel(channel: SinumerikChannel, number: object) -> SinumerikChannel:
    if number is None or arguments.whole(number) == channel.number or channel.group is None:
        return channel
    if not channel.group.has(arguments.whole(number)):
        raise AlarmError("14020", text="PUTFTOC")
    return channel.group.channel(arguments.whole(number))


def _wheel(channel: SinumerikChannel, spindle: object) -> Edge:
    """The edge of the active wheel, or of the one that a spindle carries ($TC_TPG1)."""
    tools = channel.memory.tools
    edge: Edge | None = tools.edge
    if spindle is not None:
        wheels = [
            t for t in tools.tools.values() if t.values.get(SPINDLE_OF_WHEEL) == arguments.spindle(spindle)
        ]
        if all(wheel.number != tools.active for wheel in wheels):
            edge = next((wheel.edges[min(wheel.edges)] for wheel in wheels if wheel.edges), None)
    if edge is None or not edge.is_grinding:
        raise AlarmError("20203")
    return edge


PROCEDURES = {"TOFFON": switch_on, "TOFFOF": switch_off, "PUTFTOC": put_fine}
