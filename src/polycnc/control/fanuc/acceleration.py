"""What parameters of a FANUC control say about acceleration (parameter manual B-64310EN, 4.11).

Rapids: 1620 (T or T1) and 1621 (T2). Cuts: 1660 and 1772 (T2) where they are planned ahead (G05.1 Q1, G05 P10000, G08
P1), else 1622 after the interpolation. 3708#0 SAR: the first cut waits for the spindle.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.toolpath.motion_settings import Ramp

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters
    from polycnc.toolpath.motion_settings import MotionSettings

_MS = 1e-3


def accelerated(
    settings: MotionSettings, parameters: FanucParameters[FanucAxisParameters], names: Sequence[str]
) -> MotionSettings:
    """The settings with the time constants of axes; what no parameter gives is what the machine file says."""
    rapids, cuts, after = dict[str, Ramp](), dict[str, Ramp](), dict[str, float]()
    bell_s = _seconds(parameters.cutting_bell_time)
    for name in names:
        of = parameters.of(name)
        rapid = Ramp(_seconds(of.rapid_time), _seconds(of.rapid_bell_time))
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
        rapid_ramps=rapids,
        cut_ramps=cuts,
        after_interpolation=True,
        after_times=after,
        spindle_wait="" if parameters.SAR is None else "cut" if parameters.SAR else "never",
    )


def _seconds(milliseconds: float | None) -> float | None:
    return None if milliseconds is None else milliseconds * _MS
