"""SINUMERIK 840D sl: what its language and its channel ask of it."""

from __future__ import annotations

import re
from functools import cached_property
from math import inf

from polycnc.channel.states.unchanging import unchanging
from polycnc.control.sinumerik import axis_names, gcodes, replaced, tables
from polycnc.control.sinumerik.actions.user_data import user_data
from polycnc.control.sinumerik.block import positions
from polycnc.control.sinumerik.block.plan import ExactStop, make_plan
from polycnc.control.sinumerik.channels import axis_containers, axis_exchange, coordination
from polycnc.control.sinumerik.contours import preparation
from polycnc.control.sinumerik.couplings import gantry
from polycnc.control.sinumerik.couplings.links import Couplings
from polycnc.control.sinumerik.couplings.spindle_pairs import SpindlePairs, turns
from polycnc.control.sinumerik.curve_tables import definition as curve_definition
from polycnc.control.sinumerik.data import access, init_programs
from polycnc.control.sinumerik.data.availability import refused
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import pace, spindle_speed, tolerances
from polycnc.control.sinumerik.feed.dry_run import dry_run
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.feed.spindles import Spindle, Spindles
from polycnc.control.sinumerik.frames import active as frames
from polycnc.control.sinumerik.frames.memory import Frames, chain
from polycnc.control.sinumerik.limits import working_area
from polycnc.control.sinumerik.m_functions import PROGRAM_ENDS
from polycnc.control.sinumerik.memory import Memory
from polycnc.control.sinumerik.modal_state import ModalState
from polycnc.control.sinumerik.punching import block as punching
from polycnc.control.sinumerik.reset import reset, start_codes
from polycnc.control.sinumerik.signals import interrupts, measuring, sections
from polycnc.control.sinumerik.states import PointToPoint
from polycnc.control.sinumerik.tools import sides
from polycnc.control.sinumerik.tools.memory import Tools
from polycnc.control.sinumerik.transformations import seat, smoothing
from polycnc.control.sinumerik.variables import part_counts, run_times
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.emitter import nc_shapes
from polycnc.language.sinumerik.executable import SinumerikProgram
from polycnc.language.sinumerik.interface import LanguageMemory
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES
from polycnc.language.sinumerik.names.initialisation import RESET, initialise
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.names.variables import Variable
from polycnc.memory.retained import USER_VARIABLES, VARIABLES, filled
from polycnc.messages import AlarmError
from polycnc.program import Form
from polycnc.toolpath import Context
from polycnc.toolpath.modes import CornerMode, FeedMode
from polycnc.toolpath.motion_settings import MotionSettings

with loaded_when_called():
    from polycnc.control import alarm_text
    from polycnc.control.sinumerik.actions import actions, overlay
    from polycnc.control.sinumerik.axes import jogging
    from polycnc.control.sinumerik.block import procedures, single_block
    from polycnc.control.sinumerik.cycles import calls as cycle_calls
    from polycnc.control.sinumerik.frames import tool_frames
    from polycnc.control.sinumerik.tools import stages
    from polycnc.control.sinumerik.transformations import orientation
    from polycnc.control.sinumerik.variables import by_name, functions, lengths, registry
    from polycnc.language.sinumerik import errors
    from polycnc.language.sinumerik.statements import calls as call_statements
    from polycnc.language.sinumerik.statements import sections as section_statements

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.mode import Mode
    from polycnc.channel.stack import Executable, Level
    from polycnc.channel.steps import Step as ProgramStep
    from polycnc.control.interface import HandMotion
    from polycnc.control.sinumerik.block.draft import Plan, Values
    from polycnc.control.sinumerik.block.scanned import SinumerikPlainBlocks
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.registry import SystemVariable, SystemVariables
    from polycnc.language.expressions.shapes import Shapes
    from polycnc.language.sinumerik.actions.code import ActionCode
    from polycnc.language.sinumerik.iso_dialect import IsoBlock
    from polycnc.language.sinumerik.words import Block
    from polycnc.machine.kinematics import Kinematics
    from polycnc.messages import Catalogue
    from polycnc.program import Program

