"""What parameters of a FANUC control say about the switches of an operator."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.toolpath.motion_settings import DryRun

if TYPE_CHECKING:
    from polycnc.machine.setup.values import Parameters


def dry_run(parameters: Parameters) -> DryRun:
    """1410: its speed, mm/min. 1401#6 RDR: rapids too; 1401#5 TDR: not in threads and taps."""
    return DryRun(
        speed=(abs(parameters.number(1410)) or 60.0 * DryRun().speed) / 60.0,
        with_spindle=not parameters.bit(1401, 5),
        rapids=bool(parameters.bit(1401, 6)),
    )
