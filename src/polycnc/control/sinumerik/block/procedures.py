"""Predefined procedures: MSG, STOPRE, SETMS, WAITP, PRESETON and the rest of those that act on the control.

Source: Fundamentals (MSG, SETMS, WAITS, FGROUP, BRISKA …), job planning 5.5 (PRESETON), 14.9 (SETAL).
"""

from __future__ import annotations

from polycnc.control.sinumerik.actions import actions, fixed_stop, overlay, polynomials
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.axes import geometry
from polycnc.control.sinumerik.axes import spindles as spindle_axes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.block.positions import DIAMETER_OF_AXIS, diameter_of_channel
from polycnc.control.sinumerik.channels import axis_containers, axis_exchange, coordination
from polycnc.control.sinumerik.contours import preparation, use
from polycnc.control.sinumerik.couplings import gear_words, leading, masters, synchronous, trailing
from polycnc.control.sinumerik.curve_tables import administration, definition
from polycnc.control.sinumerik.data import archive
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed import axis_settings, pace, spindle_speed, wheels
from polycnc.control.sinumerik.limits import protection, working_area
from polycnc.control.sinumerik.motion import polynomial_groups, splines
from polycnc.control.sinumerik.punching import block as punching
from polycnc.control.sinumerik.signals import interrupts, retraction, sections
from polycnc.control.sinumerik.tangential import definitions as tangential
from polycnc.control.sinumerik.tools import d_numbers, master_holder, online, stages
from polycnc.control.sinumerik.tools.management import lists, magazines, monitoring, wear_groups
from polycnc.control.sinumerik.transformations import seat, selection, start
from polycnc.control.sinumerik.variables import dialogs, lengths
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.initialisation import NEW_CONFIGURATION, initialise
from polycnc.messages import Alarm, AlarmError
from polycnc.toolpath.events import Message, Print, Shown

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel


_MAY_BE_DIAMETER = 4
#: SETAL: thousands of alarm numbers that are shown without stopping the program (job planning 14.9).
SHOWN_ONLY = frozenset((62, 67, 68, 69))


#: How many arguments a procedure takes at most, where it does not look itself.
MOST_ARGUMENTS = {
    "STOPRE": 0,
    "NEWCONF": 0,
    "DELAYFSTON": 0,
    "DELAYFSTOF": 0,
    "IPTRLOCK": 0,
    "IPTRUNLOCK": 0,
    "DIAMCHAN": 0,
    "DZERO": 0,
    "TRAFOOF": 0,
    "ICYCON": 0,
    "ICYCOF": 0,
    "SETMS": 1,
    "FPR": 1,
    "GWPSON": 1,
    "GWPSOF": 1,
    "SETAL": 2,
    "DELDL": 2,
    "MSG": 3,
    "COUPDEF": 6,
}


#: Procedures that stand behind DO alone (job planning 10.4).
OF_ACTIONS = frozenset(("RDISABLE", "STOPREOF", "DELDTG", "LOCK", "UNLOCK", "RESET", "FTOC", "SYNFCT"))


def run(channel: SinumerikChannel, name: str, args: Arguments) -> None:
    """Run a procedure.

    Raises:
        AlarmError: PC0001 for one that is not executed, 12080 for one of actions alone, 14020 for more arguments than
            it takes.
    """
    procedure = PROCEDURES.get(name)
    if name in OF_ACTIONS:
        raise AlarmError("12080", text=name, hint="hint.of-actions")
    if procedure is None:
        raise not_supported(name)
    if len(args) > MOST_ARGUMENTS.get(name, len(args)):
        raise AlarmError("14020", text=name)
    procedure(channel, args)


def message(channel: SinumerikChannel, args: Arguments) -> None:
    """MSG(text): shown until the next one; MSG() takes it away."""
    channel.event(Message(str(args[0]) if args and args[0] is not None else ""))


def diameters_of_channel(channel: SinumerikChannel, _args: Arguments) -> None:
    """DIAMCHAN: all axes that may have a diameter function (MD30460 bit 2) take over that of the channel."""
    memory, mode = channel.memory, channel.mode
    for column, axis in enumerate(channel.axes):
        if memory.data.integer("$MA_BASE_FUNCTION_MASK", axis) & _MAY_BE_DIAMETER:
            function = diameter_of_channel(mode, column, memory.transverse)
            mode = mode.with_code(DIAMETER_OF_AXIS[column], function)
    channel.mode = mode


def preprocessing_stop(channel: SinumerikChannel, _args: Arguments) -> None:
    """STOPRE: everything held back is written and executed before the next block is read."""
    definition.refuse(channel, "STOPRE")
    stages.end_blocks(channel)
    channel.synchronise()


