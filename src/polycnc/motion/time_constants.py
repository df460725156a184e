"""Acceleration by time constants: what axes can do on rapids, in cuts that are planned ahead, and in all others.

Controls say by a time how axes take up speed. On rapids, and in cuts that are planned ahead, it is the time up to the
axis's highest speed: an acceleration `a = top/T1`, which builds up over T2, a jerk `a/T2`; a move from rest to the
highest speed takes T1 + T2 for it (FANUC parameter manuals, 1620 and 1621). In cuts that are not planned ahead the
interpolator steps to the programmed feed at once, and every axis takes the same time T to follow it, whatever the feed
(1622). The way that axes run there is the interpolator's, averaged over T. The bell shape is the average under a tent
of half width T/2: up to half the speed on a parabola in the first half (B-63002EN, 5.7). The path is left at corners
by what that takes off, and no corner is slower for it. So rows have a `Use`, which says what limits and averages they
have; where it changes the axes are at rest.
"""

from __future__ import annotations

from enum import IntEnum

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import RAPID_KINDS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.machine import Axis, Machine
    from polycnc.toolpath import Context
    from polycnc.toolpath.motion_settings import MotionSettings, Ramp

#: Limits that bound nothing: of the interpolator's acceleration in front of the averages, and of its jerk.
FREE_ACCELERATION, FREE_JERK = 1e8, 1e16
#: The shortest time over which anything is averaged, s: an acceleration without a second time constant takes it.
SHORTEST_S = 0.001
#: A tolerance that bounds nothing, mm; a lag that says no more than that rows are no lines with averages of their own.
ANY_MM, NO_LAG_S = 1e9, 1e-12
#: Rows that are led by their spindle, whose own constants hold.
_LED = frozenset((Kind.TAP,))


class Use(IntEnum):
    """What a row runs by."""

    CUT = 0
    """The limits of cuts that are planned ahead; of everything where no time constants are given."""
    RAPID = 1
    AFTER = 2
    """Cuts that are accelerated after the interpolation."""
    PLAIN = 3
    """Cuts that are not planned ahead, where nothing says how they are accelerated after the interpolation either."""


class Dynamics(NamedTuple):
    """Acceleration and jerk of an axis; 0 for no limit."""

    acceleration: float
    jerk: float


def dynamics(axis: Axis, name: str, settings: MotionSettings, use: Use) -> Dynamics:
    """What an axis, called `name` in programs, can do in rows of a use."""
    if use is Use.AFTER:
        return Dynamics(FREE_ACCELERATION, FREE_JERK)
    if use is Use.RAPID:
        given, top = (
            settings.rapid_ramps.get(name),
            min(axis.rapid, settings.rapid_caps.get(name, axis.rapid)),
        )
        return _ramp(axis, given, top, axis.rapid_time_s, axis.rapid_bell_s)
    # What parameters say of cuts that are planned ahead says nothing of others: these are for the machine file.
    given = settings.cut_ramps.get(name) if use is Use.CUT else None
    top = min(axis.max_feed, settings.feed_caps.get(name, axis.max_feed))
    return _ramp(axis, given, top, axis.cutting_time_s, axis.cutting_bell_s)


def _ramp(axis: Axis, given: Ramp | None, top: float, seconds: float, bell_s: float) -> Dynamics:
    """Acceleration and jerk by time constants of the control's parameters, else of the machine file, else none."""
    if given is not None:
        seconds = seconds if given.seconds is None else given.seconds
        bell_s = bell_s if given.bell_s is None else given.bell_s
        if given.acceleration:
            return Dynamics(
                given.acceleration, given.acceleration / max(bell_s, SHORTEST_S) if bell_s else axis.jerk
            )
    if seconds > 0.0 and top > 0.0:
        pull = top / seconds
        return Dynamics(pull, pull / max(bell_s, SHORTEST_S))
    if bell_s > 0.0 and axis.acceleration > 0.0:
        return Dynamics(axis.acceleration, axis.acceleration / bell_s)
    return Dynamics(axis.acceleration, axis.jerk)


