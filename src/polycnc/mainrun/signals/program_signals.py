"""Signals as programs read and write them: through the main run, at the time of the block."""

from __future__ import annotations

from polycnc.control.machine_words import MachineSignals
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.control.syntec.macros.variables import BitState
from polycnc.control.syntec.memory import SyntecMemory
from polycnc.control.word_address.macro_b.variables import MacroMemory, MacroSignals
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.toolpath.events import SignalWrite

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.mainrun.signals.image import SignalImage


class ProgramSignals(dict[str, int]):
    """The bits between program and machine, in the control's memory: reading waits for the main run.

    Args:
        start: Values at power-on.
        channel: The channel whose programs use them.
        image: The signal image.
    """

    def __init__(self, start: Mapping[str, int], channel: Channel, image: SignalImage) -> None:
        super().__init__(start)
        self._channel = channel
        self._image = image

    def get(self, name: str, default: Any = 0) -> Any:  # noqa: ARG002 - a signal that nobody has set is 0
        """The value of a signal once everything before the running block is executed."""
        self._channel.synchronise()
        return int(self._image[name])

    def __setitem__(self, name: str, value: int) -> None:
        super().__setitem__(name, value)
        self._channel.event(SignalWrite(name=name, value=value))


def connect(channel: Channel, image: SignalImage) -> None:
    """Let the programs of a channel use the signal image; `#1000`, `READDI` and their likes."""
    memory = channel.memory
    if isinstance(memory, MacroMemory):
        signals = MacroSignals.of(channel)
        signals.values = ProgramSignals(signals.values, channel, image)
    if isinstance(memory, SyntecMemory):
        bits = BitState.of(channel)
        bits.bits = ProgramSignals(bits.bits, channel, image)
    MachineSignals.of(channel).known = None  # the machine's controller is asked when a word reaches it


def give(channel: Channel, signals: Mapping[str, float]) -> None:
    """Give signals to programs that keep them in variables (`$A_IN[1]`): before they are read, or when one changes."""
    for name, value in signals.items():
        variable, _, index = name.partition("[")
        if variable.startswith("$A_") and index[:-1].isdigit():
            values = Stored.of(channel).of_name(variable)
            values[variable, (int(index[:-1]),)] = bool(value) if variable[-1] != "A" else value
