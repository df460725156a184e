"""All synchronised actions of a channel: who acts in an interpolation cycle, in which order, and for how long (10.1.1).

In a cycle come the modal and static ones by ascending number, then those of the block in the order programmed. An
action that raises an alarm is not looked at any more; the others go on (10.7).
"""

from __future__ import annotations

from polycnc.channel.interpolator import Influence, PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions import overlay
from polycnc.control.sinumerik.actions.acting import ActionRun, is_executed
from polycnc.control.sinumerik.actions.action import Action
from polycnc.control.sinumerik.axes import spindles as spindle_axes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.signals import measuring_actions
from polycnc.control.sinumerik.variables import in_force
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.errors import arithmetic
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.actions.code import ActionCode, Frozen

NUMBERS = range(1, 256)
#: Variables that change by themselves while nothing moves, and those that change only with a motion.
_TIMED = (
    "$AC_TIMER",
    "$AC_TIME",
    "$AN_",
    "$AC_OPERATING_TIME",
    "$AC_CYCLE_TIME",
    "$AC_ACT_PROG_NET_TIME",
    "$A_YEAR",
    "$A_MONTH",
    "$A_DAY",
    "$A_HOUR",
    "$A_MINUTE",
    "$A_SECOND",
    "$A_MSECOND",
)
_STORED = (
    "$AC_MARKER", "$AC_PARAM", "$A_IN", "$A_OUT", "$A_INA", "$A_OUTA", "$R", "$AC_FIFO", "$AC_FCT", "$AN_MARKER", "$$",
    "$A_D",
)  # fmt: skip


