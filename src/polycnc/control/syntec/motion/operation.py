"""Codes that prepare operation and leave the path as it is: G10.6, G120.1 and G121 (manual 2.67, 2.81)."""

from __future__ import annotations

from polycnc.control.syntec.motion import conditions
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words

RETRACT_AXES = 1


def arm_retract(channel: SyntecChannel, words: Words) -> None:
    """G10.6 R or one axis, F: what the retract key will do; F holds for the cutting that follows."""
    distance = words.typed("R")
    axes = words.plan.axis_words
    geometric = [word for word in axes if word.axis in channel.coordinates.geometry]
    if distance is None and (len(axes) != RETRACT_AXES or len(geometric) != RETRACT_AXES):
        raise words.fail("retract_way")
    if distance is not None and (distance <= 0.0 or axes):
        raise words.fail("retract_distance" if distance <= 0.0 else "retract_way", "R")
    speed = words.typed("F")
    if speed is not None:
        channel.feed = speed * (INCH_MM if words.plan.inch else 1.0) / 60.0


def select_conditions(channel: SyntecChannel, words: Words) -> None:
    """G120.1 P Q: one of nine sets of machining conditions; P0 the default."""
    application, condition = words.typed("P"), words.typed("Q")
    if application is None and condition is None:
        return
    if application is None:
        raise words.fail("conditions_missing", "G120.1")
    condition = 1 if condition is None else condition
    if application not in range(4) or condition not in range(1, 4):
        raise words.fail("conditions_range", "P" if application not in range(4) else "Q")
    conditions.choose(channel, 3 * (int(application) - 1) + int(condition) if application else 0)


def default_conditions(channel: SyntecChannel, _words: Words) -> None:
    """G121: the default set."""
    conditions.choose(channel, 0)
