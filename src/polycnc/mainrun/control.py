"""A virtual control: what an operator's panel, a factory system or a Python program talk to.

    control = VirtualControl("fanuc-m")
    control.load("O1 ...")
    control.cycle_start()
    control.step(0.5)
    control.positions.work, control.state

Time is simulated and passes only in `step`, `run` and `run_until`; commands act at the moment at which the clock
stands. The same commands at the same times give the same trace, bit for bit.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from math import ceil, inf
from typing import TYPE_CHECKING, Any

from polycnc.mainrun.byhand import ByHand
from polycnc.mainrun.commands.programs import forget_skipped
from polycnc.mainrun.commands.search import search
from polycnc.mainrun.commands.states import Command, Mode, State, is_allowed
from polycnc.mainrun.core import AT_END, LOCKED_STATES, MANUAL_ABSOLUTE, SINGLE_BLOCK_KINDS
from polycnc.mainrun.errors import CommandRefused
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

#: Lowest and highest overrides, 1 for 100 % (Hartford manual, operator panel).
FEED_RANGE, RAPID_RANGE, SPINDLE_RANGE = (0.0, 2.0), (0.0, 1.0), (0.5, 1.2)
#: Switches that keep axes from moving.
LOCKS = ("machine_lock", "z_lock")
#: Cycles that a program runs at least before anybody looks, where nobody has to.
FREE_CYCLES = 256
#: A run without limit ends after a day.
LONGEST_RUN_S = 86400.0


class VirtualControl(ByHand):
    """One control with its machine, from power-on.

    Args:
        control: Control id.
        machine: Built-in machine or machine file; the setup's, or else the control's usual one.
        setup: Offsets, tools, parameters, inputs: what a case writes under `setup`, or a file with that.
        search: Folders in which calls look for subprograms.
        files: Further programs as texts, by name.

    Raises:
        CommandRefused: There is no such control.
        FileError: The machine or the setup is wrong.
    """

    # ---- programs ------------------------------------------------------------------------------------------

    def load(self, source: str | bytes | Path) -> None:
        """Load a program: a file, or the text itself (`bytes`, or a `str` with line ends).

        Raises:
            CommandRefused: A program runs.
            ProgramFileError: The file cannot be read.
        """
        self._ask(Command.LOAD)
        self._programs.load(source)
        self._signals[AT_END] = 0.0
        for run in self._runs.values():
            run.channel.store = self._programs.store

    def load_tape(self, source: str | bytes | Path) -> None:
        """Give the program that comes from outside in mode `tape`: tape, DNC, memory card. Sources as for `load`.

        Raises:
            CommandRefused: A program runs.
            ProgramFileError: The file cannot be read.
        """
        self._ask(Command.LOAD)
        self._tape = self._programs.from_outside(source)

    def mdi(self, text: str) -> None:
        """Type blocks in and start them; allowed in MDI mode. What they change stays.

        While a program waits at a stop or in single block, they are run in its midst (MDI intervention; not on
        SINUMERIK and SYNTEC): it goes on behind them, from where the axes then are, with the codes that then hold.

        Raises:
            CommandRefused: Out of place; or blocks of a waiting program are prepared already, or read ahead for
                compensation.
        """
        self._ask(Command.MDI)
        self._typed = self._programs.typed(text)
        self.cycle_start()

    def teach(self, words: str = "", *, line: int | None = None) -> str:
        """Write a block with the present position into the loaded program; allowed in teach-in.

        Args:
            words: What stands in front of the position (`G1`).
            line: Line of the file behind which the block goes; behind the one taught last, or the last line.

        Returns:
            The block.
        """
        self._ask(Command.TEACH)
        block = " ".join(filter(None, (words, *(_word(a, v) for a, v in self.positions.work.items()))))
        self._programs.insert(block, line)
        return block

    def block_search(self, target: int | str) -> None:
        """Search a block with calculation: a line of the main program, or a block number such as `N50`.

        Everything before it is calculated without motion. Cycle start puts out the auxiliary functions that hold there,
        leads the axes to where the block begins, and goes on with it.

        Raises:
            CommandRefused: The program ends before it.
        """
        self._ask(Command.BLOCK_SEARCH)
        if self._by_hand:
            raise CommandRefused("mainrun.moving")
        program = self._programs.main
        line = self._programs.line_of(target)
        if program is None:
            raise CommandRefused("mainrun.no-program")
        here = self.machine_position
        self._program_mode = Mode.AUTO
        self._prepare(self._run)
        self._machinery.reset()
        self._preprocessing.start(program, here)
        found = search(self._preprocessing, program.name, line)
        if found is None:
            self._give_up()
            raise CommandRefused("mainrun.search", target=target)
        self._run.manual.begin(here)
        self._execution.position = found.position
        self._execution.context = self._execution.place = found.context
        self._execution.modal = found.modal
        self._collected, self._searched = found.functions, True
        self._set_state(State.STOPPED, halt="search")

    # ---- running -------------------------------------------------------------------------------------------

    def cycle_start(self) -> None:
        """Start the program, or go on with it after a hold, a stop or a single block.

        Axes that were moved by hand meanwhile go back to where the program stands first, or the program goes on from
        where they are: as the control has it, and the signal `MANUAL_ABSOLUTE` says (`mainrun/axes/manual_offset.py`).
        """
        self._ask(Command.CYCLE_START)
        if self._by_hand:
            raise CommandRefused("mainrun.moving")
        if self.state is State.READY:
            sources = {Mode.MDI: self._typed, Mode.TAPE: self._tape}
            program = sources.get(self.mode, self._programs.main)
            if program is None:
                raise CommandRefused("mainrun.no-program")
            if self.mode is Mode.AUTO and self._signals[AT_END]:
                raise CommandRefused("mainrun.at-end")
            self._ask_machine("CYCLE_START")
            self._program_mode = self.mode
            self._pulse("STARTED")
            self._set_rates()
            self._prepare(self._run)
            self._machinery.reset()
            self._preprocessing.start(program, self._execution.position)
            self._resume()
        elif self.mode is Mode.MDI and self._program_mode is not Mode.MDI and self._may_intervene:
            self._intervene()
        elif self.mode is not self._program_mode:
            raise CommandRefused("mainrun.other-mode", mode=self._program_mode)
        else:
            self._ask_machine("CYCLE_START")
            if self._left_path and (self._searched or self._preprocessing.returns_to_path):
                self._lead_back()
                return
            self._go_on_from_here()

    def _go_on_from_here(self) -> None:
        """The program goes on from where an operator has left the axes."""
        for run in self._runs.values():
            run.intervene(absolute=bool(self._signals[MANUAL_ABSOLUTE]))
        self._resume()

    @property
    def _may_intervene(self) -> bool:
        """Whether blocks that are typed in can be run in the midst of a program."""
        return self.control.mdi_intervenes and self.state is State.STOPPED

    def _intervene(self) -> None:
        """Run what was typed in while a program waits (FANUC 0i-TF Plus II.5.4.7, MDI intervention)."""
        others = any(run.is_active for run in self._runs.values() if run is not self._run)
        if self._typed is None or self._searched or others or not self._preprocessing.is_bare:
            raise CommandRefused("mainrun.prepared", mode=self._program_mode)
        self._ask_machine("CYCLE_START")
        self._waiting_mode, self._program_mode = self._program_mode, Mode.MDI
        self._apply_switches(self.channel)
        self._preprocessing.intervene(self._typed)
        self._go_on_from_here()

    def _lead_back(self) -> None:
        """Axes that were moved by hand go to where the program waits, which then goes on."""
        self._set_state(State.RUNNING)
        for happening in self._collected:
            self._machinery.perform(happening)
        self._collected = []
        self._returning = True
        for run in self._runs.values():
            if run.manual.place is not None:
                for axis, target in enumerate(run.real):
                    run.manual.towards(axis, target, self._jog_speed(run, axis), self.time)

    def feed_hold(self) -> None:
        """Bring the axes to rest on the path; a thread is finished first."""
        self._ask(Command.FEED_HOLD)
        if self.state is State.RUNNING:
            self._rates.hold = True
            self._revise()
            self._brake_hands()
            self._returning = False
            self._set_state(State.HOLD)

    def reset(self) -> None:
        """Give the program up: the axes brake, alarms go, modal states become those after reset."""
        if self.state in LOCKED_STATES:
            raise CommandRefused("mainrun.refused", command=Command.RESET, mode=self.mode, state=self.state)
        self._brake(State.BRAKING)

    def emergency_stop(self, *, pressed: bool = True) -> None:
        """Press the emergency stop, or pull it out again: then the control is as after reset."""
        if self.state is State.OFF:
            return
        if pressed:
            self._brake(State.EMERGENCY)
        elif self.state is State.EMERGENCY:
            self._brake(State.BRAKING)

    def power_off(self) -> None:
        """Switch off: the axes come to rest, outputs drop. Programs, offsets and variables stay."""
        if self.state is State.OFF:
            return
        self._brake(State.OFF)
        for rule in self.control.plc.rules:
            if rule.latch:
                self._signals[rule.output] = 0.0

    def power_on(self) -> None:
        """Switch on again: as after reset; machines without absolute encoders have to return to their references."""
        if self.state is not State.OFF:
            return
        if self._signals["INCREMENTAL_ENCODERS"]:
            for axis in self.channel.axes:
                self._signals[f"NOT_REFERENCED_{axis}"] = 1.0
        for run in self._runs.values():
            run.forget_shift()
        self._brake(State.BRAKING)

    def key(self, name: str, *, pressed: bool = True) -> None:
        """Press a key of the machine panel by its name in the machine's rules (`B3`, `D1`), or let it go.

        Raises:
            CommandRefused: The machine refuses it; where that is an alarm, it has come.
        """
        if pressed:
            self._ask_machine(f"KEY_{name}")
        self._signals[f"KEY_{name}"] = float(pressed)

    def _press(self, key: str) -> None:
        press = {
            "CYCLE_START": self.cycle_start,
            "FEED_HOLD": self.feed_hold,
            "RESET": self.reset,
            "EMERGENCY_STOP": self.emergency_stop,
            "POWER_OFF": self.power_off,
        }[key]
        with suppress(CommandRefused):  # a key that cannot act now does nothing
            press()

    # ---- by hand -------------------------------------------------------------------------------------------

    def select_mode(self, mode: Mode | str) -> None:
        """Turn the mode switch. A running program is held; it goes on in the same mode after cycle start."""
        wanted: Mode = _one_of(Mode, "mode", mode)
        self._ask(Command.SELECT_MODE)
        if wanted is not self.mode:
            self._ask_machine(f"MODE_{wanted.upper()}")
            if self.state is State.RUNNING:
                self.feed_hold()
            self._brake_hands()
            self._signals[self.mode.upper()] = 0.0
            self.mode = wanted
            self._signals[wanted.upper()] = 1.0
            self._report("mode", mode=wanted)

    # ---- switches ------------------------------------------------------------------------------------------

    def override(
        self, *, feed: float | None = None, rapid: float | None = None, spindle: float | None = None
    ) -> None:
        """Turn the override switches; 1 is 100 %. They act at once, within what the axes can do."""
        new = {"feed": (feed, FEED_RANGE), "rapid": (rapid, RAPID_RANGE), "spindle": (spindle, SPINDLE_RANGE)}
        for name, (value, (low, high)) in new.items():
            if value is not None and not low <= value <= high:
                raise CommandRefused("mainrun.value", name=name, allowed=f"{low:g} … {high:g}", value=value)
        for name, (value, _) in new.items():
            if value is not None:
                setattr(self._dials, name, float(value))
                self._report("override", name=name, value=float(value))
        self._set_rates()
        self._set_hand_speeds()

    def set_switches(self, **changes: Any) -> None:
        """Turn panel switches, by the names of `PanelSwitches`.

        `single_block` is `SBL1`, `SBL2`, `SBL3`, or True for the first; `block_skip` True, False, or levels. Optional
        stop and single block act on the block in execution, block skip on blocks that are not prepared yet.
        """
        if "single_block" in changes:
            kind = changes["single_block"]
            changes["single_block"] = "SBL1" if kind is True else kind or ""
            if changes["single_block"] not in SINGLE_BLOCK_KINDS:
                allowed = listed(SINGLE_BLOCK_KINDS[1:])
                raise CommandRefused("mainrun.value", name="single_block", allowed=allowed, value=kind)
        if changes.get("block_skip", self._switches.block_skip) != self._switches.block_skip:
            forget_skipped(self.channel)
        if any(
            changes.get(lock, getattr(self._switches, lock)) != getattr(self._switches, lock)
            for lock in LOCKS
        ):
            self._ask(Command.MACHINE_LOCK)
            self._lock({lock: changes.get(lock, getattr(self._switches, lock)) for lock in LOCKS})
        self._switches = replace(self._switches, **changes)
        self._set_rates()
        for run in self._runs.values():
            run.machinery.optional_stop = self._switches.optional_stop
            run.machinery.mst_lock = self._switches.mst_lock
        for run in self._runs.values():
            run.execution.single_block = bool(self._switches.single_block)
            self._apply_switches(run.channel)
        self._revise()
        self._report("switch", **changes)

    def _lock(self, locks: Mapping[str, bool]) -> None:
        """Locked axes stand while the display runs on; when a lock ends, the display shows the axes again."""
        if self._by_hand:
            raise CommandRefused("mainrun.moving")
        position = self.machine_position
        z = self.machine.geometry_indices(self.channel.number)[2]
        wanted = set(range(len(position))) if locks["machine_lock"] else {z} if locks["z_lock"] else set()
        released = self._locked_at.keys() - wanted
        if released:
            self._run.stand_at(
                [self._locked_at[i] if i in released else value for i, value in enumerate(position)]
            )
            self._prepare(self._run)
        self._locked_at = {i: self._locked_at.get(i, position[i]) for i in wanted}

    # ---- time ----------------------------------------------------------------------------------------------

    def step(self, seconds: float | None = None) -> None:
        """Let time pass: the given seconds in whole interpolation cycles, or one cycle."""
        cycle = self.machine.interpolation_cycle_s
        self._cycles += 1 if seconds is None else max(round(seconds / cycle), 0)
        self._advance(self._cycles * cycle)

    def run(self, *, limit_s: float = LONGEST_RUN_S, real_time: bool = False) -> State:
        """Let time pass until nothing runs any more; gives the state then.

        Args:
            limit_s: No longer than this.
            real_time: As fast as time really passes; else as fast as the computer can.
        """
        self._follow_up()
        if real_time:
            return self._run_in_real_time(limit_s)
        cycle = self.machine.interpolation_cycle_s
        last = self._cycles + ceil(limit_s / cycle)
        while self.is_busy and self._cycles < last and (due := self._due()) < inf:
            if self._runs_freely:
                until = min(max(due, (self._cycles + FREE_CYCLES) * cycle), last * cycle)
                self._execution.advance(until, freely=True)
                due = self.time
            # Whole pieces in one step: nothing can happen before `due` but by a command.
            self._cycles = min(max(ceil(due / cycle - 1e-9), self._cycles + 1), last)
            self._advance(self._cycles * cycle)
        return self.state

    def run_until(self, reached: Callable[[VirtualControl], bool], *, limit_s: float = LONGEST_RUN_S) -> bool:
        """Let time pass, cycle by cycle, until a condition holds; false if it did not within the limit."""
        last = self._cycles + ceil(limit_s / self.machine.interpolation_cycle_s)
        while not reached(self):
            if self._cycles >= last:
                return False
            self.step()
        return True

    def _run_in_real_time(self, limit_s: float) -> State:
        from time import monotonic, sleep

        began, at = monotonic(), self.time
        while self.is_busy and self.time - at < limit_s:
            self.step()
            sleep(max(self.time - at - (monotonic() - began), 0.0))
        return self.state

    def allows(self, command: Command | str) -> bool:
        """Whether a command may be given in this mode and state."""
        return is_allowed(_one_of(Command, "command", command), self.mode, self.state)


def _one_of(kind: Any, name: str, value: object) -> Any:
    try:
        return kind(str(value).lower())
    except ValueError:
        allowed = listed(kind)
        raise CommandRefused("mainrun.value", name=name, allowed=allowed, value=value) from None


def _word(axis: str, value: float) -> str:
    """A position word with its decimal point."""
    number = f"{value + 0.0:.4f}".rstrip("0")
    return f"{axis}={number}" if axis[-1].isdigit() else f"{axis}{number}"
