"""What a program says about speeds beside F: OVR, OVRRAP, ACC, VELOLIM, JERKLIM, FGROUP, FGREF, FL, CFC, DYN….

Source: Fundamentals; job planning 16.1 (statement list).
"""

from __future__ import annotations

from math import hypot, inf, pi

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import gcodes, tables
from polycnc.control.sinumerik.actions.overlay import left_to_path
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.tables import MINUTE
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import EVEN
from polycnc.toolpath.context import Pace
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control.sinumerik.couplings.gears import Gears

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

#: What F is the speed of on arcs under radius compensation.
EDGES = {"CFC": "always", "CFIN": "inside", "CFTCP": "never"}
#: FGREF that nobody has named: the radius at which a degree is 1 mm.
DEGREE_MM = 180.0 / pi
NOTHING = Pace()
_HIGHEST = "$MA_MAX_AX_VELO"


@dataclass(slots=True)
class Overrides(State, lifetime=Lifetime.RESET):
    """Overrides, limits and what the path feed is for; with a reset 100 % and the axes of the machine data again.

    Attributes:
        percent: OVR, ACC[X] and the like, by address and axis.
        group: Columns of the axes that FGROUP names; none for those of the machine data.
        radii: FGREF by column, mm.
        tops: FL by column, mm/s or degrees/s.
    """

    percent: dict[tuple[str, str], float] = field(default_factory=dict)
    group: tuple[int, ...] = ()
    radii: dict[int, float] = field(default_factory=dict)
    tops: dict[int, float] = field(default_factory=dict)


def pace(channel: SinumerikChannel, side: int) -> Pace | None:
    """The pace that holds now; `side` is that of the radius compensation. None where F says everything."""
    overrides = Overrides.of(channel)
    left, left_pull = _left_to_following(channel, *left_to_path(channel))
    own = Pace(
        feed=overrides.percent.get(("OVR", ""), 100.0) / 100.0 * _revolutions(channel),
        rapid=overrides.percent.get(("OVRRAP", ""), 100.0) / 100.0,
        edge=EDGES[channel.mode["curve_feed"]] if side else "never",
        weights=_weights(channel),
        turning=_turning(channel),
        top=_tops(channel),
        reach=_reach(channel),
        velocity=_factors(channel, "VELOLIM"),
        acceleration=_with_technology(channel, "ACC", "$MA_MAX_AX_ACCEL", "acceleration"),
        jerk=_with_technology(channel, "JERKLIM", "$MA_MAX_AX_JERK", "jerk")
        if channel.mode["acceleration"] == "SOFT"
        else (),
        left=left,
        left_pull=left_pull,
    )
    return own if own != NOTHING else None


