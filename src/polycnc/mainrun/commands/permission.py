"""Whether a command may be given: the control's own table, and what the machine says."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.states import is_allowed
from polycnc.mainrun.errors import MachineRefused, OutOfPlace

if TYPE_CHECKING:
    from polycnc.mainrun.commands.states import Command
    from polycnc.mainrun.signals.interlocks import Interlocks
    from polycnc.mainrun.status import Status
    from polycnc.messages import Catalogue


class Permission:
    """Asked in front of every command.

    Args:
        catalogue: The texts of refusals.
        status: Mode and state.
        interlocks: What the machine's controller refuses.
    """

    def __init__(self, catalogue: Catalogue, status: Status, interlocks: Interlocks) -> None:
        self._catalogue = catalogue
        self._status = status
        self._interlocks = interlocks

    def ask(self, command: Command) -> None:
        """Ask the control.

        Raises:
            CommandRefused: The command is out of place in this mode and state.
        """
        mode, state = self._status.mode, self._status.state
        if not is_allowed(command, mode, state):
            raise OutOfPlace(command, mode, state)

    def ask_machine(self, *words: str) -> None:
        """Ask the machine's controller for something; it answers with an alarm or a message where it refuses.

        Raises:
            CommandRefused: It refuses one of the words.
        """
        for word in words:
            if code := self._interlocks.refuses(word):
                raise MachineRefused(self._catalogue, code)
