"""M codes and interlocks of a Hartford machining centre with MELDAS (manual §12, §14.1)."""

from __future__ import annotations

from polycnc.control.fanuc.hartford import SHARED_M_CODES, after
from polycnc.control.word_address import interlocks
from polycnc.control.word_address.codes import m_table
from polycnc.control.word_address.interlocks import Interlock, words

MDI_ONLY = range(31, 37)

M_CODES = m_table(*SHARED_M_CODES, *after(26, 27, *MDI_ONLY))
INTERLOCKS = (
    Interlock(words("M6"), interlocks.away_from_tool_change, "3017"),
    Interlock(words("M3", "M4", "M13", "M14", "M19"), interlocks.tool_unclamped, "3009"),
    Interlock(words("S"), interlocks.tool_unclamped, "3007"),
    Interlock(words(*(f"M{number}" for number in MDI_ONLY)), interlocks.not_in_mdi, "3010"),
)
