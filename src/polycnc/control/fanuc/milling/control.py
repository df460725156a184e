"""FANUC control of a machining centre (control id `fanuc-m`)."""

from __future__ import annotations

from functools import cache

from polycnc.control.fanuc.acceleration import accelerated
from polycnc.control.fanuc.alarm_codes import ALARMS
from polycnc.control.fanuc.code_calls import registered_codes
from polycnc.control.fanuc.milling.codes import ADDRESSES, G_CODES, M_CODES, POWER_ON
from polycnc.control.fanuc.milling.cycles import MILLING_DRILLING
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.fanuc.milling.rules import RULES
from polycnc.control.fanuc.operation import MODES_WITHOUT_JUMPS, dry_run, suppresses_reading
from polycnc.control.word_address.block.whole_numbers import DecimalPoint
from polycnc.control.word_address.coordinates import tip
from polycnc.control.word_address.machining_centre import MillingControl
from polycnc.control.word_address.macro_b import interruption
from polycnc.control.word_address.macro_b.variables import MacroMemory
from polycnc.control.word_address.motion import path
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar

with loaded_when_called():
    from polycnc.control.fanuc import tool_plane
    from polycnc.control.fanuc.milling import mechanism
    from polycnc.control.word_address.tools import length

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.compensation.policy import Policy
    from polycnc.control.word_address.block.codes import ContextStep, GCode, MCode, MRow, Planner, Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.control.word_address.macro_b.variables import Registry
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.machine.kinematics import Kinematics
    from polycnc.toolpath.motion_settings import MotionSettings


#: A speed that no axis has.
UNBOUND = 1e9


def _given(channel: Channel) -> FanucMillingParameters:
    """The parameters of a channel, in front of power-on as well."""
    return FanucMillingParameters.naming(channel.setup.parameters)


@cache
def _system_variables() -> Registry:
    from polycnc.control.fanuc.milling.variables import MILLING_VARIABLES

    return MILLING_VARIABLES


