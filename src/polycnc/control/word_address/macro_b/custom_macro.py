"""What controls with custom macro B share: numbers, arcs, reference points, programs and calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from polycnc.channel.stack import LevelKind
from polycnc.control.word_address.auxiliary import overrides
from polycnc.control.word_address.block.numbers import NumberRules
from polycnc.control.word_address.control import WordAddressControl
from polycnc.control.word_address.macro_b import code_calls, interruption, macro_calls
from polycnc.control.word_address.macro_b.variables import locals_of
from polycnc.control.word_address.transformations.normal_line import NormalLineParameters
from polycnc.language.word_address.executable import SkippedBlock
from polycnc.messages import AlarmError
from polycnc.program import ProgramFileError
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step as ProgramStep
    from polycnc.control.word_address.block.codes import GCode, MCode
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.geometry.arcs import Point
    from polycnc.language.word_address import WordAddressProgram
    from polycnc.program import Program
    from polycnc.toolpath import Context

_MACRO_KINDS = (
    LevelKind.MACRO,
    LevelKind.MODAL,
    LevelKind.G_MACRO,
    LevelKind.M_MACRO,
    LevelKind.EVERY_BLOCK,
)
#: Levels of macros, of subprograms, and together (FANUC macro B reference §5.1).
MACRO_LEVELS, SUBPROGRAM_LEVELS, LEVELS = 5, 10, 15
#: Letters of 1022: the basic axes X, Y, Z; their parallels count four more.
_BASIC_ROLES = {"X": 1, "Y": 2, "Z": 3}


class CustomMacroControl(WordAddressControl):
    """A word-address control with custom macro B.

    Attributes:
        FURTHER_REFERENCES: Reference points that G30 may name.
        EXTENDED_WORK_SYSTEMS: How many G54.1 P systems there are.
        REFERENCE_PARAMETERS: Parameter that holds each reference point.
        ARC_TOLERANCE_PARAMETER: Parameter with the allowed difference of radii, and its delivered value (mm).
        NORMAL_LINE_PARAMETERS: Parameters of G41.1 and G42.1.
    """

    FURTHER_REFERENCES: ClassVar[tuple[int, ...]] = (2, 3, 4)
    EXTENDED_WORK_SYSTEMS: ClassVar[int] = 300
    REFERENCE_PARAMETERS: ClassVar[dict[int, int]] = {1: 1240, 2: 1241, 3: 1242, 4: 1243}
    ARC_TOLERANCE_PARAMETER: ClassVar[tuple[int, float]] = (3410, 0.03)
    NORMAL_LINE_PARAMETERS: ClassVar[NormalLineParameters] = NormalLineParameters(5480, 5481, 5482, 5483)

    # ---- numbers -------------------------------------------------------------------------------------

    def number_rules(self, channel: Channel) -> NumberRules:
        """IS-B, or IS-A and IS-C by 1013#0 and #1; calculator input by 3401#0."""
        bit = channel.setup.parameters.bit
        decimals = 2 if bit(1013, 0) else 4 if bit(1013, 1) else 3
        return NumberRules(decimals, decimals + 1, calculator=bool(bit(3401, 0)))

    def feed_factor(self, _builder: Builder, form: str, mode: FeedMode) -> float:
        """F per minute counts whole units; per revolution, without a point, 0.01 mm or 0.0001 inch."""
        if (
            form == ""
            and mode is FeedMode.PER_REVOLUTION
            and not self.number_rules(_builder.channel).calculator
        ):
            return 0.0001 if _builder.inch else 0.01
        return 1.0

    def axis_role(self, channel: Channel, axis: int) -> int:
        """1, 2, 3 for the basic axes, 5, 6, 7 for their parallels, 0 for others (1022)."""
        name = channel.axes[axis]
        parallel = _BASIC_ROLES.get(channel.axis_data[axis].parallel_to, -4) + 4
        delivered = _BASIC_ROLES.get(name, parallel)
        return int(channel.setup.parameters.number(1022, name, delivered))

    def forbidden_zone(self, axis: str, direction: int, number: int = 2) -> AlarmError:
        """The alarm for a way into the zone of G22 (stored stroke check 2), of check 3, or into a barrier."""
        zone = "zone" if number == 2 else f"zone_{number}"
        return self.fail(f"{zone}_plus" if direction > 0 else f"{zone}_minus", address=axis, axis=axis)

    def macro_alarm(self, channel: Channel, number: int, told: str) -> AlarmError:
        """The alarm of #3000 = n (TEXT): 3000 + n, or n itself by 6008#6."""
        if not channel.setup.parameters.bit(6008, 6):
            if not 0 <= number <= 200:
                return self.fail("variable_number")
            number += 3000
        return AlarmError(f"MC{number:04d}", detail=told or f"MC{number:04d}")

    # ---- motion --------------------------------------------------------------------------------------

    def arc_tolerance(self, channel: Channel) -> float:
        """Allowed difference between the radii at start and end, mm."""
        number, delivered = self.ARC_TOLERANCE_PARAMETER
        return channel.setup.parameters.number(number, default=delivered)

    def check_arc(self, channel: Channel, start: Point, end: Point, center: Point) -> None:
        """Alarm for an end point off the circle; none where the limit is 0."""
        if self.arc_tolerance(channel) > 0.0:
            super().check_arc(channel, start, end, center)

    def reference_point(self, channel: Channel, axis: int, number: int) -> float:
        """Machine position of a reference point of an axis."""
        name = channel.axes[axis]
        delivered = channel.axis_data[axis].reference_points[number - 1]
        return channel.setup.parameters.number(self.REFERENCE_PARAMETERS[number], name, delivered)

    # ---- programs ------------------------------------------------------------------------------------

    def find_program(self, channel: Channel, number: int) -> Program:
        """A program by its number; the alarm where it is missing or cannot be read."""
        try:
            program = channel.store.find_number(number)
        except ProgramFileError as error:
            raise self.fail("no_program", address="P", number=number, detail=str(error)) from error
        if program is None:
            raise self.fail("no_program", address="P", number=number)
        return program

    def long_program_numbers(self, channel: Channel) -> bool:
        """Eight-digit program numbers (11304#3)."""
        return bool(channel.setup.parameters.bit(11304, 3))

    def check_nesting(self, channel: Channel, kind: LevelKind) -> None:
        """Alarm for one level of calls too many."""
        macros = sum(1 for level in channel.stack if level.kind in _MACRO_KINDS)
        others = len(channel.stack) - 1 - macros
        if kind in _MACRO_KINDS and macros >= MACRO_LEVELS:
            raise self.fail("nesting_macro")
        if (kind not in _MACRO_KINDS and others >= SUBPROGRAM_LEVELS) or macros + others >= LEVELS:
            raise self.fail("nesting_sub")

    def leave(self, channel: Channel, *, jumps: bool = False) -> None:
        """End of a subprogram or macro: the caller's local variables return; `jumps` for M99 P."""
        ended = channel.pop()
        channel.memory.locals = locals_of(channel.level)
        macro_calls.note_level(channel)
        if ended.kind is LevelKind.INTERRUPT:
            interruption.finish(channel, jumps=jumps)

    def start(self, channel: Channel) -> None:
        """Power-on state; the main program has local variables of its own."""
        super().start(channel)
        self.begin(channel)

    def begin(self, channel: Channel) -> None:
        """A main program begins: it has the local variables."""
        channel.level.locals = channel.memory.locals

    def halts(self, channel: Channel, level: Level[WordAddressProgram], step: ProgramStep) -> bool:
        """Single block halts behind blocks of words, and with 6000#5 behind macro statements; never under #3003 bit 0.

        Calls and returns do not count, and no block that block skip leaves out; the program end does.
        """
        if isinstance(step, SkippedBlock) and step.is_left_out(channel):
            return False
        memory = channel.memory
        if memory.control_switches.get("cntl1", 0) & 1 and not memory.parameters.bit(6000, 7):
            return False
        if channel.level is not level:
            return False
        if not level.counts(level.current):
            return bool(memory.parameters.bit(6000, 5) or memory.parameters.bit(6000, 7))
        return level.code.has_words(level.current)

    def context(self, channel: Channel) -> Context:
        """The context that holds now, with what the operator's switches may do."""
        return overrides.overridden(channel, super().context(channel))

    # ---- calls ---------------------------------------------------------------------------------------

    def code_calls(self, _channel: Channel) -> CodeCalls:
        """The G, M and T codes that call programs."""
        return code_calls.CodeCalls()

    def g_table(self, channel: Channel) -> Mapping[str, GCode]:
        """The G table with the codes that call programs here."""
        return self.with_calls(channel, super().g_table(channel))

    def with_calls(self, channel: Channel, table: Mapping[str, GCode]) -> Mapping[str, GCode]:
        """A G table with the codes that call programs here."""
        calls = self.code_calls(channel)
        if not calls.g or "G" not in channel.mode.codes.get("calls", ""):
            return table
        return {**table, **calls.g_rows()}

    def m_row(self, builder: Builder, number: int) -> MCode:
        """The row of an M code, or of the subprogram that it calls."""
        return code_calls.m_row(builder, number) or super().m_row(builder, number)
