"""M codes of a Hartford machining centre with MELDAS (manual §14.1); its interlocks are in `plc.toml`."""

from __future__ import annotations

from polycnc.control.hartford.m_codes import SHARED_M_CODES, after
from polycnc.control.word_address.block.codes import m_table

#: Maintenance codes, in MDI only.
MAINTENANCE = range(31, 37)
M_CODES = m_table(*SHARED_M_CODES, *after(26, 27, *MAINTENANCE))
