"""The axes by hand: jog, steps, handwheel, reference approach."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.mainrun.axes.about_tip import AboutTip
from polycnc.mainrun.commands.states import PROGRAM_MODES, Command
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from polycnc.mainrun.axes.hand import Hand
    from polycnc.mainrun.commands.permission import Permission
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.mainrun.execution.operation import Operation

#: The code under which rotary axes turn the tool about its tip.
TURNS_ABOUT_TIP = "TRAORI"
#: A signal: axes are moved by hand in the machine coordinate system, each by itself.
IN_MACHINE_SYSTEM = "JOG_MCS"


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

    def jog(self, axis: str, direction: int, *, rapid: bool, channel: int) -> None:
        """Press a jog key."""
        self._permission.ask(Command.JOG)
        run, i = self._axis(axis, channel)
        self._permission.ask_machine(*_move_words(run, i))
        here, data = self._take_in_hand(run), run.channel.axis_data[i]
        speed = self._switches.rapid_speed(data) if rapid else self._switches.jog_speed(data)
        about_tip = self._about_tip(run, i, here, others=False)
        for axis_, hand in _hands(run, i):
            target = hand.end_of_travel(direction, here[axis_])
            self._send(run, axis_, target, speed, about_tip)

    def stop_jog(self, axis: str | None, *, channel: int) -> None:
        """Let a jog key go; all of them where no axis is named."""
        if axis is None:
            self._runs.brake_hands()
        else:
            run, i = self._axis(axis, channel)
            for _, hand in _hands(run, i):
                hand.brake(self._clock.time)

    def increment(self, axis: str, way: float, *, channel: int) -> None:
        """Move by a way, as the machine display counts."""
        self._permission.ask(Command.INCREMENT)
        run, i = self._axis(axis, channel)
        self._shift(run, i, way, self._switches.jog_speed(run.channel.axis_data[i]))

    def handle(self, axis: str, way: float, *, channel: int) -> None:
        """Turn the handwheel by a way, as the machine display counts."""
        if self._switches.panel.drf and self._status.mode in PROGRAM_MODES:
            self._offset(axis, way, channel)
            return
        self._permission.ask(Command.HANDLE)
        run, i = self._axis(axis, channel)
        self._shift(run, i, way, self._switches.rapid_speed(run.channel.axis_data[i]))

    def _offset(self, axis: str, way: float, number: int) -> None:
        """Shift an axis beside the program that runs, or may run (DRF)."""
        self._permission.ask(Command.HANDWHEEL_OFFSET)
        run, i = self._axis(axis, number)
        self._permission.ask_machine(*_move_words(run, i))
        speed = run.channel.control.handwheel_offset_speed(run.channel, i)
        shift = way / run.display.machine_factor(i, run.execution.context)
        run.interpolator.shift_by_hand(i, shift, speed)

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
            speed = self._switches.rapid_speed(data)
            run.axes[i].hand.towards(data.reference_points[0], speed, self._clock.time)

    def _shift(self, run: ChannelRun, axis: int, shown: float, speed: float) -> None:
        self._permission.ask_machine(*_move_words(run, axis))
        here = self._take_in_hand(run)
        factor = run.display.machine_factor(axis, run.execution.context)
        about_tip = self._about_tip(run, axis, here, others=True)
        for i, hand in _hands(run, axis):
            self._send(run, i, hand.goal(here[i]) + shown / factor, speed, about_tip)

    def _send(
        self, run: ChannelRun, axis: int, target: float, speed: float, about_tip: AboutTip | None
    ) -> None:
        """An axis goes to a target, so far and so fast as the others stand it."""
        if about_tip is not None:
            target, speed = about_tip.reach(axis, target, speed)
        run.axes[axis].hand.towards(target, speed, self._clock.time)

    def _about_tip(self, run: ChannelRun, axis: int, here: list[float], *, others: bool) -> AboutTip | None:
        """What leads the linear axes when a rotary one is turned while TRAORI is active; None where nothing does.

        By keys one orientation axis moves at a time; the handwheel moves several (`others`).
        """
        is_rotary = run.channel.axis_data[axis].rotary
        leading = run.axes.about_tip
        if leading is not None and leading.turns and not (is_rotary and others):
            if run.axes[axis].hand.moves:
                return leading
            raise CommandRefused("mainrun.moving")
        if not is_rotary:
            return None
        if run.execution.modal.get("transformation") != TURNS_ABOUT_TIP or self._signals[IN_MACHINE_SYSTEM]:
            return None
        if leading is None or not leading.turns:
            if any(each.hand.moves for each in run.axes):
                raise CommandRefused("mainrun.moving")
            leading = AboutTip(tuple(run.axes), run.display, run.execution.context, here, self._clock.time)
            leading.lead()
            run.axes.about_tip = leading
        return leading

    def _take_in_hand(self, run: ChannelRun) -> list[float]:
        """Machine position from which axes of a channel are moved by hand."""
        if self._runs.move:
            raise CommandRefused("mainrun.moving")
        run.take_in_hand(run.machine_position)
        if run.axes.about_tip is not None and not run.axes.about_tip.turns:
            run.axes.settle()
        return run.machine_position

    def _axis(self, name: str, channel: int) -> tuple[ChannelRun, int]:
        run = self._runs.named(channel)
        index = run.channel.axis_index.get(name.upper())
        if index is None:
            raise CommandRefused("mainrun.axis", axis=name, known=listed(run.channel.axes))
        owner = self._runs.group.owner[run.channel.axis_data[index].name]
        if owner not in (0, channel):
            raise CommandRefused("mainrun.value", name="channel", allowed=str(owner), value=channel)
        return run, index


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