@dataclass(slots=True)
class SynchronisedActions(PassiveWatcher, State, lifetime=Lifetime.POWER):
    """The actions of a channel; satisfies the channel's `Watcher`.

    Attributes:
        run: What their effects do.
        modal: ID and IDS by number.
        waiting: Actions for the next block that does something.
        of_block: Those of the block in execution.
        locked_by_plc: Numbers that the machine's controller has locked.
        looks: How often they have been looked at since the block began, an intermediate one too.
    """

    run: ActionRun
    modal: dict[int, Action] = field(default_factory=dict)
    waiting: list[Action] = field(default_factory=list)
    of_block: list[Action] = field(default_factory=list)
    locked: set[int] = field(default_factory=set)
    looks: int = 0
    _last_look: float = -1.0
    _block: int = 0
    _ending: bool = False

    @classmethod
    def first(cls, channel: Channel[Any, Any, Any]) -> SynchronisedActions:
        """None are there."""
        made = cls(ActionRun(channel))
        made.run.coordinate = made.coordinate
        return made

    # ---- the program ---------------------------------------------------------------------------------------

    def begin(self, action: Action) -> None:
        """The block of an action is reached: it holds from the next one on."""
        if action.number is None:
            self.waiting.append(action)
        else:
            self._drop(self.modal.pop(action.number, None))
            self.modal[action.number] = action
        self._gate()

    def cancel(self, numbers: tuple[int, ...]) -> None:
        """CANCEL: these are no more, all where none is named; motions that they have started are broken off."""
        for number in numbers or tuple(self.modal):
            self._drop(self.modal.pop(number, None))
            self.locked.discard(number)
        self._gate()

    def bring_back(self, held: Mapping[int, Action]) -> None:
        """REPOS: the actions of the interrupted block hold again, modal ones of the routine no more (10.7)."""
        for number, action in tuple(self.modal.items()):
            if number not in held and not action.is_static:
                self._drop(self.modal.pop(number))
        for number, action in held.items():
            if self.modal.get(number) is not action:
                self._drop(self.modal.get(number))
                self.modal[number] = action
        self._gate()

    def _drop(self, action: Action | None) -> None:
        """An action is no more."""
        if action is not None:
            action.cycles.clear()
            self._stop_axes(action)

    def _stop_axes(self, action: Action) -> None:
        for column in action.axes:
            self.run.clocked.commanded(column).stop()
        action.axes.clear()

    def coordinate(self, word: str, args: Arguments) -> None:
        """LOCK, UNLOCK, RESET of actions, by their numbers (10.5.9)."""
        self.run.changed = True
        for value in args or tuple(self.modal):
            number = arguments.whole(value)
            if word == "LOCK":
                self.locked.add(number)
            elif word == "UNLOCK":
                self.locked.discard(number)
            elif number in self.modal:
                self.modal[number].restart()

    def _gate(self) -> None:
        """Blocks end in an exact stop while an action may hold the next one (10.4.3)."""
        there = (*self.modal.values(), *self.waiting, *self.of_block)
        self.run.clocked.gate(closed=any("RDISABLE" in action.code.needs.words for action in there))

    # ---- the main run --------------------------------------------------------------------------------------

    def block_begins(self) -> None:
        """A block begins that does something; what was programmed for it acts in it."""
        self.of_block, self.waiting, self.looks = self.waiting, [], 0
        if self.of_block or self.modal:
            self._look()

    def block_ends(self) -> None:
        """The block in execution is over, and its own actions with it."""
        if self.of_block:
            self.of_block = []
            self._gate()

    def look(self) -> None:
        """An interpolation cycle has come."""
        if self.run.clocked.time != self._last_look or self.run.clocked.block_number != self._block:
            self._look()

    def _look(self) -> None:
        run = self.run
        clocked = run.clocked
        if clocked.block_number != self._block:
            self._block, self.looks = clocked.block_number, 0
        self._last_look, before = clocked.time, run.influence
        run.influence, run.changed = Influence(), False
        in_program, modal = clocked.runs_programs, clocked.modal
        for number in sorted(self.modal):
            action = self.modal.get(number)
            if action is not None and number not in self.locked and (in_program or action.is_static):
                self._try(action, modal)
        for action in tuple(self.of_block) if in_program else ():
            self._try(action, modal)
        self._look_at_ends()
        self.looks += 1
        if run.influence != before or run.changed:
            run.changed = True
        clocked.influence(run.influence)
        if run.releases:
            run.releases = False
            clocked.release()

    def _look_at_ends(self) -> None:
        """An axis that MOV has led to the end of its travel ends the program with an alarm."""
        run = self.run
        for column, action in tuple(run.endless.items()):
            if run.axis_moves(column):
                continue
            del run.endless[column]
            error = action_axes.at_end(run.channel, column, run.clocked.machine(column))
            if error is not None:
                self._fail(action, error)

    def _try(self, action: Action, modal: Mapping[str, str]) -> None:
        """Look at one action, with the modal functions of the block; an alarm ends it, and the program."""
        if action.is_done and not action.cycles:
            return
        run, code = self.run, action.code
        run.begin(action, modal)
        try:
            if action.cycles:
                if action.cycles[0].step(run):
                    del action.cycles[0]
                    run.changed = True
            elif action.acts(run.channel, run):
                code.effect(run.channel, action.frozen, [], run)
                if action.cycles and action.cycles[0].step(run):
                    del action.cycles[0]
            run.finish()
        except AlarmError as error:
            self._fail(action, error)
        except (ZeroDivisionError, OverflowError, ValueError):
            self._fail(action, arithmetic())
        finally:
            run.end()

    def _fail(self, action: Action, error: AlarmError) -> None:
        action.is_done = True
        action.cycles.clear()
        self.run.clocked.fail(error, program=action.code.program, line=action.code.line)

    @property
    def is_quiet(self) -> bool:
        """Whether another look would find everything as it is, until a block begins or an axis comes to rest."""
        if self.run.changed:
            return False
        still = self.run.clocked.is_still
        for action in (*self.modal.values(), *self.of_block):
            if action.cycles:
                return False
            if action.is_done:
                continue
            reads = action.code.needs.reads
            if any(name.startswith(_TIMED) for name in reads) or "$AA_OFF" in str(action.code.needs.words):
                return False
            if not still and any(not name.startswith(_STORED) for name in reads):
                return False
        return True

    @property
    def lingers(self) -> bool:
        """Whether the end of the program has to wait: for a last look, for axes and cycles of its actions (10.1.1)."""
        own = [action for action in self.modal.values() if not action.is_static]
        if not self._ending:
            self._ending = True
            for action in own:
                for column in action.endless:
                    self.run.clocked.commanded(column).stop()
            if self.waiting or self.of_block or own:
                self.block_begins()
                return True
        return any(action.cycles or any(map(self.run.axis_moves, action.axes)) for action in own)

    def abandon(self, *, reset: bool) -> None:
        """The program has ended: only static actions go on; a reset breaks off what they do."""
        self._ending = False
        self.waiting, self.of_block = [], []
        if reset:
            self.run.endless.clear()
        for number in [number for number, action in self.modal.items() if not action.is_static]:
            self._drop(self.modal.pop(number))
        for action in self.modal.values() if reset else ():
            action.restart()
            self._stop_axes(action)
        self._gate()


