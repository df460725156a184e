"""MELDAS control of a Hartford machining centre (control id `meldas-m`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from polycnc.control.fanuc.alarm_codes import ALARMS
from polycnc.control.fanuc.milling_codes import ADDRESSES, M_CODES, POWER_ON
from polycnc.control.fanuc.system_variables import MILLING_VARIABLES
from polycnc.control.meldas.cycles import DRILLING
from polycnc.control.meldas.milling_codes import G_CODES
from polycnc.control.word_address.milling import MillingControl
from polycnc.control.word_address.variables import MacroMemory

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.codes import GCode, MCode, Planner
    from polycnc.control.word_address.drilling import Drilling


class MeldasMilling(MillingControl):
    """MELDAS M64, M70, M500, M720 class."""

    id: ClassVar[str] = "meldas-m"
    alarm_package: ClassVar[str] = "polycnc.control.fanuc"
    g_codes: ClassVar[Mapping[str, GCode]] = G_CODES
    m_codes: ClassVar[Mapping[int, MCode]] = M_CODES
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = ALARMS
    drilling: ClassVar[Drilling] = DRILLING

    def make_memory(self, channel: Channel) -> MacroMemory:
        """Offsets, tools and variables."""
        return MacroMemory(channel, MILLING_VARIABLES)
