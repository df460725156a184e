"""Motions that lie over an axis: `$AA_OFF[axis]` by an action (10.4.8), DRF by the handwheel (Fundamentals 9.7).

MD36750 bit 0 says whether what is written is the shift, or is added to it in every cycle; SD43350 limits it. It moves
no faster than MD32020, the handwheel's shift than the share of it that MD32090 says. Coordinates do not know of either.
From an action that shifts an axis on, and of all axes while the switch DRF is on, MD20610 keeps a part of the axis's
dynamics for that: the path has the rest.
CORROF takes them away, DRFOF the handwheel's: the axis stays, coordinates know where it is then.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.interpolator import HANDWHEEL_OFFSET
from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.sinumerik import tables
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed

with loaded_when_called():
    from polycnc.control.sinumerik.actions import axes as action_axes
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

_INTEGRAL = 1
NAME = "AA_OFF"
NAMES = (NAME, HANDWHEEL_OFFSET)
#: Bounds of MD20610.
LEAST, MOST = 0.01, 0.9


@dataclass(slots=True)
class Overlays(State, lifetime=Lifetime.POWER):
    """Shifts of actions.

    Attributes:
        values: What they have asked for, by column, within their limits: mm or degrees.
        expected: Columns of axes that actions of the program may shift; `expected_of_static` that static ones may.
        by_hand: The handwheel may shift every axis.
    """

    values: dict[int, float] = field(default_factory=dict)
    expected: set[int] = lasting(Lifetime.RESET, factory=set)
    expected_of_static: set[int] = field(default_factory=set)
    by_hand: bool = False


class Share(NamedTuple):
    """What a motion over an axis has of it: highest velocity, mm/s or degrees/s, and a part of its acceleration."""

    velocity: float
    pull: float


def expect(channel: SinumerikChannel, columns: Iterable[int], *, is_static: bool) -> None:
    """Actions may shift these axes from now on: what is prepared leaves them their share, and the axes stand before."""
    overlays, columns = Overlays.of(channel), set(columns)
    new = columns - overlays.expected - overlays.expected_of_static
    (overlays.expected_of_static if is_static else overlays.expected).update(columns)
    if new:
        channel.event(Deed(NAME, None, _nothing, stands=True))
        channel.context_changed()


def _nothing() -> None:
    """Nothing but standing."""


def expect_handwheel(channel: SinumerikChannel, *, is_on: bool) -> None:
    """The handwheel may shift every axis from the next block that is prepared on, or none any more (DRF)."""
    overlays = Overlays.of(channel)
    if overlays.by_hand is not is_on:
        overlays.by_hand = is_on
        channel.context_changed()


def share_of(channel: SinumerikChannel, column: int) -> Share:
    """The share of `$AA_OFF` in an axis: MD32020, but no more than MD20610 of what the axis can do."""
    return _share(channel, column, 1.0)


def handwheel_share(channel: SinumerikChannel, column: int) -> Share:
    """The share of the handwheel in an axis (DRF): MD32020 by MD32090, within the same bounds."""
    factor = channel.memory.data.number("$MA_HANDWH_VELO_OVERLAY_FACTOR", channel.axes[column])
    return _share(channel, column, factor)


def _share(channel: SinumerikChannel, column: int, factor: float) -> Share:
    data, name = channel.memory.data, channel.axes[column]
    part = min(max(data.number("$MC_ADD_MOVE_ACCEL_RESERVE"), LEAST), MOST)
    top = channel.axis_data[column].rapid
    if data.is_set("$MA_MAX_AX_VELO", name):
        top = min(top or inf, data.number("$MA_MAX_AX_VELO", name) / tables.MINUTE)
    asked = data.number("$MA_JOG_VELO", name) * factor / tables.MINUTE
    return Share(min(asked, part * top) if top else asked, part)


def left_to_path(channel: SinumerikChannel) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """What the path has of every axis: velocity, and part of the acceleration; nothing where nothing shifts one."""
    overlays = Overlays.of(channel)
    of_actions = overlays.expected | overlays.expected_of_static
    of_hand = range(len(channel.axes)) if overlays.by_hand else ()
    if not of_actions and not of_hand:
        return (), ()
    tops, pulls = [inf] * len(channel.axes), [1.0] * len(channel.axes)
    for columns, share_in in ((of_actions, share_of), (of_hand, handwheel_share)):
        for column in columns:
            share, top = share_in(channel, column), min(tops[column], channel.axis_data[column].rapid or inf)
            tops[column], pulls[column] = top - share.velocity, 1.0 - share.pull
    return tuple(tops), tuple(pulls)


def _column(channel: SinumerikChannel, indices: Indices) -> int:
    return arguments.column(channel, indices[0] if indices else None)


def _limit(channel: SinumerikChannel, column: int) -> float:
    return channel.memory.data.number("$SA_AA_OFF_LIMIT", channel.axes[column])


def _write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    column, overlays = _column(channel, indices), Overlays.of(channel).values
    name, data = channel.axes[column], channel.memory.data
    if data.integer("$MA_AA_OFF_MODE", name) & _INTEGRAL:
        value += overlays.get(column, 0.0)
    limit = _limit(channel, column)
    value = min(max(value, -limit), limit)
    clocked = channel.actual.clocked
    if clocked is not None and value:
        action_axes.check_target(channel, column, clocked.without_overlay(NAME, column) + value)
    overlays[column] = value
    if clocked is not None:
        clocked.overlay(NAME, column, value, *share_of(channel, column))


def _read(channel: SinumerikChannel, indices: Indices) -> float:
    return Overlays.of(channel).values.get(_column(channel, indices), 0.0)


def _at_limit(channel: SinumerikChannel, indices: Indices) -> int:
    """1 or -1 where the shift has reached its limit."""
    column = _column(channel, indices)
    value, limit = Overlays.of(channel).values.get(column, 0.0), _limit(channel, column)
    return (value >= limit) - (value <= -limit)


def _by_hand(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AC_DRF[axis]`: how far the handwheel has shifted an axis, mm or degrees."""
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text="$AC_DRF")
    clocked, column = channel.actual.clocked, channel.memory.column(indices[0].name)
    return 0.0 if clocked is None else clocked.overlaid(HANDWHEEL_OFFSET, column)


