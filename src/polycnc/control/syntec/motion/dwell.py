"""G04 of SYNTEC: a dwell, which a signal may end (manual 2.8)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.syntec.macros.variables import BitState
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.toolpath import Context

#: Q of G04: C101 to C132.
SIGNALS = range(101, 133)


@dataclass(slots=True)
class DwellState(State, lifetime=Lifetime.RESET):
    """The signal that ends the dwell of the running block; empty for none."""

    signal: str = ""


def ended_by_signal(channel: SyntecChannel, context: Context) -> Context:
    """A context names the signal that ends its dwell."""
    return replace(context, dwell_signal=DwellState.of(channel).signal)


def dwell(channel: SyntecChannel, words: Words) -> None:
    """G04 X or P, Q: X with a point seconds, else milliseconds; P milliseconds, decimals cut off; C bit Q ends it."""
    beside = next((word for word in words.plan.axis_words if word.address != "X"), None)
    if beside is not None:
        raise words.fail("argument", beside.address)
    seconds = _seconds(words)
    signal = _signal(words)
    if not signal:
        channel.dwell(seconds=seconds)
        return
    if BitState.of(channel).bits.get(signal, 0) or _comes_here(channel, signal):
        return
    state = DwellState.of(channel)
    state.signal = signal
    channel.context_changed()
    channel.dwell(seconds=seconds)
    state.signal = ""
    channel.context_changed()


def _seconds(words: Words) -> float:
    milliseconds = words.typed("P")
    if milliseconds is not None:
        if "X" in words:
            raise words.fail("argument", "X")
        return int(milliseconds) / 1000.0
    value = words.typed("X")
    if value is None:
        raise words.fail("argument", "G4")
    whole = words.form("X") == "" and not words.plan.rules.calculator
    return value / 1000.0 if whole else value


def _signal(words: Words) -> str:
    number = words.typed("Q")
    if number is None:
        return ""
    if number not in SIGNALS:
        raise words.fail("argument", "Q")
    return f"C{int(number)}"


def _comes_here(channel: SyntecChannel, signal: str) -> bool:
    """Whether the setup lets the signal come at the place where the axes dwell."""
    places = channel.setup.switches.signals_at.get(signal, {})
    c = channel.coordinates
    here = [
        abs(c.position[i] - channel.control.from_display(channel, i, value)) <= NO_WAY
        for name, value in places.items()
        if (i := channel.axis_index.get(name)) is not None
    ]
    return bool(here) and all(here)
