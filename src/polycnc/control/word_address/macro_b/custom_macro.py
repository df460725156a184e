"""What controls with custom macro B share: numbers, arcs, reference points, programs and calls."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.control.word_address.auxiliary import overrides
from polycnc.control.word_address.block import whole_numbers
from polycnc.control.word_address.block.numbers import NumberRules
from polycnc.control.word_address.control import WordAddressControl
from polycnc.control.word_address.macro_b import code_calls, single_block
from polycnc.control.word_address.macro_b.variables import locals_of
from polycnc.control.word_address.motion import path_modes
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.messages import AlarmError
from polycnc.program import ProgramFileError
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control.word_address.macro_b import interruption, macro_calls

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import ContextStep, GCode, Handler, MRow
    from polycnc.control.word_address.block.plain import PlainBlocks
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.single_block import Halts
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.control.word_address.macro_b.code_calls import CodeCalls
    from polycnc.control.word_address.parameters import MacroAxisParameters, MacroParameters
    from polycnc.geometry.arcs import Point
    from polycnc.program import Program

#: Letters of 1022: the basic axes X, Y, Z; their parallels count four more.
_BASIC_ROLES = {"X": 1, "Y": 2, "Z": 3}


class CustomMacroControl(WordAddressControl):
    """A word-address control with custom macro B.

    Attributes:
        FURTHER_REFERENCES: Reference points that G30 may name.
        EXTENDED_WORK_SYSTEMS: How many G54.1 P systems there are.
        CALL_LEVELS: Levels of macros, of subprograms, and together (FANUC macro B reference §5.1).
        MACRO_KINDS: Kinds of levels that count as macros.
        MODES_WITHOUT_JUMPS: Modes whose main program may hold no GOTO, WHILE and DO.
        PLANE_HELD_BY_ROTATION: Another plane within a rotation is refused where it is chosen.
        JOINING_HINT: What to do where AND, OR, XOR join conditions that may not be joined.
    """

    JOINING_HINT: ClassVar[str] = "hint.joined-conditions"
    m_rows: ClassVar[tuple[MRow, ...]] = (code_calls.m_row, code_calls.registered_row)
    halts_behind: ClassVar[tuple[Halts, ...]] = single_block.HALTS
    context_steps: ClassVar[tuple[ContextStep, ...]] = (overrides.overridden, path_modes.looks_ahead)
    acts: ClassVar[Mapping[str, Handler]] = {
        **WordAddressControl.acts,
        "feed_override_off": overrides.cancel_feed_override,
        "feed_override_on": overrides.allow_feed_override,
        "spindle_override_off": overrides.cancel_spindle_override,
        "spindle_override_on": overrides.allow_spindle_override,
    }
    FURTHER_REFERENCES: ClassVar[tuple[int, ...]] = (2, 3, 4)
    EXTENDED_WORK_SYSTEMS: ClassVar[int] = 300
    CALL_LEVELS: ClassVar[tuple[int, int, int]] = (5, 10, 15)
    MACRO_KINDS: ClassVar[frozenset[LevelKind]] = frozenset((
        LevelKind.MACRO, LevelKind.MODAL, LevelKind.G_MACRO, LevelKind.M_MACRO, LevelKind.EVERY_BLOCK,
    ))  # fmt: skip
    MODES_WITHOUT_JUMPS: ClassVar[frozenset[str]] = frozenset()
    PLANE_HELD_BY_ROTATION: ClassVar[bool] = False
    parameter_class: ClassVar[type[MacroParameters[MacroAxisParameters]]]

    # ---- numbers -------------------------------------------------------------------------------------

    def number_rules(self, channel: MacroChannel) -> NumberRules:
        """IS-B, or IS-A and IS-C by 1013#0 and #1; calculator input by 3401#0 DPI; ten increments by 1004#7 IPR."""
        parameters = channel.memory.parameters
        decimals = 2 if parameters.ISA else 4 if parameters.ISC else 3
        tenfold = parameters.IPR and not parameters.ISA
        return NumberRules(decimals, decimals + 1, calculator=parameters.DPI, tenfold=tenfold)

    def whole_numbers(self, _channel: Channel) -> frozenset[str]:
        """Addresses that take neither point nor sign (Hartford manual 2.4.1)."""
        return whole_numbers.ADDRESSES

    def feed_factor(self, _builder: Builder, form: str, mode: FeedMode) -> float:
        """F per minute counts whole units; per revolution, without a point, 0.01 mm or 0.0001 inch."""
        if (
            form == ""
            and mode is FeedMode.PER_REVOLUTION
            and not self.number_rules(_builder.channel).calculator
        ):
            return 0.0001 if _builder.inch else 0.01
        return 1.0

    def axis_role(self, channel: MacroChannel, axis: int) -> int:
        """1, 2, 3 for the basic axes, 5, 6, 7 for their parallels, 0 for others (1022)."""
        name = channel.axes[axis]
        given = channel.memory.parameters.of(name).basic_axis
        parallel = _BASIC_ROLES.get(channel.axis_data[axis].parallel_to, -4) + 4
        return _BASIC_ROLES.get(name, parallel) if given is None else given

    def forbidden_zone(self, axis: str, direction: int, number: int = 2) -> AlarmError:
        """The alarm for a way into the zone of G22 (stored stroke check 2), of check 3, or into a barrier."""
        zone = "zone" if number == 2 else f"zone_{number}"
        return self.fail(f"{zone}_plus" if direction > 0 else f"{zone}_minus", address=axis, axis=axis)

    def macro_alarm(self, channel: MacroChannel, number: int, told: str) -> AlarmError:
        """The alarm of #3000 = n (TEXT): 3000 + n up to 200, or n itself up to 4095 by 6008#1 MCA."""
        first, highest = (0, 4095) if channel.memory.parameters.MCA else (3000, 200)
        if not 0 <= number <= highest:
            return self.fail("variable_number")
        number += first
        return AlarmError(f"MC{number:04d}", detail=told or f"MC{number:04d}")

    # ---- motion --------------------------------------------------------------------------------------

    def arc_tolerance(self, channel: MacroChannel) -> float:
        """Allowed difference between the radii at start and end, mm."""
        return channel.memory.parameters.arc_tolerance

    def check_arc(self, channel: Channel, start: Point, end: Point, center: Point) -> None:
        """Alarm for an end point off the circle; none where the limit is 0."""
        if self.arc_tolerance(channel) > 0.0:
            super().check_arc(channel, start, end, center)

    def reference_point(self, channel: MacroChannel, axis: int, number: int) -> float:
        """Machine position of a reference point of an axis; its parameter is as the displays show it."""
        shown = channel.memory.parameters.of(channel.axes[axis]).reference_points[number - 1]
        if shown is None:
            return super().reference_point(channel, axis, number)
        return self.from_display(channel, axis, shown)

    def plain_blocks(self, channel: Channel) -> PlainBlocks | None:
        """What a scanner must know of plain blocks, formulas of variables among them."""
        from polycnc.control.word_address.macro_b.plain import MacroPlainBlocks  # for long programs only

        plain = super().plain_blocks(channel)
        return (
            None if plain is None else MacroPlainBlocks(replace(plain.spelling, formulas=True, m_codes=True))
        )

    # ---- programs ------------------------------------------------------------------------------------

    def find_program(self, channel: Channel, number: int | str) -> Program:
        """A program by its number, or by a name; the alarm where it is missing or cannot be read."""
        store = channel.store
        try:
            program = store.find_name(number) if isinstance(number, str) else store.find_number(number)
        except ProgramFileError as error:
            raise self.fail("no_program", address="P", number=number, detail=str(error)) from error
        if program is None:
            raise self.fail("no_program", address="P", number=number)
        return program

    def long_program_numbers(self, channel: MacroChannel) -> bool:
        """Eight-digit program numbers (11304#3 ON8)."""
        return channel.memory.parameters.ON8

    def check_nesting(self, channel: Channel, kind: LevelKind) -> None:
        """Alarm for one level of calls too many."""
        macros = 0
        for level in channel.stack:
            macros += level.kind in self.MACRO_KINDS
        others = len(channel.stack) - 1 - macros
        most_macros, most_others, most = self.CALL_LEVELS
        if kind in self.MACRO_KINDS and macros >= most_macros:
            raise self.fail("nesting_macro")
        if (kind not in self.MACRO_KINDS and others >= most_others) or macros + others >= most:
            raise self.fail("nesting_sub")

    def end_of_program(self, channel: Channel) -> None:
        """The text ends without M02, M30 or M99: an alarm, or a reset by 3404#6 EOR.

        What is typed in needs no end, nor does a text in which nothing stands.
        """
        level = channel.level
        is_typed_in = channel.setup.switches.mode == "mdi" and len(channel.stack) == 1
        if (
            level.kind is LevelKind.TYPED_IN
            or is_typed_in
            or not any(line.strip(" %") for line in level.code.lines)
        ):
            channel.pop()
        elif channel.memory.parameters.EOR:
            channel.end()
        else:
            raise self.fail("end_of_record")

    def leave(self, channel: Channel, *, jumps: bool = False) -> None:
        """End of a subprogram or macro: the caller's local variables return; `jumps` for M99 P."""
        ended = channel.pop()
        channel.memory.locals = locals_of(channel.level)
        if ended.kind.code_letter:
            macro_calls.note_level(channel)
        if ended.kind is LevelKind.INTERRUPT:
            interruption.finish(channel, jumps=jumps)

    def start(self, channel: Channel) -> None:
        """Power-on state; the main program has local variables of its own."""
        super().start(channel)
        self.begin(channel)

    def begin(self, channel: Channel) -> None:
        """A main program begins: it has the local variables; in some modes no jumps and loops may stand in it."""
        channel.level.locals = channel.memory.locals
        channel.level.code.may_jump = channel.setup.switches.mode not in self.MODES_WITHOUT_JUMPS

    # ---- calls ---------------------------------------------------------------------------------------

    def code_calls(self, _channel: Channel) -> CodeCalls:
        """The G, M and T codes that parameters let call programs."""
        return code_calls.CodeCalls()

    def called_codes(self, channel: Channel) -> CodeCalls:
        """The codes that call programs: by parameters, and under them by the machine file."""
        return self.code_calls(channel).over(code_calls.of_machine(channel.machine))

    def g_table(self, channel: Channel) -> Mapping[str, GCode]:
        """The G table with the codes that call programs here."""
        return self.with_calls(channel, super().g_table(channel))

    def with_calls(self, channel: Channel, table: Mapping[str, GCode]) -> Mapping[str, GCode]:
        """A G table with the codes that call programs here."""
        calls = self.called_codes(channel)
        if not calls.g or "G" not in channel.mode.codes.get("calls", ""):
            return table
        return {**table, **calls.g_rows()}
