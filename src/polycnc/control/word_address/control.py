"""The base of all word-address controls: how blocks become plans, and what a family may state differently."""

from __future__ import annotations

from functools import cached_property
from math import inf

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.unchanging import unchanging
from polycnc.control.word_address.auxiliary import interlocks, machine_codes
from polycnc.control.word_address.block.numbers import Convert, NumberRules, angle_converter, length_converter
from polycnc.control.word_address.block.plan import Builder, Plan
from polycnc.control.word_address.block.single_block import Halts, behind_words
from polycnc.control.word_address.block.whole_numbers import DecimalPoint
from polycnc.control.word_address.coordinates import frames, systems
from polycnc.control.word_address.coordinates.systems import ZeroState
from polycnc.control.word_address.cycles import drilling as drilling_cycles
from polycnc.control.word_address.cycles.drilling import Drilling
from polycnc.control.word_address.memory import Memory, ParameterTable
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.path_modes import BELL_SHAPED, corner_mode
from polycnc.control.word_address.states import CylinderState, PlaneAxes, PolarState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar
from polycnc.geometry.arcs import radius_mismatch
from polycnc.language.bulk import Spelling
from polycnc.language.word_address import Grammar, WordAddressProgram
from polycnc.messages import AlarmError, Catalogue, text
from polycnc.program import Form
from polycnc.toolpath import Context
from polycnc.toolpath.modes import FeedMode
from polycnc.toolpath.motion_settings import MotionSettings

with loaded_when_called():
    from polycnc.compensation import corner, policy
    from polycnc.control import alarm_text
    from polycnc.control.word_address import reset
    from polycnc.control.word_address.block import plain
    from polycnc.control.word_address.transformations import normal_line
    from polycnc.machine import kinematics
    from polycnc.transformation.planes import tilted

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.channel.mode import Mode
    from polycnc.channel.stack import Executable, Level
    from polycnc.channel.steps import Step as ProgramStep
    from polycnc.compensation.corner import CornerPolicy
    from polycnc.compensation.policy import Policy
    from polycnc.control.interface import HandMotion
    from polycnc.control.parameters import AxisParameters, ControlParameters
    from polycnc.control.word_address.block.codes import (
        ContextStep,
        GCode,
        Handler,
        MCode,
        MRow,
        Planner,
        Step,
    )
    from polycnc.control.word_address.block.plain import PlainBlocks
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.memory import ToolOffset
    from polycnc.control.word_address.transformations.normal_line import NormalLineRules
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.language.bulk import Condition
    from polycnc.machine.kinematics import Kinematics
    from polycnc.program import Program


