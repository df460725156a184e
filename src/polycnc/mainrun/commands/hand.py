"""The axes by hand: jog, steps, handwheel, reference approach."""

from __future__ import annotations

from functools import partial
from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.mainrun.axes.about_tip import AboutTip
from polycnc.mainrun.axes.along_line import AlongLine
from polycnc.mainrun.axes.hand import ENDLESS
from polycnc.mainrun.commands.states import PROGRAM_MODES, Command
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages.catalogue import listed
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.control.interface import HandMotion
    from polycnc.geometry.frames import Vector
    from polycnc.mainrun.axes.hand import Hand
    from polycnc.mainrun.commands.permission import Permission
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.mainrun.execution.operation import Operation

#: The code under which rotary axes turn the tool about its tip.
TURNS_ABOUT_TIP = "TRAORI"
#: Signals: axes are moved by hand in the machine coordinate system, each by itself; geometry axes in that of the tool,
#: or of the work. The first one that is on counts.
IN_MACHINE_SYSTEM, IN_TOOL_SYSTEM, IN_WORK_SYSTEM = "JOG_MCS", "JOG_TCS", "JOG_WCS"
#: A signal: keys lead axes back to where the program waits (SINUMERIK's REPOS).
TO_PATH = "JOG_REPOS"
#: A line is straight in the axes where they are no farther beside it than this, mm, over `TRIAL_MM` of it.
STRAIGHT_MM, TRIAL_MM = 1e-6, 10.0


