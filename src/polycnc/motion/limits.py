"""Machine, settings and contexts as the flat columns that the kernels read."""

from __future__ import annotations

from array import array
from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import Limits, PathLimits
from polycnc.motion.settings import Settings
from polycnc.motion.time_constants import (
    ANY_MM,
    NO_LAG_S,
    Use,
    averages_after,
    behind_s,
    cut_use,
    dynamics,
    is_after,
    is_ahead,
)
from polycnc.toolpath.context import NO_OVERLAP
from polycnc.toolpath.modes import AccelerationMode, CornerMode, FeedMode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.machine import Axis, Machine, Spindle
    from polycnc.toolpath import Context
    from polycnc.transformation.contract import Geometry

#: Deviation that counts as none: what a control resolves.
EXACT_MM = 0.001
#: That of columns which are axes of the machine.
NO_LINKAGE = array("d")
#: RAMP_S in terms of the time in which an axis builds up its acceleration.
RAMPS = 1.0


def channel_axes(machine: Machine, channel: int, names: tuple[str, ...]) -> tuple[Axis | None, ...]:
    """The machine's axes behind the columns of a toolpath; None for one that a transformation makes."""
    built = next((c for c in machine.channels if c.number == channel), machine.channels[0])
    called = dict(zip(built.names, built.axes, strict=True))
    return tuple(machine.axis.get(called.get(name, name)) for name in names)


def axis_limits(
    machine: Machine,
    channel: int,
    names: tuple[str, ...],
    settings: Settings,
    made: Geometry | None = None,
    use: Use = Use.CUT,
    linkage: array[float] = NO_LINKAGE,
) -> Limits:
    """The kernels' `limits` for the columns of a toolpath; `made` are X, Y and Z of a transformation that acts.

    `linkage` is how it leads the axes, in the form that kernels read.

    An axis that a transformation makes is taken to be as slow as the slowest linear one.
    """
    axes = channel_axes(machine, channel, names)
    if made is not None:
        axes = tuple(
            None if axis is not None and axis.rotary and i in made else axis for i, axis in enumerate(axes)
        )
    linear = [axis for axis in machine.axes if not axis.rotary] or list(machine.axes)

    def numbers(field: str) -> list[float]:
        slowest = min(_limit(axis, field) for axis in linear)
        return [slowest if axis is None else _limit(axis, field) for axis in axes]

    # What a transformation makes moves by what the axes can do; time constants are for axes that programs name.
    slowest = [min(_limit(axis, field) for axis in linear) for field in ("acceleration", "jerk")]
    able = [
        slowest if axis is None else [number or 1e9 for number in dynamics(axis, name, settings, use)]
        for axis, name in zip(axes, names, strict=True)
    ]

    geometry = _geometry(machine, channel, names, axes) if made is None else list(made)
    acceleration = [pull for pull, _ in able]
    step = settings.overload * machine.interpolation_cycle_s
    rapid, feed = (
        array("d", [min(top, caps.get(name, inf)) for top, name in zip(numbers(field), names, strict=True)])
        for field, caps in (("rapid", settings.rapid_caps), ("max_feed", settings.feed_caps))
    )
    return Limits(
        top_rapid=rapid,
        top_feed=feed,
        acceleration=array("d", acceleration),
        jump=array("d", [a * step for a in acceleration]),
        step=array("d", [settings.corner_steps.get(name, settings.corner_speed) for name in names]),
        arc=array("d", [settings.arc_pulls.get(name, inf) for name in names]),
        bend=array("d", [settings.line_pulls.get(name, inf) for name in names]),
        rotary=array("d", [axis is not None and axis.rotary for axis in axes]),
        jerk=array("d", [jerk for _, jerk in able]),
        geometry=array("q", geometry),
        path=PathLimits(
            settings.rapid_stops,
            min(settings.path_feed, 1e9),
            settings.arc_pull,
            settings.arc_least,
            settings.line_least,
            machine.block_time_s,
            settings.feed_along_arc,
            settings.inverse_time_by_radius,
        ),
        linkage=linkage,
    )


def _geometry(
    machine: Machine, channel: int, names: tuple[str, ...], axes: tuple[Axis | None, ...]
) -> list[int]:
    """Columns of X, Y and Z without a transformation, -1 for one that the channel does not have."""
    built = next((c for c in machine.channels if c.number == channel), machine.channels[0])
    found = []
    for name in "XYZ":
        real = built.geometry.get(name)
        column = next((i for i, axis in enumerate(axes) if axis is not None and axis.name == real), -1)
        is_virtual = column < 0 and name in built.virtual and name in names
        found.append(names.index(name) if is_virtual else column)
    return found


def _limit(axis: Axis, field: str) -> float:
    """A limit of an axis; zero stands for none named, and a bound of 1e9 is never reached."""
    return float(getattr(axis, field)) or 1e9


