"""Interrupt routines: SETINT gives an input a program, DISABLE, ENABLE and CLRINT (job planning 1.14).

Where an input comes is part of the setup (`interrupts`): an ideal signal, without braking. As the path's first stage,
the `Watch` sees every move on its way. It cuts the one on whose way an input comes, keeps the rest, and calls the
routine behind the running block. What becomes of the rest is `Interrupted.resume_at`: REPOS says from where on it is
still made; a routine that ends without REPOS leaves it, and the next block goes to its own end point (1.14.1).
"""

from __future__ import annotations

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Rank, Stage
from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import actions
from polycnc.control.sinumerik.block.positions import of_display
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.statements.calls import call_without_arguments, named_program
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments, single_block
    from polycnc.control.sinumerik.signals import retraction

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.moves.path import Move
    from polycnc.channel.stack import Level
    from polycnc.control.sinumerik.actions.action import Action
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.machine.setup.values import Interrupt
    from polycnc.program import Program

INPUTS, PRIORITIES = range(1, 9), range(1, 129)


@dataclass(slots=True)
class Assignment:
    """What SETINT has given an input.

    Attributes:
        program: The routine; None with LIFTFAST alone.
        priority: 1 is the highest.
        lifts: LIFTFAST: fast retraction first.
        waits_for_block: BLSYNC: the running block is finished first.
        enabled: Not suspended by DISABLE.
    """

    program: Program | None
    priority: int
    lifts: bool
    waits_for_block: bool
    enabled: bool = True


@dataclass(slots=True)
class Interrupted:
    """A block that an interrupt routine has cut.

    Attributes:
        way: The way of the whole move; None where the block had none.
        part: Part of the way at which the input came.
        priority: Of the routine that runs.
        level: Its program level.
        rest: Further moves of the block (of a cycle).
        end: Where the block ends.
        resume_at: Part of the way at which REPOS has come back; None before.
        left: Columns of axes that REPOS has not led back: neither geometry axes nor named.
        waited: The routine has waited for the end of the block (BLSYNC).
        actions: Modal and static actions that held in the block, once the main run comes there.
    """

    way: MovePath | None
    part: float
    priority: int
    level: Level
    rest: list[Move]
    end: list[float]
    resume_at: float | None = None
    left: frozenset[int] = frozenset()
    waited: bool = False
    actions: dict[int, Action] = field(default_factory=dict)