class HandCommands:
    """Moves axes without a program. `channel` is the number of the channel whose axis is meant.

    Args:
        operation: The channels.
        permission: Asked in front of every command.
    """

    def __init__(self, operation: Operation, permission: Permission) -> None:
        self._runs = operation.runs
        self._switches = operation.switches
        self._clock = operation.clock
        self._status = operation.status
        self._permission = permission
        self._signals = operation.signals
        self._prepare = operation.prepare

    def jog(self, axis: str, direction: int, *, rapid: bool, channel: int) -> None:
        """Press a jog key."""
        self._permission.ask(Command.JOG)
        run, i = self._axis(axis, channel)
        self._permission.ask_machine(*_move_words(run, i))
        here = self._take_in_hand(run)
        if self._signals[TO_PATH]:
            self._return(run, i, direction, here, rapid=rapid)
            return
        if (line := self._line(run, i, here)) is not None:
            line.send(direction * ENDLESS, self._speed(run, i, rapid=rapid), self._clock.time)
            return
        about_tip = self._about_tip(run, i, here, others=False)
        for axis_, hand in _hands(run, i):
            target = hand.end_of_travel(direction, here[axis_])
            self._send(run, axis_, target, self._speed(run, i, rapid=rapid), about_tip)

    def _return(
        self, run: ChannelRun, axis: int, direction: int, here: Sequence[float], *, rapid: bool
    ) -> None:
        """Back to where the program waits for the axis, and no farther."""
        target = run.without_hand[axis]
        if not run.is_active or (target - here[axis]) * direction <= NO_WAY:
            raise CommandRefused("mainrun.no-way-back", axis=run.channel.axes[axis])
        for i, _ in _hands(run, axis):
            self._send(run, i, run.without_hand[i], self._speed(run, axis, rapid=rapid), None)

    def stop_jog(self, axis: str | None, *, channel: int) -> None:
        """Let a jog key go; all of them where no axis is named."""
        if axis is None:
            self._runs.brake_hands()
        else:
            run, i = self._axis(axis, channel)
            led = run.axes.led
            if isinstance(led, AlongLine) and led.turns:
                if led.column == i:
                    led.brake(self._clock.time)
                return
            for _, hand in _hands(run, i):
                hand.brake(self._clock.time)

    def increment(self, axis: str, way: float, *, channel: int) -> None:
        """Move by a way, as the machine display counts."""
        self._permission.ask(Command.INCREMENT)
        run, i = self._axis(axis, channel)
        self._shift(run, i, way, rapid=False)

    def handle(self, axis: str, way: float, *, channel: int) -> None:
        """Turn the handwheel by a way, as the machine display counts."""
        if self._switches.panel.drf and self._status.mode in PROGRAM_MODES:
            self._offset(axis, way, channel)
            return
        self._permission.ask(Command.HANDLE)
        run, i = self._axis(axis, channel)
        self._shift(run, i, way, rapid=True)

    def _offset(self, axis: str, way: float, number: int) -> None:
        """Shift an axis beside the program that runs, or may run (DRF)."""
        self._permission.ask(Command.HANDWHEEL_OFFSET)
        run, i = self._axis(axis, number)
        self._ask_test()
        self._permission.ask_machine(*_move_words(run, i))
        speed, pull = run.channel.control.handwheel_offset(run.channel, i)
        shift = way / run.display.machine_factor(i, run.execution.context)
        run.interpolator.shift_by_hand(i, shift, speed, pull)

    def home(self, axis: str | None, *, channel: int) -> None:
        """Approach the first reference point; with all axes of the channel where none is named."""
        self._permission.ask(Command.HOME)
        run = self._runs.named(channel)
        named = range(len(run.channel.axes)) if axis is None else (self._axis(axis, channel)[1],)
        self._permission.ask_machine(*(f"HOME_{run.channel.axes[i]}" for i in named))
        self._take_in_hand(run)
        together = run.channel.control.moved_together
        for i in sorted({column for each in named for column in together(run.channel, each)}):
            data = run.channel.axis_data[i]
            run.axes.forget_shift(i)
            run.axes[i].hand.bound(
                -inf, inf
            )  # a reference point beyond the software limits is reached all the same
            speed = partial(self._switches.rapid_speed, data)
            run.axes[i].hand.towards(data.reference_points[0], speed, self._clock.time)

    def preset(self, axis: str, shown: float, *, channel: int) -> None:
        """Call the place where an axis stands another one, as the machine display counts (SINUMERIK's PRESET)."""
        self._permission.ask(Command.PRESET)
        run, i = self._axis(axis, channel)
        if not run.channel.control.presets_by_hand:
            raise CommandRefused("mainrun.no-preset")
        if not abs(shown) <= ENDLESS:
            raise CommandRefused("mainrun.value", name="value", allowed=f"±{ENDLESS:g}", value=shown)
        if self._runs.move or self._runs.move_by_hand:
            raise CommandRefused("mainrun.moving")
        context, place = run.execution.context, run.machine_position
        if context.transformation is not None:
            raise CommandRefused("mainrun.preset-transformed", axis=axis.upper())
        place[i] = shown / run.display.machine_factor(i, context)
        run.stand_at(place)
        self._prepare(run)

    def _shift(self, run: ChannelRun, axis: int, shown: float, *, rapid: bool) -> None:
        self._permission.ask_machine(*_move_words(run, axis))
        here = self._take_in_hand(run)
        factor = run.display.machine_factor(axis, run.execution.context)
        if (line := self._line(run, axis, here)) is not None:
            line.send(shown / factor, self._speed(run, axis, rapid=rapid), self._clock.time)
            return
        about_tip = self._about_tip(run, axis, here, others=True)
        for i, hand in _hands(run, axis):
            target = hand.goal(here[i]) + shown / factor
            self._send(run, i, target, self._speed(run, i, rapid=rapid), about_tip)

    def _send(
        self,
        run: ChannelRun,
        axis: int,
        target: float,
        speed: Callable[[], float],
        about_tip: AboutTip | None,
    ) -> None:
        """An axis goes to a target, so far and so fast as the others stand it."""
        if about_tip is not None:
            target, _ = about_tip.reach(axis, target, speed())
            speed = partial(about_tip.fastest, axis, target, speed)
        run.axes[axis].hand.towards(target, speed, self._clock.time)

    def _speed(self, run: ChannelRun, axis: int, *, rapid: bool) -> Callable[[], float]:
        """How fast an axis goes, asked again when an override turns."""
        what, place = self._what(run, axis)
        return partial(self._switches.hand_speed, run, axis, what, place, rapid=rapid)

    def _what(self, run: ChannelRun, axis: int) -> tuple[HandMotion, int]:
        """What an axis is while it is moved by hand, and which one of those."""
        geometry = run.display.geometry
        if axis in geometry and self._system:
            return "geometry", geometry.index(axis)
        if run.channel.axis_data[axis].rotary and self._turns_about_tip(run):
            rotary = [i for i, data in enumerate(run.channel.axis_data) if data.rotary]
            return "orientation", rotary.index(axis)
        return "axis", axis

    def _turns_about_tip(self, run: ChannelRun) -> bool:
        is_on = run.execution.modal.get("transformation") == TURNS_ABOUT_TIP
        return is_on and not self._signals[IN_MACHINE_SYSTEM]

    @property
    def _system(self) -> str:
        """The system, beside that of the machine, in which geometry axes are moved; empty for none."""
        if self._signals[IN_MACHINE_SYSTEM]:
            return ""
        return next((each for each in (IN_TOOL_SYSTEM, IN_WORK_SYSTEM) if self._signals[each]), "")

    def _line(self, run: ChannelRun, axis: int, here: list[float]) -> AlongLine | None:
        """What leads axes along an axis of the work or the tool, or with one that they follow; None for one alone."""
        system, geometry = self._system, run.display.geometry
        in_system = bool(system) and axis in geometry
        followed = [] if in_system else _with_followers(run, here, axis)
        if not in_system and not followed:
            return None
        led = run.axes.led
        if any(each.hand.moves for each in run.axes):
            if isinstance(led, AlongLine) and led.turns and led.column == axis:
                return led
            raise CommandRefused("mainrun.moving")
        if in_system:
            x, y, z = (float(axis == each) for each in geometry)
            find = _along_tool if system == IN_TOOL_SYSTEM else _along_work
            followed = _with_partners(run, find(run, here, (x, y, z)))
        line = AlongLine(tuple(run.axes), followed, here, axis)
        words = [word for i in line.moved for word in _move_words(run, i)]
        self._permission.ask_machine(*dict.fromkeys(words))
        line.lead(self._clock.time)
        run.axes.led = line
        return line

    def _about_tip(self, run: ChannelRun, axis: int, here: list[float], *, others: bool) -> AboutTip | None:
        """What leads the linear axes when a rotary one is turned while TRAORI is active; None where nothing does.

        By keys one orientation axis moves at a time; the handwheel moves several (`others`).
        """
        is_rotary = run.channel.axis_data[axis].rotary
        leading = run.axes.led
        if isinstance(leading, AlongLine):
            if leading.turns:
                raise CommandRefused("mainrun.moving")
            leading = None
        if leading is not None and leading.turns and not (is_rotary and others):
            if run.axes[axis].hand.moves:
                return leading
            raise CommandRefused("mainrun.moving")
        if not is_rotary or not self._turns_about_tip(run):
            return None
        if leading is None or not leading.turns:
            if any(each.hand.moves for each in run.axes):
                raise CommandRefused("mainrun.moving")
            leading = AboutTip(tuple(run.axes), run.display, run.execution.context, here, self._clock.time)
            leading.lead()
            run.axes.led = leading
        return leading

    def _take_in_hand(self, run: ChannelRun) -> list[float]:
        """Machine position from which axes of a channel are moved by hand."""
        if self._runs.move:
            raise CommandRefused("mainrun.moving")
        self._ask_test()
        run.take_in_hand(run.machine_position)
        for column, axis in enumerate(run.axes):
            axis.hand.bound(*run.channel.control.hand_range(run.channel, column))
        if run.axes.led is not None and not run.axes.led.turns:
            run.axes.settle()
        return run.machine_position

    def _ask_test(self) -> None:
        """While a program is tested the axes stand, and what the displays show of them is the test's."""
        if self._switches.tests:
            raise CommandRefused("mainrun.tested")

    def _axis(self, name: str, channel: int) -> tuple[ChannelRun, int]:
        run = self._runs.named(channel)
        index = run.channel.axis_index.get(name.upper())
        if index is None:
            raise CommandRefused("mainrun.axis", axis=name, known=listed(run.channel.axes))
        owner = self._runs.group.owner[run.channel.axis_data[index].name]
        if owner not in (0, channel):
            raise CommandRefused("mainrun.value", name="channel", allowed=str(owner), value=channel)
        return run, index


