"""What parameters of a FANUC control say about the switches of an operator, and about reading ahead."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.motion_settings import DryRun

if TYPE_CHECKING:
    from polycnc.control.fanuc.parameters import FanucAxisParameters, FanucParameters

#: Modes whose main program may hold no GOTO, WHILE and DO (PS0123).
MODES_WITHOUT_JUMPS = frozenset(("mdi", "dnc", "tape", "remote"))


def dry_run(parameters: FanucParameters[FanucAxisParameters]) -> DryRun:
    """1410: its speed, mm/min. 1401#6 RDR: rapids too; 1401#5 TDR: not in threads and taps."""
    return DryRun(
        speed=abs(parameters.dry_run_speed) / 60.0 or DryRun().speed,
        with_spindle=not parameters.TDR,
        rapids=parameters.RDR,
    )


def suppresses_reading(parameters: FanucParameters[FanucAxisParameters], code: int) -> bool:
    """Whether nothing is read behind an M code: 3411 to 3420 name some, 3421 to 3432 give ranges of them."""
    ends = parameters.unbuffered_m_ranges
    ranges = zip(ends[::2], ends[1::2], strict=True)
    return code in parameters.unbuffered_m_codes or any(low <= code <= high for low, high in ranges)
