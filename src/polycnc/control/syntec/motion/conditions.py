"""The nine sets of machining conditions: G120.1 P Q, G121, and P of G62 and G64 (manual 2.40, 2.67).

What a set holds the manual does not print; here it is the highest speed of the axes in cuts. 0 leaves it to Pr621 on.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.memory.retained import MACHINING_CONDITIONS
from polycnc.toolpath.context import Pace

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.deferred.typing import Self
    from polycnc.toolpath import Context

#: Sets for users: P1Q1 is 1, P1Q2 2, P3Q3 9.
SETS = range(1, 10)
#: Sets that P of G62 and G64 may name: 0 for the default, those of users, those of the product.
KNOWN = frozenset({0, *SETS, 21, 22, 23})
#: What a set is delivered with, mm/min.
DELIVERED = 0.0


@dataclass(slots=True)
class ConditionSets(State, lifetime=Lifetime.RETAINED):
    """What the page of the sets holds.

    Attributes:
        speeds: Highest speed of the axes in cuts by set, mm/min; 0 for none.
    """

    speeds: dict[int, float] = retained(MACHINING_CONDITIONS)


@dataclass(slots=True)
class ChosenSet(State, lifetime=Lifetime.RESET):
    """The set that holds; 0 for none."""

    number: int = 0

    @classmethod
    def first(cls, channel: SyntecChannel) -> Self:
        """As Pr3835 has it."""
        return cls(SyntecParameters.naming(channel.setup.parameters).machining_condition)


def choose(channel: SyntecChannel, number: int) -> None:
    """A set holds from here on; 0 for the default of Pr3835."""
    chosen = ChosenSet.of(channel)
    chosen.number = number or ChosenSet.first(channel).number
    channel.context_changed()


def speed(channel: Channel, number: int) -> float:
    """The highest speed of the axes in cuts that a set has, mm/min; 0 for none."""
    return ConditionSets.of(channel).speeds.get(number, DELIVERED)


def set_speed(channel: Channel, number: int, value: float) -> None:
    """Another speed for a set, mm/min."""
    ConditionSets.of(channel).speeds[number] = value
    channel.context_changed()


def bounded(channel: SyntecChannel, context: Context) -> Context:
    """The context with what the chosen set says."""
    number = ChosenSet.of(channel).number
    top = speed(channel, number) if number in SETS else 0.0
    if not top:
        return context
    speeds = (inf if axis.rotary else top / 60.0 for axis in channel.axis_data)
    return replace(context, pace=replace(context.pace or Pace(), top=tuple(speeds)))
