"""MELDAS control of a Hartford machining centre (control id `meldas-m`)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

from polycnc.control.fanuc.milling.codes import ADDRESSES, POWER_ON
from polycnc.control.fanuc.milling.variables import MILLING_VARIABLES
from polycnc.control.meldas.alarm_codes import ALARMS
from polycnc.control.meldas.code_calls import registered_codes
from polycnc.control.meldas.cycles import DRILLING
from polycnc.control.meldas.hartford import M_CODES
from polycnc.control.meldas.milling_codes import G_CODES
from polycnc.control.word_address.machining_centre import MillingControl
from polycnc.control.word_address.macro_b.variables import MacroMemory
from polycnc.control.word_address.transformations.normal_line import NormalLineParameters

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import GCode, MCode, Planner
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.messages import AlarmError
    from polycnc.toolpath.motion_settings import MotionSettings


class MeldasMilling(MillingControl):
    """MELDAS M64, M70, M500, M720 class."""

    id: ClassVar[str] = "meldas-m"
    alarm_files: ClassVar[tuple[str, ...]] = (
        "fanuc/alarms.toml",
        "meldas/alarms.toml",
        "meldas/f00_f49_alarms.toml",
        "meldas/f50_f99_alarms.toml",
        "meldas/operation_messages.toml",
    )
    g_codes: ClassVar[Mapping[str, GCode]] = G_CODES
    m_codes: ClassVar[Mapping[int, MCode]] = M_CODES
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = ALARMS
    drilling: ClassVar[Drilling] = DRILLING
    plc_files: ClassVar[tuple[str, ...]] = ("hartford/rules.toml", "meldas/plc.toml")
    REFERENCE_PARAMETERS: ClassVar[dict[int, int]] = {1: 2037, 2: 2038, 3: 2039, 4: 2040}
    ARC_TOLERANCE_PARAMETER: ClassVar[tuple[int, float]] = (1084, 0.1)
    OVERRUN_PARAMETER: ClassVar[int] = 8209
    NORMAL_LINE_PARAMETERS: ClassVar[NormalLineParameters] = NormalLineParameters(1522, 1523)

    def macro_alarm(self, _channel: Channel, number: int, told: str) -> AlarmError:
        """#3000 = n (TEXT): P277 with the number and the text."""
        return self.fail("macro_alarm", detail=f"{number} {told}".strip())

    def motion_settings(self, channel: Channel) -> MotionSettings:
        """#1086 G0Intp = 0: rapids run on a line; delivered, every axis by itself."""
        by_axis = channel.setup.parameters.number(1086, default=1) != 0
        return replace(super().motion_settings(channel), rapid_by_axis=by_axis, returns_to_path=False)

    def code_calls(self, channel: Channel) -> CodeCalls:
        """Codes registered by #7001 to #7303."""
        return registered_codes(channel)

    def measuring(self, channel: Channel, words: Words) -> tuple[float, float, float]:
        """G37: R way before the target at feed, D allowed difference, F feed."""
        return words.length("R") or 0.0, words.length("D") or 0.0, channel.feed

    def make_memory(self, channel: Channel) -> MacroMemory:
        """Offsets, tools and variables."""
        return MacroMemory(channel, MILLING_VARIABLES)
