"""States of the program as synchronised actions see them: those of the block in execution (job planning 10.1.2).

Preparation runs ahead, and with it the states that blocks change: speeds of spindles, couplings, tolerances, sections,
frames. While actions read some of them, the first stage of the path notes what has changed, in order with the moves;
the main run takes it over when the axes are there.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.moves.path import Move, PlacedEvent, Rank, Stage
from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader

#: Variables of the main run that tell a state of the program: of the channel, of an axis or spindle, of a spindle.
OF_CHANNEL = frozenset(
    (
        *("$AC_DELAYFST", "$AC_CTOL", "$AC_OTOL", "$AC_MSNUM", "$AC_SDIR"),
        *("$AC_CUTMOD", "$AC_CUTMOD_ANG", "$AC_CUT_INV"),
    )
)
OF_AXES = frozenset(("$AA_MOTEND", "$AA_SCPAR", "$AA_COUP_ACT", "$AA_ATOL", "$AA_FXS", "$AA_FOC"))
SPEED = "$AA_S"
OF_SPINDLES = frozenset((SPEED, "$AC_SDIR"))
NAMES = OF_CHANNEL | OF_AXES | OF_SPINDLES
#: Positions, of which frames of the program are states.
OF_FRAMES = frozenset(("$AA_IEN", "$AA_IBN"))
#: Variable and indices.
Key: TypeAlias = tuple[str, tuple[Any, ...]]


@dataclass(slots=True)
class InForce(State, lifetime=Lifetime.RESET):
    """What holds in the block in execution, as far as actions ask.

    Attributes:
        names: Variables that actions have asked for.
        values: Their values in the main run; empty where no action asks.
        prepared: Their values behind the block that was prepared last.
    """

    names: set[str] = field(default_factory=set)
    values: dict[Key, Any] = field(default_factory=dict)
    prepared: dict[Key, Any] = field(default_factory=dict)


#: How the preparation reads them.
_READERS: dict[str, Reader] = {}


def live(name: str, reader: Reader) -> Reader:
    """A reader of such a variable, or of the frames of a position, that tells what is in force."""
    _READERS[name] = reader

    return partial(_in_force, name)


def watch(channel: SinumerikChannel, names: Iterable[str]) -> None:
    """An action that reads variables is prepared: from here on their values go along with the path."""
    asked = (NAMES | OF_FRAMES).intersection(names)
    state = InForce.of(channel)
    if not asked <= state.names:
        state.names |= asked
        now = dict(_prepared(channel, asked))
        state.prepared.update(now)
        state.values.update(now)
    if asked and channel.path.find(StatesOfProgram) is None:
        channel.path.put(StatesOfProgram(channel))


def turning(channel: SinumerikChannel, number: int) -> float:
    """What a spindle turns with in the block in execution, rpm, negative for M4; as far as `SPEED` is watched."""
    speed: float = _in_force(SPEED, channel, (number,))
    return speed


def _in_force(name: str, channel: SinumerikChannel, indices: Indices) -> Any:
    values = InForce.of(channel).values
    key = name, indices
    return values[key] if values and key in values else _READERS[name](channel, indices)


def refresh(channel: SinumerikChannel) -> None:
    """The main run itself has changed a state: that holds at once."""
    state = InForce.of(channel)
    if state.names:
        state.prepared = dict(_prepared(channel, state.names))
        state.values.update(state.prepared)


def _prepared(channel: SinumerikChannel, names: Iterable[str]) -> Iterator[tuple[Key, Any]]:
    """Variables with their indices and values where preparation is."""
    for name in names:
        for indices in _indices(channel, name):
            try:
                yield (name, indices), _READERS[name](channel, indices)
            except AlarmError:  # this axis has no such state
                continue


def _indices(channel: SinumerikChannel, name: str) -> Iterator[tuple[Any, ...]]:
    spindles = tuple(channel.memory.spindles.all)
    if name in OF_CHANNEL or name in OF_FRAMES:
        yield ()
    if name in OF_SPINDLES:
        yield from ((number,) for number in spindles)
    if name in OF_AXES or name in OF_SPINDLES:
        yield from ((Axis(f"S{number}"),) for number in spindles)
    if name in OF_AXES:
        yield from ((Axis(each),) for each in {*channel.axes, *channel.memory.data.axes})


class StatesOfProgram(Stage):
    """The first stage of the path while actions read states of the program."""

    rank = Rank.STATES
    keeps_ends = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel

    def move(self, move: Move) -> None:
        """What a block has changed in front of its motion holds from there."""
        self._note()
        self.after.move(move)

    def block(self) -> None:
        """A block without motion may have changed something too."""
        self._note()
        self.after.block()

    def flush(self) -> None:
        """Whoever flushes may wait for the main run then."""
        self._note()
        self.after.flush()

    def _note(self) -> None:
        channel = self._channel
        state = InForce.of(channel)
        now = dict(_prepared(channel, state.names))
        changed = {key: value for key, value in now.items() if state.prepared.get(key) != value}
        if changed:
            state.prepared = now
            deed = Deed("STATES", None, partial(_take_over, channel, changed))
            number, context = channel.level.program_number, channel.context_number()
            self.after.event(PlacedEvent(deed, number, channel.line, context))


def _take_over(channel: SinumerikChannel, changed: dict[Key, Any]) -> None:
    InForce.of(channel).values.update(changed)
