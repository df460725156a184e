"""The SYNTEC milling control (control id `syntec-mill`)."""

from __future__ import annotations

from functools import cached_property
from math import hypot, inf

from polycnc.channel.stack import LevelKind
from polycnc.control.syntec import cycles, tapping
from polycnc.control.syntec.alarm_codes import ALARMS, FOREIGN_CODES
from polycnc.control.syntec.axis_groups import groups
from polycnc.control.syntec.builder import SyntecBuilder
from polycnc.control.syntec.codes import ADDRESSES, G_CODES, M_CODES, POWER_ON
from polycnc.control.syntec.coordinates import systems
from polycnc.control.syntec.coordinates.turns import OVER_POWER_OFF, TurnState, end_turns, following
from polycnc.control.syntec.macros import calls, interrupts, single_block
from polycnc.control.syntec.macros.variables import USER, SpaceState, locals_of
from polycnc.control.syntec.memory import SyntecMemory
from polycnc.control.syntec.motion import arcs, conditions, dwell, moves, smoothing
from polycnc.control.syntec.motion.moves import FeedState
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.control.syntec.rules import RULES
from polycnc.control.syntec.units import decimals, least_unit
from polycnc.control.word_address.auxiliary.overrides import in_tapping_mode
from polycnc.control.word_address.block.numbers import NumberRules
from polycnc.control.word_address.control import WordAddressControl
from polycnc.control.word_address.coordinates import frames
from polycnc.control.word_address.states import CurveState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.language.syntec import executable, iso_grammar
from polycnc.messages import AlarmError
from polycnc.program import Form
from polycnc.program.split import split_channels
from polycnc.toolpath.modes import FeedMode
from polycnc.toolpath.motion_settings import Ramp

with loaded_when_called():
    from polycnc.compensation import policy
    from polycnc.control.syntec.five_axes import mechanism, normal_direction, tilted
    from polycnc.control.syntec.motion import polar, quiet
    from polycnc.control.syntec.plain import SyntecPlainBlocks
    from polycnc.control.word_address.motion import nurbs
    from polycnc.control.word_address.tools import spatial
    from polycnc.control.word_address.transformations import normal_line

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.stack import Executable
    from polycnc.compensation.policy import Policy
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import ContextStep, GCode, Handler, MCode, MRow, Planner
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.block.single_block import Halts
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.control.word_address.transformations.normal_line import NormalLineRules
    from polycnc.geometry.arcs import Point
    from polycnc.language.bulk import Condition
    from polycnc.language.word_address import Grammar
    from polycnc.machine.kinematics import Kinematics
    from polycnc.program import Program
    from polycnc.toolpath.motion_settings import MotionSettings


#: Radius of the arc that Pr408 is the speed of (general knowledge), mm.
_ARC_REFERENCE_MM = 5.0
#: Parameters of the reference points behind the first, by number of the point.
REFERENCE_POINTS = {
    2: SyntecParameters.reference_points_2,
    3: SyntecParameters.reference_points_3,
    4: SyntecParameters.reference_points_4,
}


