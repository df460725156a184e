"""How a control says that something is plain: what the interpreter's function does, told as data.

A control makes functions out of the shape of a block: a step that moves, a step that sets the feed, a conversion of a
number. Where such a function does no more than what is told here, it carries that as a declaration. A block is plain
if every one of its steps carries one; the scanner then does the same without calling them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from enum import IntEnum
from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias, TypeVar
from polycnc.language.bulk.conversions import Reading

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel

_F = TypeVar("_F", bound=Callable[..., object])
#: A step of a plan: gets the channel, and the values of the block's words by their index.
Step: TypeAlias = "Callable[[Channel, Any], object]"
#: Something of a channel on which it rests that a block is plain.
Condition: TypeAlias = "Callable[[Channel], bool]"


class Scaling(IntEnum):
    """How a typed number becomes one in internal units."""

    AS_IS = Reading.AS_IS
    #: `value * unit`
    TIMES = Reading.TIMES
    #: `value / scale * unit`
    INCREMENTS = Reading.INCREMENTS
    #: Digits below `1 / scale` are cut off, then `* unit`.
    CUT = Reading.CUT
    #: `value * unit / scale`
    RATIO = Reading.RATIO
    #: To the nearest `1 / scale`, then `* unit`.
    ROUNDED = Reading.ROUNDED


class Conversion(NamedTuple):
    """A conversion of a typed number; see `Scaling`."""

    way: Scaling = Scaling.AS_IS
    scale: float = 1.0
    unit: float = 1.0


AS_TYPED = Conversion()


class Word(NamedTuple):
    """A word with a number: index of its value, and its conversion."""

    slot: int
    conversion: Conversion = AS_TYPED


class Target(NamedTuple):
    """An axis word: index of its value, its conversion, the channel axis, whether it is an increment."""

    slot: int
    conversion: Conversion
    axis: int
    incremental: bool = False


class SetFeed(NamedTuple):
    """A step that sets the channel's feed.

    Attributes:
        word: The feed.
        positive: A feed that is not above zero is the interpreter's.
    """

    word: Word
    positive: bool = False


class Straight(NamedTuple):
    """A step that moves in a straight line.

    Attributes:
        rapid: Rapid traverse; its row names the feed only with `names_feed`.
        targets: Axis words in the order in which they act.
        names_feed: The block has a feed of its own.
        needs_feed: No feed above zero is an alarm.
        absolute: No word is an increment: where programmed point and display are one, the end point is worked
            out from the display.
        skips_tiny: A way below rounding noise is none, and the position stays.
        direction: Indices of the values of the direction in which the tool stands at its end, -1 for zero.
        drills: The axis along which strokes of the active cycle follow (`Drilled`); -1 for none.
    """

    rapid: bool
    targets: tuple[Target, ...]
    names_feed: bool = False
    needs_feed: bool = True
    absolute: bool = True
    skips_tiny: bool = False
    direction: tuple[int, int, int] | None = None
    drills: int = -1


class Drilled(NamedTuple):
    """The strokes of the next hole.

    Attributes:
        axis: Along which they go.
        level: Where the tool stands on it, `feed` the feed in force: for others they are not known.
        end: Where it stands behind them.
        blocks: How many blocks they count.
        strokes: Kind, feed and place of each; of a dwell its seconds in place of a feed.
    """

    axis: int
    level: float
    feed: float
    end: float
    blocks: int
    strokes: tuple[tuple[int, float, float], ...]


class Arc(NamedTuple):
    """A step that moves along an arc or helix.

    Attributes:
        ccw: Sense, seen from the tip of the plane's third axis.
        plane: The plane's first, second and third axis as geometry axes.
        targets: Axis words in the order in which they act.
        centers: Words of the way from start to centre along the first and second axis of the plane.
        radius: Word of the radius; it wins over the centre.
        needs_feed: No feed above zero is an alarm.
        line_without_way: With a radius and without way in the plane the move is a straight line.
        radius_tolerances: How often the control's arc tolerance is allowed between chord and diameter.
    """

    ccw: bool
    plane: tuple[int, int, int]
    targets: tuple[Target, ...]
    centers: tuple[Word | None, Word | None] = (None, None)
    radius: Word | None = None
    needs_feed: bool = True
    line_without_way: bool = False
    radius_tolerances: float = 1.0


class Note(NamedTuple):
    """A step that touches nothing that the scanner works with: an event, another context.

    The scan goes past it; afterwards the step is called where its block stood.

    Attributes:
        slot: Index of the value that it needs, or -1.
        lowest: A smaller value is the interpreter's.
        condition: While it does not hold, the step is the interpreter's.
        step: What is called where the condition holds; the whole step, if None.
        apart: What it writes is told apart from rows of the same line (`Toolpath.set_block_apart`): a block that moves
            beside it is the interpreter's.
    """

    slot: int = -1
    lowest: float = -inf
    condition: Condition | None = None
    step: Step | None = None
    apart: bool = False


class Enter(NamedTuple):
    """A step that changes nothing but the modal state."""

    state: Hashable


class Idle(NamedTuple):
    """A step that changes nothing as long as a condition holds: a code that is in force already."""

    condition: Condition | None = None


class Call(NamedTuple):
    """A step that calls a program by its number, from its first block on.

    Attributes:
        number: The word with the number.
        repeats: The word that says how often; once without it.
        arguments: Words that set local variables of the program's own (`Target.axis`); None where it has none.
    """

    number: Word
    repeats: Word | None
    arguments: tuple[Target, ...] | None


class Return(NamedTuple):
    """A step that ends a program that was called, and goes on behind the call."""


class Later(NamedTuple):
    """What a step does is told when it is asked for: it may be an alarm, which the interpreter comes to.

    Attributes:
        tell: Gives what the step does, None for what cannot be told.
    """

    tell: Callable[[], object]


class Recipe(NamedTuple):
    """What a block of some shape does in some modal state.

    Attributes:
        next_state: The modal state that it leaves, as the dialect names it; hashable.
        feed: Sets the feed before it moves.
        motion: Its move, or how it calls or ends a program.
        notes: What it does in front of that, in order, one with a value at the most.
        formulas: What is calculated before all that: pairs of `layout.Operation` and argument.
    """

    next_state: Hashable
    feed: SetFeed | None = None
    motion: Straight | Arc | Call | Return | None = None
    notes: tuple[tuple[Step, Note], ...] = ()
    formulas: tuple[int, ...] = ()


class Conditions:
    """Makes recipes of steps, and keeps the conditions on which those given so far rest."""

    def __init__(self) -> None:
        self._held: dict[Condition, bool] = {}
        self._changes = 0

    def changes(self, channel: Channel) -> int:
        """How often any of them has changed, as far as this has been asked: while that stays, the recipes hold."""
        now = {condition: condition(channel) for condition in self._held}
        if now != self._held:
            self._held = now
            self._changes += 1
        return self._changes

    def _holds(self, channel: Channel, condition: Condition | None) -> bool:
        if condition is None:
            return True
        if condition not in self._held:
            self._held[condition] = condition(channel)
        return condition(channel)

    def recipe(self, channel: Channel, steps: Iterable[Step], state: Hashable) -> Recipe | None:
        """The recipe of a block that leaves a modal state; None where a step does what cannot be told."""
        feed: SetFeed | None = None
        motion: Straight | Arc | Call | Return | None = None
        notes: list[tuple[Step, Note]] = []
        for step in steps:
            told = declared(step)
            parts: tuple[object, ...] = told if type(told) is tuple else (told,)
            for told_part in parts:
                part = told_part.tell() if isinstance(told_part, Later) else told_part
                if isinstance(part, Idle) and self._holds(channel, part.condition):
                    continue
                if motion is not None:
                    return None
                if isinstance(part, Enter):
                    state = part.state
                elif isinstance(part, SetFeed):
                    feed = part
                elif isinstance(part, Note) and self._holds(channel, part.condition):
                    notes.append((part.step or step, part))
                elif isinstance(part, (Straight, Arc, Call, Return)):
                    motion = part
                else:
                    return None
        if sum(note.slot >= 0 for _, note in notes) > 1 or (motion and any(note.apart for _, note in notes)):
            return None
        return Recipe(state, feed, motion, tuple(notes))


@dataclass(frozen=True, slots=True)
class Spelling:
    """What a control's text looks like, as far as plain blocks go.

    Attributes:
        max_digits: Digits that a number may have, zeros in front not counted.
        round_comments: `( … )`.
        starred_comments: `(* … *)` in some of its files, which no other bracket ends.
        open_comments: A `(` without its `)` makes the rest of the line a comment.
        slash_comments: `//` to the end of the line.
        semicolon_comments: `;` to the end of the line; else `;` ends the block.
        equals: `X=1` is a word.
        forms_count: How a number was written is part of a block's shape.
        hexadecimal: `0X1` may be a hexadecimal number.
        cr_radius: `CR=` is an address.
        directions: `A3=`, `B3=` and `C3=` are words.
        blank_lines_are_blocks: A line without a block counts as one.
        formulas: `X[#1+2.]` is a word.
        expressions: `X=R1*2` and `R1=R2` are words.
        m_codes: `M3` is a code, else a word.
    """

    max_digits: int
    round_comments: bool = False
    starred_comments: bool = False
    open_comments: bool = False
    slash_comments: bool = False
    semicolon_comments: bool = False
    equals: bool = False
    forms_count: bool = True
    hexadecimal: bool = False
    cr_radius: bool = False
    directions: bool = False
    blank_lines_are_blocks: bool = True
    formulas: bool = False
    expressions: bool = False
    m_codes: bool = False

    @property
    def flags(self) -> int:
        """As the kernels read it."""
        from polycnc.language.bulk.layout import Grammar  # for long programs

        return (
            self.round_comments * Grammar.ROUND_COMMENTS
            | self.starred_comments * Grammar.STARRED_COMMENTS
            | self.open_comments * Grammar.OPEN_COMMENTS
            | self.slash_comments * Grammar.SLASH_COMMENTS
            | self.semicolon_comments * Grammar.SEMICOLON_COMMENTS
            | self.equals * Grammar.EQUALS
            | self.forms_count * Grammar.FORMS_COUNT
            | self.hexadecimal * Grammar.HEXADECIMAL
            | self.cr_radius * Grammar.CR_RADIUS
            | self.formulas * Grammar.FORMULAS
            | self.expressions * Grammar.EXPRESSIONS
            | self.directions * Grammar.DIRECTIONS
            | self.m_codes * Grammar.M_CODES
            | (not self.blank_lines_are_blocks) * Grammar.BLANK_LINES_ARE_NONE
        )


def declare(function: _F, what: object) -> _F:
    """Let a function carry what it does."""
    function.plain = what  # type: ignore[attr-defined]
    return function


def declared(function: Callable[..., object] | None) -> object:
    """What a function does, if it carries it; else None."""
    return getattr(function, "plain", None)
