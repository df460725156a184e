"""Measuring with touch probes: MEAS, MEAW, MEASA, MEAWA, MEAC and what they leave (job planning 4.7, 4.8).

When a probe switches is part of the setup (`probe`): ideal signals at work positions. The `Prober` is the last stage of
the path. It sees every move, knows from it how each probe stands, and hands the positions of an edge to the jobs of the
running block. A job that deletes the distance to go ends the move there, without delay.
"""

from __future__ import annotations

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import fifo as fifos
from polycnc.control.sinumerik.block.positions import of_display, shown
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.variables.row import Indices, RowWithStop
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.language.sinumerik.words import WordShape
    from polycnc.machine.setup.values import ProbeEdge

#: Words of a block for all its axes, and those for one axis each; the first of each pair deletes the distance to go.
OF_BLOCK, OF_AXIS = ("MEAS", "MEAW"), ("MEASA", "MEAWA")
CONTINUOUS = "MEAC"
WORDS = (*OF_BLOCK, *OF_AXIS, CONTINUOUS)
EVENTS = (1, -1, 2, -2)
MAX_EVENTS = 4
#: Units of the mode: end the job; in any order; in the programmed order, the first event being checked or not.
ABORT, ANY_ORDER, IN_ORDER, UNCHECKED = range(4)
SYSTEMS = range(4)
BOTH_SYSTEMS = 3


@dataclass(slots=True)
class Job:
    """What a block measures.

    Attributes:
        events: Edges in programmed order: the probe's number, negative for falling.
        columns: Axes whose positions are kept.
        axial: It is a job of one axis (MEASA, MEAWA, MEAC).
        deletes: The distance to go is deleted when all events have come.
        in_order: Events count in their programmed order only.
        fifo: Memory of a continuous job, 0 for none.
        systems: Measuring systems that give a value for each event.
        came: Which events have come, by place.
    """

    events: tuple[int, ...]
    columns: tuple[int, ...]
    axial: bool
    deletes: bool
    in_order: bool = False
    fifo: int = 0
    systems: int = 1
    came: list[int] = field(default_factory=list)

    @property
    def is_complete(self) -> bool:
        """Whether every event has come."""
        return len(self.came) == len(self.events)

    def place(self, event: int) -> int | None:
        """The place of an event that this job waits for."""
        if event not in self.events:
            return None
        if self.fifo:
            return self.events.index(event)
        if self.in_order:
            following = len(self.came)
            return following if following < len(self.events) and self.events[following] == event else None
        place = self.events.index(event)
        return None if place in self.came else place


class Prober(Stage):
    """The last stage of the path while the setup has probes."""

    rank = Rank.PROBES
    lasts = True
    keeps_ends = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self.jobs: list[Job] = []
        self.continuous: dict[int, Job] = {}
        self.stopped: list[float] | None = None
        self._channel = channel
        self._edges: dict[int, list[ProbeEdge]] = {
            number: list(edges) for number, edges in channel.setup.switches.probe.items()
        }
        self.deflected: dict[int, bool] = dict.fromkeys(self._edges, False)

    def move(self, move: Move) -> None:
        """Pass a move on, as far as the event that deletes the rest of the block."""
        if self.stopped is None:
            part = self.follow(move)
            if part is None:
                self.after.move(move)
            elif part > 0.0:
                self.after.move(MovePath(move, self._channel.coordinates.geometry).until(part))

    def follow(self, move: Move) -> float | None:
        """Let probes switch along a move; the part of it at which the distance to go is deleted."""
        way = MovePath(move, self._channel.coordinates.geometry)
        for part, probe, edge in sorted(edges_on(self._channel, self._edges, way), key=lambda each: each[0]):
            self._edges[probe].pop(0)
            self.deflected[probe] = edge.rising
            point = way.at(part)
            self._record(probe if edge.rising else -probe, point)
            deleting = [job for job in self.jobs if job.deletes]
            if deleting and all(job.is_complete for job in deleting):
                self.stopped = point
                return part
        return None

    def remaining(self) -> dict[int, list[ProbeEdge]]:
        """The edges that have not come yet, by probe."""
        return {probe: list(edges) for probe, edges in self._edges.items()}

    def _record(self, event: int, point: list[float]) -> None:
        machine = self._channel.coordinates.to_machine(point)
        found = Measuring.of(self._channel)
        for job in (*self.jobs, *self.continuous.values()):
            place = job.place(event)
            if place is None:
                continue
            if job.fifo:
                append(self._channel, job, event, machine[job.columns[0]])
                continue
            job.came.append(place)
            for column in job.columns:
                for system in range(job.systems):
                    slot = place * job.systems + system + 1
                    found.measured[slot, column] = point[column], machine[column]
        self._tell()

    def _tell(self) -> None:
        """$AC_MEA: the events of a probe that the block waits for have all come."""
        for probe in (1, 2):
            waiting = [job for job in self.jobs if any(abs(event) == probe for event in job.events)]
            if waiting:
                came = all(
                    place in job.came
                    for job in waiting
                    for place, e in enumerate(job.events)
                    if abs(e) == probe
                )
                Measuring.of(self._channel).triggered[probe] = came


