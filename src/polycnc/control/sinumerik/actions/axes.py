"""Axes that synchronised actions command, and how the program has them again (10.4.12, 10.4.15, 10.4.18).

An axis belongs to the program or to actions. When the program names one that actions may have moved, preparation is
reorganised: the block waits until everything before it is executed and the axis stands, and goes on from there.
"""

from __future__ import annotations

from functools import partial
from math import nan

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.channel.waits import PreprocessingStop
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.couplings.links import coupled
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from polycnc.toolpath.events import AxesAwaited, AxesPositioned, Deed
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.channel.interpolator import Interpolator
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

#: `$AA_AXCHANGE_TYP`: of the program, commanded by an action, of another channel, neutral; of another channel, or
#: commanded, and asked for by the program or as neutral.
PROGRAM, COMMANDED, ELSEWHERE, NEUTRAL = 0, 1, 2, 3
ELSEWHERE_FOR_PROGRAM, ELSEWHERE_FOR_NEUTRAL, FOR_PROGRAM, FOR_NEUTRAL = 5, 6, 7, 8
#: `$AA_TYP` of the same.
_TYPES = {
    PROGRAM: 1, COMMANDED: 8, ELSEWHERE: 0, NEUTRAL: 2, FOR_PROGRAM: 8, FOR_NEUTRAL: 8, ELSEWHERE_FOR_PROGRAM: 0,
    ELSEWHERE_FOR_NEUTRAL: 0,
}  # fmt: skip
#: What an axis is that is asked for once more (GET), and what it is once it stands.
_ASKED = {
    COMMANDED: FOR_NEUTRAL, FOR_NEUTRAL: FOR_PROGRAM, NEUTRAL: PROGRAM, ELSEWHERE: ELSEWHERE_FOR_NEUTRAL,
    ELSEWHERE_FOR_NEUTRAL: ELSEWHERE_FOR_PROGRAM,
}  # fmt: skip
_AT_REST = {COMMANDED: NEUTRAL, FOR_NEUTRAL: NEUTRAL, FOR_PROGRAM: PROGRAM}


@dataclass(slots=True)
class ActionAxes(State, lifetime=Lifetime.RESET):
    """Axes and actions.

    Attributes:
        may_move: Columns of axes that some action may command.
        lent: Those of them that only a positioning word of the program has moved, and no path since.
        states: Who has an axis, by column, where it is not the program.
        speeds: FA of actions, mm/s or degrees/s, by column.
        held: Columns of axes that oscillate: they are not free, though they rest at reversal points.
        geared: Columns of axes that a spindle leads (EGON), or a generated value: the program does not move them.
        along: Columns of what a positioned axis moves, by its column: several where a transformation makes it.
    """

    may_move: set[int] = field(default_factory=set)
    lent: set[int] = field(default_factory=set)
    states: dict[int, int] = field(default_factory=dict)
    speeds: dict[int, float] = field(default_factory=dict)
    held: set[int] = field(default_factory=set)
    geared: set[int] = lasting(Lifetime.POWER, factory=set)
    along: dict[int, tuple[int, ...]] = field(default_factory=dict)


def _lend(channel: SinumerikChannel, columns: Iterable[int]) -> None:
    """Positioning words move axes; those that no action may command are lent until a block of the path names them."""
    axes, columns = ActionAxes.of(channel), tuple(columns)
    lent = {column for column in columns if column not in axes.may_move} | axes.lent
    expect(channel, columns)
    axes.lent |= lent


def expect(channel: SinumerikChannel, columns: Iterable[int]) -> None:
    """Actions may command these axes from now on; PC0001 for one that a coupling of the program has."""
    axes, memory = ActionAxes.of(channel), channel.memory
    columns = tuple(columns)
    for column in sorted(coupled(channel).intersection(columns)):
        raise not_supported(f"TRAILON LEADON EGON: {channel.axes[column]} POS MOV")
    axes.may_move.update(columns)
    axes.lent.difference_update(columns)
    if not memory.shares_axes:
        memory.shares_axes = True
        channel.modes.forget_plans()  # they do not say which axes a block moves


