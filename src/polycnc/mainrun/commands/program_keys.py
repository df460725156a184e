"""Programs: loading, typing in, searching, teaching; start, hold and reset; power and modes."""

from __future__ import annotations

from polycnc.control.alarm_text import catalogue_of
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.search import ProgramTest, SearchMode, Wanted, at_line, search
from polycnc.mainrun.commands.states import Command, Mode, State
from polycnc.mainrun.errors import CommandRefused, OutOfPlace, SearchStopped
from polycnc.mainrun.execution.operation import AT_END
from polycnc.mainrun.signals.machine_states import axis_names

if TYPE_CHECKING:
    from pathlib import Path

    from polycnc.mainrun.commands.permission import Permission
    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.execution.operation import Operation
    from polycnc.mainrun.preparation.items import Places
    from polycnc.program import Program


class ProgramCommands:
    """What an operator does with programs, and with the control as a whole.

    Args:
        operation: The channels, and what the control does with them.
        programs: What is loaded.
        permission: Asked in front of every command.
    """

    def __init__(self, operation: Operation, programs: Programs, permission: Permission) -> None:
        self._operation = operation
        self._programs = programs
        self._permission = permission
        self._status, self._signals = operation.status, operation.signals
        self._typed: dict[int, Program] = {}
        self._tape: dict[int, Program] = {}

    # ---- programs ------------------------------------------------------------------------------------------

    def load(self, source: str | bytes | Path, channel: int) -> None:
        """Load a program into a channel."""
        self._permission.ask(Command.LOAD)
        runs = self._operation.runs
        number = runs.named(channel).number
        program = self._programs.load(source, number)
        runs[number].reached.clear()
        self._signals[AT_END] = 0.0
        for run in runs:
            run.channel.store = self._programs.store
        runs.group.select(number, program)

    def select(self, program: Program, channel: int) -> None:
        """A program of the memory becomes the main program of a channel."""
        number = self._operation.runs.named(channel).number
        self._programs.select(program, number)
        self._signals[AT_END] = 0.0
        self._operation.runs.group.select(number, program)

    def load_tape(self, source: str | bytes | Path, channel: int) -> None:
        """Give the program of a channel that comes from outside."""
        self._permission.ask(Command.LOAD)
        self._tape[self._operation.runs.named(channel).number] = self._programs.from_outside(source)

    def mdi(self, text: str, channel: int) -> None:
        """Type blocks in for a channel and start them."""
        self._permission.ask(Command.MDI)
        self._typed = {self._operation.runs.named(channel).number: self._programs.typed(text)}
        self.cycle_start()

    def teach(self, words: str, line: int | None, channel: int) -> str:
        """Write a block with the present position into the program that is loaded in a channel."""
        self._permission.ask(Command.TEACH)
        operation = self._operation
        position = operation.positions(operation.runs.named(channel)).work
        block = " ".join(filter(None, (words, *(_word(a, v) for a, v in position.items()))))
        self._programs.insert(block, line, channel)
        return block

    def block_search(self, target: int | str | Places, channel: int, how: SearchMode) -> None:
        """Search a block: with calculation, up to its beginning or its end, or without."""
        self._permission.ask(Command.BLOCK_SEARCH)
        operation = self._operation
        if operation.runs.move_by_hand:
            raise CommandRefused("mainrun.moving")
        run = operation.runs.named(channel)
        program = self._programs.main(channel)
        wanted, named = self._wanted(target, channel)
        line = wanted.levels[0][1]
        here = run.machine_position
        operation.program_mode = Mode.AUTO
        if how is SearchMode.TEST:
            self._test(ProgramTest(channel, wanted, tuple(here), named), program)
            return
        operation.prepare(run)
        run.machinery.reset()
        operation.mains = {channel}
        if how is SearchMode.WITHOUT:
            if wanted.levels[1:] or not 0 <= line - program.first_line < len(program.lines):
                raise CommandRefused("mainrun.search", target=named)
            run.preprocessing.start(program, here, at_line(line))
            operation.collected, operation.searched = {}, True
            self._status.become(State.STOPPED, halt="search")
            return
        run.preprocessing.start(program, here)
        run.channel.is_searched, run.preprocessing.sought = True, wanted.levels[-1]
        found = search(run.preprocessing, wanted, behind=how is SearchMode.END_POINT)
        run.channel.is_searched, run.preprocessing.sought = False, None
        if found is None:
            alarms = list(run.channel.alarms)
            operation.give_up()
            if alarms:
                texts = catalogue_of(operation.control, run.channel.machine)
                raise SearchStopped(named, alarms[0].told_by(texts))
            raise wanted.missed(named)
        run.execution.stand_before(found.position, found.context, found.modal)
        run.take_in_hand(here)
        operation.collected, operation.searched = {channel: found.functions}, True
        self._status.become(State.STOPPED, halt="search")

    def _wanted(self, target: int | str | Places, channel: int) -> tuple[Wanted, int | str]:
        """The block that is looked for, and what it is called."""
        if not isinstance(target, int | str):
            try:
                levels = tuple((str(name), int(line)) for name, line in target)
                return Wanted(levels), levels[-1][1]
            except (TypeError, ValueError, IndexError):
                raise CommandRefused("mainrun.search", target=target) from None
        place = self._programs.main(channel).name, self._programs.line_of(target, channel)
        return Wanted((place,)), target

    def _test(self, test: ProgramTest, program: Program) -> None:
        """Run a program to a block while the axes stand."""
        line = test.wanted.levels[0][1]
        if not 0 <= line - program.first_line < len(program.lines):
            raise CommandRefused("mainrun.search", target=line)
        operation = self._operation
        operation.mains = {test.channel}
        preprocessing = operation.begin_test(test).preprocessing
        preprocessing.start(program, list(test.here))
        preprocessing.sought = test.wanted.levels[-1]
        operation.resume()

    # ---- running -------------------------------------------------------------------------------------------

    def cycle_start(self) -> None:
        """Start the program, or go on with it after a hold, a stop or a single block.

        Channels that stand while others wait for them go on too: the control is not at rest then.
        """
        operation, mode = self._operation, self._status.mode
        if self._status.state is State.RUNNING and mode is operation.program_mode and operation.has_halted:
            self._permission.ask_machine("CYCLE_START")
            operation.go_on_halted()
            return
        self._permission.ask(Command.CYCLE_START)
        if operation.runs.move_by_hand:
            raise CommandRefused("mainrun.moving")
        if self._status.state is State.READY:
            self._start()
        elif mode is Mode.MDI and operation.program_mode is not Mode.MDI and self._may_intervene:
            self._intervene()
        elif mode is not operation.program_mode:
            raise CommandRefused("mainrun.other-mode", mode=operation.program_mode)
        else:
            self._permission.ask_machine("CYCLE_START")
            returns = operation.searched or any(
                run.preprocessing.returns_to_path for run in operation.runs if run.is_active
            )
            if operation.runs.left_path and returns:
                operation.lead_back()
            else:
                operation.go_on_from_here()

    def _start(self) -> None:
        """A program begins from its top."""
        operation, mode = self._operation, self._status.mode
        programs = {Mode.MDI: self._typed, Mode.TAPE: self._tape}.get(mode, self._programs.mains)
        if not programs:
            raise CommandRefused("mainrun.no-program")
        if mode is Mode.AUTO and self._signals[AT_END]:
            raise CommandRefused("mainrun.at-end")
        self._permission.ask_machine("CYCLE_START")
        operation.program_mode = mode
        self._status.pulse("STARTED")
        operation.set_rates()
        operation.mains = set(programs)
        for number in sorted(programs):
            run = operation.runs.named(number)
            operation.prepare(run)
            run.machinery.reset()
            if (
                mode is not Mode.MDI
            ):  # a tool is changed by hand, and the search finds the point of interruption
                run.reached.clear()
            run.preprocessing.start(programs[number], run.execution.position)
        operation.resume()

    @property
    def _may_intervene(self) -> bool:
        """Whether blocks that are typed in can be run in the midst of a program."""
        return self._operation.control.mdi_intervenes and self._status.state is State.STOPPED

    def _intervene(self) -> None:
        """Run what was typed in while a program waits (FANUC 0i-TF Plus II.5.4.7, MDI intervention)."""
        operation = self._operation
        active = [run.number for run in operation.runs if run.is_active]
        if active != list(self._typed) or operation.searched:
            raise CommandRefused("mainrun.prepared", mode=operation.program_mode)
        run = operation.runs[active[0]]
        if not run.preprocessing.is_bare:
            raise CommandRefused("mainrun.prepared", mode=operation.program_mode)
        self._permission.ask_machine("CYCLE_START")
        operation.waiting_mode, operation.program_mode = operation.program_mode, Mode.MDI
        operation.switches.apply_to(run.channel, typed=True)
        run.preprocessing.intervene(self._typed[run.number])
        operation.go_on_from_here()

    def feed_hold(self) -> None:
        """Bring the axes to rest on the path."""
        self._permission.ask(Command.FEED_HOLD)
        self._operation.hold()

    def reset(self) -> None:
        """Give the program up."""
        status = self._status
        if status.is_locked:
            raise OutOfPlace(Command.RESET, status.mode, status.state)
        self._operation.brake(State.BRAKING)

    # ---- power, modes, keys --------------------------------------------------------------------------------

    def emergency_stop(self, *, pressed: bool = True) -> None:
        """Press the emergency stop, or pull it out again."""
        state = self._status.state
        if state is not State.OFF and pressed:
            self._operation.brake(State.EMERGENCY)
        elif state is State.EMERGENCY:
            self._operation.brake(State.BRAKING)

    def power_off(self) -> None:
        """Switch off."""
        if self._status.state is State.OFF:
            return
        self._operation.brake(State.OFF)
        for rule in self._operation.machine.plc(self._operation.control.id).rules:
            if rule.latch:
                self._signals[rule.output] = 0.0

    def power_on(self) -> None:
        """Switch on again."""
        if self._status.state is not State.OFF:
            return
        runs = self._operation.runs
        if self._signals["INCREMENTAL_ENCODERS"]:
            for axis in {axis for run in runs for axis in axis_names(run.channel)}:
                self._signals[f"NOT_REFERENCED_{axis}"] = 1.0
        for run in runs:
            run.forget_shift()
        self._operation.starts_up = True
        self._operation.brake(State.BRAKING)

    def key(self, name: str, *, pressed: bool) -> None:
        """Press a key of the machine panel, or let it go."""
        if pressed:
            self._permission.ask_machine(f"KEY_{name}")
        self._signals[f"KEY_{name}"] = float(pressed)

    def select_mode(self, wanted: Mode) -> None:
        """Turn the mode switch."""
        self._permission.ask(Command.SELECT_MODE)
        if wanted is not self._status.mode:
            self._permission.ask_machine(f"MODE_{wanted.upper()}")
            if self._status.state is State.RUNNING:
                self.feed_hold()
            self._operation.runs.brake_hands()
            self._status.turn_to(wanted)
            for run in self._operation.runs:
                run.interpolator.runs_programs = wanted is self._operation.program_mode
                run.interpolator.wake()


def _word(axis: str, value: float) -> str:
    """A position word with its decimal point."""
    number = f"{value + 0.0:.4f}".rstrip("0")
    return f"{axis}={number}" if axis[-1].isdigit() else f"{axis}{number}"