def _along_work(run: ChannelRun, here: Sequence[float], direction: Vector) -> list[float]:
    """How far each axis goes for a millimetre along an axis of the work; refused where they do not go evenly."""
    display, context = run.display, run.execution.context
    path, along = display.on_path(here, context), unit(context.frame.direct(*direction))

    def real(way: float) -> list[float]:
        point = list(path)
        for column, share in zip(display.geometry, along, strict=True):
            if column >= 0:
                point[column] += way * share
        return display.real(point, context)

    start, ways = real(0.0), [b - a for a, b in zip(real(0.0), real(1.0), strict=True)]
    for at, way, there in zip(start, ways, real(TRIAL_MM), strict=True):
        if abs(there - at - TRIAL_MM * way) > STRAIGHT_MM:
            raise CommandRefused("mainrun.no-line")
    return ways


def _along_tool(run: ChannelRun, here: Sequence[float], direction: Vector) -> list[float]:
    """The same along an axis of the tool, which the head has turned."""
    turn = Kinematics.of(run.channel.machine).head_turn(dict(zip(run.channel.axes, here, strict=True)))
    ways = [0.0] * len(here)
    for column, share in zip(run.display.geometry, turn.direct(*direction), strict=True):
        if column >= 0:
            ways[column] = share
    return ways