def _left_to_following(
    channel: SinumerikChannel, left: tuple[float, ...], pull: tuple[float, ...]
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """What is left of real axes, with VELOLIMA and ACCLIMA of those that follow others."""
    following, count = Couplings.of(channel).links, len(channel.axes)
    speeds, pulls = (_factors(channel, address) if following else () for address in ("VELOLIMA", "ACCLIMA"))
    if not speeds and not pulls:
        return left, pull
    top, own = list(left or (inf,) * count), list(pull or (1.0,) * count)
    for column in following:
        if speeds and channel.axis_data[column].rapid:
            top[column] = min(top[column], channel.axis_data[column].rapid * speeds[column])
        own[column] *= pulls[column] if pulls else 1.0
    return tuple(top), tuple(own)


def _revolutions(channel: SinumerikChannel) -> float:
    """Revolutions of what a feed per revolution follows, for one of the spindle: its ratio for a gear's axis (FPR)."""
    feed = PathFeed.of(channel)
    if feed.axis < 0 or feed.mode is not FeedMode.PER_REVOLUTION:
        return 1.0
    gear = Gears.of(channel).defined.get(feed.axis)
    return 0.0 if gear is None else abs(gear.ratio_to_spindle)


def _weights(channel: SinumerikChannel) -> tuple[float, ...]:
    """FGROUP: what a millimetre or degree of each axis counts; a degree of a rotary axis an arc of FGREF, else 1 mm.

    A millimetre of the program is what frames make of it; the path of a transformation lies in front of them.
    """
    overrides, sizes = Overrides.of(channel), _sizes(channel)
    named = overrides.group
    weights = [0.0] * len(channel.axes)
    for column in named or sizes:
        radius = overrides.radii.get(column, DEGREE_MM)
        turns = channel.memory.axes[column].rotary
        weights[column] = radius * pi / 180.0 if turns else sizes.get(column, 1.0)
    return tuple(weights) if named or sizes else ()


def _turning(channel: SinumerikChannel) -> tuple[float, ...]:
    """What a degree counts where rotary axes outside of FGROUP move alone: an arc of FGREF, mm."""
    radii = Overrides.of(channel).radii
    columns = range(len(channel.axes)) if radii else ()
    return tuple(radii.get(column, DEGREE_MM) * pi / 180.0 for column in columns)


def _sizes(channel: SinumerikChannel) -> dict[int, float]:
    """What frames in front of a transformation make of a millimetre, by column; none where they keep it."""
    coordinates = channel.coordinates
    if coordinates.transformation is None:
        return {}
    columns = zip(*seat.frame_in_front(channel).m, strict=True)
    sizes = {
        axis: hypot(*column) for axis, column in zip(coordinates.geometry, columns, strict=True) if axis >= 0
    }
    return sizes if any(abs(size - 1.0) > EVEN for size in sizes.values()) else {}


def _tops(channel: SinumerikChannel) -> tuple[float, ...]:
    """FL: limits of synchronous axes, those outside FGROUP."""
    overrides = Overrides.of(channel)
    named = overrides.group
    tops = [
        overrides.tops.get(column, inf) if named and column not in named else inf
        for column in range(len(channel.axes))
    ]
    return tuple(tops) if min(tops, default=inf) < inf else ()


def _reach(channel: SinumerikChannel) -> tuple[float, ...]:
    """MD32000 where it is set: no axis is faster, and VELOLIM is a part of it; the machine file holds in any case."""
    data, factors = channel.memory.data, _factors(channel, "VELOLIM") or (1.0,) * len(channel.axes)
    reach = [
        data.number(_HIGHEST, axis) / MINUTE * factor if data.is_set(_HIGHEST, axis) else inf
        for axis, factor in zip(channel.axes, factors, strict=True)
    ]
    return tuple(reach) if min(reach, default=inf) < inf else ()


def real_column(channel: SinumerikChannel, axis: str) -> int | None:
    """Column of the machine's axis that a name means, whatever a transformation makes of it (8.7); None for none."""
    memory = channel.memory
    return memory.own_columns.get(axis, memory.machine_columns.get(axis))


def _factors(channel: SinumerikChannel, address: str) -> tuple[float, ...]:
    factors = [1.0] * len(channel.axes)
    for (name, axis), percent in Overrides.of(channel).percent.items():
        column = real_column(channel, axis) if name == address else None
        if column is not None:
            factors[column] = percent / 100.0
    return tuple(factors) if any(factor != 1.0 for factor in factors) else ()


def _with_technology(channel: SinumerikChannel, address: str, datum: str, limit: str) -> tuple[float, ...]:
    """The programmed factors times those of the technology's dynamics (DYNNORM …), where machine data name them.

    MD32300 and MD32431 are in m/s² and m/s³.
    """
    memory = channel.memory
    factors = list(_factors(channel, address)) or [1.0] * len(channel.axes)
    mode = gcodes.number_of(channel.mode["dynamics"]) - 1
    for column, axis in enumerate(channel.axis_data):
        machine = getattr(axis, limit)
        if machine and memory.data.is_set(datum, mode, channel.axes[column]):
            own = memory.data.number(datum, mode, channel.axes[column])
            if own > 0.0:  # no axis can do with less; the data do not take it
                factors[column] *= own * tables.MM_PER_M / machine
    return tuple(factors) if any(factor != 1.0 for factor in factors) else ()
