"""Lines that differ in their numbers only are read once.

A long program with variables has many lines of few patterns: `G1 X[#1+0.001] Y#7`, `G1 X[#1+2.505] Y#9`. With a zero
in the place of every digit both read the same. They are one step with other numbers if also those numbers agree that
are no values: codes, and variables by the memory that holds them.

Which numbers are values the reader says while it reads the first line of a pattern. All others are part of the pattern
as they are written, so a number of which the reader says nothing is never taken for another one.
"""

from __future__ import annotations

from operator import call, itemgetter

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Protocol, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from polycnc.channel.channel import Channel

    Reading: TypeAlias = Callable[[str], float]
    Choice: TypeAlias = Callable[[Sequence[str]], tuple[str, ...]]

NUMBER = regex(r"\d+\.?\d*|\.\d+")
#: Lines that are kept; when there are more, all are forgotten.
MOST_LINES = 4096
#: Longer ones may be out of the range of numbers, which only the reader finds out.
LONGEST_NUMBER = 100
#: Variables that lie in one memory each: local ones, common ones that are lost and that stay without power.
MEMORIES = {"locals": range(1, 34), "common": range(100, 200), "kept": range(500, 1000)}
_MEMORY_OF = {str(number): memory for memory, numbers in MEMORIES.items() for number in numbers}
_WITHOUT_DIGITS = str.maketrans("123456789", "000000000")


def negative(digits: str) -> float:
    """The value of digits behind a minus."""
    return -float(digits)


class Spot(NamedTuple):
    """Where a line has a number that is a parameter of its step.

    Attributes:
        begin: Column of the first digit, from 0.
        reading: From its digits to the parameter.
        is_variable: Whether it is the number of a variable, else a value.
    """

    begin: int
    reading: Reading
    is_variable: bool = False


class Repeatable(Protocol):
    """A step that lines of its pattern share."""

    def with_numbers(self, numbers: tuple[float, ...]) -> Repeatable:
        """The same with other numbers."""

    def __call__(self, channel: Channel) -> None:
        """Run the step."""


class _Line(NamedTuple):
    """A line that has been read: its step, which of a line's numbers are the step's, and how they are read."""

    step: Repeatable
    chosen: Choice
    readings: tuple[Reading, ...]


class _Pattern(NamedTuple):
    """Lines with equal characters but for digits: the places of their values, and by all other numbers the lines.

    `written` has lines by those numbers as they are written, `lines` by what they mean.
    """

    values: frozenset[int]
    others: Choice
    fixed: Choice
    variables: Choice
    written: dict[tuple[str, ...] | str, _Line]
    lines: dict[tuple[object, object], _Line]

    def key(self, numbers: Sequence[str]) -> tuple[object, object]:
        """What the numbers of a line must have in common with those of another one to be the same step."""
        variables = self.variables(numbers)
        return self.fixed(numbers), tuple(map(_MEMORY_OF.get, variables, variables))


class Patterns:
    """The lines of a control's programs that have been read.

    Args:
        most: Lines that are kept.
    """

    def __init__(self, most: int = MOST_LINES) -> None:
        self.most = most
        self._patterns: dict[str, _Pattern] = {}
        self._count = 0

    def step(self, text: str) -> Repeatable | None:
        """The step of a line; None where no line of its pattern has been read."""
        pattern = self._patterns.get(text.translate(_WITHOUT_DIGITS))
        if pattern is None:
            return None
        numbers = NUMBER.findall(text)
        others = pattern.others(numbers)
        line = pattern.written.get(others)
        if line is None:
            line = pattern.lines.get(pattern.key(numbers))
            if line is None:
                return None
            self._make_room()
            pattern.written[others] = line
        return line.step.with_numbers(tuple(map(call, line.readings, line.chosen(numbers))))

    def learn(
        self, text: str, step: Repeatable, spots: Sequence[Spot | None], unimportant: Collection[int]
    ) -> None:
        """Keep the step of a line.

        Args:
            text: The line.
            step: Its step.
            spots: The numbers that the step has as parameters, in their order; None for one that no other line has.
            unimportant: Columns of numbers that mean nothing to the step.
        """
        matches = list(NUMBER.finditer(text))
        place = {match.start(): i for i, match in enumerate(matches)}
        if any(match.end() - match.start() > LONGEST_NUMBER for match in matches):
            return
        known = [spot for spot in spots if spot is not None and spot.begin in place]
        if len(known) < len(spots):
            return
        values = frozenset(
            [place[begin] for begin in unimportant]
            + [place[spot.begin] for spot in known if not spot.is_variable]
        )
        self._make_room()
        pattern = self._patterns.setdefault(
            text.translate(_WITHOUT_DIGITS), _pattern(text, [match.start() for match in matches], values)
        )
        if pattern.values == values:
            key = pattern.key([match.group() for match in matches])
            chosen = _choice([place[spot.begin] for spot in known])
            pattern.lines[key] = _Line(step, chosen, tuple(spot.reading for spot in known))

    def _make_room(self) -> None:
        """One line more is going to be kept."""
        if self._count >= self.most:
            self._patterns.clear()
            self._count = 0
        self._count += 1


def _pattern(text: str, begins: Sequence[int], values: frozenset[int]) -> _Pattern:
    """The pattern of a line whose numbers begin at some columns."""
    others = [i for i in range(len(begins)) if i not in values]
    variables = [i for i in others if text[: begins[i]].rstrip().endswith("#")]
    fixed = [i for i in others if i not in variables]
    return _Pattern(values, _choice(others), _choice(fixed), _choice(variables), {}, {})


def _choice(places: Sequence[int]) -> Choice:
    """What takes the items at some places."""
    if len(places) > 1:
        return itemgetter(*places)
    return lambda items: tuple([items[place] for place in places])
