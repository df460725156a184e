"""A calculation goes on in time: a program that has run so far without a clock needs one from some block on.

Its channels stay what they are, with their rows, variables and program levels; from here on a main run executes what
they write, and actions of the program act on it. So a program that never asks for the clock never pays for one.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.programs import Programs
from polycnc.mainrun.commands.settings import Switches
from polycnc.mainrun.commands.states import State
from polycnc.mainrun.execution.clock import Clock
from polycnc.mainrun.execution.main_loop import LONGEST_RUN_S, MainLoop
from polycnc.mainrun.execution.operation import Operation
from polycnc.mainrun.preparation.items import Move
from polycnc.mainrun.signals.image import SignalImage
from polycnc.mainrun.signals.interlocks import Interlocks
from polycnc.mainrun.status import Status
from polycnc.memory.retained import InMemoryStore
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.group import ChannelGroup

#: A program that has written or executed no row for so long, nor got any further on its path, waits for something that
#: never comes: where other axes move, and where none does. It is looked at as often.
LONGEST_WAIT_S, LONGEST_REST_S, LOOK_S = 300.0, 60.0, 30.0
#: What the setup calls the mode in which programs are typed in.
MDI = "mdi"
#: No row written, nothing prepared, and nowhere.
_NOTHING_DONE: tuple[int, int, list[float]] = -1, -1, []
#: Halts behind which the program does not go on.
OVER = frozenset({"end", "alarm"})


class Continuation:
    """The main run of a calculation, from the block on that needs the clock.

    Where time stands because nothing will ever happen (an override of 0), or nothing gets any further, PC0013 ends it.
    An interpolation cycle in which actions look counts as a block, so the block limit ends programs that last for days.

    Args:
        group: The channels; one of them waits for the clock.

    Attributes:
        halts: Where single block has halted, as N words.
    """

    def __init__(self, group: ChannelGroup) -> None:
        first = group.first
        control, machine, setup = first.control, first.machine, first.setup
        signals = {
            name: float(value)
            for name, value in setup.switches.signals.items()
            if isinstance(value, int | float)
        }
        plc, self._clock = machine.plc(control.id), Clock(machine.interpolation_cycle_s)
        image = SignalImage(signals, plc.rules, self._clock)
        interlocks = Interlocks(plc, image)
        retained = InMemoryStore()
        status = Status(control.id, self._clock, image, retained)
        programs = Programs(control.form, (), {}, {})
        programs.store = first.store
        self._operation = Operation(
            control, machine, setup, programs, self._clock, Switches(setup.switches), image, interlocks, status,
            retained, group,
        )  # fmt: skip
        self._group = group
        self.halts: list[str] = []

    @property
    def seconds(self) -> float:
        """How long it has lasted, s."""
        return self._clock.time

    def run(self) -> None:
        """Run to the end of the program or to an alarm; programmed stops are started again."""
        operation, runs = self._operation, self._operation.runs
        operation.mains = {runs.first.number}
        for channel in self._group.channels:
            run = runs[channel.number]
            run.execution.place = channel.context
            channel.move_times, channel.standstill, channel.bulk = None, None, None
            for level in channel.stack:
                level.scanner = None
            operation.switches.apply_to(channel, typed=channel.setup.switches.mode == MDI)
            channel.optional_stop = channel.setup.switches.optional_stop  # nobody turns the switch meanwhile
        runs.go_on()
        operation.set_rates()
        operation.resume()
        loop = MainLoop(operation, self._clock)
        execution, first = runs.first.execution, runs.first.channel
        toolpath = first.toolpath
        since, done = 0.0, _NOTHING_DONE
        while self._clock.time < LONGEST_RUN_S:
            before = self._clock.time
            loop.run(LOOK_S)
            if execution.halt in OVER:
                if execution.halt == "end" and runs.first.preprocessing.last_block:
                    self.halts.append(runs.first.preprocessing.last_block)
                break
            now_done = len(toolpath), len(execution.preprocessing.items), execution.machine
            if now_done != done or execution.knows_when:
                since, done = self._clock.time, now_done
            longest = LONGEST_WAIT_S if runs.move_beside_path else LONGEST_REST_S
            if operation.status.state is State.STOPPED:
                self._note_halt()
                operation.resume()
            elif not loop.is_busy:
                break
            elif any(run.is_active and run.execution.halt not in {"", *OVER} for run in runs):
                self._note_halt()
                operation.go_on_halted()  # while other channels run or wait
            elif self._clock.time == before or self._clock.time - since >= longest:
                self._give_up(AlarmError("PC0013"))
            elif first.blocks + self._clock.visits >= first.block_limit:
                self._give_up(first.control.block_limit())
        self._end_by_machine()
        self._stand()

    def _note_halt(self) -> None:
        """Where single block has halted the first channel, and inside the block in front of that."""
        run = self._operation.runs.first
        if run.execution.halt == "single-block":
            self.halts += [*run.channel.inner_halts, run.execution.halted_behind]
            run.channel.inner_halts.clear()

    def _give_up(self, error: AlarmError) -> None:
        """Nothing that is waited for comes, or too late: the program ends with an alarm where it stands."""
        run = self._operation.runs.first
        run.interpolator.end(reset=False)
        run.execution.abandon()
        run.preprocessing.refuse(error)
        run.execution.start()

    def _end_by_machine(self) -> None:
        """An alarm of the machine's own controller ends the program too; what is only prepared has not happened."""
        operation = self._operation
        alarm = next((each for each in operation.status.alarms if not each.channel), None)
        if alarm is None:
            return
        run = operation.runs.first
        execution, preprocessing = run.execution, run.preprocessing
        if execution.motion is not None:
            preprocessing.cut(execution.motion.piece.row)
        comes = next((item.row for item in preprocessing.items if isinstance(item, Move)), None)
        if comes is not None:
            preprocessing.toolpath.forget_from(int(comes))
        preprocessing.arrived(execution.machine)
        run.interpolator.end(reset=False)
        execution.abandon()
        number = preprocessing.toolpath.program_number(alarm.program)
        preprocessing.refuse(AlarmError(alarm.code, line=alarm.line, program=number))

    def _stand(self) -> None:
        """Axes that were moved beside the path stand where that has led them."""
        for run in self._operation.runs:
            shares = run.interpolator.commanded_shares()
            if any(shares.values()):
                coordinates = run.channel.coordinates
                machine = coordinates.machine
                for column, share in shares.items():
                    machine[column] += share
                coordinates.arrive_machine(machine)
