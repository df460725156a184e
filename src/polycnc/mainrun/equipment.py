"""What a virtual control is made of: the control, its machine and its setup."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from polycnc.control import registry
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.machine import load_machine, load_setup, parse_setup
from polycnc.machine.model import Machine
from polycnc.machine.setup.file import check_bits
from polycnc.machine.setup.values import Setup
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from polycnc.control.interface import Control


def equipment(
    control: str | Control,
    machine: str | Path | Machine | None,
    setup: Mapping[str, Any] | str | Path | Setup | None,
) -> tuple[Control, Machine, Setup]:
    """Find control, machine and setup.

    Raises:
        CommandRefused: There is no such control, or it does not know tools by their names.
        FileError: The machine or the setup is wrong.
    """
    chosen = _control(control) if isinstance(control, str) else control
    if isinstance(setup, Setup):
        start = setup
    elif setup is None or isinstance(setup, Mapping):
        start = parse_setup(setup)
    else:
        start = load_setup(setup)
    check_bits(start, chosen.id, chosen.last_bit, setup if isinstance(setup, str | Path) else "")
    if start.tool_name and not chosen.tools_have_names:
        raise CommandRefused("session.tool-name", tool=start.tool_name, control=chosen.id)
    if isinstance(machine, Machine):
        return chosen, machine, start
    named = start.machine
    if named.endswith(".toml") and isinstance(setup, str | Path):
        named = str(Path(setup).parent / named)  # a file that a file names lies beside it
    built = load_machine(machine or named or chosen.default_machine)
    return chosen, built.with_channels(start.channels) if start.channels else built, start


def _control(control_id: str) -> Control:
    if control_id not in registry.ids():
        known = listed(registry.ids())
        raise CommandRefused("session.control-unknown", control=control_id, known=known)
    return registry.control(control_id)