def after_s(machine: Machine, channel: int, settings: MotionSettings) -> float:
    """The time constant after interpolation of a channel's cuts, seconds; 0 where all are planned ahead.

    All axes take the longest one: a control asks for the same of all that interpolate together.
    """
    if not settings.after_interpolation:
        return 0.0
    return max(
        (
            settings.after_times.get(name, axis.after_interpolation_s)
            for axis, name in _axes(machine, channel)
        ),
        default=0.0,
    )


def use_of(kind: int, context: Context, uses: Uses) -> Use:
    """What a row of a kind runs by."""
    if kind in RAPID_KINDS:
        return Use.RAPID if uses.rapid else Use.CUT
    if kind not in _LED and is_after(context, uses.after_s):
        return Use.AFTER
    return Use.PLAIN if uses.plain and context.acceleration is None else Use.CUT


def cut_use(context: Context, settings: MotionSettings) -> Use:
    """What cuts under a context run by, but for those that are accelerated after the interpolation."""
    return Use.CUT if is_ahead(context, settings) or not settings.cut_ramps else Use.PLAIN


def is_after(context: Context, seconds: float) -> bool:
    """Whether cuts under a context are accelerated after the interpolation, by a time constant of so many seconds.

    Not under a transformation, whose real axes have their limits, nor where the context says how axes accelerate or
    has a time constant of its own.
    """
    return (
        seconds > 0.0
        and context.acceleration is None
        and context.transformation is None
        and context.lag_s == 0.0
    )


def is_ahead(context: Context, settings: MotionSettings) -> bool:
    """Whether cuts under a context are planned ahead, so that parameters for corners and arcs of such cuts hold."""
    return context.acceleration is not None or not settings.after_interpolation


def behind_s(context: Context, settings: MotionSettings) -> float:
    """Seconds over which cuts that are planned ahead are averaged behind that, twice (FANUC 1769); 0 for none.

    Together both take the time constant, as that of other cuts: the longest one of all axes. Not under a
    transformation, nor where the context has a time constant of its own.
    """
    if not settings.behind_times or not settings.after_interpolation or context.acceleration is None:
        return 0.0
    if context.transformation is not None or context.lag_s != 0.0:
        return 0.0
    return 0.5 * max(settings.behind_times.values())


class Uses(NamedTuple):
    """Which uses differ on a channel.

    Attributes:
        rapid: Rapids have limits of their own.
        after_s: Time constant of cuts after the interpolation, s; 0 for none.
        plain: Parameters say how cuts accelerate that are planned ahead, and not all are.
    """

    rapid: bool
    after_s: float
    plain: bool = False

    @property
    def differ(self) -> bool:
        """Whether any do."""
        return self.rapid or self.after_s > 0.0 or self.plain


def uses_of(machine: Machine, channel: int, settings: MotionSettings) -> Uses:
    """Which uses differ on a channel. Rapids do where the axes rest before and behind each: others share averages."""
    rapid = settings.rapid_stops and any(
        dynamics(axis, name, settings, Use.RAPID) != dynamics(axis, name, settings, Use.CUT)
        for axis, name in _axes(machine, channel)
    )
    plain = settings.after_interpolation and len(settings.cut_ramps) > 0
    return Uses(rapid, after_s(machine, channel, settings), plain)


def averages_after(seconds: float) -> tuple[float, float]:
    """RAMP_S and BLEND_S of cuts after the interpolation: together they take so many seconds."""
    ramp = min(SHORTEST_S, 0.1 * seconds)
    return ramp, 0.5 * (seconds - ramp)


def _axes(machine: Machine, channel: int) -> Iterable[tuple[Axis, str]]:
    """The axes of a channel, and what its programs call them."""
    built = next((c for c in machine.channels if c.number == channel), machine.channels[0])
    names = zip(built.axes, built.names, strict=True)
    return [(machine.axis[axis], name) for axis, name in names if axis in machine.axis]
