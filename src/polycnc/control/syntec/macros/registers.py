"""R registers that a program writes as the PLC does: G10 L1000, SETRREGBIT (manual 2.14, 2.51, 2.78).

Unlike `@` these ways reach the registers of the interface too.
"""

from __future__ import annotations

from polycnc.control.syntec.macros.variables import SHOWN_REGISTERS
from polycnc.control.syntec.motion.oscillation import OVERRIDE, PERCENTAGES, override_set
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel


def write_register(channel: SyntecChannel, register: int, value: int) -> None:
    """Set an R register, and let it act.

    Raises:
        AlarmError: The register takes no such value, or the control alone writes it.
    """
    if any(register in shown for shown in SHOWN_REGISTERS):
        raise channel.control.not_yet(f"R{register}", f"R{register}")
    check_register(channel, register, value)
    channel.memory.globals.registers[register] = value
    if register == OVERRIDE:
        override_set(channel)


def check_register(channel: SyntecChannel, register: int, value: int) -> None:
    """Refuse what a register cannot mean: R19 is 0 to 150 %."""
    low, high = PERCENTAGES
    if register == OVERRIDE and not low <= value <= high:
        raise channel.control.fail("argument", address=f"R{register}")