#: Delivered values of speed limits: none.
NO_LIMIT_RPM = 1e8
#: R parameters of a channel whose machine data say nothing.
R_PARAMETERS = 1000
#: Rotations of frames: RPY angles (1), or Euler angles, which polycnc does not execute.
EULER_ANGLES = "$MN_FRAME_ANGLE_INPUT_MODE"
#: The older way of CUTMOD (7.11), which polycnc does not execute: only an empty text is taken.
CUTTING_DIRECTION = "$SC_CUTDIRMOD"
#: What stands behind the name of a variable: the number of an R parameter, indices.
_INDEX = regex(r"(?<=^R)\d+$|\[.*", re.IGNORECASE)


@unchanging
class Sinumerik:
    """SINUMERIK 840D sl with its full NC language."""

    id: ClassVar[str] = "sinumerik-840d"
    alarm_series: ClassVar[Mapping[str, str] | None] = None
    default_machine: ClassVar[str] = "mill3"
    parameter_files: ClassVar[tuple[str, ...]] = ("sinumerik/data/machine_data.toml",)
    tools_have_names: ClassVar[bool] = True
    display_names: ClassVar[tuple[str, ...]] = GEOMETRY_AXES
    last_bit: ClassVar[int] = 31
    mdi_intervenes: ClassVar[bool] = False
    presets_by_hand: ClassVar[bool] = True
    form: ClassVar[Form] = Form.SINUMERIK

    def __init__(self) -> None:
        self.g_groups: Mapping[str, int] = {word: group.number for word, group in gcodes.GROUP_OF.items()}

    @cached_property
    def shapes(self) -> Shapes:
        """Compiled code of the control's programs."""
        return nc_shapes()

    @cached_property
    def catalogue(self) -> Catalogue:
        """Texts of the control's alarms."""
        return alarm_text.alarm_catalogue("sinumerik/alarms.toml", "sinumerik/cycles/alarms.toml")

    @cached_property
    def system_variables(self) -> SystemVariables:
        """All variables `$…`."""
        return registry.SystemVariables()

    # ---- programs

    def compile(self, program: Program) -> Executable:
        """Make a program ready to run."""
        return SinumerikProgram(program, self)

    def start_position(self, _channel: SinumerikChannel, shown: list[float]) -> list[float]:
        """Machine positions are shown in radius (DIAMOF)."""
        return shown

    def start(self, channel: SinumerikChannel) -> None:
        """Power-on: modal state, machine data, tools and frames as machine and setup say."""
        kept = _names_kept(channel)
        channel.axis_data = positions.configured_axes(channel)
        channel.memory = memory = Memory(
            language=LanguageMemory.of(channel),
            data=MachineData.of(channel),
            frames=Frames.of(channel),
            tools=Tools.of(channel),
            spindles=Spindles.of(channel),
            axes=channel.axis_data,
            columns=axis_names.columns(channel),
            machine_columns=axis_names.machine_columns(channel),
            own_columns=axis_names.columns(channel),
            shares_axes=axis_exchange.shares_axes(channel),
            machine_refuses_moves=bool(channel.machine.plc(self.id).moves),
            transverse=next((i for i, axis in enumerate(channel.axis_data) if axis.diameter), -1),
        )
        channel.mode = channel.modes.mode(start_codes(channel, memory.data))
        PathFeed.of(channel).mode = tables.feed_type(channel.mode).mode
        memory.frames.select(gcodes.number_of(channel.mode["wcs"]) - 1)
        memory.tools.stand_in(channel.setup.tool_at_start(channel.number))
        gantry.close(channel)
        frames.apply(channel)
        working_area.refresh(channel)
        if channel.group is None or channel is channel.group.first:
            for name, value in channel.setup.variables.items():
                if _INDEX.sub("", name.strip()).upper() not in kept:
                    self.write_variable(channel, name, value)
        measuring.watch(channel)
        interrupts.watch(channel)
        if memory.data.integer(EULER_ANGLES) != 1:
            raise not_supported(EULER_ANGLES)
        if memory.data.read(CUTTING_DIRECTION):
            raise not_supported(CUTTING_DIRECTION)
        self.begin(channel)

    def begin(self, channel: SinumerikChannel) -> None:
        """A main program begins in the state that the channel is in; SD42110 is its feed where it has none."""
        feed = channel.memory.data.number("$SC_DEFAULT_FEED")
        if feed > 0.0 and not channel.feed > 0.0:
            channel.feed = feed * tables.feed_type(channel.mode).factor
        smoothing.follow(channel)
        init_programs.call(channel)
        run_times.begin(channel)

    def clocked(self, channel: SinumerikChannel) -> None:
        """A main run executes the channel's rows."""
        run_times.watch(channel)

    def reset(self, channel: SinumerikChannel) -> None:
        """The state after reset, and after the end of a program."""
        memory = channel.memory
        reset(channel)
        initialise(channel, RESET, keep_values=memory.data.keeps_first_values)

    def give_up(self, channel: SinumerikChannel, modal: Mapping[str, str], context: Context) -> None:  # noqa: ARG002
        """A reset in the midst of a program: machine data decide what holds behind it."""
        channel.mode = channel.modes.mode(modal)
        self.reset(channel)

    def stays_at_end(self, channel: SinumerikChannel, code: int) -> bool:  # noqa: ARG002 - the same on every machine
        """A program that has ended goes back to its top."""
        return False

    def stop_spindles(self, channel: SinumerikChannel) -> None:
        """The drives are off."""
        channel.memory.spindles.stop()

    def moved_together(self, channel: SinumerikChannel, axis: int) -> tuple[int, ...]:
        """The axes of a gantry."""
        return gantry.moved_together(channel, axis)

    def hand_range(self, channel: SinumerikChannel, axis: int) -> tuple[float, float]:
        """MD36100 and MD36110, or the second ones."""
        return working_area.switches(channel, axis)

    def handwheel_offset(self, channel: SinumerikChannel, axis: int) -> tuple[float, float]:
        """DRF: MD32020 by MD32090."""
        return overlay.handwheel_share(channel, axis)

    def expect_handwheel(self, channel: SinumerikChannel, *, is_on: bool) -> None:
        """The switch DRF is on: the path leaves axes their share for the handwheel (MD20610)."""
        overlay.expect_handwheel(channel, is_on=is_on)

    def hand_speed(
        self, channel: SinumerikChannel, axis: int, what: HandMotion, place: int, *, rapid: bool
    ) -> float | None:
        """MD32010, MD32020 and their like."""
        return jogging.speed(channel, axis, what, place, rapid=rapid)

    def language_memory(self, channel: SinumerikChannel) -> LanguageMemory:
        """What the language begins with: what machine data say, and values that are retained."""
        data, shared = MachineData.of(channel), channel.group.shared if channel.group is not None else {}
        count = data.count("$MC_MM_NUM_R_PARAM") if data.is_set("$MC_MM_NUM_R_PARAM") else R_PARAMETERS
        retained = channel.retained
        parameters = retained.table(VARIABLES, channel.number)
        return LanguageMemory(
            r_parameters=parameters,
            user_variables=retained.table(USER_VARIABLES, channel.number),
            nck_user_variables=retained.table(USER_VARIABLES),
            r=filled(parameters, "R", [0.0] * count),
            axes={**axis_names.identifiers(channel), **axis_containers.identifiers(channel)},
            default_axis=Axis(str(data.read("$MC_AXCONF_CHANAX_DEFAULT_NAME")).upper()),
            exact_order=bool(data.integer("$MN_PROG_FUNCTION_MASK") & 1),
            main_variables_everywhere=bool(data.integer("$MN_LUD_EXTENDED_SCOPE")),
            access_level=access.operator_level(channel),
            directory_levels=access.directory_levels(data),
            write_levels=access.write_levels(data),
            nck_variables=shared.setdefault("user variables", {}),
            global_variables={
                **{
                    name: Variable(name, Type.INT, store=[value])
                    for name, value in tables.CYCLE_SYMBOLS.items()
                },
                **user_data(data),
            },
            macros={**punching.macros(channel), **coordination.names(channel)},
            refused=refused(channel.machine.control_variant, channel.machine.control_options),
        )

    def end_of_program(self, channel: SinumerikChannel) -> None:
        """The text has ended: as M30, or as M17 in a subprogram."""
        if len(channel.stack) > 1:
            section_statements.end_of_subprogram(channel)
        else:
            preparation.check_end(channel)
            curve_definition.check_end(channel)
            channel.end()

    def plain_blocks(self, _channel: SinumerikChannel) -> SinumerikPlainBlocks:
        """What a scanner must know of plain blocks."""
        # For long programs only.
        from polycnc.control.sinumerik.block.scanned import SinumerikPlainBlocks

        return SinumerikPlainBlocks(self.plan, orientation.tool_record, orientation.note_turn)

    # ---- blocks

    def execute(self, channel: SinumerikChannel, block: Block, values: Values) -> bool:
        """Run the functions and words of a block; true if a modal subprogram (MCALL) follows the block."""
        plan = channel.mode.plans.get(block)
        if plan is None:
            plan = self.plan(channel, block)
        steps, acts, calls, ends, shared = plan
        if shared and not axis_exchange.ready(channel, shared):
            return False
        for step in steps:
            step(channel, values)
        if channel.attention:  # as wherever moves pass stages, and in single block operation
            if channel.path.head is not None:
                channel.path.relax()
            if channel.single_block:
                single_block.RunningBlock.of(channel).acted = acts
        if ends and replaced.call_programs(channel, [int(values[position]) for position in ends]):
            return False
        for position in ends:
            if values[position] in PROGRAM_ENDS:
                if len(channel.stack) == 1:
                    part_counts.count(channel, int(values[position]))
                if not (calls and _modal_in_front(channel)):
                    self.end_of_program(channel)
                return False
        return calls and channel.memory.language.modal_call is not None

    def plan(self, channel: SinumerikChannel, block: Block) -> Plan:
        """Work out what a block does in the modal state that holds."""
        mode = channel.mode
        plan = mode.plans[block] = make_plan(channel, block)
        return plan

    def procedure(self, channel: SinumerikChannel, name: str, args: tuple[Any, ...], column: int) -> None:
        """Run a predefined procedure or a machining cycle; alarms have the column of the call."""
        try:
            if name in keywords.CYCLES:
                cycle_calls.start(channel, name, args, column)
            else:
                procedures.run(channel, name, args)
        except AlarmError as alarm:
            alarm.column = alarm.column or column
            raise

    def define_action(
        self, channel: SinumerikChannel, code: ActionCode, number: int | None, frozen: tuple[Any, ...]
    ) -> None:
        """A synchronised action begins with the next block, with the values that were worked out now."""
        actions.define(channel, code, number, frozen)

    def function(self, channel: SinumerikChannel, name: str, args: tuple[Any, ...], column: int) -> Any:
        """The value of a predefined function that depends on the control's state."""
        return functions.value(channel, name, args, column)

    def g_function(self, group: int, number: int) -> str:
        """The function that `G[group]=number` names; 12470 if there is none or the group is not modal."""
        found = gcodes.BY_NUMBER.get(group)
        if found is None or not found.is_modal or not 1 <= number <= len(found.words):
            raise AlarmError("12470", text=f"G[{group}]={number}")
        return found.words[number - 1]

    def system_variable(self, name: str) -> SystemVariable:
        """The variable `$NAME`; alarm 12550 for one that does not exist, PC0001 for one that is not kept."""
        return self.system_variables.find(name)

    def preprocessing_stop(self, channel: SinumerikChannel) -> bool:
        """Wait for the main run: everything held back is written; the block need not come again."""
        curve_definition.refuse(channel, "$A")
        stages.end_blocks(channel)
        channel.synchronise()
        return False

    def reads_inches(self, channel: SinumerikChannel) -> bool:
        """Whether the program reads and writes values with units of length in inches now (G700)."""
        return channel.mode["unit"] == "G700"

    def unit_of(self, channel: SinumerikChannel, axis: str) -> float:
        """The mm that one unit of the program is for an axis: 25.4 for a linear one under G700, else 1."""
        return lengths.of_axis(channel, axis)

    def restore_setting(self, channel: SinumerikChannel, name: str) -> None:
        """Give a setting or machine datum the values of the setup."""
        channel.memory.data.restore(name)
        working_area.refresh(channel)

    def restarts(self, channel: SinumerikChannel) -> bool:
        """Whether GOTOS goes back to the program start (DB21 ff., DBX384.0)."""
        number = 20 + channel.number
        return bool(channel.setup.switches.plc.get(f"DB{number}.DBX384.0"))

    def skipped(self, channel: SinumerikChannel, level: int) -> bool:
        """Whether blocks marked `/` with this level are skipped now."""
        return bool(channel.setup.switches.block_skip_mask(plain=0) >> level & 1)

    def save(self, channel: SinumerikChannel) -> ModalState:
        """What PROC … SAVE brings back: all modal functions, and the frames that they chose."""
        return ModalState(channel.mode, channel.memory.frames.programmable, channel.feed)

    def restore(self, channel: SinumerikChannel, saved: object) -> None:
        """Bring back what `save` returned."""
        assert isinstance(saved, ModalState)
        if saved != self.save(channel):
            saved.restore(channel)

    # ---- the toolpath

    def context(self, channel: SinumerikChannel) -> Context:
        """The context that holds now."""
        mode, coordinates = channel.mode, channel.coordinates
        memory = channel.memory
        feed = tables.feed_type(mode)
        speed_type = "G96" if feed.surface_speed else mode["feed"]
        leading = (
            PathFeed.of(channel).spindle
            if feed.mode is FeedMode.PER_REVOLUTION and PathFeed.of(channel).spindle
            else memory.spindles.master
        )
        spindle = memory.spindles.all.get(leading)
        shown = (positions.diameter_function(mode, i, memory.transverse) for i in range(len(channel.axes)))
        diameters = sum(1 << i for i, function in enumerate(shown) if function in positions.SHOWS_DIAMETERS)
        side = sides.SIDES.get(mode["compensation"], 0)
        turn = smoothing.turn(channel, mode)
        delays_stops = sections.delays_stops(channel)
        return Context(
            plane=mode["plane"],
            feed_inch=mode["unit"] == "G700",
            feed_mode=feed.mode,
            frame=coordinates.zero,
            offsets=tuple(coordinates.offsets),
            tool=memory.tools.active,
            tool_name=memory.tools.name,
            radius_mm=stages.distance(channel) if side else 0.0,
            side=side,
            spindle=leading,
            spindle_rpm=_speed(channel, spindle, speed_type),
            spindle_direction=_direction(channel, spindle),
            surface_speed=feed.surface_speed,
            spindle_limit_rpm=_limit(memory, spindle, speed_type),
            corner_mode=_corner_mode(channel, mode),
            stop_window=tables.STOP_WINDOWS[mode["exact_stop"]],
            tolerance_mm=smoothing.contour(channel, mode, _tolerance(channel, mode["path"])),
            fairing=smoothing.fairing(channel, mode),
            turn_tolerance_deg=turn.tolerance_deg,
            turn_distance_mm=turn.distance_mm,
            swing_deg=smoothing.swing(channel, mode),
            acceleration=tables.ACCELERATION_MODES[mode["acceleration"]],
            rapid_by_axis=mode["rapid"] == "RTLIOF",
            diameter_axes=diameters,
            wcs=mode["wcs"],
            part=chain(memory.frames.inner()).frame,
            transformation=coordinates.transformation,
            names=seat.shown_names(channel),
            stop_delay=delays_stops,
            search_lock=sections.locks_pointer(channel),
            feed_hold=not delays_stops,
            shown_by=PointToPoint.of(channel).shown_by or Couplings.of(channel).shown_by,
            pace=pace.pace(channel, side),
        )

    def select_iso(self, channel: SinumerikChannel) -> None:
        """G291 acts; PC0001 in a subprogram, and what `_begin_iso` raises."""
        if len(channel.stack) > 1:
            raise not_supported("G291")
        self._begin_iso(channel)
        channel.mode = channel.mode.with_code("language", "G291")

    def calls_iso(self, channel: SinumerikChannel) -> bool:
        """MD18800: 1 for code M, 2 for code T of a lathe; PC0001 for the code of the other kind of machine."""
        chosen = MachineData.of(channel).integer("$MN_MM_EXTERN_LANGUAGE")
        if chosen:
            if chosen != (2 if channel.memory.transverse >= 0 else 1):
                raise not_supported("ISOCALL")
            self._begin_iso(channel)
        return bool(chosen)

    def _begin_iso(self, channel: SinumerikChannel) -> None:
        """The dialect begins: PC0001 with MCALL active, and under G91 where it has no G90 (code A of a lathe)."""
        from polycnc.control.sinumerik.iso import systems, turning

        is_lathe, modal = channel.memory.transverse >= 0, LanguageMemory.of(channel).modal_call
        has_g90 = (
            not is_lathe or MachineData.of(channel).integer("$MN_EXTERN_GCODE_SYSTEM") != systems.SYSTEM_A
        )
        if modal is not None or (channel.mode["distance"] == "G91" and not has_g90):
            raise not_supported("G291")
        turning.begin(channel)

    def run_iso(self, channel: SinumerikChannel, block: IsoBlock, perform: Callable[[str], None]) -> None:
        """A block of the ISO dialect comes: PC0001 where the program has come there without G291."""
        if channel.mode["language"] != "G291":
            raise not_supported("G291")
        from polycnc.control.sinumerik.iso import dialect

        dialect.run(channel, block, perform)

    def halts(self, channel: SinumerikChannel, level: Level, step: ProgramStep) -> bool:  # noqa: ARG002 - levels decide
        """Whether single block operation halts behind the block that a level has run."""
        return single_block.halts(channel, level)

    def over_travel(self, axis: str, direction: int) -> AlarmError:
        """10720: the target lies beyond a software limit switch."""
        return AlarmError("10720", axis=axis, side="+" if direction > 0 else "-")

    def reference_point(self, channel: SinumerikChannel, axis: int, number: int) -> float:
        """Machine position of a reference point of an axis (1 to 4)."""
        return channel.axis_data[axis].reference_points[number - 1]

    def arithmetic_alarm(self, error: ArithmeticError) -> AlarmError:  # noqa: ARG002 - one alarm for all
        """The alarm for a calculation without a result: 14051."""
        return errors.arithmetic()

    def block_limit(self) -> AlarmError:
        """The program has run more blocks than allowed."""
        return AlarmError("PC0002", hint="hint.block-limit")

    def mechanism(self, channel: SinumerikChannel, context: Context) -> Kinematics:
        """That of an orientation transformation; a head that does not turn holds the tool across the plane."""
        return tool_frames.mechanism(channel, context)

    def motion_settings(self, channel: SinumerikChannel) -> MotionSettings:
        """How the control leads the axes: rapids stop only where an exact stop does; feeds count linear axes.

        DRIVE: MD35220 and MD35230 of the axis that asks for most caution. MD35500: what waits for a spindle.
        """
        data = MachineData.of(channel)
        waits = data.said("$MA_SPIND_ON_SPEED_AT_IPO_START")
        return MotionSettings(
            bends_by_way=True,
            rapid_stops=False,
            rotary_in_feed=False,
            drive_speed=min(data.number("$MA_ACCEL_REDUCTION_SPEED_POINT", name) for name in channel.axes),
            drive_reduction=max(data.number("$MA_ACCEL_REDUCTION_FACTOR", name) for name in channel.axes),
            dry_run=dry_run(data),
            spindle_wait="" if waits is None else "cut" if waits else "never",
        )

    # ---- variables by name

    def read_variable(self, channel: SinumerikChannel, name: str) -> object:
        """The value of a variable as a program would name it (`R1`, `$P_GG[6]`, a user variable)."""
        return by_name.read(channel, name)

    def write_variable(self, channel: SinumerikChannel, name: str, value: object) -> None:
        """Set a variable as a program would name it."""
        by_name.write(channel, name, value)

    def variable_names(self, channel: SinumerikChannel) -> list[str]:
        """Names of all variables that hold something."""
        memory = channel.memory
        return [f"R{n}" for n, value in enumerate(memory.language.r) if value]


