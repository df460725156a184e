"""Words that the machine's own controller (PLC) refuses while a program is calculated, on every control.

The rows are data of the machine (`machine/plc.py`). Here only what a program itself brings about is known, and what the
setup says of the machine: where the axes stand, and what earlier M codes have done. On the main run's clock the same
rows are asked with the live signals, and this module stands aside.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError
from polycnc.toolpath.events import InterlockQuery

with loaded_when_called():
    from polycnc.control import tool_change

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.machine.plc import Plc, PlcAlarm
    from polycnc.machine.setup.values import Setup

#: What the rules call an M code that is in no list.
UNKNOWN_M = "UNKNOWN_M"
#: A move of the second rotary axis, whatever its name.
FIFTH_AXIS = "MOVE_FIFTH_AXIS"


def _z_is_referenced(channel: Channel) -> bool:
    z = channel.coordinates.geometry[2]
    return z < 0 or tool_change.stands_at_reference(channel, z)


#: Signals that follow from the state of the program.
STATES: Mapping[str, Callable[[Channel], bool]] = {
    "Z_AT_REFERENCE": _z_is_referenced,
    "Z_AT_CHANGE_POINT": tool_change.z_stands_at_change_point,
    "AUTO": lambda channel: channel.setup.switches.mode.lower() != "mdi",
    "MDI": lambda channel: channel.setup.switches.mode.lower() == "mdi",
}


def signals_of(setup: Setup) -> dict[str, float]:
    """What a setup tells the machine: its numeric switches."""
    given = setup.switches.signals.items()
    return {name: float(value) for name, value in given if isinstance(value, int | float)}


@dataclass(slots=True)
class MachineSignals(State, lifetime=Lifetime.POWER):
    """What the setup and the program have told the machine.

    Attributes:
        known: Values by name; None where the main run knows, which is asked when a word reaches it.
    """

    known: dict[str, float] | None = None

    @classmethod
    def first(cls, channel: Channel) -> MachineSignals:
        """What the setup says."""
        return cls(signals_of(channel.setup))


def plc_of(channel: Channel) -> Plc:
    """The machine's own controller as it is on the channel's control."""
    return channel.machine.plc(channel.control.id)


def refuse(channel: Channel, word: str, address: str = "", *, calls: bool = False) -> None:
    """Raise the machine's alarm if it refuses a word now; else let its rules answer to the word.

    Args:
        channel: The channel.
        word: A word of the rules.
        address: How the program writes it, where that differs.
        calls: It calls a program, so it does not go to the machine itself.
    """
    signals = MachineSignals.of(channel).known
    if signals is None:
        if calls or word.startswith("MOVE_") or word == UNKNOWN_M:
            channel.event(InterlockQuery(word))  # asked when the axes are there
        return
    row = refusal(channel, word, signals)
    if row is not None and row.stops:
        channel.mark = channel.toolpath.mark()  # what the block has done before stays: the machine stops here
        raise AlarmError(row.code, address=address or word.removesuffix("_CODE"))
    plc_of(channel).latch(word, signals)


def asking(step: Callable[..., None] | None, words: Iterable[str], plc: Plc) -> Callable[..., None]:
    """A step of a block that asks the machine first, for the words that any row of its answers to, in their order.

    Without such a word it is the step itself; without a step it does no more than ask.
    """
    mine = tuple(word for word in words if plc.knows(word))
    if not mine and step is not None:
        return step

    def act(channel: Channel, values: Any) -> None:
        for word in mine:
            refuse(channel, word)
        if step is not None:
            step(channel, values)

    return act


def move_words(channel: Channel, axes: Iterable[int]) -> list[str]:
    """The words of a move along some axes of a channel; the second rotary axis has a further one of its own."""
    moved = list(dict.fromkeys(axes))
    rotary = [axis for axis, data in enumerate(channel.axis_data) if data.rotary]
    fifth = [FIFTH_AXIS] if any(axis in moved for axis in rotary[1:2]) else []
    return [f"MOVE_{channel.axes[axis]}" for axis in moved] + fifth


def may_refuse_moves(channel: Channel) -> bool:
    """Whether the machine refuses a move along some axis now, may do so while axes move, or sets outputs as they do."""
    signals = MachineSignals.of(channel).known
    plc = plc_of(channel)
    if signals is None or not plc.moves:
        return False
    words = plc.moves.intersection(move_words(channel, range(len(channel.axes))))
    return any(
        plc.sets(word) or plc.signals_of(word) & STATES.keys() or refusal(channel, word, signals)
        for word in words
    )


def refusal(channel: Channel, word: str, signals: dict[str, float]) -> PlcAlarm | None:
    """The row that refuses a word in the state of the program and of the machine."""

    def value(name: str) -> float:
        state = STATES.get(name)
        return float(state(channel)) if state is not None else signals.get(name, 0.0)

    return plc_of(channel).refusal(word, value)
