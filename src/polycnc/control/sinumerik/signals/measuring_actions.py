"""MEAWA and MEAC of synchronised actions: probes are followed in the main run (job planning 10.4.23).

Nothing is deleted of a move. The axes are where they are in each interpolation cycle, and go straight between two, so
the place of an edge is exact on lines.
"""

from __future__ import annotations

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.signals import measuring
from polycnc.control.sinumerik.signals.measuring import (
    ABORT,
    ANY_ORDER,
    CONTINUOUS,
    IN_ORDER,
    UNCHECKED,
    Job,
    Measuring,
)
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.actions.run import Running
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop
    from polycnc.machine.setup.values import ProbeEdge

#: Words of actions that measure.
WORDS = ("MEAWA", CONTINUOUS)


@dataclass(slots=True)
class ActionProbes(PassiveWatcher, State, lifetime=Lifetime.RESET):
    """Probes as the main run sees them; satisfies the channel's `Watcher`.

    Attributes:
        channel: Whose axes lead to them.
        edges: What is still to come of each probe.
        deflected: How each stands.
        jobs: What actions measure, by column.
        is_on: Somebody measures, or has measured.
        work: Work position at the last look; `machine` that of the machine.
    """

    channel: Channel[Any, Any, Any]
    edges: dict[int, list[ProbeEdge]] = field(default_factory=dict)
    deflected: dict[int, bool] = field(default_factory=dict)
    jobs: dict[int, Job] = field(default_factory=dict)
    is_on: bool = False
    work: list[float] = field(default_factory=list)
    machine: list[float] = field(default_factory=list)

    @classmethod
    def first(cls, channel: Channel[Any, Any, Any]) -> ActionProbes:
        """Nobody measures."""
        return cls(channel)

    def begin(self, edges: dict[int, list[ProbeEdge]], deflected: dict[int, bool]) -> None:
        """The block of an action that measures is reached: so the probes stand here, and these edges are to come."""
        if not self.is_on:
            self.edges, self.deflected, self.is_on = edges, deflected, True
            self._note()

    def _note(self) -> None:
        self.work, self.machine = list(self.channel.actual.work), list(self.channel.actual.machine)

    def look(self) -> None:
        """An interpolation cycle: edges on the way since the last one."""
        if not self.is_on:
            return
        before, machine = self.work, self.machine
        self._note()
        if before == self.work:
            return
        way = MovePath(Move(Kind.FEED, before, self.work), self.channel.coordinates.geometry)
        for part, probe, edge in sorted(
            measuring.edges_on(self.channel, self.edges, way), key=lambda each: each[0]
        ):
            self.edges[probe].pop(0)
            self.deflected[probe] = edge.rising
            place = [a + (b - a) * part for a, b in zip(machine, self.machine, strict=True)]
            self._record(probe if edge.rising else -probe, place)

    def _record(self, event: int, machine: list[float]) -> None:
        found = Measuring.of(self.channel).measured
        for column, job in tuple(self.jobs.items()):
            place = job.place(event)
            if place is None:
                continue
            if job.fifo:
                measuring.append(self.channel, job, event, machine[column])
                continue
            job.came.append(place)
            for system in range(job.systems):
                slot = place * job.systems + system + 1, column
                found[slot] = found.get(slot, (0.0, 0.0))[0], machine[column]
            if job.is_complete:
                del self.jobs[column]

    def block_begins(self) -> None:
        """What came in the block before is known first."""
        self.look()

    @property
    def is_quiet(self) -> bool:
        """Nothing is measured."""
        return not self.jobs

    def abandon(self, *, reset: bool) -> None:  # noqa: ARG002 - both end it
        """The program has ended, and all measurements with it."""
        self.jobs.clear()
        self.is_on = False


def beginning(channel: SinumerikChannel) -> Callable[[], None]:
    """What follows the probes from the block of an action on, which is being prepared."""
    probes, prober = ActionProbes.of(channel), Measuring.of(channel).prober
    channel.on_clock().watch(probes)
    edges, deflected = (prober.remaining(), dict(prober.deflected)) if prober is not None else ({}, {})
    return lambda: probes.begin(edges, deflected)


def start(word: str) -> Callable[[Running, Any, str, Any], None]:
    """MEAWA[axis]=(mode,event,…), MEAC[axis]=(mode,memory,event,…): a job of an axis, or with mode 0 the end of one."""

    def measure(run: Running, index: Any, _modifier: str, value: Any) -> None:
        channel = run.channel
        column, probes = arguments.column(channel, index), ActionProbes.of(channel)
        mode, fifo, events = measuring.listed(word, value, 0)
        if mode % 10 == ABORT:
            probes.jobs.pop(column, None)
            return
        if not probes.is_on:  # of a technology cycle, or of a static action behind the end of its program
            raise not_supported(word)
        if mode % 10 in (ANY_ORDER, IN_ORDER) and not fifo:
            measuring.check_start(probes.deflected, events[0])
        in_order = mode % 10 in (IN_ORDER, UNCHECKED)
        probes.jobs[column] = Job(events, (column,), axial=True, deletes=False, in_order=in_order, fifo=fifo)
        run.changed = True

    return measure


def _is_active(channel: SinumerikChannel, indices: Indices) -> bool:
    """`$AA_MEAACT[axis]`: somebody measures with an axis, a block of the program or an action."""
    if len(indices) != 1 or not isinstance(indices[0], Axis):
        raise AlarmError("12400", text="$AA_MEAACT")
    column, prober = channel.memory.column(indices[0].name), Measuring.of(channel).prober
    in_program = prober is not None and column in prober.continuous
    return in_program or column in ActionProbes.of(channel).jobs


ACTIVITY_VARIABLES: dict[str, RowWithStop] = {"$AA_MEAACT": (Type.BOOL, _is_active, None, True)}
