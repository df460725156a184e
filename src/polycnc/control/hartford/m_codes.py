"""M codes that both controls of a Hartford machining centre have (manual §14); its interlocks are in `plc.toml`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.word_address.auxiliary import functions, overrides
from polycnc.control.word_address.block.codes import MCode, m_table
from polycnc.control.word_address.coordinates import frames
from polycnc.control.word_address.macro_b import subprograms

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Handler


def after(*codes: int, handler: Handler | None = None) -> tuple[MCode, ...]:
    """Rows of codes that act after the motion of their block."""
    return tuple(MCode(code, after=True, handler=handler) for code in codes)


def together(*codes: int) -> tuple[MCode, ...]:
    """Rows of codes that act with the motion of their block."""
    return tuple(MCode(code) for code in codes)


SHARED_M_CODES = (
    MCode(0, after=True, handler=functions.stop, silent=True),
    MCode(1, after=True, handler=functions.optional_stop, silent=True),
    *after(2, 30, handler=functions.end_program),
    MCode(3, handler=functions.spindle_clockwise),
    MCode(4, handler=functions.spindle_counter_clockwise),
    *after(5, 19, handler=functions.spindle_stop),
    *after(6, handler=functions.change_tool),
    *together(7, 8, 12, 17, 18, 22, 23, 50, 53, 58, 61, 63, 68),
    *after(9, 10, 11, 24, 25, 54, 62, 64, 69, 82, 83, 84, 85, 86, 87, 93, 96, 97),
    *after(13, handler=functions.spindle_clockwise),
    *after(14, handler=functions.spindle_counter_clockwise),
    *after(20),
    *together(21),
    MCode(73, handler=overrides.cancel_feed_override),
    MCode(74, after=True, handler=overrides.allow_feed_override),
    MCode(75, handler=overrides.cancel_spindle_override),
    MCode(76, after=True, handler=overrides.allow_spindle_override),
    MCode(70, handler=frames.mirror_first_axis),
    MCode(71, handler=frames.mirror_second_axis),
    MCode(72, handler=frames.end_mirror_by_m),
    MCode(98, after=True, handler=subprograms.call_subprogram, takes="P L Q", silent=True),
    MCode(99, after=True, handler=subprograms.return_from_subprogram, takes="P L", silent=True),
    MCode(198, after=True, handler=subprograms.call_external_subprogram, takes="P L", silent=True),
)
FANUC_M_CODES = m_table(
    *SHARED_M_CODES,
    MCode(29, handler=functions.arm_rigid_tapping),
    *after(60, 65),
)