class Watch(Stage):
    """The first stage of the path while inputs may come."""

    rank = Rank.INTERRUPTS
    lasts = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self.came: set[int] = set()
        self.running: list[Interrupted] = []
        self._channel = channel
        self._cut: tuple[MovePath, float] | None = None
        self._pending: list[tuple[Interrupt, Assignment]] = []
        self._held: list[Move] = []
        self._stands: list[float] | None = None
        self._moved = False
        self._lifts = False

    # ---- the path

    def move(self, move: Move) -> None:
        """Pass a move on, as far as the first input that comes on its way."""
        if self._stands is not None:
            # The rest of an interrupted block was left: this move begins where the machine stands.
            move, self._stands = replace(move, start=self._stands), None
        self._moved = True
        if self._cut is not None:
            self._held.append(move)
            return
        way = MovePath(move, self._channel.coordinates.geometry)
        part = self._first_input(way) if not self._lifts else None
        if part is None:
            self.after.move(move)
            return
        self._cut = way, part
        if part > 0.0:
            self.after.move(way.until(part) if part < 1.0 else move)

    def _first_input(self, way: MovePath) -> float | None:
        """The part of a way at which the first inputs come that call a routine; they become pending."""
        found: list[tuple[float, int, Interrupt]] = []
        for number, interrupt in enumerate(self._channel.setup.switches.interrupts):
            if number in self.came or not self._runs(interrupt, way.move.program, way.move.line):
                continue
            part = way.part_at(self._wanted(interrupt))
            if part is not None:
                found.append((part, number, interrupt))
        first: float | None = None
        for part, number, interrupt in sorted(found, key=lambda each: each[:2]):
            if first is not None and part > first:
                break
            self.came.add(number)
            if self._is_called(interrupt):
                first = part
        if first is not None and all(assignment.waits_for_block for _, assignment in self._pending):
            return 1.0
        return first

    def _wanted(self, interrupt: Interrupt) -> dict[int, float]:
        memory = self._channel.memory
        wanted = {memory.column(axis.upper()): value for axis, value in interrupt.at.items()}
        return {column: of_display(self._channel, column, value) for column, value in wanted.items()}

    def _runs(self, interrupt: Interrupt, program: int, line: int) -> bool:
        if line != interrupt.line:
            return False
        name = self._channel.toolpath.programs[program]
        if not interrupt.program:
            return name == self._channel.stack[0].code.program.name
        wanted = interrupt.program.upper()
        return name.upper() in (wanted, f"_N_{wanted}_SPF", f"_N_{wanted}_MPF")

    def _is_called(self, interrupt: Interrupt) -> bool:
        """Note the routine of an input; false where it has none, or none of higher priority than what runs."""
        assignment = Interrupts.of(self._channel).assignments.get(interrupt.input)
        if assignment is None or not assignment.enabled:
            return False
        self._pending.append((interrupt, assignment))
        self._pending.sort(key=lambda each: each[1].priority)
        return not self.running or assignment.priority < self.running[-1].priority

    def flush(self) -> None:
        """Pass on everything that stages hold back."""
        self.after.flush()
        if self._channel.finished and self._stands is not None:
            self._channel.coordinates.arrive(self._stands)

    # ---- blocks

    def block(self) -> None:
        """A block has ended: begin or end a routine."""
        self.after.block()
        channel = self._channel
        if channel.finished:
            return
        if not self._moved:
            self._inputs_that_came_standing()
        self._moved = False
        while self._cut is None and self.running and not self._runs_still(self.running[-1]):
            self._ended(self.running.pop())
        if self._cut is not None:
            way, part = self._cut
            self._cut = None
            self._interrupt(way, part)

    def _runs_still(self, interrupted: Interrupted) -> bool:
        return any(level is interrupted.level for level in self._channel.stack)

    def _inputs_that_came_standing(self) -> None:
        """Inputs whose position the channel has when a block without motion runs."""
        channel = self._channel
        level = channel.level
        position = channel.coordinates.position
        for number, interrupt in enumerate(channel.setup.switches.interrupts):
            if number in self.came or not self._runs(interrupt, level.program_number, channel.line):
                continue
            if all(abs(position[column] - value) < 1e-3 for column, value in self._wanted(interrupt).items()):
                self.came.add(number)
                if self._is_called(interrupt):
                    self._call(None, 1.0, [], position.copy())
                    return

    def _interrupt(self, way: MovePath, part: float) -> None:
        channel = self._channel
        self.after.flush()
        rest, self._held = self._held, []
        end = channel.coordinates.position
        stands = way.at(part)
        channel.coordinates.arrive(stands)
        self._call(way, part, rest, end)

    def _call(self, way: MovePath | None, part: float, rest: list[Move], end: list[float]) -> None:
        """Call the pending routine of the highest priority."""
        channel = self._channel
        _, assignment = self._pending.pop(0)
        if assignment.lifts:
            self._lifts = True
            retraction.lift(channel, way.direction(part) if way is not None else (0.0, 0.0, 0.0))
            self._lifts = False
        if assignment.program is None:
            channel.stop("LIFTFAST")
            raise AlarmError("PC0004")
        call_without_arguments(channel, assignment.program, LevelKind.INTERRUPT)
        single_block.begin_routine(channel, channel.level)
        waited = assignment.waits_for_block
        interrupted = Interrupted(way, part, assignment.priority, channel.level, rest, end, waited=waited)
        self.running.append(interrupted)
        actions.note(channel, interrupted.actions)

    def _ended(self, interrupted: Interrupted) -> None:
        """A routine has ended: another one that waits for it, or what is left of the block."""
        channel = self._channel
        below = self.running[-1].priority if self.running else max(PRIORITIES) + 1
        if self._pending and self._pending[0][1].priority < below:
            before = interrupted.resume_at
            self._call(interrupted.way, interrupted.part, interrupted.rest, interrupted.end)
            self.running[-1].resume_at, self.running[-1].actions = before, interrupted.actions
            return
        stands = channel.coordinates.position
        part, way = interrupted.resume_at, interrupted.way
        if part is None or way is None:
            self._stands = stands if way is not None else None
        else:
            actions.bring_back(channel, interrupted.actions)
            keep = _places_kept(interrupted, stands)
            rest = way.beyond(part, stands)
            rest = replace(rest, end=keep(rest.end))
            if part < 1.0 or rest.end != stands:  # other inputs may still come
                self.move(self._renewed(rest))
            for move in interrupted.rest:
                self.move(self._renewed(replace(move, start=keep(move.start), end=keep(move.end))))
            single_block.halt_behind_rest(channel)
            interrupted.end = keep(interrupted.end)
        channel.coordinates.arrive(interrupted.end)

    def _renewed(self, move: Move) -> Move:
        """A move with the tool that the routine has left in force (8.6)."""
        channel = self._channel
        now = channel.toolpath.contexts[channel.context_number()]
        then = channel.toolpath.contexts[move.context]
        renewed = replace(
            then, tool=now.tool, tool_name=now.tool_name, offsets=now.offsets, radius_mm=now.radius_mm
        )
        return replace(move, context=channel.toolpath.context_number(renewed))