def _limits(channel: SinumerikChannel, column: int) -> Iterator[tuple[str, int, float]]:
    """Software limit switches and working areas by setting data: alarm, side (1, -1) and machine position.

    WALIMON and WALIMOF of the program mean nothing here (10.4.17).
    """
    data, name, axis = channel.memory.data, channel.axes[column], channel.axis_data[column]
    for side, sign, travel in (("MINUS", -1, axis.limit_minus), ("PLUS", 1, axis.limit_plus)):
        switch = f"$MA_POS_LIMIT_{side}"
        yield "20070", sign, data.number(switch, name) if data.is_set(switch, name) else travel
        if data.number(f"$SA_WORKAREA_{side}_ENABLE", name):
            yield "20071", sign, data.number(f"$SA_WORKAREA_LIMIT_{side}", name)


def _beyond(channel: SinumerikChannel, column: int, code: str, sign: int) -> AlarmError:
    return AlarmError(code, axis=channel.axes[column], side="+" if sign > 0 else "-")


def check_target(channel: SinumerikChannel, column: int, target: float) -> None:
    """Refuse a target beyond a software limit switch (20070), or beyond a working area by setting data (20071)."""
    error = beyond(channel, column, target)
    if error is not None:
        raise error


def beyond(channel: SinumerikChannel, column: int, place: float) -> AlarmError | None:
    """The alarm of an axis that would pass an end of its travel (20070, 20071); None within it."""
    for code, sign, limit in _limits(channel, column):
        if sign * (place - limit) > NO_WAY:
            return _beyond(channel, column, code, sign)
    return None


def end_of_travel(channel: SinumerikChannel, column: int, direction: int) -> float:
    """How far an axis can go in a direction, machine position; inf or -inf for one without an end."""
    return direction * min(
        direction * limit for _, sign, limit in _limits(channel, column) if sign == direction
    )


def at_end(channel: SinumerikChannel, column: int, place: float) -> AlarmError | None:
    """The alarm of an axis that stands at an end of its travel (20070, 20071); None elsewhere."""
    for code, sign, limit in _limits(channel, column):
        if sign * (place - limit) >= -NO_WAY:
            return _beyond(channel, column, code, sign)
    return None


def speed_of(channel: SinumerikChannel, column: int) -> float:
    """Speed of a commanded axis: FDA of the block, FA, else MD32060, by OVRA."""
    feeds = PathFeed.of(channel)
    own = feeds.of_block.get(column) or ActionAxes.of(channel).speeds.get(column) or feeds.of_axes.get(column)
    own = own or channel.memory.data.number("$MA_POS_AX_VELO", channel.axes[column]) / tables.MINUTE
    return own * feeds.overrides.get(column, 1.0)


def may_be_away(channel: SinumerikChannel, columns: Iterable[int]) -> bool:
    """Whether actions, spindles or generated values may have moved any of these axes."""
    axes = ActionAxes.of(channel)
    away = axes.lent if channel.actual.clocked is None else axes.may_move | axes.geared
    return bool(away.intersection(columns))


def give_back(channel: SinumerikChannel, columns: Iterable[int]) -> None:
    """The program is about to move axes: those that actions may have moved come back to it, when they stand.

    Raises:
        PreprocessingStop: The main run is behind, or an axis moves.
        AlarmError: PC0001 for an axis that a spindle leads, or a generated value.
    """
    axes, columns = ActionAxes.of(channel), tuple(columns)
    for column in sorted(axes.geared.intersection(columns)):
        raise not_supported(f"EGON LEADON: {channel.axes[column]}")
    taken = [column for column in columns if column in axes.may_move]
    clocked = channel.actual.clocked
    if not taken:
        return
    channel.flush()
    if clocked is None:
        await_rest(channel, taken)
        _have_back(axes, taken)
        return
    channel.synchronise()
    if any(column in axes.held or clocked.commanded(column).moves for column in taken):
        raise PreprocessingStop
    coordinates, path = channel.coordinates, channel.path
    machine = coordinates.to_machine(path.beside(coordinates.position))
    before = machine.copy()
    for column in taken:
        axes.states.pop(column, None)
        machine[column] = clocked.take_back(column)
    _have_back(axes, taken)
    if any(abs(a - b) > NO_WAY for a, b in zip(machine, before, strict=True)):
        coordinates.arrive(path.programmed(coordinates.from_machine(machine)))


