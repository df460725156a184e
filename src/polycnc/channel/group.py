"""The channels of one control, run together: who runs next, wait marks, and what all of them share.

A channel runs until it has to wait for another one (`Wait.until`); then the next one in the order of their numbers
runs as far as it can. So the order of what different channels do follows from their wait marks alone, and the same
programs always give the same result. The run ends with the program of the first channel.
"""

from __future__ import annotations

from polycnc.channel.channel import Channel
from polycnc.channel.waits import Wait, Why
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from polycnc.program import Program


@dataclass(slots=True, eq=False)
class Member:
    """One channel of the group.

    Attributes:
        channel: The channel.
        selected: The program that a start runs.
        run: The program that runs.
        until: What the channel waits for: asked again and again, true once it may go on.
        marks: Wait marks that are set.
    """

    channel: Channel
    selected: Program | None = None
    run: Iterator[Wait] | None = None
    until: Callable[[], bool] | None = None
    marks: set[int] = field(default_factory=set)


@dataclass(slots=True, eq=False)
class Meeting:
    """A channel that waits at a mark for others.

    Attributes:
        number: The channel.
        mark: The mark.
        missing: Channels that have not been seen at the mark.
    """

    number: int
    mark: int
    missing: set[int]


class ChannelGroup:
    """All channels of a control; further ones are made when they are first spoken of.

    Args:
        first: The channel whose end is the end of the run.
        make: Makes a further channel by its number; a plain one where it is left out.
        on_start: Called when a channel starts another one, with that channel's number and its run; without it `run`
            drives all of them.

    Attributes:
        first: That channel.
        shared: What the control keeps once for all channels, by names of its own.
        owner: Number of the channel that may move an axis of the machine, 0 for none.
        moved_by: Number of the channel that knows where an axis of the machine stands.
        running: The run that was begun last.
    """

    #: A snapshot does not go on to these: they belong to who drives the group.
    UNFOLLOWED: ClassVar = frozenset({"_make", "_on_start"})

    def __init__(
        self,
        first: Channel,
        make: Callable[[int], Channel] | None = None,
        on_start: Callable[[int, Iterator[Wait]], None] | None = None,
    ) -> None:
        self.first = first
        self._make = make or self._plain_channel
        self._on_start = on_start
        self.shared: dict[str, Any] = {}
        machine = first.machine
        self.owner = {axis: machine.owner(axis) for each in machine.channels for axis in each.axes}
        self.moved_by = self.owner.copy()
        self._members = {first.number: Member(first)}
        self._meetings: list[Meeting] = []
        self.running: GroupRun | None = None
        first.group = self

    @property
    def channels(self) -> list[Channel]:
        """The channels that have been spoken of, the first one in front."""
        return [member.channel for member in self._members.values()]

    def has(self, number: int) -> bool:
        """Whether the machine has a channel of this number."""
        return any(channel.number == number for channel in self.first.machine.channels)

    def channel(self, number: int) -> Channel:
        """A channel by its number; `KeyError` where the machine has none."""
        return self._member(number).channel

    def _member(self, number: int) -> Member:
        if number not in self._members:
            if not self.has(number):
                raise KeyError(number)
            channel = self._make(number)
            channel.group = self
            channel.alarms = self.first.alarms
            self._members[number] = Member(channel)
        return self._members[number]

    def _plain_channel(self, number: int) -> Channel:
        first = self.first
        channel = Channel(
            first.control, first.machine, first.setup, first.store, number=number,
            block_limit=first.block_limit, bulk=first.bulk, retained=first.retained,
        )  # fmt: skip
        channel.move_times = first.move_times
        return channel

    def drive(
        self, make: Callable[[int], Channel], on_start: Callable[[int, Iterator[Wait]], None]
    ) -> dict[int, tuple[Iterator[Wait], Wait | None]]:
        """A main run goes on with the channels from here: gives the runs that are under way and what they wait for.

        Args:
            make: Makes a further channel by its number.
            on_start: Called when a channel starts another one.
        """
        self._make, self._on_start = make, on_start
        return {
            number: (member.run, Wait(Why.CHANNEL, until=member.until) if member.until is not None else None)
            for number, member in self._members.items()
            if member.run is not None
        }

    # ---- programs

    def select(self, number: int, program: Program) -> None:
        """Choose the program that the next start of a channel runs."""
        self._member(number).selected = program

    def is_selected(self, number: int) -> bool:
        """Whether a channel has a program: the one that runs, or that the next start runs."""
        member = self._members.get(number)
        return member is not None and (member.run is not None or member.selected is not None)

    def is_running(self, number: int) -> bool:
        """Whether a channel runs a program."""
        member = self._members.get(number)
        return member is not None and member.run is not None

    def start(self, number: int) -> bool:
        """Start the selected program of a channel; false where none is selected, or one is still running."""
        member = self._member(number)
        if member.selected is None or member.run is not None:
            return False
        channel = member.channel
        first_time = channel.memory is None
        if not first_time:
            channel.control.reset(channel)
        member.run = channel.run(member.selected, power_on=first_time)
        if self._on_start is not None:
            self._on_start(number, member.run)
        return True

    def begin(self, number: int, run: Iterator[Wait]) -> None:
        """A channel runs a program that somebody else drives. Where no other one runs, no mark is set."""
        if not any(self.is_running(other) for other in self._members if other != number):
            self._meetings.clear()
            for member in self._members.values():
                member.marks.clear()
        self._member(number).run = run

    def end(self, number: int) -> None:
        """The program of a channel is over."""
        if number in self._members:
            self._members[number].run = None

    def run(self, program: Program) -> GroupRun:
        """Run a program in the first channel, and in the others what it starts: gives the waits of the first."""
        self.running = GroupRun(self, program)
        return self.running

    def first_turn(self, program: Program) -> Member:
        """The first channel begins with a program; `run` calls it."""
        first = self._members[self.first.number]
        first.run, first.until = self.first.run(program), None
        return first

    def next_turn(self, number: int) -> Member | None:
        """The member whose turn comes behind that of a channel; None where none can go on."""
        member = self._next(number)
        if member is not None:
            member.until = None
        return member

    def end_turns(self) -> None:
        """The run is over; where every channel waits for another one, nothing would ever happen again: PC0005."""
        if self.is_running(self.first.number) and not self.first.alarms:
            self.first.fail(AlarmError("PC0005"))
        for member in self._members.values():
            member.run = None

    def _next(self, number: int) -> Member | None:
        """The channel that can go on, from the one behind a number on; None where all wait."""
        order = sorted(self._members, key=lambda other: (other <= number, other))
        for member in map(self._members.__getitem__, order):
            if member.run is not None and (member.until is None or member.until()):
                return member
        return None

    # ---- wait marks

    def marks(self, number: int) -> set[int]:
        """The marks that a channel has set."""
        return self._member(number).marks

    def set_mark(self, number: int, mark: int) -> None:
        """Set a mark; those who wait for it see it."""
        self._member(number).marks.add(mark)
        for meeting in self._meetings:
            if meeting.mark == mark:
                meeting.missing.discard(number)
        # Marks of channels that have met are deleted at once, before one of them can come to the same mark again.
        for meeting in [meeting for meeting in self._meetings if not meeting.missing]:
            self._meetings.remove(meeting)
            self.marks(meeting.number).discard(meeting.mark)

    def meet(self, channel: Channel, mark: int, others: Iterable[int]) -> None:
        """Set a mark and wait until the others have set it too; the mark is deleted when they have met."""
        number = channel.number
        missing = {other for other in others if other != number and mark not in self.marks(other)}
        meeting = Meeting(number, mark, missing)
        self._meetings.append(meeting)
        self.set_mark(number, mark)
        channel.wait = Wait(Why.CHANNEL, until=lambda: not meeting.missing)

    def wait_for_ends(self, channel: Channel, others: Iterable[int]) -> None:
        """Wait until the programs of other channels have ended."""
        awaited = tuple(others)
        channel.wait = Wait(Why.CHANNEL, until=lambda: not any(self.is_running(number) for number in awaited))

    def let_run(self, channel: Channel) -> None:
        """Give the other channels a turn."""
        channel.wait = Wait(Why.CHANNEL, until=lambda: True)


class GroupRun:
    """The waits of the first channel while all channels of a group take turns; see `Run`.

    Args:
        group: The group.
        program: The program of the first channel.
    """

    __slots__ = ("_begun", "_group", "_over", "_program", "_turn")

    def __init__(self, group: ChannelGroup, program: Program) -> None:
        self._group = group
        self._program = program
        self._begun = self._over = False
        self._turn: Member | None = None

    def __iter__(self) -> GroupRun:
        return self

    def __next__(self) -> Wait:
        if self._over:
            raise StopIteration
        group = self._group
        if not self._begun:
            self._begun = True
            self._turn = group.first_turn(self._program)
        first = group.first
        while (
            (member := self._turn) is not None and member.run is not None and group.is_running(first.number)
        ):
            wait = next(member.run, None)
            if wait is None:
                member.run = None
            elif wait.until is not None:
                member.until = wait.until
            elif member.channel is first or wait.reason is Why.CLOCK:
                return wait
            else:
                continue
            self._turn = group.next_turn(member.channel.number)
        self._over = True
        group.end_turns()
        raise StopIteration