class FanucMilling(MillingControl):
    """FANUC 0i-M / 18M class with custom macro B."""

    id: ClassVar[str] = "fanuc-m"
    alarm_files: ClassVar[tuple[str, ...]] = (
        "fanuc/alarms.toml",
        "fanuc/milling/alarms.toml",
    )
    g_codes: ClassVar[Mapping[str, GCode]] = G_CODES
    m_codes: ClassVar[Mapping[int, MCode]] = M_CODES
    m_rows: ClassVar[tuple[MRow, ...]] = (interruption.m_row, *MillingControl.m_rows)
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = ALARMS
    parameter_files: ClassVar[tuple[str, ...]] = ("fanuc/parameters.toml", "fanuc/milling/parameters.toml")
    parameter_class: ClassVar = FanucMillingParameters
    drilling: ClassVar[Drilling] = MILLING_DRILLING
    context_steps: ClassVar[tuple[ContextStep, ...]] = (
        *MillingControl.context_steps,
        tip.displayed,
    )
    rules: ClassVar[tuple[Rule, ...]] = RULES
    SCALE_CENTER_IS_ABSOLUTE: ClassVar[bool] = True
    MODES_WITHOUT_JUMPS: ClassVar[frozenset[str]] = MODES_WITHOUT_JUMPS
    POINT_IN_WHOLE_NUMBERS: ClassVar[DecimalPoint] = DecimalPoint.REFUSED

    def start_codes(self, channel: Channel) -> dict[str, str]:
        """Codes of power-on: 3402#0 to #3, and the unit by 0#2 INI."""
        parameters, codes = _given(channel), super().start_codes(channel)
        if parameters.start_g01:
            codes["motion"] = "G1"
        if parameters.start_g18 or parameters.start_g19:
            codes["plane"] = "G18" if parameters.start_g18 else "G19"
        if parameters.start_g91:
            codes["distance"] = "G91"
        if parameters.INI:
            codes["unit"] = "G20"
        return codes

    def code_calls(self, channel: Channel) -> CodeCalls:
        """Codes registered by 6050 to 6089 and 6001#5."""
        return registered_codes(_given(channel))

    def radius_value(self, channel: Channel, number: int) -> float:
        """5004#2 ODI: the offset is the radius, or the diameter."""
        return self.offset_amount(channel, number) * (0.5 if _given(channel).ODI else 1.0)

    def several_m_codes(self, channel: Channel) -> bool:
        """3404#7 M3B: up to three M codes in a block."""
        return _given(channel).M3B

    def stops_reading(self, channel: Channel, code: int) -> bool:
        """M codes that stop the program, and those of 3411 to 3432."""
        return super().stops_reading(channel, code) or suppresses_reading(_given(channel), code)

    def leave_length(self, channel: Channel, axes: list[int], *, to_reference: bool) -> None:  # noqa: ARG002
        """G28, G30 and G53 cancel the length of their axes; 5001#6 EVO says until when (B-63844, 14.1.2)."""
        length.leave_length(channel, axes, returns=_given(channel).EVO)

    def compensates_to_intermediate(self, channel: Channel) -> bool:
        """5003#2 CCN: the vector vanishes behind the intermediate point of G28 and G30."""
        return _given(channel).CCN

    def compensation_policy(self, channel: Channel) -> Policy:
        """Start-up types A, B, C (5003#0, #1), blocks read ahead (19625), interference (5008)."""
        from polycnc.compensation.policy import Approach

        parameters = _given(channel)
        return replace(
            super().compensation_policy(channel),
            approach=Approach.CORNER if parameters.SUP else Approach.SQUARE,
            bare_cancel_is_square=True,
            shifts_without_motion=parameters.SUV,
            read_blocks=min(max(parameters.read_blocks, 3), 8),
            least_move_mm=parameters.least_corner_move,
            checks_direction=not parameters.CNC,
        )

    def whole_numbers(self, channel: Channel) -> frozenset[str]:
        """3451#2 SDP: S may have a decimal point."""
        addresses = super().whole_numbers(channel)
        return addresses - {"S"} if _given(channel).SDP else addresses

    def plan_arc_without_center(self, builder: Builder, plan: Plan) -> Step | None:
        """G02/G03 without R, I, J, K: a straight line; PS0022 by 3403#5 CIR."""
        if _given(builder.channel).CIR:
            return super().plan_arc_without_center(builder, plan)
        return path.plan_line(builder, plan)

    def rotation_adds(self, channel: Channel) -> bool:
        """5400#0 RIN: under G91 R of G68 is an increment."""
        return channel.mode["distance"] == "G91" and _given(channel).RIN

    def rotation_without_angle(self, channel: Channel) -> float:
        """5410."""
        return _given(channel).rotation_angle

    def keeps_point_at_rotation(self, channel: Channel) -> bool:
        """11600#5 AX1 = 0."""
        return not _given(channel).AX1

    def kinematics(self, channel: Channel) -> Kinematics:
        """With 19666, 19697 to 19714 and 19665#4, #5."""
        return mechanism.kinematics_of(channel, _given(channel))

    def rotary_ranges(self, channel: Channel) -> Mapping[str, tuple[float, float]]:
        """19741 to 19744: of the first rotary axis (it carries the other one, or is in the head), and of the second."""
        parameters, kinematics = _given(channel), self.kinematics(channel)
        names = [joint.axis for joint in (*kinematics.tool, *kinematics.work)]
        spans = (
            (parameters.first_rotary_low, parameters.first_rotary_high),
            (parameters.second_rotary_low, parameters.second_rotary_high),
        )
        return {name: span for name, span in zip(names, spans, strict=False) if any(span)}

    def plane_across(self, channel: Channel, tool: Vector) -> Frame:
        """G68.3 by 12321 and 12322."""
        return tool_plane.plane_across(channel, _given(channel), tool)

    def goes_with_fixture(self, channel: Channel) -> bool:
        """7570#0 FTP = 0."""
        return not _given(channel).FTP

    def turns_tool_with_work(self, channel: Channel) -> bool:
        """11200#0 RCM."""
        return _given(channel).RCM

    def measuring(self, channel: Channel, _words: Words) -> tuple[float, float, float]:
        """G37: way before the target at feed (6251), allowed difference (6254), feed (6241)."""
        of = _given(channel).of(channel.axes[channel.coordinates.geometry[2]])
        return of.measuring_deceleration, of.measuring_window, of.measuring_feed / 60.0

    def motion_settings(self, channel: Channel) -> MotionSettings:
        """1401#1 LRP: rapids on a line, else every axis by itself; 7001#0 MIT: manual intervention and return.

        19696#6 RFC: cuts of tip control that turn rotary axes alone run at 1422, or at F.
        1403#5 HTG: F of a helix counts the whole path, else the arc alone. G93 counts the radius of an arc (operator's
        manual B-62764EN, 5.4).
        """
        parameters = _given(channel)
        return replace(
            accelerated(super().motion_settings(channel), parameters, channel.axes),
            rapid_by_axis=not parameters.LRP,
            feed_along_arc=not parameters.HTG,
            inverse_time_by_radius=True,
            turn_speed=0.0 if parameters.RFC else (parameters.path_feed / 60.0 or UNBOUND),
            returns_to_path=parameters.MIT,
            dry_run=dry_run(parameters),
            slowest_rapid=parameters.rapid_f0 / 60.0,
            rapid_held=parameters.RF0,
        )

    def make_memory(self, channel: Channel) -> MacroMemory:
        """Offsets, tools and variables."""
        return MacroMemory(channel, _system_variables)