def _have_back(axes: ActionAxes, columns: Iterable[int]) -> None:
    """The path has axes again, which rest; those that no action may command are its own from here on."""
    back = axes.lent.intersection(columns)
    axes.may_move -= back
    axes.lent -= back


def position_beside(channel: SinumerikChannel, column: int, end: list[float]) -> None:
    """POS, POSA: an axis goes to its place in `end` beside the path.

    An axis that a transformation makes is several: they go together. One of them that oscillates meanwhile takes its
    part with its next stroke.
    """
    clocked, coordinates = channel.actual.clocked, channel.coordinates
    if channel.is_searched and not channel.path.changes_ends:
        channel.straight(
            Kind.RAPID, end, nan
        )  # nothing moves in a block search: what is sought begins behind the axis
        return
    before, after = coordinates.machine, coordinates.to_machine(end)
    moved = [i for i, (a, b) in enumerate(zip(before, after, strict=True)) if abs(a - b) > NO_WAY]
    if moved != [column] and not _goes_straight(channel, end):
        return  # a way that axes going evenly would leave: the path has it
    if not moved:
        return
    _lend(channel, moved)
    ActionAxes.of(channel).along[column] = tuple(moved)
    speed, way = speed_of(channel, column), abs(end[column] - coordinates.position[column])
    goals = [(i, after[i], speed * abs(after[i] - before[i]) / way) for i in moved]
    places, starts = tuple((i, after[i]) for i in moved), tuple(before[i] for i in moved)
    speeds = tuple(own_speed for _, _, own_speed in goals)
    do = None if clocked is None else partial(_start, channel, clocked, column, goals)
    channel.event(AxesPositioned("POS", None, do, False, None, places, False, starts, speeds))


def _start(
    channel: SinumerikChannel, clocked: Interpolator, column: int, goals: list[tuple[int, float, float]]
) -> None:
    """Axes go to their places, by column, place and speed; `column` is that which the program names."""
    held = ActionAxes.of(channel).held
    for axis, place, own_speed in goals:
        if axis == column or axis not in held:
            clocked.position_beside(axis, place, own_speed)
        else:
            clocked.shift_path(axis, place)


def _goes_straight(channel: SinumerikChannel, end: list[float]) -> bool:
    """Whether the axes of a transformation go evenly where the path goes straight to `end`."""
    coordinates = channel.coordinates
    if coordinates.transformation is None:
        return False
    middle = [0.5 * (a + b) for a, b in zip(coordinates.position, end, strict=True)]
    ends = zip(coordinates.machine, coordinates.to_machine(end), strict=True)
    between = coordinates.to_machine(middle)
    return all(abs(0.5 * (a + b) - c) <= NO_WAY for (a, b), c in zip(ends, between, strict=True))


def await_positioned(channel: SinumerikChannel, column: int) -> None:
    """The block ends when a positioned axis stands, and what moves along with it."""
    await_rest(channel, ActionAxes.of(channel).along.pop(column, (column,)), column)


def await_rest(channel: SinumerikChannel, columns: Iterable[int], leading: int | None = None) -> None:
    """The block ends when these axes stand; beside a leading one those that oscillate are not waited for."""
    clocked, known = channel.actual.clocked, ActionAxes.of(channel).may_move
    awaited = tuple(column for column in columns if column in known)
    if not awaited:
        return
    awaits = None if clocked is None else partial(_moves, channel, clocked, awaited, leading)
    channel.event(AxesAwaited("WAITP", None, None, False, awaits, columns=awaited))


