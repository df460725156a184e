"""FANUC Series 0i-TF Plus lathe (control id `fanuc-0i-tf`)."""

from __future__ import annotations

from functools import cache

from polycnc.channel.stack import LevelKind
from polycnc.control.fanuc.acceleration import accelerated
from polycnc.control.fanuc.alarm_codes import ALARMS, HINTED_WORDS
from polycnc.control.fanuc.code_calls import registered_codes
from polycnc.control.fanuc.lathe import balance
from polycnc.control.fanuc.lathe.codes import (
    ADDRESSES,
    M_CODES,
    POWER_ON,
    WRITTEN,
    g_table,
    missing_codes,
    written_codes,
)
from polycnc.control.fanuc.lathe.coordinates import limits, systems
from polycnc.control.fanuc.lathe.cycles import drilling, modal, tapping
from polycnc.control.fanuc.lathe.memory import TurningMemory, has_diameter
from polycnc.control.fanuc.lathe.motion import threads
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.fanuc.lathe.rules import RULES
from polycnc.control.fanuc.lathe.tools import offsets
from polycnc.control.fanuc.operation import MODES_WITHOUT_JUMPS, dry_run, suppresses_reading
from polycnc.control.word_address.block.whole_numbers import DecimalPoint
from polycnc.control.word_address.macro_b import code_calls, interruption
from polycnc.control.word_address.macro_b.custom_macro import CustomMacroControl
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.states import PolarState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control.fanuc import tool_plane
    from polycnc.control.fanuc.lathe import auxiliary
    from polycnc.control.fanuc.lathe import reset as turning_reset
    from polycnc.control.fanuc.lathe.cycles import repetitive
    from polycnc.control.fanuc.lathe.motion import drawing
    from polycnc.control.fanuc.lathe.tools import nose_radius
    from polycnc.control.word_address.transformations import normal_line

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.compensation.policy import Policy
    from polycnc.control.data_files import DataFiles
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import (
        ContextStep,
        GCode,
        Handler,
        MCode,
        MRow,
        Planner,
        Step,
    )
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.block.single_block import Halts
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.control.word_address.macro_b.variables import Registry
    from polycnc.control.word_address.transformations.normal_line import NormalLineRules
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.language.bulk import Condition
    from polycnc.messages import AlarmError
    from polycnc.toolpath.motion_settings import MotionSettings


@cache
def _system_variables() -> Registry:
    from polycnc.control.fanuc.lathe.variables import TURNING_VARIABLES

    return TURNING_VARIABLES