def take_away(channel: SinumerikChannel, args: Arguments) -> None:
    """CORROF(axis,"AA_OFF",…): the shift is no more; the axis stays where it is, and the program knows it there."""
    pairs = list(zip(args[::2], args[1::2], strict=False))
    if len(args) % 2 or any(
        not isinstance(axis, Axis) or str(what).upper() not in NAMES for axis, what in pairs
    ):
        raise AlarmError("14020", text="CORROF")
    _take_in(channel, [(str(what).upper(), arguments.column(channel, axis)) for axis, what in pairs])


def take_away_by_hand(channel: SinumerikChannel, args: Arguments) -> None:
    """DRFOF: what the handwheel has shifted is no more, on all axes of the channel."""
    if args:
        raise AlarmError("14020", text="DRFOF")
    _take_in(channel, [(HANDWHEEL_OFFSET, column) for column in range(len(channel.axes))])


def _take_in(channel: SinumerikChannel, shifts: list[tuple[str, int]]) -> None:
    clocked = channel.actual.clocked
    if clocked is None or not shifts:
        return
    channel.flush()
    channel.synchronise()
    machine = channel.coordinates.machine
    for name, column in shifts:
        if name == NAME:
            Overlays.of(channel).values.pop(column, None)
        machine[column] = clocked.take_in_overlay(name, column)
    channel.coordinates.arrive_machine(machine)


def refuse_suppression(channel: SinumerikChannel) -> None:
    """SUPA: takes motions out that lie over axes.

    Raises:
        AlarmError: PC0001 where there is one, as that is not executed.
    """
    clocked = channel.actual.clocked
    columns = range(len(channel.axes))
    if clocked is not None and any(clocked.overlaid(name, i) for name in NAMES for i in columns):
        raise AlarmError("PC0001", hint="hint.not-supported", code="SUPA $AA_OFF/DRF")


OVERLAY_VARIABLES: dict[str, RowWithStop] = {
    "$AA_OFF": (Type.REAL, _read, _write, True),
    "$AA_OFF_VAL": (Type.REAL, _read, None, True),
    "$AA_OFF_LIMIT": (Type.INT, _at_limit, None, True),
    "$AC_DRF": (Type.REAL, _by_hand, None, True),
}