def edges_on(
    channel: SinumerikChannel, edges: Mapping[int, list[ProbeEdge]], way: MovePath
) -> Iterator[tuple[float, int, ProbeEdge]]:
    """The edges that come on a way, each probe's own in their order: part of the way, probe, edge."""
    for probe, own in edges.items():
        before = 0.0
        for edge in own:
            column = channel.memory.column(edge.axis.upper())
            part = way.part_at({column: of_display(channel, column, edge.at)})
            if part is None or part < before:
                break
            yield part, probe, edge
            before = part


@dataclass(slots=True)
class Measuring(State, lifetime=Lifetime.POWER):
    """What probes do and have found.

    Attributes:
        prober: The stage that follows them; None where the setup has none.
        measured: Work and machine position of an axis by number of the value and column.
        triggered: $AC_MEA by probe.
    """

    prober: Prober | None = None
    measured: dict[tuple[int, int], tuple[float, float]] = field(default_factory=dict)
    triggered: dict[int, bool] = field(default_factory=dict)


def watch(channel: SinumerikChannel) -> None:
    """Follow the probes from now on, if the setup has any."""
    if channel.setup.switches.probe:
        Measuring.of(channel).prober = channel.path.put(Prober(channel))


# ---- words


def measure(draft: Draft) -> tuple[Step, Step] | None:
    """Steps of a measuring block: before its motion, behind it."""
    words = [(position, word) for position, word in draft.open_words() if word.address in WORDS]
    if not words:
        return None
    for position, _ in words:
        draft.close(position)
    kinds = {word.address for _, word in words}
    if len(kinds & set(OF_BLOCK)) > 1 or (kinds & set(OF_BLOCK) and kinds & set(OF_AXIS)):
        raise WordAlarm("14020", words[0][0], text=" ".join(sorted(kinds)))
    path = {draft.memory.columns[w.address] for w in draft.block.words if w.address in draft.memory.columns}
    moved = _moved_columns(draft, path)

    def begin(channel: SinumerikChannel, values: Values) -> None:
        jobs = [_job(channel, word, values, position, moved) for position, word in words]
        _check_geometry(channel, words, values, path)
        _start(channel, [job for job in jobs if job is not None])

    return begin, _end


def _moved_columns(draft: Draft, path: set[int]) -> tuple[int, ...]:
    """Columns of the axes that a block moves: one geometry axis of the path stands for all of them.

    So does one axis of a transformation for all of its axes, and words of orientation for the rotary ones.
    """
    positioned = (word.index for word in draft.block.words if word.address in ("POS", "POSA"))
    alone = {draft.memory.column(axis.name) for axis in positioned if isinstance(axis, Axis)}
    geometry = {column for column in draft.channel.coordinates.geometry if column >= 0}
    together = seat.transformed(draft.channel)
    path = path | together if path & together or draft.lead is not None else path
    return tuple(sorted((path | geometry if path & geometry else path) | alone))


def _job(
    channel: SinumerikChannel, word: WordShape, values: Values, position: int, moved: tuple[int, ...]
) -> Job | None:
    """The job of a word; None where it only ends one."""
    if word.address in OF_BLOCK:
        if word.index is not None:
            raise WordAlarm("12400", position, text=word.address)
        event = values[position]
        if event not in EVENTS:
            raise WordAlarm("12560", position, text=word.address)
        return Job((int(event),), moved, axial=False, deletes=word.address == OF_BLOCK[0])
    if not isinstance(word.index, Axis):
        raise WordAlarm("12040", position, text=word.address)
    column = channel.memory.column(word.index.name)
    mode, fifo, events = listed(word.address, values[position], position)
    prober = Measuring.of(channel).prober
    if mode % 10 == ABORT:
        if prober is not None:
            prober.continuous.pop(column, None)
        return None
    if prober is not None and mode % 10 in (ANY_ORDER, IN_ORDER):
        check_start(prober.deflected, events[0])
    encoders = channel.memory.data.integer("$MA_NUM_ENCS", word.index)
    systems = 2 if mode // 10 == BOTH_SYSTEMS and encoders > 1 and not fifo else 1
    return Job(
        events,
        (column,),
        axial=True,
        deletes=word.address == OF_AXIS[0],
        in_order=mode % 10 in (IN_ORDER, UNCHECKED),
        fifo=fifo,
        systems=systems,
    )


def listed(name: str, value: Any, position: int) -> tuple[int, int, tuple[int, ...]]:
    """Mode, FIFO and events of `(mode, [memory,] event, …)`; 14020 and 12560 for what cannot be."""
    listed = list(value) if isinstance(value, tuple) else [value]
    if not listed or any(not isinstance(item, (int, float)) or item != int(item) for item in listed):
        raise WordAlarm("14020", position, text=name)
    mode, *rest = (int(item) for item in listed)
    if mode // 10 not in SYSTEMS or mode % 10 not in range(4):
        raise WordAlarm("12560", position, text=f"{name} {mode}")
    fifo = rest.pop(0) if name == CONTINUOUS and rest else 0
    if mode % 10 == ABORT:
        return mode, 0, ()
    is_wrong_fifo = name == CONTINUOUS and (not 1 <= fifo <= fifos.MOST or mode % 10 == UNCHECKED)
    if not 1 <= len(rest) <= MAX_EVENTS or is_wrong_fifo:
        raise WordAlarm("14020", position, text=name)
    if any(event not in EVENTS for event in rest):
        raise WordAlarm("12560", position, text=name)
    if len(set(rest)) < len(rest) and mode % 10 == ANY_ORDER:
        raise WordAlarm("14020", position, text=name)
    return mode, fifo, tuple(rest)


