"""Drilling cycles of MELDAS: FANUC's, with amounts from its own parameters and F of a tap as its pitch."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.control.fanuc.milling.cycles import CYCLES, MILLING_DRILLING
from polycnc.control.word_address.motion.path import FEED_MODES
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.cycles.drilling import CycleData

#: Parameter with the retract or clearance of each pecking cycle, mm (G73 n, G83 n).
RELIEF_PARAMETERS = {"G73": 8012, "G83": 8013}
#: Tapping cycles that FANUC has and MELDAS has not.
_FOREIGN = ("G84.2", "G84.3")


def relief(channel: Channel, code: str) -> float:
    """Retract or clearance between pecks, mm."""
    number = RELIEF_PARAMETERS.get(code)
    return channel.setup.parameters.number(number) if number else 0.0


def shift_off_wall(_channel: Channel, data: CycleData, _plane: tuple[int, int]) -> tuple[float, float]:
    """I and J (Hartford manual §3.3.3, G76 and G87)."""
    return data.amount("I"), data.amount("J")


def pitch_of_tap(channel: Channel) -> float:
    """F of G74 and G84 is the pitch, whatever the feed mode (Hartford manual §3.3.3, G84)."""
    return (
        channel.feed if FEED_MODES[channel.mode["feed"]] is FeedMode.PER_REVOLUTION else channel.feed * 60.0
    )


DRILLING = replace(
    MILLING_DRILLING,
    cycles={code: cycle for code, cycle in CYCLES.items() if code not in _FOREIGN},
    relief=relief,
    shift=shift_off_wall,
    lead=pitch_of_tap,
)