def context_fields(
    context: Context,
    axes: int,
    spindle: Spindle | None,
    station: int,
    settings: Settings,
    averages: tuple[float, float] = (0.0, 0.0),
    *,
    after: bool = False,
) -> list[float]:
    """One row of the kernels' table of contexts, in the order of the constants in `kernels/columns.py`.

    `averages` is what `averages` gave for the context; without them the jerk has no limit. `after`: of rows that are
    accelerated after the interpolation, where neither corners nor rests change what the axes follow.
    """
    highest = spindle.max_rpm if spindle else inf
    if context.spindle_limit_rpm > 0.0:
        highest = min(highest, context.spindle_limit_rpm)
    surface = max(context.surface_m_min, 0.0) * 1000.0 / 60.0 if context.surface_speed else 0.0
    (a, b, c), (d, e, f), (g, h, i) = context.frame.m
    return [
        context.feed_mode is FeedMode.PER_REVOLUTION,
        context.feed_mode is FeedMode.INVERSE_TIME,
        min(context.spindle_rpm, highest),
        surface,
        highest,
        spindle.acceleration_rpm_s / 60.0 if spindle else inf,
        context.stops,
        ANY_MM if after else _corner_tolerance(context, settings, soft=averages[0] > 0.0),
        rotary_weight(context, settings),
        station,
        not context.frame.is_identity,
        -1.0 if context.frame.mirrors else 1.0,
        (settings.rapid_by_axis or context.rapid_by_axis)
        and not context.lag_s
        and context.transformation is None,
        *averages,
        settings.drive_speed if context.acceleration is AccelerationMode.REDUCED_AT_SPEED else 1.0,
        settings.drive_reduction,
        context.rapid_speed,
        context.overlap,
        context.rapid_overlap,
        NO_LAG_S if after else context.lag_s,
        inf if after else context.lag_from,
        context.pace.rapid if context.pace is not None else 1.0,
        _rounding(context),
        context.turn_tolerance_deg,
        context.turn_distance_mm,
        context.swing_deg,
        is_led(context, settings),
        is_ahead(context, settings),
        behind_s(context, settings),
        settings.turn_speed if settings.turn_speed > 0.0 and _is_tip(context) else 0.0,
        context.degree_mm,
        averages[0] > 0.0 and not after and is_bent_by_way(context, settings),
        context.chords,
        min(context.pace.velocity, default=1.0) if context.pace is not None else 1.0,
        *(a, b, c, d, e, f, g, h, i),
        *context.frame.t,
        *(context.offsets or [0.0] * axes),
    ]


def averages(context: Context, machine: Machine, settings: Settings) -> tuple[float, float]:
    """RAMP_S and BLEND_S of a context, seconds; zero without limited jerk.

    RAMP_S is the time in which the slowest axis builds up its acceleration: a balance between short ways, which it
    delays, and long ones, which need acceleration. Lines from rest to rest choose theirs (`kernels/alone.py`).
    BLEND_S lets a corner use up its parts of the tolerance and of the jerk alike (`kernels/jerk.py`): of linear axes,
    behind the tip of a tool of all, for there it is the rotary ones that turn from row to row. Where rotary axes
    have a tolerance of their own it is no longer than they may, so that none of them leaves its way by more. A time
    constant behind the interpolation is not for the plan to choose.
    """
    use = cut_use(context, settings)
    able = [(axis.rotary, *dynamics(axis, axis.name, settings, use)) for axis in machine.axes]
    axes = [own for own in able if own[1] > 0.0 and own[2] > 0.0]
    if (context.acceleration or settings.acceleration) is not AccelerationMode.JERK_LIMITED or not axes:
        return 0.0, 0.0
    ramp = RAMPS * max(pull / jerk for _, pull, jerk in axes)
    tolerance = _kept_tolerance(context, settings)
    turns = _is_tip(context)
    jerk = min((jerk for rotary, _, jerk in axes if turns or not rotary), default=axes[0][2])
    blends = [_blend(tolerance, jerk)]
    if context.turn_tolerance_deg > 0.0:
        blends += [_blend(context.turn_tolerance_deg, jerk) for rotary, _, jerk in axes if rotary]
    return ramp, max(min(*blends, ramp), behind_s(context, settings))


def _blend(tolerance: float, jerk: float) -> float:
    """BLEND_S at which a corner of the highest jerk that it may have deviates as far as it may."""
    from polycnc.motion.kernels.jerk import DEVIATION_CORNER, JERK_CORNER  # for limited jerk

    return float((6.0 * DEVIATION_CORNER * tolerance / (JERK_CORNER * jerk)) ** (1.0 / 3.0))