def _moves(
    channel: SinumerikChannel, clocked: Interpolator, awaited: tuple[int, ...], leading: int | None
) -> bool:
    """Whether awaited axes are under way; as of `await_rest`."""
    held = ActionAxes.of(channel).held
    if leading is None:
        return any(column in held or clocked.commanded(column).moves for column in awaited)
    waited = (column for column in awaited if column == leading or column not in held)
    return any(clocked.commanded(column).moves for column in waited)


def call(channel: SinumerikChannel, name: str, places: dict[int, float]) -> None:
    """Axes, which stand, are at other machine positions from here on, by column; nothing moves (PRESETON, AXCTSWE)."""
    machine, clocked = channel.coordinates.machine, channel.actual.clocked
    for column, place in places.items():
        machine[column] = place
    channel.coordinates.arrive_machine(machine)
    if clocked is None:
        channel.flush()
        channel.toolpath.recount(places)
        return

    def do() -> None:
        for column, place in places.items():
            clocked.stand_at(column, place)

    channel.event(Deed(name, None, do, places=tuple(places.items()), stands=True))


def release(channel: SinumerikChannel, args: Arguments) -> None:
    """RELEASE: the axes are neutral."""
    for axis in args:
        ActionAxes.of(channel).states[arguments.column(channel, axis)] = NEUTRAL


def request(channel: SinumerikChannel, column: int) -> bool:
    """A channel asks for an axis: whether it must come from another one first."""
    state = _state_of(channel, column)
    ActionAxes.of(channel).states[column] = _ASKED.get(state, state)
    return _owned(channel, column) != PROGRAM


def arrived(channel: SinumerikChannel, column: int) -> None:
    """An axis that has been asked for is there: neutral, or the program's where it has been asked for twice."""
    states = ActionAxes.of(channel).states
    states[column] = PROGRAM if states.get(column) in (ELSEWHERE_FOR_PROGRAM, PROGRAM) else NEUTRAL


def is_neutral(channel: SinumerikChannel, column: int) -> bool:
    """Whether an axis stands and belongs to neither the program nor an action of its channel."""
    return _state_of(channel, column) == NEUTRAL


def forget(channel: SinumerikChannel, axis: str) -> None:
    """The program has released an axis, by its name on the machine: what actions have made of it is over."""
    names = channel.machine.channel(channel.number).axes
    if axis in names:
        ActionAxes.of(channel).states.pop(names.index(axis), None)


def _state_of(channel: SinumerikChannel, column: int) -> int:
    """Who has an axis now."""
    clocked = channel.actual.clocked
    state = ActionAxes.of(channel).states.get(column)
    if state is None:
        return _owned(channel, column)
    rests = clocked is not None and not clocked.commanded(column).moves
    return _AT_REST.get(state, state) if rests else state


def is_elsewhere(channel: SinumerikChannel, column: int) -> bool:
    """Whether another channel has an axis."""
    return _owned(channel, column) == ELSEWHERE


def _owned(channel: SinumerikChannel, column: int) -> int:
    """Who has an axis that no action has had: RELEASE of the program makes it neutral."""
    axis = channel.machine.channel(channel.number).axes[column]
    owner = channel.group.owner[axis] if channel.group is not None else channel.number
    return PROGRAM if owner == channel.number else ELSEWHERE if owner else NEUTRAL


def _state(channel: SinumerikChannel, indices: Indices) -> int:
    return _state_of(channel, arguments.column(channel, indices[0] if indices else None))


EXCHANGE_VARIABLES: dict[str, RowWithStop] = {
    "$AA_AXCHANGE_TYP": (Type.INT, _state, None, True),
    "$AA_TYP": (Type.INT, lambda channel, indices: _TYPES[_state(channel, indices)], None, True),
}