def log(channel: SinumerikChannel, args: Arguments) -> None:
    """WRTPR(text[, n]): a line for the log, written along with the path, which goes on without a stop."""
    if not 1 <= len(args) <= 2 or not isinstance(args[0], str):
        raise AlarmError("14020", text="WRTPR")
    channel.event(Print(args[0]))


def set_alarm(channel: SinumerikChannel, args: Arguments) -> None:
    """SETAL(number, text): an alarm of the program; some numbers are only shown."""
    number = args[0] if args else None
    if not isinstance(number, int) or not 60000 <= number <= 69999:
        raise AlarmError("14020", text="SETAL")
    text = str(args[1]) if len(args) > 1 and args[1] is not None else f"SETAL({number})"
    if number // 1000 not in SHOWN_ONLY:
        raise AlarmError(str(number), detail=text)
    program = channel.level.code.program
    channel.alarms.append(
        Alarm(
            channel.control.id,
            str(number),
            program.name,
            channel.line,
            detail=text,
            file=str(program.path or ""),
            channel=channel.number,
        )
    )
    channel.event(Shown(code=str(number), line=channel.line, column=0, program=program.name))


def set_master_spindle(channel: SinumerikChannel, args: Arguments) -> None:
    """SETMS(n): the master spindle; SETMS alone returns to that of the machine data."""
    spindles = channel.memory.spindles
    number = arguments.spindle(args[0]) if args else None
    number = spindles.default_master if number is None else number
    spindles.get(number)
    before = master_holder.master_of(channel)
    spindles.master = number
    channel.context_changed()
    lists.take_over(channel, before)


def position_control(on: bool) -> Callable[[SinumerikChannel, Arguments], None]:
    """SPCON, SPCOF: the named spindles, or the master spindle, in position control."""

    def switch(channel: SinumerikChannel, args: Arguments) -> None:
        for number in args or (None,):
            channel.memory.spindles.get(arguments.spindle(number)).controlled = on

    return switch


def wait_for_axes(channel: SinumerikChannel, args: Arguments) -> None:
    """WAITP(axis, …): the program waits until positioning axes stand; they are neutral then."""
    columns = [arguments.column(channel, axis) for axis in args]
    action_axes.await_rest(channel, columns)
    action_axes.release(channel, args)


def wait_for_spindles(channel: SinumerikChannel, args: Arguments) -> None:
    """WAITS(n, …): spindles stand at their positions; without a number the master spindle does."""
    spindles = channel.memory.spindles
    for number in [arguments.spindle(each) for each in args] or [spindles.master]:
        spindle_axes.wait(channel, spindles.get(number).number)


def preset(channel: SinumerikChannel, args: Arguments) -> None:
    """PRESETON(machine axis, value, …): the axis stands where it is and shows another machine position."""
    if not args or len(args) % 2:
        raise AlarmError("14020", text="PRESETON")
    seat.refuse_transformed(channel, [arguments.column(channel, axis) for axis in args[::2]], "17600")
    values = {
        arguments.column(channel, axis): arguments.real(value) * lengths.of_axis(channel, axis.name)
        for axis, value in zip(args[::2], args[1::2], strict=True)
    }
    action_axes.call(channel, "PRESETON", values)


def dynamics(name: str) -> Callable[[SinumerikChannel, Arguments], None]:
    """BRISKA, SOFTA, DRIVEA, JERKA: acceleration of single axes, kept for the motion planner."""

    def keep(channel: SinumerikChannel, args: Arguments) -> None:
        for axis in args:
            axis_settings.AxisSettings.of(channel).acceleration[arguments.column(channel, axis)] = name

    return keep


def path_group(channel: SinumerikChannel, args: Arguments) -> None:
    """FGROUP(axis, …): the axes whose way the path feed is for; none for those of the machine data."""
    pace.Overrides.of(channel).group = tuple(arguments.column(channel, axis) for axis in args)
    channel.context_changed()


def renumber(channel: SinumerikChannel, args: Arguments) -> None:
    """SETDNO(t, ce, d) without use of its status."""
    if len(args) != 3 or None in args:
        raise AlarmError("14020", text="SETDNO")
    d_numbers.set_number(channel, args)


def new_configuration(channel: SinumerikChannel, _args: Arguments) -> None:
    """NEWCONF: machine data that the program has written act; variables with INICF begin anew.

    It stops preprocessing (job planning 1.17).
    """
    definition.refuse(channel, "NEWCONF")
    channel.flush()
    channel.synchronise()
    memory = channel.memory
    working_area.refresh(channel)
    masters.reconfigure(channel)
    channel.context_changed()
    initialise(channel, NEW_CONFIGURATION, keep_values=memory.data.keeps_first_values)


