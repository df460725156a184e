"""The wait for the spindle's speed at the start of a hole (3740), and where it is left out (11507#7 SAC; II.4.3.6)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.lathe.cycles import tapping
from polycnc.control.word_address.block.rules import Rule
from polycnc.cycles.drilling.lathe import when_arrived
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.cycles.drilling.holes import Stroke


#: M codes at which the spindle stops.
_STOPS = frozenset({5, 19})


@dataclass(slots=True)
class ArrivalState(State, lifetime=Lifetime.RESET):
    """The spindle whose speed a hole of the active drilling cycle has waited for.

    Attributes:
        turns: Direction and programmed speed then; None where no hole has waited.
    """

    turns: tuple[int, float] | None = None


def waiting(channel: LatheChannel, code: str, strokes: Iterator[Stroke]) -> Iterator[Stroke]:
    """The strokes of a hole, with the wait in front of the first one that works; a rigid tap moves its spindle itself.

    With SAC only the first hole waits, and the first one behind what makes SAR fall: another speed or direction. Taps
    reverse the spindle and wait at every hole.
    """
    seconds = channel.memory.parameters.speed_arrival_wait / 1000.0
    if not seconds > 0.0 or (code in tapping.TAPS and tapping.is_rigid(channel)):
        return strokes
    state, spindle = ArrivalState.of(channel), channel.memory.spindle
    turns = (spindle.direction, spindle.speed)
    goes_on = channel.memory.parameters.SAC and code not in tapping.TAPS and state.turns == turns
    state.turns = turns
    return strokes if goes_on else when_arrived(strokes, seconds)


def _plan_forgetting(builder: Builder, _plan: Plan) -> Step | None:
    """S, a stop of the spindle, the end of the cycle and another cycle: the next hole waits."""
    stays = builder.mode["cycle"] == builder.before["cycle"]
    if stays and not builder.has("S") and _STOPS.isdisjoint(builder.m_codes):
        return None

    def forget(channel: LatheChannel, _values: list[float]) -> None:
        ArrivalState.of(channel).turns = None

    return forget


#: What makes the next hole of a drilling cycle wait again.
RULE = Rule("speed arrival", unless={"cycle": "G80"}, before=_plan_forgetting)