class SyntecMill(WordAddressControl):
    """SYNTEC milling controls of the 900M … 220MA-5 family."""

    id: ClassVar[str] = "syntec-mill"
    parameter_files: ClassVar[tuple[str, ...]] = ("syntec/parameters.toml",)
    parameter_class: ClassVar = SyntecParameters
    alarm_series: ClassVar[Mapping[str, str] | None] = {"MAR": "MACRO"}
    alarm_files: ClassVar[tuple[str, ...]] = ("syntec/alarms.toml", "syntec/alarms_special.toml")
    g_codes: ClassVar[Mapping[str, GCode]] = G_CODES
    m_codes: ClassVar[Mapping[int, MCode]] = M_CODES
    m_rows: ClassVar[tuple[MRow, ...]] = (interrupts.m_row,)
    context_steps: ClassVar[tuple[ContextStep, ...]] = (
        in_tapping_mode,
        moves.recorded,
        dwell.ended_by_signal,
        smoothing.smoothed,
        following,
        tapping.finished,
        conditions.bounded,
    )
    addresses: ClassVar[Mapping[str, Planner]] = ADDRESSES
    power_on: ClassVar[Mapping[str, str]] = POWER_ON
    alarms: ClassVar[Mapping[str, str]] = ALARMS
    foreign_codes: ClassVar[Mapping[str, str]] = FOREIGN_CODES
    drilling: ClassVar[Drilling] = cycles.DRILLING
    FEED_AT_START: ClassVar[float | None] = moves.DEFAULT_FEED["G94"]
    INCREMENTAL_ADDRESSES: ClassVar[Mapping[str, str]] = {"U": "X", "V": "Y", "W": "Z"}
    INCH_CODE: ClassVar[str] = "G70"
    LENGTH_TRAVELS_ALONE: ClassVar[bool] = False
    mdi_intervenes: ClassVar[bool] = False
    last_bit: ClassVar[int] = 31
    only_context: ClassVar[tuple[Handler, ...]] = (*WordAddressControl.only_context, systems.cutting_mode)
    repeated_codes: ClassVar[Mapping[str, Condition]] = moves.REPEATED
    #: A motion code cancels the cycle of its block, in whatever order they are typed (2.47.3, note 9).
    ENDED_ANYWHERE: ClassVar[frozenset[str]] = frozenset(G_CODES)
    halts_behind: ClassVar[tuple[Halts, ...]] = (
        single_block.not_where_forbidden,
        arcs.not_at_mid_point,
        single_block.behind_typed_blocks,
        *WordAddressControl.halts_behind,
    )
    builder: ClassVar[type[Builder]] = SyntecBuilder
    rules: ClassVar[tuple[Rule, ...]] = RULES

    # ---- programs ----------------------------------------------------------------------------------------

    @cached_property
    def grammar(self) -> Grammar:
        """How ISO files are written."""
        return iso_grammar()

    def compile(self, program: Program) -> Executable:
        """Make a program ready to run: macro language where its file says so."""
        return executable(program, self.grammar, macro=program.form is Form.MACRO)

    def plain_blocks(self, _channel: SyntecChannel) -> SyntecPlainBlocks:
        """What a scanner must know of plain blocks."""
        return SyntecPlainBlocks()

    def find_program(self, _channel: SyntecChannel, number: int) -> Program:
        """A program by its number."""
        program = _channel.store.find_number(number)
        if program is None:
            raise self.fail("no_program", address="P", number=number)
        return program

    # ---- states ------------------------------------------------------------------------------------------

    def motion_settings(self, channel: SyntecChannel) -> MotionSettings:
        """Pr411: each axis runs a rapid by itself; Pr405, Pr406, Pr461 on, Pr621 on: speeds in mm/min, 0 for none.

        Pr441 on, Pr541 on: milliseconds from rest to these speeds; Pr641 on: in which the acceleration builds up.
        Pr401: the same of cuts on their path.
        """
        given = SyntecParameters.naming(channel.setup.parameters)

        def caps(speeds: tuple[int, ...]) -> dict[str, float]:
            """Caps of the axes that have one, by their names."""
            numbers = zip(channel.axes, speeds, strict=False)
            return {name: number / 60.0 for name, number in numbers if number > 0}

        def ramps(times: tuple[int, ...], bells: tuple[int, ...]) -> dict[str, Ramp]:
            """Ramps of the axes that have time constants, by their names."""
            numbers = zip(channel.axes, times, bells, strict=False)
            found = {name: Ramp(time / 1000.0 or None, bell / 1000.0 or None) for name, time, bell in numbers}
            return {name: ramp for name, ramp in found.items() if ramp != Ramp()}

        cut_ramps = ramps(given.cutting_times, given.cutting_bell_times)
        if given.cutting_time > 0:
            cut_ramps = self._with_path_time(channel, cut_ramps, caps(given.cutting_speeds))
        return replace(
            super().motion_settings(channel),
            rapid_ramps=ramps(given.rapid_times, given.cutting_bell_times),
            cut_ramps=cut_ramps,
            rapid_by_axis=given.rapids_by_axis == 1,
            path_feed=(given.path_feed or inf) / 60.0,
            corner_speed=(given.corner_feed or inf) / 60.0,
            arc_pull=((given.arc_feed or inf) / 60.0) ** 2 / _ARC_REFERENCE_MM,
            rapid_caps=caps(given.rapid_speeds),
            feed_caps=caps(given.cutting_speeds),
        )

    def _with_path_time(
        self, channel: SyntecChannel, ramps: Mapping[str, Ramp], caps: Mapping[str, float]
    ) -> dict[str, Ramp]:
        """Pr401: time of cuts from rest to Pr405, or to the highest feed of an axis; Pr541 where that is slower."""
        given = SyntecParameters.naming(channel.setup.parameters)
        found: dict[str, Ramp] = {}
        for name, axis in zip(channel.axes, channel.axis_data, strict=True):
            own = ramps.get(name, Ramp())
            top = min(axis.max_feed or inf, caps.get(name, inf))
            pulls = [(given.path_feed / 60.0 or top) / (given.cutting_time / 1000.0)]
            if own.seconds:
                pulls.append(top / own.seconds)
            pull = min(pulls)
            found[name] = Ramp(bell_s=own.bell_s, acceleration=pull) if pull < inf else own
        return found

    def make_memory(self, channel: SyntecChannel) -> SyntecMemory:
        """Offsets, tools and variables."""
        return SyntecMemory(channel)

    def start(self, channel: SyntecChannel) -> None:
        """Power-on state."""
        super().start(channel)
        memory = channel.memory
        feed = FeedState.of(channel).mode = channel.mode["feed"]
        if feed == "G95":
            channel.feed = moves.DEFAULT_FEED["G95"]
        for number, code in zip(SyntecParameters.m_macros.numbers, memory.parameters.m_macros, strict=True):
            on = memory.parameters.interrupt_m
            if code in calls.NEVER_REGISTERED - {0} or code in (on, on + 1):
                raise self.fail("registered_m", number=number)
        if memory.parameters.rotates_at_start == 1 or memory.parameters.keeps_tilt == OVER_POWER_OFF:
            kept = tilted.kept_over_power_off(channel)
            tilted.rotate_work_system(channel, on=memory.parameters.rotates_at_start == 1)
            kept.restore(channel)
        else:
            end_turns(channel)
        self.begin(channel)
        if memory.parameters.travel_2_at_start == 1:
            channel.mode = channel.mode.with_code("stroke", "G22")
            systems.set_zone(channel, systems.limits_in(channel, memory.parameters.second_travel))

    def travel_by_parameters(self, channel: SyntecChannel) -> Mapping[int, tuple[float, float]]:
        """First travel limits, Pr2401 on."""
        travel = channel.memory.parameters.first_travel
        return systems.limits_in(channel, travel)

    def begin(self, channel: SyntecChannel) -> None:
        """A main program begins: it has the local variables; a channel of a file with `$n` runs its section."""
        local = channel.memory.locals
        channel.level.locals = local
        groups.start_others(channel, channel.level.code.program)
        section = split_channels(channel.level.code.program).get(channel.number)
        if section is not None:
            channel.stack.pop()
            channel.push(section, kind=LevelKind.MAIN, local=local)
        smoothing.begin(channel)

    def start_codes(self, channel: SyntecChannel) -> dict[str, str]:
        """Power-on codes; Pr3836 chooses between G94 and G95."""
        codes = super().start_codes(channel)
        if SyntecParameters.naming(channel.setup.parameters).feed_per_revolution == 1:
            codes["feed"] = "G95"
        return codes

    def reset(self, channel: SyntecChannel) -> None:
        """The state after reset: G54.4 stays, Pr3014 may keep the tilted plane, Pr413 the turn of G92.1."""
        quiet.switch_quiet(channel, on=False)
        normal_line.end(channel)
        spatial.end(channel)
        polar.leave_plane(channel)
        smoothing.leave(channel)
        if not channel.memory.parameters.keeps_preset_turn:
            systems.forget_preset_turn(channel.memory)
        kept = tilted.kept_over_reset(channel)
        super().reset(channel)
        tilted.rotate_work_system(channel, on=TurnState.of(channel).by_table)
        kept.restore(channel)

    def end_of_program(self, channel: SyntecChannel) -> None:
        """The text ends: as M30, in a subprogram as M99."""
        if len(channel.stack) > 1:
            calls.leave_program(channel)
        else:
            self.finish(channel)

    def finish(self, channel: SyntecChannel) -> None:
        """The main program is over."""
        arcs.check_pair_complete(channel)
        if CurveState.of(channel).curve is not None:
            nurbs.check_complete(channel)
        interrupts.check_off(channel)
        channel.end()

    def leave(self, channel: SyntecChannel) -> None:
        """End of a subprogram or macro: the caller's local variables return, words that were left act."""
        ended = channel.pop()
        channel.memory.locals = locals_of(channel.level)
        calls.finish_macro(channel, ended)

    def check_nesting(self, channel: SyntecChannel, _kind: LevelKind) -> None:
        """Alarm for one level of calls too many."""
        if len(channel.stack) >= calls.MAX_LEVELS:
            raise self.fail("nesting", hint="hint.syntec.levels")

    # ---- alarms ------------------------------------------------------------------------------------------

    def arithmetic_alarm(self, _error: ArithmeticError) -> AlarmError:
        """The alarm for a calculation whose result no variable can hold."""
        return AlarmError("COR-004", hint="hint.syntec.overflow")

    def not_yet(self, code: str, address: str = "") -> AlarmError:
        """The alarm for something that the control knows and polycnc does not execute."""
        return AlarmError("PC0001", hint="hint.not-supported", address=address, code=code)

    def untaken(self, address: str, _builder: Builder) -> AlarmError:
        """The alarm for a word that nothing in its block takes."""
        if address.startswith(","):
            return self.not_yet(address, address)
        return self.fail("address", address=address, hint="hint.syntec.word-not-used", word=address)

    # ---- numbers -----------------------------------------------------------------------------------------

    def number_rules(self, channel: SyntecChannel) -> NumberRules:
        """Least input units by Pr17; Pr3241 = 1 makes numbers without a point whole units."""
        parameters = SyntecParameters.naming(channel.setup.parameters)
        return NumberRules(
            decimals=decimals(parameters, inch=False),
            decimals_inch=decimals(parameters, inch=True),
            calculator=parameters.whole_units == 1,
            cuts_digits=False,
        )

    def feed_factor(self, builder: Builder, form: str, mode: FeedMode) -> float:
        """F per minute counts whole units; per revolution, without a point, least input units (chapter 5)."""
        rules = builder.rules
        if form != "" or mode is not FeedMode.PER_REVOLUTION or rules.calculator:
            return 1.0
        return float(10.0 ** -(rules.decimals_inch if builder.inch else rules.decimals))

    def is_diameter(self, channel: SyntecChannel, axis: int) -> bool:
        """Whether words of an axis are diameters (Pr281~, G10.9)."""
        return bool(channel.memory.is_diameter(axis))

    def axis_of_address(
        self, channel: SyntecChannel, address: str, builder: Builder
    ) -> tuple[int, bool] | None:
        """U, V, W are increments of X, Y, Z only with Pr3809 = 1, and not for G53 (2.37.3)."""
        increments = channel.memory.parameters.uvw_increments == 1 and address in self.INCREMENTAL_ADDRESSES
        if increments and not any(row.code == "G53" for row in builder.codes):
            index = channel.axis_index.get(self.INCREMENTAL_ADDRESSES[address])
            return None if index is None else (index, True)
        index = channel.axis_index.get(address)
        return None if index is None else (index, builder.mode["distance"] == "G91")

    # ---- motion ------------------------------------------------------------------------------------------

    def arc_tolerance(self, channel: SyntecChannel) -> float:
        """Allowed distance of an arc's end from its circle (Pr3807), mm."""
        parameters = channel.memory.parameters
        return parameters.arc_tolerance * least_unit(parameters)

    def check_arc(self, channel: SyntecChannel, start: Point, end: Point, center: Point) -> None:
        """COR-006 for an end point that is not on the circle, or an arc without radius."""
        first = hypot(start[0] - center[0], start[1] - center[1])
        last = hypot(end[0] - center[0], end[1] - center[1])
        if first == 0.0 or abs(first - last) > self.arc_tolerance(channel) + 1e-9:
            raise self.fail("arc_end")

    def polar_target(self, channel: SyntecChannel, plan: Plan, values: list[float]) -> list[float]:
        """End point under G16."""
        return frames.polar_target(channel, plan, values)

    def scale_factors(self, channel: SyntecChannel, words: Words) -> tuple[float, float, float]:
        """Factors of G51."""
        return systems.scale_factors(channel, words)

    def kinematics(self, channel: SyntecChannel) -> Kinematics:
        """The rotary joints of the machine, with the holder of Pr3013."""
        return mechanism.kinematics_of(channel)

    def feed_to(self, channel: SyntecChannel, end: list[float]) -> float:
        """Feed of a straight cut to a position: F, under G93 F times the way."""
        return moves.feed_to(channel, end)

    def reference_point(self, channel: SyntecChannel, axis: int, number: int) -> float:
        """Machine position of a reference point: 1 the machine zero, 2 to 4 by Pr2801 on, in least units."""
        delivered = channel.axis_data[axis].reference_points[number - 1]
        if number == 1:
            return delivered
        parameters = channel.memory.parameters
        value = parameters.value(REFERENCE_POINTS[number])[axis]
        return delivered if value is None else value * least_unit(parameters)

    # ---- offsets -----------------------------------------------------------------------------------------

    def compensation_policy(self, channel: SyntecChannel) -> Policy:
        """Radius compensation; Pr3819 = 1 checks for overcut."""
        checked = channel.memory.parameters.overcut_check == 1
        return policy.Policy(checks_direction=checked, sign_is_side=False)

    def normal_line_rules(self) -> NormalLineRules:
        """What G41.1 and G42.1 refuse."""
        return normal_direction.rules()

    # ---- reports -----------------------------------------------------------------------------------------

    def variable_names(self, channel: SyntecChannel) -> list[str]:
        """Names of all variables that hold something."""
        memory = channel.memory
        names = [f"#{index}" for index in sorted(memory.locals)]
        spaces = SpaceState.of(channel)
        names += [f"#{USER[offset]}" for offset in sorted(spaces.user)]
        names += [f"#{2001 + offset}" for offset in sorted(spaces.modal_doubles)]
        names += [f"@{index}" for index in sorted(memory.globals.values)]
        return names + [f"R{index}" for index in sorted(memory.globals.registers)]
