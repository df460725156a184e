"""Master and slave axes and spindles: MASLDEF, MASLON, MASLOF, MASLOFS, MASLDEL (job planning 9.6).

A slave does what its master does. Axes, and spindles with MD37263 = 0, open and close their coupling at standstill
only: what is told before that happens as soon as both stand. MD37262 makes a coupling permanent: the commands have no
effect on it, and NEWCONF lets a new value of the datum act.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.moves.path import Rank, Stage
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.couplings import spindle_pairs, synchronous
from polycnc.control.sinumerik.couplings.links import Couplings, Kind, Link
from polycnc.control.sinumerik.couplings.spindle_pairs import Pair, SpindlePairs, turns
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.sinumerik.names.spindles import spindle_number
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError
from polycnc.transformation.couplings.laws import Ratio

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments
    from polycnc.control.sinumerik.couplings import switching

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel

#: MD37262: the coupling is permanent; MD37263: a turning spindle is coupled at once.
PERMANENT, AT_ONCE = "$MA_MS_COUPLING_ALWAYS_ACTIVE", "$MA_MS_SPIND_COUPLING_MODE"


@dataclass(slots=True)
class Masters(State, lifetime=Lifetime.POWER):
    """Who is the slave of whom.

    Attributes:
        axes: Column of the master of each slave axis, by its column.
        wanted: What slave spindles shall do once they may: be coupled or not, by number.
        stops: Numbers of those that shall stop then.
    """

    axes: dict[int, int] = field(default_factory=dict)
    wanted: dict[int, bool] = field(default_factory=dict)
    stops: set[int] = field(default_factory=set)


def define(channel: SinumerikChannel, args: Arguments) -> None:
    """MASLDEF(slave,…,master): the last one is the master of all others.

    Raises:
        AlarmError: 14020 for less than two names, or a spindle among axes; 16785 and 16778 for one that would lead
            itself; 16797 for a slave that is coupled.
    """
    if len(args) < 2 or None in args:
        raise AlarmError("14020", text="MASLDEF")
    *slaves, master = (_named(channel, value) for value in args)
    if any(is_spindle is not master[0] for is_spindle, _ in slaves):
        raise AlarmError("14020", text="MASLDEF")
    for is_spindle, slave in slaves:
        if is_spindle:
            _define_spindle(channel, slave, master[1])
        elif slave == master[1]:
            raise AlarmError("16785", axis=channel.axes[slave])
        elif _links(channel, slave):
            raise AlarmError("16797", axis=channel.axes[slave])
        else:
            Masters.of(channel).axes[slave] = master[1]
    settle(channel)


def _define_spindle(channel: SinumerikChannel, slave: int, master: int) -> None:
    spindle_pairs.refuse_ring(channel, slave, master)
    if SpindlePairs.of(channel).acting(slave) is not None:
        raise AlarmError("16797", axis=f"S{slave}")
    SpindlePairs.of(channel).by_following[slave] = Pair(master, is_slave=True)


def couple(channel: SinumerikChannel, args: Arguments) -> None:
    """MASLON(slave,…): the coupling closes.

    Raises:
        AlarmError: 16796 for one without a master.
    """
    for is_spindle, slave in _slaves(channel, "MASLON", args):
        if is_spindle:
            _want(channel, slave, coupled=True)
        elif not _is_permanent(channel, channel.axes[slave]):
            _couple_axis(channel, slave)
    settle(channel)


def uncouple(name: str, channel: SinumerikChannel, args: Arguments, *, stops: bool = False) -> None:
    """MASLOF(slave,…): the coupling opens, a turning spindle goes on; MASLOFS: it stops, with MD37263 = 1."""
    for is_spindle, slave in _slaves(channel, name, args):
        if is_spindle:
            _want(channel, slave, coupled=False, stops=stops)
        elif not _is_permanent(channel, channel.axes[slave]):
            _uncouple_axis(channel, slave, name)
    settle(channel)


def delete(channel: SinumerikChannel, args: Arguments) -> None:
    """MASLDEL(slave,…): the coupling opens, and nobody is their master any more."""
    slaves = list(_slaves(channel, "MASLDEL", args))
    uncouple("MASLDEL", channel, args)
    for is_spindle, slave in slaves:
        if not is_spindle:
            Masters.of(channel).axes.pop(slave, None)
        elif SpindlePairs.of(channel).acting(slave) is None:
            SpindlePairs.of(channel).by_following.pop(slave, None)
        else:
            raise not_supported(f"MASLDEL S{slave}: MD37263 = 0")


def settle(channel: SinumerikChannel) -> None:
    """Couplings of slave spindles open and close that may do so now."""
    state = Masters.of(channel)
    for slave, coupled in list(state.wanted.items()):
        pair = SpindlePairs.of(channel).by_following[slave]
        at_once = bool(channel.memory.data.integer(AT_ONCE, f"S{slave}"))
        if not at_once and (turns(channel, slave) or turns(channel, pair.leading)):
            continue
        del state.wanted[slave]
        if coupled:
            pair.offset, pair.acts = spindle_pairs.offset_of(channel, slave, pair), True
        elif pair.acts:
            synchronous.leave(channel, slave, pair, stops=slave in state.stops and at_once)
        state.stops.discard(slave)
        channel.context_changed()


def reconfigure(channel: SinumerikChannel) -> None:
    """NEWCONF: permanent couplings close, and stay until MASLOF once they are permanent no more."""
    for slave in Masters.of(channel).axes:
        if _is_permanent(channel, channel.axes[slave]) and not _links(channel, slave):
            _couple_axis(channel, slave)
    for slave, pair in SpindlePairs.of(channel).by_following.items():
        if pair.is_slave and not pair.acts and _is_permanent(channel, f"S{slave}"):
            Masters.of(channel).wanted[slave] = True
    settle(channel)


def master_of(channel: SinumerikChannel, value: Any) -> int:
    """`$AA_MASL_STAT[slave]`: number of the machine axis or spindle that leads a slave now, 0 for none."""
    is_spindle, slave = _named(channel, value)
    if is_spindle:
        pair = SpindlePairs.of(channel).acting(slave)
        return pair.leading if pair is not None and pair.is_slave else 0
    return next((link.law.leading + 1 for link in _links(channel, slave)), 0)


def _named(channel: SinumerikChannel, value: Any) -> tuple[bool, int]:
    """Whether a name is that of a spindle, and its number or column."""
    number = spindle_number(value) if isinstance(value, Axis) else None
    if number is not None:
        return True, channel.memory.spindles.get(number).number
    return False, arguments.column(channel, value)


def _slaves(channel: SinumerikChannel, name: str, args: Arguments) -> list[tuple[bool, int]]:
    """The slaves that a call names; 16796 for one without a master."""
    if not args:
        raise AlarmError("14020", text=name)
    slaves = [_named(channel, value) for value in args]
    for is_spindle, slave in slaves:
        pair = SpindlePairs.of(channel).by_following.get(slave) if is_spindle else None
        if not (pair is not None and pair.is_slave if is_spindle else slave in Masters.of(channel).axes):
            raise AlarmError("16796", axis=f"S{slave}" if is_spindle else channel.axes[slave])
    return slaves


def _want(channel: SinumerikChannel, slave: int, *, coupled: bool, stops: bool = False) -> None:
    state = Masters.of(channel)
    if _is_permanent(channel, f"S{slave}"):
        return
    state.wanted[slave] = coupled
    state.stops.discard(slave)
    if stops:
        state.stops.add(slave)


def _is_permanent(channel: SinumerikChannel, name: str) -> bool:
    return bool(channel.memory.data.integer(PERMANENT, name))


# ---- axes


def _links(channel: SinumerikChannel, slave: int) -> list[Link]:
    return Couplings.of(channel).of_kind(slave, Kind.SLAVE)


def _couple_axis(channel: SinumerikChannel, slave: int) -> None:
    """A slave axis goes with its master from where both stand."""
    if _links(channel, slave):
        return
    master = Masters.of(channel).axes[slave]
    if Couplings.of(channel).links.get(slave):
        raise AlarmError("16797", axis=channel.axes[slave])
    switching.begin(channel, "MASLON")
    origin = channel.coordinates.machine[master]
    switching.change(channel, slave, [Link(Kind.SLAVE, Ratio(master, 1.0, origin))])
    channel.path.put(SlaveStage(channel))


def _uncouple_axis(channel: SinumerikChannel, slave: int, name: str) -> None:
    if _links(channel, slave):
        switching.begin(channel, name)
        switching.change(channel, slave, [])


class SlaveStage(Stage):
    """Refuses words of slave axes: only their master moves them.

    Args:
        channel: The channel whose moves come by.
    """

    rank = Rank.SLAVES
    lasts = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel

    @property
    def active(self) -> bool:
        """Whether an axis is coupled to its master."""
        links = Couplings.of(self._channel).links
        return any(link.kind is Kind.SLAVE for of in links.values() for link in of)

    def move(self, move: Move) -> None:
        """Pass a move on.

        Raises:
            AlarmError: PC0001 for a move of a slave by itself.
        """
        for column in Couplings.of(self._channel).links:
            if _links(self._channel, column) and abs(move.end[column] - move.start[column]) > NO_WAY:
                raise not_supported(f"MASLON {self._channel.axes[column]}")
        self.after.move(move)


PROCEDURES: dict[str, Procedure] = {
    "MASLDEF": define,
    "MASLON": couple,
    "MASLOF": partial(uncouple, "MASLOF"),
    "MASLOFS": partial(uncouple, "MASLOFS", stops=True),
    "MASLDEL": delete,
}
