"""Axis groups of one control: their programs in a file with `$1`, `$2` …, and how they wait for each other (2.7)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.channel.waits import Wait, Why
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.program.split import split_channels

with loaded_when_called():
    from polycnc.control.word_address.tools import data_input

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.program import Program

MEETINGS = "meetings"
#: A file with sections of axis groups that is called is smaller than this, bytes.
LARGEST_CALLED_FILE = 60_000


@dataclass(slots=True)
class SectionState(State, lifetime=Lifetime.POWER):
    """What this axis group runs of the files that it has called."""

    of_files: dict[Program, Program] = field(default_factory=dict)


@dataclass(slots=True, eq=False)
class Meeting:
    """An axis group that waits for others.

    Attributes:
        mark: P of its G04.1.
        named: Groups that Q names, or all of them.
        over: All have come.
    """

    mark: int
    named: frozenset[int]
    over: bool = False


def start_others(channel: SyntecChannel, program: Program) -> None:
    """The first axis group starts: those with a section of their own start with it."""
    group = channel.group
    if group is None or channel is not group.first:
        return
    group.shared.pop(MEETINGS, None)
    for number in split_channels(program):
        if number != channel.number and group.has(number):
            group.select(number, program)
            group.start(number)


def section(channel: SyntecChannel, program: Program) -> Program:
    """What an axis group runs of a file that is called: its own section where the file has sections (`$1`, `$2`).

    Raises:
        AlarmError: COR-203, the file is too large for that.
    """
    found: dict[Program, Program] = SectionState.of(channel).of_files
    if program not in found:
        sections = split_channels(program)
        if sections and _bytes_of(program) >= LARGEST_CALLED_FILE:
            raise channel.control.fail("group_file_size", address="P")
        found[program] = sections.get(channel.number, program)
    return found[program]


def _bytes_of(program: Program) -> int:
    return sum(len(line.encode()) + 1 for line in program.lines)


def meet(channel: SyntecChannel, words: Words) -> None:
    """G04.1 P Q: axis groups wait for each other; Q names them by digits, without Q all of them."""
    data_input.refuse_axes(words, "meeting_mark")
    mark, groups = words.typed("P"), words.typed("Q")
    existing = {each.number for each in channel.machine.channels}
    if mark is None or mark < 0 or mark != int(mark):
        raise words.fail("meeting_mark", "P" if mark is not None else "G4.1")
    last = channel.memory.parameters.cnc_groups
    named = {number for number in existing if number <= last} if last > 0 else existing
    if groups is not None:
        if groups <= 0 or groups != int(groups):
            raise words.fail("meeting_groups", "Q")
        named = {int(digit) for digit in str(int(groups))}
        if not named <= existing or channel.number not in named:
            raise words.fail("meeting_groups", "Q")
    channel.flush()
    channel.synchronise()
    if named - {channel.number}:
        _wait_for(channel, words, Meeting(int(mark), frozenset(named)))


def _wait_for(channel: SyntecChannel, words: Words, own: Meeting) -> None:
    """Wait until all groups named stand at the same mark; another mark or another set of groups is a mistake."""
    assert channel.group is not None  # a session always runs a group
    waiting: dict[int, Meeting] = channel.group.shared.setdefault(MEETINGS, {})
    for number in own.named & set(waiting):
        other = waiting[number]
        if channel.number in other.named and (other.mark == own.mark) != (other.named == own.named):
            raise words.fail("meeting_mark", "P")
    waiting[channel.number] = own
    together = [waiting[number] for number in own.named if number in waiting]
    if len(together) == len(own.named) and all((m.mark, m.named) == (own.mark, own.named) for m in together):
        for number in own.named:
            waiting.pop(number).over = True
        return
    channel.wait = Wait(Why.CHANNEL, until=lambda: own.over)
