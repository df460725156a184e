"""Generated master values: LEADON of an axis with `$SA_LEAD_TYPE` 2 follows what is written to `$AA_LEAD_SP` (9.3).

Nothing moves on the path: each value that is written sends the following axis to its place on the table, as fast as it
can go. Before that it waits until its place comes to where it stands, or within MD37200.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.actions.axes import ActionAxes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.curve_tables.memory import CurveTables
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.curve_tables.curve import CurveTable
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Writer

TYPE, GENERATED = "$SA_LEAD_TYPE", 2
_TOLERANCE = "$MA_COUPLE_POS_TOL_COARSE"


@dataclass(slots=True)
class Follower:
    """What follows a generated value.

    Attributes:
        leading: Column of the axis whose value it is.
        table: Says where the following axis belongs.
        gap: How far that is from where the axis stands while it waits; None once it follows, or before the first look.
        follows: It does not wait any more.
    """

    leading: int
    table: CurveTable
    gap: float | None = None
    follows: bool = False


@dataclass(slots=True)
class MasterValues(State, lifetime=Lifetime.POWER):
    """What programs and actions have written, by the column of the leading axis, and who follows it.

    Attributes:
        places: `$AA_LEAD_SP`, mm or degrees.
        speeds: `$AA_LEAD_SV`, as written.
        led: By the column of the following axis.
    """

    places: dict[int, float] = field(default_factory=dict)
    speeds: dict[int, float] = field(default_factory=dict)
    led: dict[int, Follower] = field(default_factory=dict)

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset ends what follows; power-on forgets the values."""
        if lifetime >= Lifetime.RESET:
            for column in list(self.led):
                let_go(channel, column)
        if lifetime >= Lifetime.POWER:
            self.places, self.speeds = {}, {}


def is_generated(channel: SinumerikChannel, leading: int) -> bool:
    """Whether the master value of an axis is generated."""
    return channel.memory.data.integer(TYPE, channel.axes[leading]) == GENERATED


def lead(channel: SinumerikChannel, following: int, leading: int, table: CurveTable) -> None:
    """LEADON: an axis follows a generated value from here on."""
    channel.on_clock()
    action_axes.expect(channel, (following,))
    _take(channel, following, Follower(leading, table))

    def begin() -> None:
        _send(channel, following)

    channel.event(Deed("LEADON", None, begin, is_silent=False))


def lead_now(
    channel: SinumerikChannel, following: int, leading: int, table: CurveTable, *, at_once: bool
) -> None:
    """LEADON of an action: from this moment on, without a wait for its place where it is to go there `at_once`."""
    if following in MasterValues.of(channel).led:
        let_go(channel, following)
    _take(channel, following, Follower(leading, table, follows=at_once))
    _send(channel, following)


def leave_now(channel: SinumerikChannel, following: int) -> None:
    """LEADOF of an action: the axis brakes."""
    let_go(channel, following)
    channel.on_clock().commanded(following).stop()


def _take(channel: SinumerikChannel, following: int, follower: Follower) -> None:
    ActionAxes.of(channel).geared.add(following)
    CurveTables.of(channel).use(follower.table.number)
    MasterValues.of(channel).led[following] = follower


def leave(channel: SinumerikChannel, following: int) -> None:
    """LEADOF: the axis brakes, and is the program's again."""
    clocked = channel.on_clock()
    action_axes.expect(channel, (following,))

    def end() -> None:
        clocked.commanded(following).stop()

    def moves() -> bool:
        return clocked.commanded(following).moves

    let_go(channel, following)
    channel.event(Deed("LEADOF", None, end, is_silent=False, awaits=moves))


def let_go(channel: Channel, following: int) -> None:
    """An axis follows no generated value any more."""
    follower = MasterValues.of(channel).led.pop(following)
    CurveTables.of(channel).leave(follower.table.number)
    ActionAxes.of(channel).geared.discard(following)


def _send(channel: SinumerikChannel, following: int) -> None:
    """The following axis goes to its place, unless it waits for that."""
    state, clocked = MasterValues.of(channel), channel.actual.clocked
    follower = state.led.get(following)
    if follower is None or clocked is None:
        return
    wanted = follower.table.followed(state.places.get(follower.leading, 0.0)).place
    if not follower.follows:
        gap, before = wanted - clocked.machine(following), follower.gap
        near = abs(gap) <= channel.memory.data.number(_TOLERANCE, channel.axes[following])
        follower.gap, follower.follows = gap, near or (before is not None and before * gap <= 0.0)
    if follower.follows:
        clocked.commanded(following).move_to(wanted, channel.axis_data[following].rapid)


def place(channel: SinumerikChannel, column: int) -> float:
    """The generated place of an axis."""
    return MasterValues.of(channel).places.get(column, 0.0)


def speed(channel: SinumerikChannel, column: int) -> float:
    """The generated speed of an axis."""
    return MasterValues.of(channel).speeds.get(column, 0.0)


def write(what: str) -> Writer:
    """`$AA_LEAD_SP[axis]=`, `$AA_LEAD_SV[axis]=`: of a program when its axes are there."""

    def run(channel: SinumerikChannel, indices: Indices, value: float) -> None:
        column = arguments.column(channel, indices[0] if indices else None)

        def store() -> None:
            state = MasterValues.of(channel)
            getattr(state, what)[column] = float(value)
            for following, follower in state.led.items():
                if follower.leading == column:
                    _send(channel, following)

        if channel.main_run is None:
            store()
        else:
            channel.event(Deed("$AA_LEAD", None, store))

    return run
