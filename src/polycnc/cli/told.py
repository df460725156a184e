"""What a setup says and the control does not act on: told beside the results, so that nobody relies on it."""

from __future__ import annotations

from polycnc.cli.console import note
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from polycnc.control.interface import Control
    from polycnc.machine.setup.values import ParameterKey, Parameters


def tell_unheeded(control: Control, given: Parameters) -> None:
    """Name on standard error the parameters of a setup that polycnc does not know, and those that it only keeps."""
    from polycnc.control.parameters import unheeded

    found = unheeded(control, given)
    for message, is_kept in (("parameters.unknown", False), ("parameters.idle", True)):
        numbers = dict.fromkeys(_number(key) for key, kept in found.items() if kept is is_kept)
        if numbers:
            note(text(message, control=control.id, number=listed(numbers)))


def _number(key: ParameterKey) -> str:
    """A parameter without its axis."""
    return f"{key.id}" if key.bit is None else f"{key.id}#{key.bit}"