def _with_partners(run: ChannelRun, ways: list[float]) -> list[float]:
    """With the axes that go together with others (gantries)."""
    for column, way in enumerate(tuple(ways)):
        if abs(way) > NO_WAY:
            for other in run.channel.control.moved_together(run.channel, column):
                ways[other] = way
    return ways


def _with_followers(run: ChannelRun, here: Sequence[float], axis: int) -> list[float]:
    """How far each axis goes for a millimetre of one that leads others; empty where none but its partners goes with it.

    Refused where they do not go evenly: curve tables lead no axis by hand.
    """
    seated = run.execution.context.transformation
    if not isinstance(seated, Seated) or not seated.is_coupled:
        return []
    ways, there = (
        [b - a for a, b in zip(here, seated.carried(here, axis, way), strict=True)] for way in (1.0, TRIAL_MM)
    )
    if any(abs(far - TRIAL_MM * way) > STRAIGHT_MM for way, far in zip(ways, there, strict=True)):
        raise CommandRefused("mainrun.no-line")
    moved = {column for column, way in enumerate(ways) if abs(way) > NO_WAY}
    return ways if moved - set(run.channel.control.moved_together(run.channel, axis)) else []


def _hands(run: ChannelRun, axis: int) -> list[tuple[int, Hand]]:
    """What moves an axis, and those that go with it, by hand."""
    return [(i, run.axes[i].hand) for i in run.channel.control.moved_together(run.channel, axis)]


def _move_words(run: ChannelRun, axis: int) -> list[str]:
    """What an axis that is to move asks the machine for."""
    channel = run.channel
    rotary = [i for i, data in enumerate(channel.axis_data) if data.rotary]
    words = [f"MOVE_{channel.axes[axis]}"]
    words += ["MOVE_FIFTH_AXIS"] if axis in rotary[1:2] else []
    others = any(other.hand.moves for column, other in enumerate(run.axes) if column != axis)
    return words + (["MOVE_SECOND_AXIS"] if others else [])