class ContextTables:
    """The kernels' tables of contexts: one for cuts and rapids, and one for cuts after the interpolation.

    Attributes:
        plain: For rows of the uses CUT and RAPID.
        after: For rows of the use AFTER; the same table where no cut has that use.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self.plain = array("d")
        self.after = array("d") if seconds > 0.0 else self.plain

    def of(self, use: Use) -> array[float]:
        """The table of a use."""
        return self.after if use is Use.AFTER else self.plain

    def smoothing(self, context: Context, machine: Machine, settings: Settings) -> tuple[float, ...]:
        """What rows of a context are averaged over, in cuts and on rapids."""
        own = averages(context, machine, settings)
        return (*own, *averages_after(self._seconds)) if is_after(context, self._seconds) else own

    def add(
        self,
        context: Context,
        axes: int,
        spindle: Spindle | None,
        station: int,
        settings: Settings,
        smoothing: tuple[float, ...],
    ) -> None:
        """Take a context in, with what `smoothing` gave for it."""
        own = smoothing[0], smoothing[1]
        self.plain.extend(context_fields(context, axes, spindle, station, settings, own))
        if self.after is not self.plain:
            after = len(smoothing) > len(own)
            times = (smoothing[2], smoothing[3]) if after else own
            self.after.extend(context_fields(context, axes, spindle, station, settings, times, after=after))


def is_led(context: Context, settings: Settings) -> bool:
    """Whether straight rows are laid out under the limits of the axes behind a tip, where it has a linkage.

    Not with limited jerk, nor where something else bounds speed or acceleration along the path: DRIVE, overrides of
    the program for single axes, a lag, a constant surface speed. Nor where turns of the tool are rounded (OST, OSD):
    ends of such rows are passed at what the rounding allows, of which the axes behind the tip leave a part only.
    """
    acceleration = context.acceleration or settings.acceleration
    return (
        context.transformation is not None
        and acceleration is AccelerationMode.CONSTANT
        and context.frame.is_identity
        and not context.chords
        and context.pace is None
        and context.turn_tolerance_deg == 0.0
        and context.turn_distance_mm == 0.0
        and context.lag_s == 0.0
        and not context.surface_speed
    )


def is_bent_by_way(context: Context, settings: Settings) -> bool:
    """Whether with limited jerk a path is bent by its way, and a law leads along it (`third_order`).

    Of cuts that are planned ahead; not under a transformation or a coupling, whose real axes are others than those of
    the path; not by time constants behind the interpolation, nor where strokes and rapids overlap.
    """
    return (
        settings.bends_by_way
        and is_ahead(context, settings)
        and context.transformation is None
        and context.lag_s == 0.0
        and behind_s(context, settings) == 0.0
        and context.overlap == NO_OVERLAP
        and context.rapid_overlap == 0.0
    )


class AxisRapid(NamedTuple):
    """How an axis runs a rapid alone: highest speed, acceleration, seconds that it is averaged over."""

    top: float
    pull: float
    ramp: float


def axis_rapids(ways: Sequence[float], context: Context, limits: Limits, *, soft: bool) -> list[AxisRapid]:
    """How each axis runs its way of a rapid on which every axis runs alone, with limited jerk (`soft`) or without."""
    from polycnc.motion.kernels.alone import alone_pull, alone_top, best_ramp  # for rapids that are looked at

    found: list[AxisRapid] = []
    own_limits = zip(limits.top_rapid, limits.acceleration, limits.jerk, limits.rotary, strict=True)
    for way, (limit, pull, jerk, rotary) in zip(ways, own_limits, strict=True):
        top = context.rapid_top(limit, rotary=bool(rotary))
        ramp = best_ramp(abs(way), top, pull, jerk) if soft and way else 0.0
        own = alone_pull(ramp, pull, jerk)
        found.append(AxisRapid(alone_top(abs(way), top, own, ramp), own, ramp))
    return found


def rotary_weight(context: Context, settings: Settings) -> float:
    """Millimetres that a degree counts in the length that the feed refers to: that of a tip is its way on the work."""
    if not settings.rotary_in_feed or _is_tip(context):
        return 0.0
    return context.degree_mm


def _is_tip(context: Context) -> bool:
    if context.transformation is None:
        return False
    from polycnc.transformation.orientation.linked import is_tip

    return is_tip(context.transformation)


def _corner_tolerance(context: Context, settings: Settings, *, soft: bool) -> float:
    """How far corners may leave the path; an average behind the interpolator is not for the plan to choose."""
    if behind_s(context, settings) > 0.0 and context.tolerance_mm == 0.0:
        return ANY_MM
    return (
        _kept_tolerance(context, settings) if soft else max(_tolerance(context, settings), context.knot_deg)
    )


def _rounding(context: Context) -> float:
    """How far from a corner its rounding reaches at most."""
    is_from = context.corner_mode is CornerMode.ROUNDED_FROM and context.knot_deg == 0.0
    return context.tolerance_mm or inf if is_from else inf


def _kept_tolerance(context: Context, settings: Settings) -> float:
    """How far averaged positions may leave the path."""
    if context.tolerance_mm == 0.0 and context.corner_mode is CornerMode.EXACT_STOP:
        return EXACT_MM
    return _tolerance(context, settings) or EXACT_MM


def _tolerance(context: Context, settings: Settings) -> float:
    """Contour tolerance of a context; 0 for corners without deviation."""
    if context.tolerance_mm > 0.0:
        return context.tolerance_mm
    keeps = context.corner_mode is CornerMode.CONTINUOUS and settings.keeps_corners
    return 0.0 if keeps or context.corner_mode is CornerMode.ROUNDED_FROM else settings.tolerance_mm
