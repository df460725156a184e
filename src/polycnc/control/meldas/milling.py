"""MELDAS control of a machining centre (control id `meldas-m`)."""

from __future__ import annotations

from functools import cache

from polycnc.control.fanuc.milling.codes import ADDRESSES, POWER_ON
from polycnc.control.meldas.alarm_codes import ALARMS
from polycnc.control.meldas.code_calls import registered_codes
from polycnc.control.meldas.cycles import DRILLING
from polycnc.control.meldas.milling_codes import G_CODES, M_CODES
from polycnc.control.meldas.parameters import MeldasParameters
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.block.whole_numbers import DecimalPoint
from polycnc.control.word_address.coordinates import frames
from polycnc.control.word_address.machining_centre import MillingControl, hartford
from polycnc.control.word_address.macro_b.variables import MacroMemory
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.toolpath.motion_settings import Ramp

with loaded_when_called():
    from polycnc.control.meldas import tool_axis_length
    from polycnc.control.word_address.tools import length

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.compensation.policy import Policy
    from polycnc.control.word_address.block.codes import GCode, MCode, Planner
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.control.word_address.macro_b.variables import Registry
    from polycnc.messages import AlarmError
    from polycnc.toolpath.motion_settings import MotionSettings


@cache
def _system_variables() -> Registry:
    from polycnc.control.fanuc.milling.variables import MILLING_VARIABLES

    return MILLING_VARIABLES


class MeldasMilling(MillingControl):
    """MELDAS M64, M70, M500, M720 class."""

    id: ClassVar[str] = "meldas-m"
    alarm_files: ClassVar[tuple[str, ...]] = (
        "fanuc/alarms.toml",
        "meldas/alarms.toml",
    )
    g_codes: ClassVar[Mapping[str, GCode]] = G_CODES
    m_codes: ClassVar[Mapping[int, MCode]] = M_CODES
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = ALARMS
    drilling: ClassVar[Drilling] = DRILLING
    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "length along the tool",
            modes={"length": ("G43.1",)},
            check=tool_axis_length.check_company,
            motion=tool_axis_length.plan_turning,
            after=tool_axis_length.turn_behind,
        ),
        *MillingControl.rules,
    )
    SCALES_NAMED_AXES: ClassVar[bool] = True
    PLANE_HELD_BY_ROTATION: ClassVar[bool] = True
    JOINING_HINT: ClassVar[str] = "hint.single-conditions"
    #: M700 programming manual: DO1 to DO127, 27 deep; four levels of macros, eight of subprograms.
    LOOPS: ClassVar[tuple[int, int]] = (127, 27)
    CALL_LEVELS: ClassVar[tuple[int, int, int]] = (4, 8, 12)
    POINT_IN_WHOLE_NUMBERS: ClassVar[DecimalPoint] = DecimalPoint.CUT
    parameter_files: ClassVar[tuple[str, ...]] = ("meldas/parameters.toml",)
    parameter_class: ClassVar = MeldasParameters

    def macro_alarm(self, _channel: Channel, number: int, told: str) -> AlarmError:
        """#3000 = n (TEXT): P277 with the number and the text."""
        return self.fail("macro_alarm", detail=f"{number} {told}".strip())

    def leave_length(self, channel: Channel, axes: list[int], *, to_reference: bool) -> None:
        """G28 and G30 of the axis end the length as G49 does; G53 keeps it (M700 programming manual, tool length)."""
        if to_reference:
            length.end_length(channel, axes)

    def reached_reference(self, channel: Channel) -> None:
        """G27, G28 and G30 end the scaling (M700 programming manual, 13.20)."""
        frames.end_scale(channel)
        channel.mode = channel.mode.with_code("scaling", "G50")

    def compensation_policy(self, _channel: Channel) -> Policy:
        """Five blocks are read, so three without motion may stand between two moves; the start-up block reads three.

        So the manual of the machine prints it for both of its controls (3.3.1 D).
        """
        return replace(hartford(), read_blocks=5, start_blocks=3)

    def motion_settings(self, channel: Channel) -> MotionSettings:
        """#1086 G0Intp = 0: rapids run on a line; delivered, every axis by itself.

        #2001 rapid and #2002 clamp bound the speeds of axes.

        #1206 G1bF, reached within #1207 G1btL, is the acceleration of cuts that are planned ahead (general knowledge).
        #2004 G0tL and #2007 G1tL: time constants of rapids and of cuts that are not planned ahead, milliseconds.
        """
        given = MeldasParameters.naming(channel.setup.parameters)
        feed, time = given.ahead_feed, given.ahead_time
        ahead = Ramp(acceleration=feed / 60.0 / (time / 1000.0)) if feed > 0.0 and time > 0.0 else None
        axes = [(name, given.of(name)) for name in channel.axes]
        return replace(
            super().motion_settings(channel),
            rapid_by_axis=given.rapids_by_axis != 0,
            inverse_time_by_radius=True,
            returns_to_path=False,
            rapid_caps={name: of.rapid_speed / 60.0 for name, of in axes if of.rapid_speed > 0.0},
            feed_caps={name: of.cutting_speed / 60.0 for name, of in axes if of.cutting_speed > 0.0},
            rapid_ramps={
                name: Ramp(of.rapid_time / 1000.0) for name, of in axes if of.rapid_time is not None
            },
            cut_ramps={} if ahead is None else dict.fromkeys(channel.axes, ahead),
            after_interpolation=True,
            after_times={name: of.cutting_time / 1000.0 for name, of in axes if of.cutting_time is not None},
        )

    def rotation_adds(self, channel: Channel) -> bool:
        """Under G91 R of G68 is an increment."""
        return channel.mode["distance"] == "G91"

    def rotation_without_angle(self, channel: Channel) -> float:
        """#8081 Gcode Rotat."""
        return MeldasParameters.naming(channel.setup.parameters).rotation_angle

    def code_calls(self, channel: Channel) -> CodeCalls:
        """Codes registered by #7001 to #7303."""
        return registered_codes(MeldasParameters.naming(channel.setup.parameters))

    def measuring(self, channel: Channel, words: Words) -> tuple[float, float, float]:
        """G37: R way before the target at feed, D allowed difference, F feed."""
        return words.length("R") or 0.0, words.length("D") or 0.0, channel.feed

    def make_memory(self, channel: Channel) -> MacroMemory:
        """Offsets, tools and variables."""
        return MacroMemory(channel, _system_variables)
