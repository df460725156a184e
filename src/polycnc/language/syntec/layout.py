"""The flat form of a macro text: steps, jumps between them, and the block statements that are being read."""

from __future__ import annotations

from polycnc.channel.stack import Executable
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol, TypeAlias
from polycnc.language.syntec.values import Text, Vacant, is_true, storable, whole
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.syntec.expressions import Evaluate
    from polycnc.language.syntec.tokens import Token

NO_SEQUENCE = "COR-017"
WRONG_TYPE = "COR-023"


@dataclass(frozen=True, slots=True)
class Kind:
    """A block statement: how it closes, and its alarms.

    Attributes:
        closer: Word that closes it.
        head_missing: Alarm for a part of it without its head.
        closer_missing: Alarm when it is never closed.
        closer_missing_late: The same behind its ELSE or UNTIL.
        too_many: Alarm for too many of them in a file.
        loop: EXIT leaves it.
    """

    closer: str
    head_missing: str
    closer_missing: str
    closer_missing_late: str
    too_many: str
    loop: bool = True


KINDS = {
    "IF": Kind("END_IF", "COM-019", "COM-020", "COM-021", "COM-030", loop=False),
    "CASE": Kind("END_CASE", "COM-022", "COM-023", "COM-024", "COM-029", loop=False),
    "FOR": Kind("END_FOR", "COM-013", "COM-014", "COM-014", "COM-033"),
    "WHILE": Kind("END_WHILE", "COM-017", "COM-018", "COM-018", "COM-032"),
    "REPEAT": Kind("END_REPEAT", "COM-034", "COM-015", "COM-016", "COM-031"),
}


class Label:
    """A place in the list of steps, known when it has been reached."""

    __slots__ = ("index",)

    def __init__(self) -> None:
        self.index = -1


@dataclass(slots=True)
class Group:
    """A block statement that is being read.

    Attributes:
        kind: Its row of `KINDS`.
        head: Its first word.
        start: Index of its first step.
        end: Behind its last step.
        branch: Where a false condition goes: the next ELSEIF, ELSE, or the end.
        again: First step of a loop's next pass.
        late: ELSE or UNTIL has been read.
        next_pass: Step at the end of a FOR's body.
        cases: Labels of a CASE by their constant.
        other: ELSE of a CASE.
        branches: ELSEIFs so far.
    """

    kind: Kind
    head: Token
    start: int
    end: Label = field(default_factory=Label)
    branch: Label = field(default_factory=Label)
    again: Label = field(default_factory=Label)
    late: bool = False
    next_pass: Step | None = None
    cases: dict[int, Label] = field(default_factory=dict)
    other: Label | None = None
    branches: int = 0


class Layout:
    """The steps of a text.

    Attributes:
        steps: What runs, in order; a jump sets `level.index`.
        lines: Line of the file at which each step's statement begins.
        sequences: Step of every N number, the first of equal ones.
        mistakes: Everything that cannot be read, in the order of the text.
        unclosed: Lines of statements whose semicolon is missing.
        runs: Lines each of which is a block of numbers and nothing else, as ranges of lines that follow each other.
    """

    def __init__(self) -> None:
        self.runs: list[range] = []
        self.steps: list[Step] = []
        self.lines: list[int] = []
        self.sequences: dict[int, int] = {}
        self.mistakes: list[AlarmError] = []
        self.unclosed: list[int] = []
        self._failed: set[int] = set()

    def emit(self, step: Step, line: int) -> None:
        """Add a step."""
        self.steps.append(step)
        self.lines.append(line)

    def fills_line(self, line: int) -> None:
        """The last step is a block of numbers, and a line holds nothing beside it."""
        if self.runs and self.runs[-1].stop == line:
            self.runs[-1] = range(self.runs[-1].start, line + 1)
        else:
            self.runs.append(range(line, line + 1))

    def place(self, label: Label) -> None:
        """A label stands before the next step."""
        label.index = len(self.steps)

    def fail(self, error: AlarmError, index: int | None = None) -> None:
        """A mistake: its step raises the alarm, a new one or the one of a head that turned out wrong."""
        if index in self._failed:
            return
        self.mistakes.append(error)
        if index is None:
            self._failed.add(len(self.steps))
            self.emit(raising(error), error.line)
        else:
            self._failed.add(index)
            self.steps[index] = raising(error)


