"""G05 and G05.1 of SYNTEC: high-precision modes (manual 2.9 to 2.11).

Both let the control bend the path within a tolerance. polycnc checks what is written and keeps the programmed path,
which lies within every tolerance; the mode is recorded for the planner.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.syntec.five_axes import tip_control
from polycnc.control.word_address.motion import nurbs
from polycnc.control.word_address.motion.path_modes import PathModeState

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words

ON = 10_000
#: Smallest and largest tolerance of G05.1 Q5, in the program's unit.
TOLERANCES = (0.001, 1.0)
STOPPING_MODES = ("G61", "G63")
MAX_ROTARY = 2
FILTERS = (1, 2)
INTELLIGENT = 5


def smooth_path(channel: SyntecChannel, words: Words) -> None:
    """G05.1 Q1 E, Q2 E: filter or insert points; Q5 R E: tolerance of arcs and corners; Q0: off."""
    kind = words.typed("Q")
    if kind not in (0, *FILTERS, INTELLIGENT):
        raise words.fail("smoothing_format", "Q" if kind is not None else "G5.1")
    error = words.typed("E")
    if kind in FILTERS:
        if error is None or error <= 0.0:
            raise words.fail("smoothing_format", "E" if error is not None else "G5.1")
        if channel.mode["path"] in STOPPING_MODES:
            raise words.fail("smoothing_stops", "G5.1")
    if kind == INTELLIGENT:
        low, high = TOLERANCES
        for address in ("R", "E"):
            value = words.typed(address)
            if value is not None and not low <= value <= high:
                raise words.fail("smoothing_format", address)
    PathModeState.of(channel).contour_control = kind != 0
    channel.context_changed()


def high_precision(channel: SyntecChannel, words: Words) -> None:
    """G05 P10000 [E] [axes], G05 E: curve fitting on; G05 P0, G05: off."""
    if not channel.memory.parameters.option_path_fitting:
        raise words.fail("option", "G5")
    nurbs.check_complete(channel)
    switch = words.typed("P")
    error = words.typed("E")
    if switch is None:
        switch = 0 if error is None else ON
    if switch not in (0, ON) or (error is not None and error <= 0.0):
        raise words.fail("smoothing_format", "P" if switch not in (0, ON) else "E")
    _check_axes(channel, words)
    if switch == ON and tip_control.is_on(channel):
        raise words.fail("tip_smoothing", "G5")
    if switch == ON and channel.mode["path"] in STOPPING_MODES:
        raise words.fail("smoothing_stops", "G5")
    PathModeState.of(channel).contour_control = switch == ON
    channel.context_changed()


def _check_axes(channel: SyntecChannel, words: Words) -> None:
    """Geometry axes are listed with 0, up to two rotary axes with their tolerance."""
    geometry = rotary = 0
    for axis, value, _ in words.axes():
        if axis in channel.coordinates.geometry:
            geometry += 1
            wrong = value != 0.0
        else:
            rotary += 1
            wrong = value <= 0.0 or not channel.axis_data[axis].rotary
        if wrong:
            raise words.fail("smoothing_format", channel.axes[axis])
    if rotary > MAX_ROTARY or (rotary and not geometry):
        raise words.fail("smoothing_format", "G5")