class FanucTurning(CustomMacroControl):
    """FANUC 0i-TF Plus: G code systems A, B and C, diameters, turning cycles, tool offsets by T."""

    id: ClassVar[str] = "fanuc-0i-tf"
    alarm_files: ClassVar[tuple[str, ...]] = ("fanuc/alarms.toml",)
    default_machine: ClassVar[str] = "lathe2"
    m_codes: ClassVar[Mapping[int, MCode]] = M_CODES
    m_rows: ClassVar[tuple[MRow, ...]] = (
        drilling.clamp_row,
        code_calls.m_row,
        modal.silent_row,
        interruption.m_row,
    )
    context_steps: ClassVar[tuple[ContextStep, ...]] = (
        *CustomMacroControl.context_steps,
        threads.locked,
        drilling.in_cycle,
    )
    only_context: ClassVar[tuple[Handler, ...]] = (*CustomMacroControl.only_context, auxiliary.surface_speed)
    repeated_codes: ClassVar[Mapping[str, Condition]] = systems.REPEATED
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = {
        **ALARMS,
        "comp_skip": "PS0035",
        "comp_no_avoidance": "PS5446",
        "comp_avoidance_dangerous": "PS5447",
        "comp_avoidance_interferes": "PS5448",
    }
    parameter_files: ClassVar[tuple[str, ...]] = ("fanuc/parameters.toml", "fanuc/lathe/parameters.toml")
    parameter_class: ClassVar = LatheParameters
    EXTENDED_WORK_SYSTEMS: ClassVar[int] = 48
    MODES_WITHOUT_JUMPS: ClassVar[frozenset[str]] = MODES_WITHOUT_JUMPS
    DIAMETER_PROGRAMMING: ClassVar[bool] = True
    POINT_IN_WHOLE_NUMBERS: ClassVar[DecimalPoint] = DecimalPoint.REFUSED
    INCREMENTAL_ADDRESSES: ClassVar[Mapping[str, str]] = {"U": "X", "V": "Y", "W": "Z", "H": "C"}
    LATER_AXIS_WORD_COUNTS: ClassVar[bool] = True
    #: A motion code in the block of a tap cancels the tap, wherever it stands (II.4.5.1, "cancel").
    ENDED_ANYWHERE: ClassVar[frozenset[str]] = tapping.TAPS
    halts_behind: ClassVar[tuple[Halts, ...]] = (
        threads.not_between_threads,
        *CustomMacroControl.halts_behind,
    )
    rules: ClassVar[tuple[Rule, ...]] = RULES

    # ---- state -----------------------------------------------------------------------------------------------

    def system(self, channel: LatheChannel) -> str:
        """The G code system, A, B or C (3401#6 GSB, #7 GSC)."""
        parameters = channel.memory.parameters
        return "C" if parameters.GSC else "B" if parameters.GSB else "A"

    def g_table(self, channel: LatheChannel) -> Mapping[str, GCode]:
        """The G codes as programs of this channel write them."""
        parameters = channel.memory.parameters
        table = g_table(
            self.system(channel),
            circular_thread=parameters.G36,
            grinding=parameters.GFX,
            series_15=drilling.drills_in_series_15(channel),
            balance=balance.is_available(channel),
            gear=parameters.gear_axis > 0,
            missing=missing_codes(channel.memory.parameters),
        )
        return self.with_calls(channel, self.with_machine_codes(channel, table))

    @property
    def known_codes(self) -> frozenset[str]:
        """The codes of all systems, with those that a parameter takes away."""
        return WRITTEN

    def rotation_adds(self, channel: LatheChannel) -> bool:
        """5400#0 RIN: under G91 R of G68.1 is an increment; system A has no G91."""
        return channel.mode["distance"] == "G91" and channel.memory.parameters.RIN

    def code_calls(self, channel: LatheChannel) -> CodeCalls:
        """Codes registered by 6050 to 6089 and 6001#5."""
        return registered_codes(channel.memory.parameters)

    def written_code(self, channel: LatheChannel, group: str) -> str:
        """The active code of a modal group as the program writes it."""
        code = channel.mode[group]
        return written_codes(self.system(channel)).get((group, code), code)

    def parameters_changed(self, channel: LatheChannel) -> None:
        """Stroke limits and zone 3 are those of the parameters."""
        limits.renew_zones(channel)

    def hand_range(self, channel: LatheChannel, axis: int) -> tuple[float, float]:
        """Stored stroke check 1."""
        return limits.hand_range(channel, axis)

    def plane_across(self, channel: LatheChannel, tool: Vector) -> Frame:
        """G68.3 by 12321 and 12322."""
        return tool_plane.plane_across(channel, channel.memory.parameters, tool)

    def motion_settings(self, channel: LatheChannel) -> MotionSettings:
        """1401#1 LRP: rapids run on a line, else every axis by itself; what acts on a rigid tap (5203#4, 5200#6).

        1403#5 HTG: F of a helix counts the whole path, else the arc alone.

        7001#0 MIT: manual intervention and return. The main run asks this also in front of power-on.
        """
        parameters = LatheParameters.naming(channel.setup.parameters)
        return replace(
            accelerated(super().motion_settings(channel), parameters, channel.axes),
            rapid_by_axis=not parameters.LRP,
            feed_along_arc=not parameters.HTG,
            taps_overridden=parameters.OVS,
            taps_held=parameters.FHD,
            returns_to_path=parameters.MIT,
            dry_run=dry_run(parameters),
            slowest_rapid=parameters.rapid_f0 / 60.0,
            rapid_held=parameters.RF0,
        )

    def stays_at_end(self, channel: LatheChannel, code: int) -> bool:
        """3404#5 M02, 3404#4 M30: the program is not rewound to its top."""
        parameters = channel.memory.parameters
        return parameters.M30 if code == 30 else parameters.M02

    def make_memory(self, channel: LatheChannel) -> TurningMemory:
        """Offsets, tools and variables."""
        return TurningMemory(channel, _system_variables)

    @property
    def data_files(self) -> DataFiles:
        """Offsets and parameters as files."""
        from polycnc.control.fanuc.lathe.tools import files

        return files

    def start_position(self, channel: LatheChannel, shown: list[float]) -> list[float]:
        """X is shown in diameter, and what 1006#3 DIA says of other axes."""
        parameters = LatheParameters.naming(channel.setup.parameters)
        halved = (has_diameter(channel, parameters, i) for i in range(len(shown)))
        return [value / 2.0 if half else value for half, value in zip(halved, shown, strict=True)]

    def start(self, channel: LatheChannel) -> None:
        """Power-on state."""
        super().start(channel)
        limits.at_power_on(channel)
        systems.note_codes(channel)
        balance.start_paths(channel)

    def begin(self, channel: LatheChannel) -> None:
        """Cycle start: further paths start with the first one."""
        super().begin(channel)
        balance.start_paths(channel)

    def reset(self, channel: LatheChannel) -> None:
        """The state after reset, and after the end of a program."""
        turning_reset.reset(channel)

    def start_codes(self, channel: LatheChannel) -> dict[str, str]:
        """Code of every modal group at power-on (3402)."""
        parameters = channel.memory.parameters
        codes = dict(self.power_on)
        if parameters.start_g01:
            codes["motion"] = "G1"
        if parameters.start_g17:
            codes["plane"] = "G17"
        elif parameters.start_g19:
            codes["plane"] = "G19"
        if parameters.start_g91 and self.system(channel) != "A":
            codes["distance"] = "G91"
        if parameters.FPM:
            codes["feed"] = "G98"
        if parameters.start_g23:
            codes["stroke"] = "G23"
        if parameters.INI:
            codes["unit"] = "G20"
        return codes

    # ---- axes and numbers ------------------------------------------------------------------------------------

    def is_diameter(self, channel: LatheChannel, axis: int) -> bool:
        """Whether words of an axis are diameters (1006#3 DIA; delivered: X)."""
        polar = PolarState.of(channel).plane
        if polar is not None and axis == polar.linear and not channel.memory.parameters.PDI:
            return False
        return channel.memory.has_diameter(channel, axis)

    def feed_factor(self, builder: Builder, form: str, mode: FeedMode) -> float:
        """F without a point: also feeds per minute count 0.01 inch (II.4.5.1, "unit of F")."""
        if (
            form == ""
            and mode is FeedMode.PER_MINUTE
            and builder.inch
            and not self.number_rules(builder.channel).calculator
        ):
            return 0.01
        return super().feed_factor(builder, form, mode)

    def axis_of_address(
        self, channel: LatheChannel, address: str, builder: Builder
    ) -> tuple[int, bool] | None:
        """X/U, Z/W, Y/V, C/H in system A; G90/G91 in B and C."""
        if self.system(channel) != "A":
            index = channel.axis_index.get(address)
            return None if index is None else (index, builder.mode["distance"] == "G91")
        return super().axis_of_address(channel, address, builder)

    # ---- motion ----------------------------------------------------------------------------------------------

    def check_nesting(self, channel: LatheChannel, kind: LevelKind) -> None:
        """As everywhere; the shape that G70 runs calls no program at all (II.4.2.8)."""
        if channel.level.kind == LevelKind.SHAPE:
            raise self.fail("shape_command", address="P")
        super().check_nesting(channel, kind)

    def end_of_program(self, channel: LatheChannel) -> None:
        """The shape of G70 ends with its last block; every other text as usual."""
        if channel.level.kind == LevelKind.SHAPE:
            repetitive.end_of_shape(channel)
        else:
            super().end_of_program(channel)

    def center_may_be_start(self, channel: LatheChannel) -> bool:
        """Nose radius compensation has an alarm of its own for such an arc (II.5.2.5)."""
        return RadiusState.of(channel).side != 0

    def plan_arc_without_center(self, builder: Builder, plan: Plan) -> Step | None:
        """G02/G03 without R, I, K: a straight line; PS0022 by 3403#5 CIR."""
        if builder.channel.memory.parameters.CIR:
            raise self.fail("no_center", address=builder.mode["motion"])
        return path.plan_line(builder, plan)

    def untaken(self, address: str, builder: Builder) -> AlarmError:
        """The alarm for a word that nothing takes: drawing dimensions beside a code that allows none have their own."""
        if drawing.is_word(address) and drawing.is_on(builder):
            return self.fail("drawing_increment", address=address)
        return self.fail("address", address=address, word=address, hint=HINTED_WORDS.get(address, ""))

    # ---- drilling, spindle, M --------------------------------------------------------------------------------

    def drilling_rules(self, channel: LatheChannel) -> Drilling:
        """The drilling cycles of the chosen format."""
        return drilling.rules(channel)

    def packs_repeats(self, channel: LatheChannel) -> bool:
        """In the Series 15 format the last four digits of P count, and L has the repeats (II.6.2)."""
        return not drilling.is_series_15(channel)

    def spindle_slot(self, builder: Builder) -> int | None:
        """P beside S or M names the spindle (3703#3 MPP), where no code takes it; that of a builder's M is its own."""
        if not builder.has("P"):
            return None
        by_parameter = builder.channel.memory.parameters.MPP
        m_rows = [self.m_codes[number] for number in builder.m_codes if number in self.m_codes]
        names_spindle = builder.m_codes or by_parameter
        if any(
            ("P" in row.takes and not (row.code == "G96" and names_spindle)) or row.takes == "*"
            for row in builder.codes
        ):
            return None
        if any("P" in row.takes for row in m_rows) or not (m_rows or by_parameter or builder.has("S")):
            return None
        if builder.mode["cycle"] != "G80" or not (builder.m_codes or builder.has("S")):
            return None
        builder.take("P")
        return builder.slot("P")

    # ---- offsets ---------------------------------------------------------------------------------------------

    def radius_value(self, channel: LatheChannel, _number: int) -> float:
        """Nose radius of the active offset, mm."""
        return offsets.nose_radius(channel)

    def nose_tip(self, channel: LatheChannel) -> tuple[float, float]:
        """Way from the nose centre to the imaginary tip, in units of the radius."""
        return offsets.nose_tip(channel)

    def stops_reading(self, channel: LatheChannel, code: int) -> bool:
        """M codes that stop the program, and those of 3411 to 3432."""
        return super().stops_reading(channel, code) or suppresses_reading(channel.memory.parameters, code)

    def compensates_to_intermediate(self, channel: LatheChannel) -> bool:
        """5003#2 CCN: the vector vanishes behind the intermediate point of G28 and G30."""
        return channel.memory.parameters.CCN

    def normal_line_rules(self) -> NormalLineRules:
        """What G41.1 and G42.1 refuse."""
        return normal_line.NormalLineRules(preset="G50")

    def compensation_policy(self, channel: LatheChannel) -> Policy:
        """Rules of nose radius compensation by 5003, 5008, 5010, 19607, 19625."""
        return nose_radius.policy(channel)
