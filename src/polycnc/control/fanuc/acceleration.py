"""What parameters of a FANUC control say about speed and acceleration (parameter manual B-64310EN, 4.10 and 4.11).

Speeds: 1420 of axes at rapid traverse, 1430 in cuts, 1422 along the path.
Rapids: 1620 (T or T1) and 1621 (T2). Cuts: 1660 and 1772 (T2) where they are planned ahead (G05.1 Q1, G05 P10000, G08
P1), else 1622 after the interpolation. 3708#0 SAR: the first cut waits for the spindle.

General knowledge, from parameter manuals of later controls: rapids on a line (1401#1 LRP) by 1671 and 1672 where
19501#5 FRP says so; with look-ahead the change of an axis's speed at corners by 1783, the feed of arcs by 1735, not
below 1732, the acceleration of an axis from one short line to the next by 1737, not below 1738, and a time constant
behind the interpolation, 1769.
"""

from __future__ import annotations

from math import inf

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.motion_settings import Ramp

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters
    from polycnc.toolpath.motion_settings import MotionSettings

_MS = 1e-3


def accelerated(
    settings: MotionSettings, parameters: FanucParameters[FanucAxisParameters], names: Sequence[str]
) -> MotionSettings:
    """The settings with the time constants of axes; what no parameter gives is what the machine file says."""
    rapids, cuts, after = dict[str, Ramp](), dict[str, Ramp](), dict[str, float]()
    before = parameters.LRP and parameters.FRP
    bell_s = _seconds(parameters.cutting_bell_time)
    for name in names:
        of = parameters.of(name)
        rapid = Ramp(_seconds(of.rapid_time), _seconds(of.rapid_bell_time))
        if before and of.rapid_acceleration:
            rapid = Ramp(
                bell_s=_seconds(parameters.rapid_change_time or 0.0), acceleration=of.rapid_acceleration
            )
        most = of.cutting_acceleration or 0.0
        cut = Ramp(bell_s=bell_s, acceleration=most if most > 0.0 else None)
        if rapid != Ramp():
            rapids[name] = rapid
        if cut != Ramp():
            cuts[name] = cut
        seconds = _seconds(of.cutting_time)
        if seconds is not None:
            after[name] = (
                seconds if of.CTL or of.CTB else 2.0 * seconds
            )  # an exponential one is as far behind
    return replace(
        settings,
        rapid_caps=_given(names, lambda name: parameters.of(name).rapid_speed / 60.0),
        feed_caps=_given(names, lambda name: parameters.of(name).cutting_speed / 60.0),
        path_feed=(parameters.path_feed or inf) / 60.0,
        rapid_ramps=rapids,
        cut_ramps=cuts,
        after_interpolation=True,
        after_times=after,
        corner_steps=_given(names, lambda name: parameters.of(name).corner_step / 60.0),
        arc_pulls=_given(names, lambda name: parameters.of(name).arc_acceleration),
        arc_least=parameters.arc_least_feed / 60.0,
        line_pulls=_given(names, lambda name: parameters.of(name).line_acceleration),
        line_least=parameters.line_least_feed / 60.0,
        behind_times=_given(names, lambda name: parameters.of(name).ahead_time * _MS),
        spindle_wait="" if parameters.SAR is None else "cut" if parameters.SAR else "never",
    )


def _given(names: Sequence[str], number: Callable[[str], float]) -> dict[str, float]:
    """The number of every axis that has one above zero."""
    return {name: value for name in names if (value := number(name)) > 0.0}


def _seconds(milliseconds: float | None) -> float | None:
    return None if milliseconds is None else milliseconds * _MS