@unchanging
class WordAddressControl:
    """A word-address control. A family states its tables as class attributes and overrides what differs.

    Attributes:
        id: Control id.
        alarm_series, display_names: As `Control` says.
        alarm_files: Files with the alarm texts, as `folder/file`; of two texts for a number the later counts.
        form: How program files are marked off.
        default_machine: Built-in machine of a run that names none.
        tools_have_names: Programs may call a tool by its name.
        last_bit: The last bit of a parameter.
        g_codes: The G table.
        m_codes: The M table; a number that is not in it passes as an event.
        addresses: What words beside axis words and code arguments do (F, S, T, H, D …).
        power_on: Code of every modal group at power-on.
        alarms: Names of mistakes to alarm codes.
        only_context: Handlers that do no more than change the context.
        repeated_codes: When codes that are in force already change nothing; see `block/repeated_codes.py`.
        foreign_codes: Codes that the control writes otherwise, to message ids of hints.
        acts: What M functions of a machine file can do in the control.
        parameter_files: The list of its parameters, as `folder/file`; of two entries for a number the later counts.
        parameter_class: The parameters as attributes, by the module that is written from the list.
        drilling: The drilling cycles.
        m_rows: What gives M codes of a block another row than `m_codes`; the first that has one decides.
        context_steps: What features change in a context, each what those in front of it have left.
        rules: What acts on blocks beside their codes and words, in the order in which it acts; see `block/rules.py`.
        halts_behind: Behind which blocks single block halts; the first rule that knows decides.
        builder: What works out plans.
        FEED_AT_START: Feed that holds before any F (mm/s), or None for the alarm of a missing feed.
        DIAMETER_PROGRAMMING: Axes marked as transverse are programmed in diameters.
        SCALE_CENTER_IS_ABSOLUTE: The centre of G51 is an absolute point under G91 too.
        SCALES_NAMED_AXES: G51 scales those axes alone of which it names the centre, and arcs need both of their plane.
        CURVE_BEGINS_AT_TOOL: The first pole of a G06.2 curve must be where the tool stands.
        INCREMENTAL_ADDRESSES: Addresses that are increments of an axis whatever the mode (U is X …).
        LENGTH_TRAVELS_ALONE: G43 H without a Z word moves Z by the offset at once.
        LATER_AXIS_WORD_COUNTS: Of an absolute and an incremental word of one axis the later one counts alone.
        ENDED_ANYWHERE: Codes that a code of their block ends wherever it stands there; others only behind them.
        LOOPS: The largest number of a loop (DO m), and how deep loops nest.
        POINT_IN_WHOLE_NUMBERS: What a decimal point does where none belongs.
    """

    id: ClassVar[str] = ""
    alarm_series: ClassVar[Mapping[str, str] | None] = None
    alarm_files: ClassVar[tuple[str, ...]] = ()
    g_codes: ClassVar[Mapping[str, GCode]] = {}
    m_codes: ClassVar[Mapping[int, MCode]] = {}
    m_rows: ClassVar[tuple[MRow, ...]] = ()
    context_steps: ClassVar[tuple[ContextStep, ...]] = ()
    addresses: ClassVar[Mapping[str, Planner]] = {}
    power_on: ClassVar[Mapping[str, str]] = {}
    alarms: ClassVar[Mapping[str, str]] = {}
    only_context: ClassVar[tuple[Handler, ...]] = (systems.note_context,)
    repeated_codes: ClassVar[Mapping[str, Condition]] = {}
    foreign_codes: ClassVar[Mapping[str, str]] = {}
    acts: ClassVar[Mapping[str, Handler]] = machine_codes.ACTS
    parameter_files: ClassVar[tuple[str, ...]] = ()
    parameter_class: ClassVar[type[ControlParameters[AxisParameters]] | None] = None
    drilling: ClassVar[Drilling] = Drilling({})
    rules: ClassVar[tuple[Rule, ...]] = (drilling_cycles.RULE,)
    halts_behind: ClassVar[tuple[Halts, ...]] = (behind_words,)
    builder: ClassVar[type[Builder]] = Builder
    FEED_AT_START: ClassVar[float | None] = None
    DIAMETER_PROGRAMMING: ClassVar[bool] = False
    SCALE_CENTER_IS_ABSOLUTE: ClassVar[bool] = False
    SCALES_NAMED_AXES: ClassVar[bool] = False
    CURVE_BEGINS_AT_TOOL: ClassVar[bool] = False
    INCREMENTAL_ADDRESSES: ClassVar[Mapping[str, str]] = {}
    LENGTH_TRAVELS_ALONE: ClassVar[bool] = True
    LATER_AXIS_WORD_COUNTS: ClassVar[bool] = False
    INCH_CODE: ClassVar[str] = "G20"
    #: Modal groups that a reset leaves as they are.
    KEPT_AT_RESET: ClassVar[frozenset[str]] = frozenset({"stroke"})
    ENDED_ANYWHERE: ClassVar[frozenset[str]] = frozenset()
    LOOPS: ClassVar[tuple[int, int]] = (3, 3)
    POINT_IN_WHOLE_NUMBERS: ClassVar[DecimalPoint] = DecimalPoint.READ_OVER
    form: ClassVar[Form] = Form.WORD_ADDRESS
    default_machine: ClassVar[str] = "mill3"
    tools_have_names: ClassVar[bool] = False
    display_names: ClassVar[tuple[str, ...]] = ()
    last_bit: ClassVar[int] = 7
    mdi_intervenes: ClassVar[bool] = True
    presets_by_hand: ClassVar[bool] = False

    # ---- texts and alarms ---------------------------------------------------------------------------------------

    @cached_property
    def catalogue(self) -> Catalogue:
        """Texts of the control's alarms."""
        return alarm_text.alarm_catalogue(*self.alarm_files)

    def fail(self, mistake: str, **where: Any) -> AlarmError:
        """The control's alarm for a named mistake; its text names the word or the code where that is told."""
        address = where.get("address", "")
        return AlarmError(self.alarms[mistake], **{"word": address, "code": address, **where})

    @property
    def known_codes(self) -> frozenset[str]:
        """The codes that the control has in any case, though a program may not write them so now."""
        return frozenset(self.g_codes)

    def unknown_code(self, code: str) -> AlarmError:
        """The alarm for a G code that is in no table; with a hint on how it is written, or how it is declared."""
        told = machine_codes.undeclared(code) if code not in self.known_codes else {"hint": ""}
        hint = self.foreign_codes.get(code, told["hint"])
        return self.fail("improper_g", address=code, **{**told, "hint": hint})

    def over_travel(self, axis: str, direction: int) -> AlarmError:
        """The alarm for a target beyond a limit."""
        return self.fail(
            "over_travel_plus" if direction > 0 else "over_travel_minus", address=axis, axis=axis
        )

    def forbidden_zone(self, axis: str, direction: int, _number: int = 2) -> AlarmError:
        """The alarm for a way into a zone that the program has forbidden."""
        return self.over_travel(axis, direction)

    def block_limit(self) -> AlarmError:
        """The alarm for a program that does not end."""
        return AlarmError("PC0002", hint="hint.block-limit")

    def arithmetic_alarm(self, error: ArithmeticError) -> AlarmError:
        """The alarm for a division by zero or an overflow in an expression."""
        return self.fail("zero_divide" if isinstance(error, ZeroDivisionError) else "overflow")

    def halts(self, channel: Channel, level: Level, step: ProgramStep) -> bool:
        """Whether single block halts behind the block that `step` of `level` was."""
        found = (rule(channel, level, step) for rule in self.halts_behind)
        return bool(next((halts for halts in found if halts is not None), False))

    def untaken(self, address: str, _builder: Builder) -> AlarmError:
        """The alarm for a word that nothing in its block takes."""
        return self.fail("address", address=address, word=address)

    # ---- programs -----------------------------------------------------------------------------------------------

    @cached_property
    def grammar(self) -> Grammar:
        """How programs are written."""
        last, deepest = self.LOOPS
        reads_over = self.POINT_IN_WHOLE_NUMBERS is not DecimalPoint.REFUSED
        return Grammar(self.alarms, point_in_numbers=reads_over, last_loop=last, deepest_loop=deepest)

    def compile(self, program: Program) -> Executable:
        """Make a program ready to run."""
        return WordAddressProgram(program, self.grammar)

    def plain_blocks(self, _channel: Channel) -> PlainBlocks | None:
        """What a scanner must know of plain blocks."""
        return plain.PlainBlocks(Spelling(self.grammar.max_digits, round_comments=True, open_comments=True))

    def make_memory(self, channel: Channel) -> Memory:
        """The control's memory as the setup fills it."""
        return Memory(channel)

    def start_position(self, _channel: Channel, shown: list[float]) -> list[float]:
        """Displays show positions as they are."""
        return shown

    def start(self, channel: Channel) -> None:
        """Power-on state."""
        self.name_parameters(channel)
        ParameterTable.of(channel).put_into(channel)
        channel.memory = self.make_memory(channel)
        channel.mode = channel.modes.mode(self.start_codes(channel))
        channel.boundary = None
        channel.skip_levels = channel.setup.switches.block_skip_mask(plain=1)
        tool = channel.memory.tool
        tool.number = tool.next = int(channel.setup.tool_at_start(channel.number))
        if self.FEED_AT_START is not None:
            channel.feed = self.FEED_AT_START
        systems.refresh_zero(channel)
        self.parameters_changed(channel)
        for name, value in channel.setup.variables.items():
            if channel.memory.is_kept(name):
                continue
            try:
                self.write_variable(channel, name, value)
            except (KeyError, ValueError):
                raise self.fail("variable_number", detail=text("setup.no-variable", name=name)) from None

    def name_parameters(self, channel: Channel) -> None:
        """Let parameters of the setup be attributes by their names, where the control has a list of them."""
        if self.parameter_class is not None:
            named = self.parameter_class.naming(channel.setup.parameters)
            channel.setup = replace(channel.setup, parameters=named)

    def begin(self, channel: Channel) -> None:
        """A main program begins in the state that the channel is in."""

    def reset(self, channel: Channel) -> None:
        """The state after reset, and after the end of a program."""
        reset.reset(channel)

    def give_up(self, channel: Channel, modal: Mapping[str, str], context: Context) -> None:
        """A reset in the midst of a program: blocks that were only prepared have changed no state that stays."""
        memory = channel.memory
        channel.mode = channel.modes.mode(modal)
        ZeroState.of(channel).system, memory.spindle.speed = context.wcs, context.spindle_rpm
        memory.spindle.direction = context.spindle_direction
        self.reset(channel)
        memory.forget_commons()

    def stays_at_end(self, channel: Channel, code: int) -> bool:  # noqa: ARG002 - parameters decide on a lathe
        """A program that has ended goes back to its top; a machine's own rules may differ."""
        return False

    def clocked(self, channel: Channel) -> None:
        """Nothing of these controls counts with the clock."""

    def moved_together(self, _channel: Channel, axis: int) -> tuple[int, ...]:
        """Each axis goes by itself."""
        return (axis,)

    def travel_by_parameters(self, _channel: Channel) -> Mapping[int, tuple[float, float]]:
        """Software limits of axes by column, machine position, where parameters give some."""
        return {}

    def parameters_changed(self, channel: Channel) -> None:
        """Parameters have other values: the travel of every axis is that of the machine within them."""
        within = self.travel_by_parameters(channel)
        machine = ((axis.limit_minus, axis.limit_plus) for axis in channel.axis_data)
        limits = tuple(
            (max(low, within[i][0]), min(high, within[i][1])) if i in within else (low, high)
            for i, (low, high) in enumerate(machine)
        )
        channel.limits = limits if any(low > -inf or high < inf for low, high in limits) else ()

    def hand_range(self, channel: Channel, axis: int) -> tuple[float, float]:
        """Software limits stop an axis by hand too."""
        return self.travel_by_parameters(channel).get(axis, (-inf, inf))

    def expect_handwheel(self, _channel: Channel, *, is_on: bool) -> None:
        """No handwheel shifts axes beside their program."""

    def handwheel_offset(self, _channel: Channel, _axis: int) -> tuple[float, float]:
        """No handwheel shifts an axis beside its program."""
        return 0.0, 1.0

    def hand_speed(
        self, _channel: Channel, _axis: int, _what: HandMotion, _place: int, *, rapid: bool
    ) -> float | None:
        """The machine says it."""
        del rapid
        return None

    def stop_spindles(self, channel: Channel) -> None:
        """The drives are off."""
        channel.memory.spindle.direction = 0

    def start_codes(self, channel: Channel) -> dict[str, str]:  # noqa: ARG002 - parameters decide on a lathe
        """Code of every modal group at program start."""
        return dict(self.power_on)

    def end_of_program(self, channel: Channel) -> None:
        """The text ends: at level 0 the run ends, a subprogram without M99 is an alarm."""
        if len(channel.stack) > 1 and channel.level.kind is not LevelKind.TYPED_IN:
            raise self.fail("end_of_record")
        channel.pop()

    def g_table(self, channel: Channel) -> Mapping[str, GCode]:
        """The G codes as programs of this channel write them; the rows carry the codes of `g_codes`."""
        return self.with_machine_codes(channel, self.g_codes)

    def with_machine_codes(self, channel: Channel, table: Mapping[str, GCode]) -> Mapping[str, GCode]:
        """A G table with the codes that the machine file declares."""
        return {**table, **machine_codes.g_rows(channel)} if channel.machine.g_functions else table

    def spindle_slot(self, _builder: Builder) -> int | None:
        """Index of the word by which a block names a spindle for its S and M; the word counts as taken."""
        return None

    # ---- blocks -------------------------------------------------------------------------------------------------

    def plan(self, channel: Channel, signature: tuple[str, ...]) -> Plan:
        """The plan of a shape in the present modal state, made and kept."""
        plan = self.builder(channel, self, signature).build()
        channel.mode.plans[signature] = plan
        return plan

    def modal_changes(self, rows: list[GCode]) -> Iterator[tuple[str, str]]:
        """The modal groups that the G codes of a block change, in the order typed."""
        for row in rows:
            if row.ends:
                yield row.ends, self.power_on[row.ends]
            if row.group:
                yield row.group, row.code
        chosen = {row.group for row in rows if row.code in self.ENDED_ANYWHERE}
        for row in rows:
            if row.ends and row.ends in chosen:
                yield row.ends, self.power_on[row.ends]

    def m_row(self, builder: Builder, number: int) -> MCode:
        """The row of an M code in a block, by `m_rows` and else by the table and the machine file."""
        for find in self.m_rows:
            row = find(builder, number)
            if row is not None:
                return row
        return machine_codes.m_row(builder.channel, self.m_codes.get(number), number)

    def guarded_word(self, builder: Builder, address: str, step: Step | None) -> Step | None:
        """The step of a word of `addresses`, unless the machine refuses the word now."""
        return interlocks.guarded_word(builder, address, step) if address[0] in "STB" else step

    def packs_repeats(self, _channel: Channel) -> bool:
        """Whether the digits of P in front of a four-digit program number are the repeats of a call."""
        return True

    def drilling_rules(self, _channel: Channel) -> Drilling:
        """How the control drills."""
        return self.drilling

    # ---- what the motion planners ask ---------------------------------------------------------------------------

    def feed_factor(self, _builder: Builder, _form: str, _mode: FeedMode) -> float:
        """What an F word counts in: 1 for whole units."""
        return 1.0

    def length_value(self, channel: Channel, number: int) -> float:
        """Length offset of an H number, mm."""
        return self._offset(channel, number, "H").total_length

    def radius_value(self, channel: Channel, number: int) -> float:
        """Radius of the tool by the offset of a D number, mm."""
        return self.offset_amount(channel, number)

    def offset_amount(self, channel: Channel, number: int) -> float:
        """The offset of a D number as it is stored, mm."""
        return self._offset(channel, number, "D").total_radius if number else 0.0

    def _offset(self, channel: Channel, number: int, address: str) -> ToolOffset:
        """The tool offset of a number (H, D) up to 999."""
        if not 0 <= number <= 999:
            raise self.fail("offset_number", address=address)
        return channel.memory.offset_number(number)  # type: ignore[no-any-return]

    def arc_tolerance(self, _channel: Channel) -> float:
        """Allowed difference between the radii at start and end of an arc, mm."""
        return 0.01

    def center_may_be_start(self, _channel: Channel) -> bool:
        """Whether an arc whose centre is its start is no mistake of its own."""
        return False

    def check_arc(self, channel: Channel, start: Point, end: Point, center: Point) -> None:
        """Alarm for an end point that is not on the circle."""
        if abs(radius_mismatch(start, end, center)) > self.arc_tolerance(channel) + 1e-9:
            raise self.fail("arc_end")

    def spiral_tolerance(self, channel: Channel) -> float:
        """Difference between the radii at start and end that an arc takes up on its way, mm."""
        return self.arc_tolerance(channel)

    def plan_arc_without_center(self, builder: Builder, _plan: Plan) -> Step | None:
        """An arc block without radius and centre."""
        raise self.fail("no_center", address=builder.mode["motion"])

    def polar_target(self, channel: Channel, plan: Plan, values: list[float]) -> list[float]:
        """End point of a block in polar words."""
        return frames.polar_target(channel, plan, values)

    def scale_factors(self, _channel: Channel, _words: Words) -> tuple[float, float, float]:
        """Factors of G51 on the geometry axes."""
        return (1.0, 1.0, 1.0)

    def rotation_adds(self, _channel: Channel) -> bool:
        """Whether R of a rotation counts from the angle of the one that it replaces."""
        return False

    def rotation_without_angle(self, _channel: Channel) -> float | None:
        """Angle of a rotation without R, degrees; None where R must be there."""
        return None

    def keeps_point_at_rotation(self, _channel: Channel) -> bool:
        """Whether an axis that the block behind a rotation does not name goes where the rotation turns its coordinate.

        Otherwise it counts from where it stands.
        """
        return False

    def kinematics(self, channel: Channel) -> Kinematics:
        """The rotary joints of the machine, with what parameters add to them."""
        return kinematics.Kinematics.of(channel.machine)

    def mechanism(self, channel: Channel, _context: Context) -> Kinematics:
        """A working plane turns no tool."""
        return self.kinematics(channel)

    def feed_to(self, channel: Channel, _end: list[float]) -> float:
        """Feed of a straight cut to a position (absolute display), internal units."""
        return channel.feed

    def rotary_ranges(self, _channel: Channel) -> Mapping[str, tuple[float, float]]:
        """Lowest and highest machine position of rotary axes that stand the tool, degrees by name; none for any."""
        return {}

    def plane_across(self, _channel: Channel, tool: Vector) -> Frame:
        """G68.3: the plane across a tool (a unit vector of the machine)."""
        return tilted.square_on(tool)

    def reference_point(self, channel: Channel, axis: int, number: int) -> float:
        """Machine position of a reference point of an axis, from 1."""
        return channel.axis_data[axis].reference_points[number - 1]

    def reached_reference(self, channel: Channel) -> None:
        """What G27, G28 and G30 end at the reference point: nothing."""

    def leave_length(self, channel: Channel, axes: list[int], *, to_reference: bool) -> None:
        """What becomes of the tool length of axes that G28 and G30, or else G53, have moved: it stays in force."""

    def compensates_to_intermediate(self, _channel: Channel) -> bool:
        """Whether G28 and G30 go to their intermediate point within radius compensation."""
        return False

    def compensation_policy(self, _channel: Channel) -> Policy:
        """Rules of radius compensation."""
        return policy.Policy()

    def corner_policy(self) -> CornerPolicy:
        """What may stand between the two moves of a chamfer or rounding."""
        return corner.CornerPolicy(threads_follow=False)

    def normal_line_rules(self) -> NormalLineRules:
        """What G41.1 and G42.1 refuse."""
        return normal_line.NormalLineRules()

    def stops_reading(self, _channel: Channel, code: int) -> bool:
        """Whether nothing is read behind an M code before it has run: those that stop a program, or end it."""
        return code in (0, 1, 2, 30)

    def nose_tip(self, _channel: Channel) -> tuple[float, float]:
        """Way from the centre of the tool to its programmed point, in the plane, in units of its radius."""
        return (0.0, 0.0)

    # ---- what a family may state differently ----------------------------------------------------------------------

    def is_inch(self, mode: Mode) -> bool:
        """Whether words are inches."""
        return mode["unit"] == self.INCH_CODE

    def number_rules(self, _channel: Channel) -> NumberRules:
        """How numbers are read."""
        return NumberRules()

    def whole_numbers(self, _channel: Channel) -> frozenset[str]:
        """Addresses that are whole numbers wherever they stand, beside M and N."""
        return frozenset()

    def is_diameter(self, channel: Channel, axis: int) -> bool:
        """Whether words of an axis are diameters."""
        return self.DIAMETER_PROGRAMMING and channel.axis_data[axis].diameter

    def from_display(self, channel: Channel, axis: int, value: float) -> float:
        """A position as the displays show it (millimetres, diameter where the axis has one), in internal units."""
        return value / 2.0 if self.is_diameter(channel, axis) else value

    def axis_converter(self, builder: Builder, axis: int, form: str) -> Convert | None:
        """What turns a word of an axis into internal units."""
        channel = builder.channel
        if channel.axis_data[axis].rotary:
            return angle_converter(form, builder.rules)
        diameters = builder.footing.diameters
        return length_converter(form, builder.rules, inch=builder.inch, diameter=diameters[axis])

    def axis_of_address(self, channel: Channel, address: str, builder: Builder) -> tuple[int, bool] | None:
        """The axis that an address names and whether the word is an increment; None for another address."""
        index = channel.axis_index.get(address)
        if index is not None:
            return index, builder.mode["distance"] == "G91"
        name = self.INCREMENTAL_ADDRESSES.get(address)
        if name is None or name not in channel.axis_index:
            return None
        return channel.axis_index[name], True

    def context(self, channel: Channel) -> Context:
        """The context that holds now, with what features change in it."""
        context = self._context(channel)
        for step in self.context_steps:
            context = step(channel, context)
        return context

    def _context(self, channel: Channel) -> Context:
        mode, memory, c = channel.mode, channel.memory, channel.coordinates
        diameters = sum(1 << i for i in range(len(channel.axes)) if self.is_diameter(channel, i))
        polar, unrolled = PolarState.of(channel), CylinderState.of(channel).active
        leading = c.transformation or PlaneAxes.of(channel).parallel
        return Context(
            plane=mode["plane"],
            inch=self.is_inch(mode),
            feed_mode=path.FEED_MODES[mode["feed"]],
            frame=c.zero,
            offsets=tuple(c.offsets),
            tool=memory.tool.number,
            spindle_rpm=memory.spindle.speed,
            spindle_direction=memory.spindle.direction,
            surface_speed=mode.codes.get("surface_speed") == "G96",
            spindle_limit_rpm=memory.spindle.limit_rpm,
            corner_mode=corner_mode(channel),
            diameter_axes=diameters,
            wcs=ZeroState.of(channel).system,
            part=systems.on_work(channel),
            # A path that leads the axes leaves nothing to transform.
            transformation=None if channel.path.leads_axes else leading,
            machine_diameters=diameters | polar.diameter << polar.plane.linear if polar.plane else None,
            unrolled=(unrolled.axis, 1.0 / unrolled.mm_per_degree) if unrolled else None,
        )

    def motion_settings(self, _channel: Channel) -> MotionSettings:
        """How the control leads the axes: corners of G64 are rounded, acceleration is bell-shaped."""
        return BELL_SHAPED

    # ---- variables by name, for reports and test cases ---------------------------------------------------------------

    def read_variable(self, channel: Channel, name: str) -> object:
        """The value of a variable as a user names it; None for a vacant one."""
        return channel.memory.read_text(name)

    def variable_names(self, channel: Channel) -> list[str]:
        """Names of all variables that hold something."""
        return [*channel.memory.variable_names()]

    def write_variable(self, channel: Channel, name: str, value: object) -> None:
        """Set a variable as a user names it."""
        channel.memory.write_text(name, value)