def _places_kept(interrupted: Interrupted, stands: list[float]) -> Callable[[list[float]], list[float]]:
    """Let axes that REPOS has not led back stay where they stand, if the interrupted block does not move them (8.6)."""
    moves = [*interrupted.rest, *([interrupted.way.move] if interrupted.way else ())]
    still = {c for c in interrupted.left if all(move.start[c] == move.end[c] for move in moves)}
    return lambda position: [stands[c] if c in still else value for c, value in enumerate(position)]


@dataclass(slots=True)
class Interrupts(State, lifetime=Lifetime.POWER):
    """What inputs do.

    Attributes:
        assignments: What SETINT has given each input.
        watch: The stage that routines begin from; None where the setup has no inputs.
    """

    assignments: dict[int, Assignment] = field(default_factory=dict)
    watch: Watch | None = None


# ---- procedures


def watch(channel: SinumerikChannel) -> None:
    """Let inputs interrupt from now on, if the setup has any."""
    if channel.setup.switches.interrupts:
        Interrupts.of(channel).watch = channel.path.put(Watch(channel))


def running(channel: SinumerikChannel) -> Interrupted | None:
    """The block that the running routine has interrupted."""
    watch = Interrupts.of(channel).watch
    return watch.running[-1] if watch is not None and watch.running else None


def set_interrupt(channel: SinumerikChannel, args: tuple[Any, ...]) -> None:
    """SETINT(n) PRIO=v NAME LIFTFAST BLSYNC: a new assignment of an input replaces the old one."""
    number, priority, name, lifts, waits_for_block = args
    if number not in INPUTS or priority not in PRIORITIES or not (name or lifts):
        raise AlarmError("14020", text="SETINT")
    program = named_program(channel, name) if name else None
    Interrupts.of(channel).assignments[number] = Assignment(program, priority, lifts, waits_for_block)


def switch(on: bool) -> Any:
    """DISABLE(n), ENABLE(n): suspend the assignment of an input, and reactivate it."""

    def run(channel: SinumerikChannel, args: tuple[Any, ...]) -> None:
        for number in _inputs(args, "ENABLE" if on else "DISABLE"):
            assignment = Interrupts.of(channel).assignments.get(number)
            if assignment is not None:
                assignment.enabled = on

    return run


def clear(channel: SinumerikChannel, args: tuple[Any, ...]) -> None:
    """CLRINT(n): delete the assignment of an input."""
    for number in _inputs(args, "CLRINT"):
        Interrupts.of(channel).assignments.pop(number, None)


def _inputs(args: tuple[Any, ...], name: str) -> list[int]:
    if len(args) != 1 or arguments.whole(args[0]) not in INPUTS:
        raise AlarmError("14020", text=name)
    return [int(args[0])]


PROCEDURES = {
    "SETINT": set_interrupt,
    "DISABLE": switch(False),
    "ENABLE": switch(True),
    "CLRINT": clear,
}
