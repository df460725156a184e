"""TANG, TANGON, TANGOF, TLIFT, TANGDEL; words of a coupled axis; `$AA_COUP_ACT` of it (job planning 8.1).

A word of a coupled axis is put to its offset angle: absolute ones take the place of the last, incremental ones add up.
"""

from __future__ import annotations

from math import inf, nan

from polycnc.channel.moves.path import PlacedEvent
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.block.positions import Dimension, axis_term, number
from polycnc.control.sinumerik.feed.pace import Overrides
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.tangential.coupling import Coupling
from polycnc.control.sinumerik.tangential.stage import Positioned, TangentialStage
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.block.positions import AxisTerm
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Modal state that names the columns of coupled axes, so that blocks that name them are worked out anew.
GROUP = "tangential"
BASIC_SYSTEM, STANDARD, OPTIMISED = "B", "S", "P"
#: `$AA_COUP_ACT` of an axis that follows the path.
TANGENTIAL = 1


class Definition(NamedTuple):
    """What TANG says of a following axis: columns of its leading axes, factor, optimisation; and TLIFT.

    TANGON has used it where `is_used` is set: TLIFT comes too late then.
    """

    leading: tuple[int, int]
    factor: float
    optimised: bool
    lifts: bool = False
    is_used: bool = False


@dataclass(slots=True)
class Tangential(State, lifetime=Lifetime.RESET):
    """What is defined, by the columns of following axes.

    Attributes:
        definitions: By TANG.
        added: What words have put to the offsets of coupled axes, degrees.
        stood: Where all axes stood in front of the block that names coupled ones.
    """

    definitions: dict[int, Definition] = field(default_factory=dict)
    added: dict[int, float] = field(default_factory=dict)
    stood: list[float] = field(default_factory=list)


# ---- procedures


def define(channel: SinumerikChannel, args: Arguments) -> None:
    """TANG(following, leading 1, leading 2, factor, system, optimisation): only says what TANGON will couple."""
    if not 3 <= len(args) <= 6 or None in args[:3]:
        raise AlarmError("14020", text="TANG")
    following, *leading = (arguments.column(channel, axis) for axis in args[:3])
    factor, system, optimisation = (args[i] if i < len(args) else None for i in range(3, 6))
    is_rotary = channel.memory.axes[following].rotary
    if not is_rotary or len({following, *leading}) < 3:
        raise AlarmError("14020", text="TANG", hint="hint.tangential-axes")
    if system not in (None, "", BASIC_SYSTEM) or optimisation not in (None, "", STANDARD, OPTIMISED):
        raise AlarmError("14020", text="TANG", hint="hint.tangential-letters")
    told = Definition(
        (leading[0], leading[1]),
        1.0 if factor is None else arguments.real(factor),
        optimisation == OPTIMISED,
    )
    definitions = Tangential.of(channel).definitions
    if following in definitions and definitions[following].leading != told.leading:
        raise AlarmError("14020", text="TANG", hint="hint.tangential-defined")
    definitions[following] = told
    _couple_anew(channel, following)


def lift(channel: SinumerikChannel, args: Arguments) -> None:
    """TLIFT(axis): behind its TANG, also while the coupling is on; at corners the axis turns in a block of its own."""
    column = _following(channel, "TLIFT", args)
    definitions = Tangential.of(channel).definitions
    if definitions[column].is_used:
        raise AlarmError("14020", text="TLIFT", hint="hint.tangential-lift")
    definitions[column] = definitions[column]._replace(lifts=True)
    _couple_anew(channel, column)


def couple(channel: SinumerikChannel, args: Arguments) -> None:
    """TANGON(axis, offset angle, smoothing way, tolerance): from the next motion on the axis follows."""
    column = _following(channel, "TANGON", args, most=4)
    angle, distance, tolerance = (
        0.0 if value is None else arguments.real(value) for value in (*args[1:], *(None,) * (4 - len(args)))
    )
    definitions = Tangential.of(channel).definitions
    definition = definitions[column]
    if distance < 0.0 or tolerance < 0.0:
        raise AlarmError("14020", text="TANGON")
    definitions[column] = definition._replace(is_used=True)
    channel.flush()
    Tangential.of(channel).added[column] = 0.0
    axis, memory = channel.axis_data[column], channel.memory
    unbounded = definition.optimised and not (len(args) > 3 and args[3] is not None)
    coupling = Coupling(
        column,
        definition.leading,
        definition.factor,
        angle,
        definition.lifts,
        memory.data.number("$MA_EPS_TLIFT_TANG_STEP", channel.axes[column]),
        action_axes.speed_of(channel, column),
        Overrides.of(channel).radii.get(column, 0.0),
        definition.optimised,
        distance * tables.length_factor(channel.mode),
        inf if unbounded else tolerance,
        axis.rapid,
        axis.acceleration,
        channel.coordinates.position[column],
    )
    stage = channel.path.find(TangentialStage)
    if stage is None:
        stage = TangentialStage(channel)
        channel.path.put(stage)
    before = stage.couplings.get(column)
    if before is not None:
        coupling.direction, coupling.turns, coupling.at = before.direction, before.turns, before.at
    stage.couplings[column] = coupling
    _note(channel, stage)