def check_start(states: Mapping[int, bool], event: int) -> None:
    """21700, 21703: the probe already stands as the first event would leave it; `states` says how probes stand."""
    deflected = states.get(abs(event), False)
    if deflected is (event > 0):
        raise AlarmError("21700" if deflected else "21703", probe=abs(event))


def _check_geometry(
    channel: SinumerikChannel, words: list[tuple[int, WordShape]], values: Values, path: set[int]
) -> None:
    """14020: geometry axes that travel in the block need one and the same job each."""
    jobs = {
        channel.memory.column(word.index.name): (word.address, values[position])
        for position, word in words
        if word.address in OF_AXIS and isinstance(word.index, Axis)
    }
    geometry = [column for column in channel.coordinates.geometry if column >= 0]
    own = [column for column in geometry if column in jobs]
    if own and (
        len({jobs[column] for column in own}) > 1 or any(c in geometry and c not in jobs for c in path)
    ):
        raise AlarmError("14020", text="MEASA")


def _start(channel: SinumerikChannel, jobs: list[Job]) -> None:
    state = Measuring.of(channel)
    prober = state.prober
    for job in jobs:
        for probe in {abs(event) for event in job.events}:
            deflected = prober is not None and prober.deflected.get(probe, False)
            state.triggered[probe] = deflected and not job.axial
        if job.fifo:
            fifos.values(channel, job.fifo)
    if prober is not None:
        prober.jobs = [job for job in jobs if not job.fifo]
        prober.continuous.update({job.columns[0]: job for job in jobs if job.fifo})


def positioned(channel: SinumerikChannel, end: list[float]) -> list[float]:
    """Where a positioning axis comes to on its way to `end`: probes switch on a way without a row as well."""
    prober, start = Measuring.of(channel).prober, channel.coordinates.position
    if prober is None or start == end:
        return end
    move = Move(Kind.FEED, start, end)
    part = prober.follow(move)
    prober.stopped = None
    return end if part is None else MovePath(move, channel.coordinates.geometry).at(part)


def _end(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """The block has moved: nothing of it is held back, and it stands where its distance to go was deleted."""
    prober = Measuring.of(channel).prober
    if prober is None:
        return
    channel.flush()
    prober.jobs = []
    if prober.stopped is not None:
        channel.coordinates.arrive(channel.path.programmed(prober.stopped))
        prober.stopped = None


# ---- what measuring leaves


def append(channel: SinumerikChannel, job: Job, event: int, value: float) -> None:
    """A value of a continuous job: each probe has its own memory; a full one ends the job."""
    others = sorted({abs(each) for each in job.events})
    number = job.fifo + others.index(abs(event))
    values = fifos.values(channel, number)
    length = channel.memory.data.integer("$MC_LEN_AC_FIFO")
    if not length or len(values) < length:
        values.append(value)


def _measured(slot: int, *, work: bool) -> Callable[[SinumerikChannel, Indices], float]:
    name = f"$AA_M{'W' if work else 'M'}{slot or ''}"

    def read(channel: SinumerikChannel, indices: Indices) -> float:
        if len(indices) != 1 or not isinstance(indices[0], Axis):
            raise AlarmError("12400", text=name)
        column = channel.memory.column(indices[0].name)
        of_work, of_machine = Measuring.of(channel).measured.get((max(slot, 1), column), (0.0, 0.0))
        return shown(channel, column, of_work if work else of_machine, work=work)

    return read


def _of_probe(
    name: str, state: Callable[[Measuring], dict[int, bool]]
) -> Callable[[SinumerikChannel, Indices], int]:
    def read(channel: SinumerikChannel, indices: Indices) -> int:
        if len(indices) != 1 or indices[0] not in (1, 2):
            raise AlarmError("17020", text=name, index=", ".join(map(str, indices)))
        return int(state(Measuring.of(channel)).get(indices[0], False))

    return read


MEASURE_VARIABLES: dict[str, RowWithStop] = {
    **{f"$AA_MM{slot or ''}": (Type.REAL, _measured(slot, work=False), None, True) for slot in range(5)},
    **{f"$AA_MW{slot or ''}": (Type.REAL, _measured(slot, work=True), None, True) for slot in range(5)},
    "$AC_MEA": (Type.INT, _of_probe("$AC_MEA", lambda state: state.triggered), None, True),
    "$A_PROBE": (
        Type.INT,
        _of_probe("$A_PROBE", lambda state: state.prober.deflected if state.prober else {}),
        None,
        True,
    ),
}