# ---- the program ---------------------------------------------------------------------------------------------------


def define(channel: SinumerikChannel, code: ActionCode, number: int | None, frozen: Frozen) -> None:
    """An action begins with the next block that does something.

    Raises:
        AlarmError: 12571 for a number beyond 255.
    """
    clocked = channel.on_clock()
    if number is not None and number not in NUMBERS:
        raise AlarmError("12571", text=f"{code.word}={number}")
    unknown = [word for word in sorted(code.needs.words) if word[0] != "$" and not is_executed(word)]
    if unknown:
        raise not_supported(unknown[0])
    actions = SynchronisedActions.of(channel)
    clocked.watch(actions)
    commanded, shifted = (_columns(channel, axes) for axes in (code.needs.axes, code.needs.shifts))
    if "SPOS" in code.needs.words:
        commanded = [*commanded, *spindle_axes.all_of(channel)]
    if commanded:
        action_axes.expect(channel, commanded)
    if shifted:
        overlay.expect(channel, shifted, is_static=code.word == "IDS")
    if code.needs.words.intersection(measuring_actions.WORDS):
        channel.event(Deed("PROBE", None, measuring_actions.beginning(channel)))
    in_force.watch(channel, code.needs.reads)
    action = Action(code, number, frozen)
    channel.event(Deed(code.word or code.keyword or "DO", number, _beginning(actions, action)))
    if not code.word and "DELDTG()" in code.needs.words:
        clocked.stop_behind_next()


def _columns(channel: SinumerikChannel, axes: frozenset[str | None]) -> list[int]:
    """Columns of axes that an action names; of all where only the main run knows which it means."""
    if None in axes:
        return list(range(len(channel.axes)))
    return [channel.memory.column(axis) for axis in axes if axis is not None]


def _beginning(actions: SynchronisedActions, action: Action) -> Callable[[], None]:
    return lambda: actions.begin(action)


def note(channel: SinumerikChannel, held: dict[int, Action]) -> None:
    """A routine interrupts a block: keep the modal and static actions that hold there."""
    if channel.actual.clocked is not None:
        actions = SynchronisedActions.of(channel)
        channel.event(Deed("ASUB", None, lambda: held.update(actions.modal)))


def bring_back(channel: SinumerikChannel, held: Mapping[int, Action]) -> None:
    """The rest of the block comes: the actions are those that `note` has kept."""
    if channel.actual.clocked is not None:
        actions = SynchronisedActions.of(channel)
        channel.event(Deed("REPOS", None, lambda: actions.bring_back(held)))


def cancel(channel: SinumerikChannel, args: Arguments) -> None:
    """CANCEL(n,…): these actions end when the program comes here, all of them where none is named (10.6)."""
    numbers = tuple(arguments.whole(value) for value in args)
    actions = SynchronisedActions.of(channel)
    if channel.actual.clocked is not None:
        channel.event(Deed("CANCEL", None, lambda: actions.cancel(numbers)))


PROCEDURES = {"CANCEL": cancel}