def workpiece(channel: SinumerikChannel, args: Arguments) -> None:
    """WORKPIECE(…): the blank that pictures show; WORKPIECE() takes it away. No motion."""
    Stored.of(channel).values["WORKPIECE", ()] = args or None


def channel_data(channel: SinumerikChannel, args: Arguments) -> None:
    """CHANDATA(n): in a program it only makes sure that the channel is the right one (job planning 2.2)."""
    if len(args) != 1 or arguments.whole(args[0]) != channel.number:
        raise AlarmError("14020", text="CHANDATA")


def section_of_program(channel: SinumerikChannel, args: Arguments) -> None:
    """SEFORM(name, level, icon): a section for the step editor; the name is kept for the operator interface."""
    if len(args) != 3 or not isinstance(args[0], str) or not isinstance(args[2], str):
        raise AlarmError("14020", text="SEFORM")
    arguments.whole(args[1])
    dialogs.begin_section(channel, args[0])


def of_technology_cycles(_channel: SinumerikChannel, _args: Arguments) -> None:
    """ICYCOF, ICYCON: how the lines of a technology cycle run; part programs pass them over (job planning 10.5.4)."""


def editor_mark(_channel: SinumerikChannel, _args: Arguments) -> None:
    """GROUP_BEGIN, GROUP_END, GROUP_ADDEND: marks of the editor."""


PROCEDURES: dict[str, Callable[[SinumerikChannel, Arguments], None]] = {
    "MSG": message,
    "WRTPR": log,
    "STOPRE": preprocessing_stop,
    "SETAL": set_alarm,
    "SETMS": set_master_spindle,
    "SPCON": position_control(True),
    "SPCOF": position_control(False),
    "WAITP": wait_for_axes,
    "WAITS": wait_for_spindles,
    "PRESETON": preset,
    "BRISKA": dynamics("BRISK"),
    "SOFTA": dynamics("SOFT"),
    "DRIVEA": dynamics("DRIVE"),
    "JERKA": dynamics("JERK"),
    "FGROUP": path_group,
    "FPR": spindle_speed.feed_source,
    "SCC": spindle_speed.reference_axis,
    "FPRAON": spindle_speed.axis_feed_source,
    "FPRAOF": spindle_speed.axis_feed_source_off,
    **wheels.PROCEDURES,
    "DELAYFSTON": sections.begin(sections.STOP_DELAY),
    "DELAYFSTOF": sections.end(sections.STOP_DELAY),
    "IPTRLOCK": sections.begin(sections.POINTER_LOCK),
    "IPTRUNLOCK": sections.end(sections.POINTER_LOCK),
    **{name: axis_settings.motion_end(name) for name in axis_settings.MOTION_ENDS},
    "QECLRNON": axis_settings.learn_friction,
    "QECLRNOF": axis_settings.end_learning,
    "SETDNO": renumber,
    "DZERO": d_numbers.invalidate,
    "DELDL": d_numbers.without_status(d_numbers.delete_additive),
    "NEWCONF": new_configuration,
    "CHANDATA": channel_data,
    "SEFORM": section_of_program,
    "MMC": dialogs.call,
    "DIAMCHAN": diameters_of_channel,
    "WORKPIECE": workpiece,
    "ICYCOF": of_technology_cycles,
    "ICYCON": of_technology_cycles,
    "GROUP_BEGIN": editor_mark,
    "GROUP_END": editor_mark,
    "GROUP_ADDEND": editor_mark,
    "CORROF": overlay.take_away,
    "DRFOF": overlay.take_away_by_hand,
    **actions.PROCEDURES,
    **polynomials.PROCEDURES,
    **fixed_stop.PROCEDURES,
    **interrupts.PROCEDURES,
    **coordination.PROCEDURES,
    **axis_exchange.PROCEDURES,
    **axis_containers.PROCEDURES,
    **retraction.PROCEDURES,
    **splines.PROCEDURES,
    **polynomial_groups.PROCEDURES,
    **protection.PROCEDURES,
    **preparation.PROCEDURES,
    **use.PROCEDURES,
    **archive.PROCEDURES,
    **selection.PROCEDURES,
    **start.PROCEDURES,
    **online.PROCEDURES,
    **lists.PROCEDURES,
    **magazines.PROCEDURES,
    **monitoring.PROCEDURES,
    **wear_groups.PROCEDURES,
    **punching.PROCEDURES,
    **geometry.PROCEDURES,
    **tangential.PROCEDURES,
    **definition.PROCEDURES,
    **trailing.PROCEDURES,
    **leading.PROCEDURES,
    **gear_words.PROCEDURES,
    **synchronous.PROCEDURES,
    **masters.PROCEDURES,
    **administration.PROCEDURES,
}
