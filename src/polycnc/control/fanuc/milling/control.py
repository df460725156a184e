"""FANUC control of a Hartford machining centre (control id `fanuc-m`)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

from polycnc.compensation.policy import Approach, Policy
from polycnc.control.fanuc.alarm_codes import ALARMS, FOREIGN_CODES
from polycnc.control.fanuc.code_calls import registered_codes
from polycnc.control.fanuc.milling.codes import ADDRESSES, G_CODES, POWER_ON
from polycnc.control.fanuc.milling.cycles import MILLING_DRILLING
from polycnc.control.fanuc.milling.variables import MILLING_VARIABLES
from polycnc.control.fanuc.operation import dry_run
from polycnc.control.hartford import m_codes as hartford
from polycnc.control.word_address.machining_centre import HARTFORD, MillingControl
from polycnc.control.word_address.macro_b import interruption
from polycnc.control.word_address.macro_b.variables import MacroMemory

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import GCode, MCode, Planner
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.toolpath.motion_settings import MotionSettings


class FanucMilling(MillingControl):
    """FANUC 0i-M / 18M class with custom macro B."""

    id: ClassVar[str] = "fanuc-m"
    alarm_files: ClassVar[tuple[str, ...]] = (
        "fanuc/alarms.toml",
        "fanuc/milling/alarms.toml",
        "hartford/alarms.toml",
        "hartford/messages.toml",
    )
    g_codes: ClassVar[Mapping[str, GCode]] = G_CODES
    m_codes: ClassVar[Mapping[int, MCode]] = hartford.FANUC_M_CODES
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = ALARMS
    foreign_codes: ClassVar[Mapping[str, str]] = FOREIGN_CODES
    drilling: ClassVar[Drilling] = MILLING_DRILLING
    rules: ClassVar[tuple[Rule, ...]] = (*MillingControl.rules, interruption.RULE)
    plc_files: ClassVar[tuple[str, ...]] = ("hartford/rules.toml", "fanuc/plc.toml")

    def code_calls(self, channel: Channel) -> CodeCalls:
        """Codes registered by 6050 to 6089 and 6001#5."""
        return registered_codes(channel)

    def m_row(self, builder: Builder, number: int) -> MCode:
        """The row of an M code; M96 P and M97 are those of the interruption macro where 6003#7 enables it."""
        return interruption.m_code(builder.channel, number) or super().m_row(builder, number)

    def several_m_codes(self, channel: Channel) -> bool:
        """3404#7: up to three M codes in a block."""
        return bool(channel.setup.parameters.bit(3404, 7))

    def compensation_policy(self, channel: Channel) -> Policy:
        """Start-up types A, B, C (5003#0, #1), blocks read ahead (19625), interference (5008)."""
        parameters = channel.setup.parameters
        return replace(
            HARTFORD,
            approach=Approach.CORNER if parameters.bit(5003, 0) else Approach.SQUARE,
            shifts_without_motion=bool(parameters.bit(5003, 1)),
            read_blocks=min(max(int(parameters.number(19625, default=3)), 3), 8),
            least_move_mm=parameters.number(5010, default=HARTFORD.least_move_mm),
            checks_direction=not parameters.bit(5008, 1),
        )

    def motion_settings(self, channel: Channel) -> MotionSettings:
        """1401#1 LRP: rapids on a line, else every axis by itself; 7001#0 MIT: manual intervention and return."""
        bit = channel.setup.parameters.bit
        return replace(
            super().motion_settings(channel),
            rapid_by_axis=not bit(1401, 1),
            returns_to_path=bool(bit(7001, 0)),
            dry_run=dry_run(channel.setup.parameters),
        )

    def make_memory(self, channel: Channel) -> MacroMemory:
        """Offsets, tools and variables."""
        return MacroMemory(channel, MILLING_VARIABLES)