def _names_kept(channel: SinumerikChannel) -> set[str]:
    """Names of variables that have their values from an earlier power-on: the setup leaves them alone."""
    tables_ = (
        channel.retained.table(name, number)
        for name in (VARIABLES, USER_VARIABLES)
        for number in (channel.number, 0)
    )
    return {name for table in tables_ for name in table}


def _corner_mode(channel: SinumerikChannel, mode: Mode) -> CornerMode:
    """G9 holds for its block, else group 10; with strokes every block ends in an exact stop."""
    if ExactStop.of(channel).block or mode[punching.GROUP] != punching.OFF:
        return CornerMode.EXACT_STOP
    return smoothing.corner_mode(mode, tables.CORNER_MODES[mode["path"]])


def _tolerance(channel: SinumerikChannel, path_mode: str) -> float:
    """ADIS for G641, CTOL for the kinds of rounding that keep a tolerance."""
    if path_mode in ("G642", "G643", "G645"):
        return tolerances.contour_tolerance(channel)
    return tolerances.Smoothing.of(channel).distance_mm.get("ADIS", 0.0) if path_mode == "G641" else 0.0


def _speed(channel: SinumerikChannel, spindle: Spindle | None, feed: str) -> float:
    if spindle is None:
        return 0.0
    if SpindlePairs.of(channel).acting(spindle.number) is not None:
        return abs(turns(channel, spindle.number))
    if feed in tables.SURFACE_SPEEDS:
        return spindle.cutting_speed
    return spindle_speed.turning_speed(channel.memory, spindle, feed)


def _direction(channel: SinumerikChannel, spindle: Spindle | None) -> int:
    if spindle is None:
        return 0
    if SpindlePairs.of(channel).acting(spindle.number) is None:
        return spindle.direction
    speed = turns(channel, spindle.number)
    return (speed > 0.0) - (speed < 0.0)


def _limit(memory: Memory, spindle: Spindle | None, feed: str) -> float:
    """The spindle's highest speed; 0 for none."""
    limit = spindle_speed.highest(memory, spindle, feed) if spindle is not None else inf
    return limit if limit < NO_LIMIT_RPM else 0.0


def _modal_in_front(channel: SinumerikChannel) -> bool:
    """Run what MCALL has set behind the motion of a block that ends its program; the program ends behind that."""
    level = channel.level
    call_statements.call_modal(channel)
    if channel.level is level:
        return False
    level.index = len(level.code.whole)
    return True