def release(channel: SinumerikChannel, args: Arguments) -> None:
    """TANGOF(axis): the axis stays where it is."""
    column = _following(channel, "TANGOF", args)
    stage = channel.path.find(TangentialStage)
    if stage is None or column not in stage.couplings:
        return
    channel.flush()
    del stage.couplings[column]
    if not stage.couplings:
        channel.path.take(TangentialStage)
    _note(channel, stage)


def delete(channel: SinumerikChannel, args: Arguments) -> None:
    """TANGDEL(axis): the definition goes; only behind TANGOF."""
    column = _following(channel, "TANGDEL", args)
    if is_coupled(channel, column):
        raise AlarmError("14020", text="TANGDEL", hint="hint.tangential-on")
    del Tangential.of(channel).definitions[column]


PROCEDURES: dict[str, Procedure] = {
    "TANG": define,
    "TLIFT": lift,
    "TANGON": couple,
    "TANGOF": release,
    "TANGDEL": delete,
}


def _following(channel: SinumerikChannel, name: str, args: Arguments, most: int = 1) -> int:
    """Column of the following axis; 14020 where TANG has not defined it, or with too many arguments."""
    if not 1 <= len(args) <= most:
        raise AlarmError("14020", text=name)
    column = arguments.column(channel, args[0])
    if column not in Tangential.of(channel).definitions:
        raise AlarmError("14020", text=name, hint="hint.tangential-undefined")
    return column


def _couple_anew(channel: SinumerikChannel, column: int) -> None:
    """TANG again while the coupling is on: factor, optimisation and TLIFT are the new ones."""
    stage = channel.path.find(TangentialStage)
    if stage is not None and column in stage.couplings:
        channel.flush()
        told, coupling = Tangential.of(channel).definitions[column], stage.couplings[column]
        stage.couplings[column] = replace(
            coupling, factor=told.factor, leads_speed=told.optimised, lifts=told.lifts
        )


def is_coupled(channel: SinumerikChannel, column: int) -> bool:
    """Whether an axis follows the path."""
    return str(column) in channel.mode[GROUP].split()


def _note(channel: SinumerikChannel, stage: TangentialStage) -> None:
    channel.mode = channel.mode.with_code(GROUP, " ".join(map(str, sorted(stage.couplings))))


# ---- words of a coupled axis


def plan_words(draft: Draft) -> Step | None:
    """Take the words of coupled axes out of a block; gives what turns them where nothing else moves."""
    coupled = {int(column) for column in draft.mode[GROUP].split()}
    terms: list[tuple[AxisTerm, bool]] = []
    for position, word in draft.open_words():
        beside = word.address in ("POS", "POSA") and isinstance(word.index, Axis)
        if not beside and (word.index is not None or word.address not in draft.memory.columns):
            continue
        column = draft.memory.column(word.index.name if isinstance(word.index, Axis) else word.address)
        if column in coupled:
            draft.close(position)
            terms.append((axis_term(draft.channel, draft.mode, position, column, word.modifier), beside))
    if not terms:
        return None

    def add(channel: SinumerikChannel, values: Values) -> None:
        Tangential.of(channel).stood = channel.coordinates.position.copy()
        for term, _ in terms:
            _put_to_offset(channel, term, number(values, term.position))

    draft.steps.append(add)
    return _turn_alone(terms, rapid=draft.mode["motion"] == "G0")


def _put_to_offset(channel: SinumerikChannel, term: AxisTerm, value: float) -> None:
    added = Tangential.of(channel).added
    total = value + (added.get(term.column, 0.0) if term.way is Dimension.INCREMENTAL else 0.0)
    added[term.column] = total
    event = Positioned(term.column, total)
    level, head = channel.level, channel.path.head
    if head is not None:
        head.event(PlacedEvent(event, level.program_number, channel.line, channel.context_number()))


def _turn_alone(terms: list[tuple[AxisTerm, bool]], *, rapid: bool) -> Step:
    """Behind the motion of a block: where the path has stood, the axes turn on the spot."""

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        stage, before = channel.path.find(TangentialStage), Tangential.of(channel).stood
        if stage is None or channel.coordinates.position != before:
            return
        changes = {column: c.added - c.applied for column, c in stage.couplings.items()}
        end = [value + changes.get(column, 0.0) for column, value in enumerate(before)]
        if all(beside for _, beside in terms):
            channel.straight(Kind.FEED, end, action_axes.speed_of(channel, terms[0][0].column))
        else:
            feed = nan if rapid else moves.checked_feed(channel.feed)
            channel.straight(Kind.RAPID if rapid else Kind.FEED, end, feed)

    return run


# ---- the state of a coupling


def coupling_state(channel: SinumerikChannel, column: int) -> int:
    """`$AA_COUP_ACT` as far as tangential control goes: 0 for none."""
    return TANGENTIAL if is_coupled(channel, column) else 0