# ---- steps -----------------------------------------------------------------------------------------------


def raising(error: AlarmError) -> Step:
    """The step of a statement that cannot be read. It stands in the line of the mistake."""
    from copy import copy

    alarm = copy(error)
    alarm.line = 0

    def stop(_channel: Channel) -> None:
        raise alarm

    return stop


def nothing(_channel: Channel) -> None:
    """A place without an action."""


def jump(label: Label) -> Step:
    """To a label, always."""

    def jump(channel: Channel) -> None:
        channel.level.index = label.index

    return jump


def unless(condition: Evaluate, label: Label) -> Step:
    """Go on if the condition holds, else to the label."""

    def branch(channel: Channel) -> None:
        if not is_true(condition(channel)):
            channel.level.index = label.index

    return branch


def choose(selector: Evaluate, group: Group) -> Step:
    """CASE: to the label of the selector's value, to ELSE, or behind."""

    def choose(channel: Channel) -> None:
        value = selector(channel)
        if not isinstance(value, int) or value < 0:
            raise AlarmError(WRONG_TYPE, hint="hint.syntec.case-selector")
        label = group.cases.get(value) or group.other or group.end
        channel.level.index = label.index

    return choose


class NumberedProgram(Executable, Protocol):
    """A program of which any block can be found: both forms of SYNTEC files are such."""

    def find_sequence(self, number: int, _index: int = 0, /) -> int:
        """The step of `N number`; the alarm where there is none."""

    def sequence_at(self, index: int) -> int:
        """The last N number at or before a step; 0 where there is none."""

    def find_line(self, line: int) -> int:
        """The first step of a line of the file, or of the next line that has one."""


#: A channel whose programs are such.
NumberedChannel: TypeAlias = "Channel[Any, Any, NumberedProgram]"


def goto(target: Evaluate) -> Step:
    """`GOTO e`: to a sequence number of the same file."""

    def go(channel: NumberedChannel) -> None:
        number = whole(target(channel), NO_SEQUENCE)
        level = channel.level
        level.index = level.code.find_sequence(number, level.current)

    return go


def running(value: Evaluate) -> Step:
    """A function that stands alone."""

    def run(channel: Channel) -> None:
        value(channel)

    return run


def assign_local(number: int, value: Evaluate) -> Step:
    """`#n := value` for a local variable; VACANT clears it."""

    def assign(channel: Channel) -> None:
        result = storable(value(channel))
        variables = channel.memory.locals
        if isinstance(result, Vacant):
            variables.pop(number, None)
        else:
            variables[number] = result

    return assign


def one(_channel: Channel) -> int:
    """The increment of a FOR without BY."""
    return 1


def assign_nowhere(index: Evaluate, _value: Evaluate) -> Step:
    """AR and MAR outside an APP cannot be written."""

    def refuse(channel: Channel) -> None:
        index(channel)
        raise AlarmError("COR-016", hint="hint.syntec.app-variable")

    return refuse


def for_test(variable: Evaluate, limit: Evaluate, step: Evaluate, end: Label) -> Step:
    """Before each pass: end value included, direction by the sign of BY."""

    def test(channel: Channel) -> None:
        value, last = variable(channel), limit(channel)
        if isinstance(value, Text) or isinstance(last, Text):
            raise AlarmError(WRONG_TYPE)
        if (value < last) if step(channel) < 0 else (value > last):
            channel.level.index = end.index

    return test


def for_next(variable: Evaluate, assign: Callable[[Evaluate], Step], step: Evaluate, again: Label) -> Step:
    """Behind each pass: the variable grows by BY."""
    grow = assign(lambda channel: variable(channel) + step(channel))

    def go_on(channel: Channel) -> None:
        grow(channel)
        channel.level.index = again.index

    return go_on
