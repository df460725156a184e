"""GET, RELEASE and AXTOCHAN of actions: axes that go from channel to channel while programs run (10.4.15, 1.16).

An action only asks for an axis. It comes as soon as nobody has it: released by a program, or neutral where an action
has released it. Asked for once it is neutral in its channel, asked for again it is the program's.
"""

from __future__ import annotations

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.channels import axis_exchange
from polycnc.control.sinumerik.channels.coordination import group_of
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel


@dataclass(slots=True)
class AxisRequests(PassiveWatcher, State, lifetime=Lifetime.RESET):
    """What actions of a channel have asked for and not got yet; satisfies the channel's `Watcher`.

    Attributes:
        channel: Whose actions.
        pending: Numbers of channels, and the axes that they shall have, by names of the machine.
    """

    channel: Channel[Any, Any, Any]
    pending: list[tuple[int, str]] = field(default_factory=list)

    @classmethod
    def first(cls, channel: Channel[Any, Any, Any]) -> AxisRequests:
        """Nothing is asked for."""
        return cls(channel)

    def ask(self, number: int, axis: str) -> None:
        """A channel shall have an axis."""
        if (number, axis) not in self.pending:
            self.pending.append((number, axis))
            self.channel.on_clock().watch(self)
        self.look()

    def look(self) -> None:
        """An interpolation cycle: axes that are free by now go where they are asked for."""
        for number, axis in tuple(self.pending):
            if _is_given(self.channel, axis, number):
                self.pending.remove((number, axis))
                _give(self.channel, axis, number)

    def block_begins(self) -> None:
        """A request waits over the ends of blocks."""
        self.look()

    @property
    def is_quiet(self) -> bool:
        """Nothing is asked for: another channel may release an axis at any time."""
        return not self.pending

    def abandon(self, *, reset: bool) -> None:  # noqa: ARG002 - both end it
        """The program has ended, and with it what its actions have asked for."""
        self.pending.clear()


def release(channel: SinumerikChannel, args: Arguments) -> None:
    """RELEASE: the axes are neutral."""
    action_axes.release(channel, args)


def get(channel: SinumerikChannel, args: Arguments) -> None:
    """GET: a neutral axis is the program's; one that moves, or that another channel has, is asked for."""
    for value in args:
        _ask(
            channel, channel.number, axis_exchange.name_on_machine(channel, arguments.column(channel, value))
        )


def to_channel(channel: SinumerikChannel, args: Arguments) -> None:
    """AXTOCHAN(axis, n, …): channels ask for axes, the own one as GET does (1.16)."""
    if not args or len(args) % 2:
        raise AlarmError("14020", text="AXTOCHAN")
    for value, given in zip(args[::2], args[1::2], strict=True):
        number = arguments.whole(given)
        axis = axis_exchange.name_on_machine(channel, arguments.column(channel, value))
        group = group_of(channel)
        if not group.has(number) or axis not in channel.machine.channel(number).axes:
            raise AlarmError("14020", text=f"AXTOCHAN({number})")
        _ask(channel, number, axis)


def _ask(channel: SinumerikChannel, number: int, axis: str) -> None:
    asking = _channel(channel, number)
    column = axis_exchange.column_of(asking, axis)
    if action_axes.request(asking, column):
        AxisRequests.of(channel).ask(number, axis)


def _channel(channel: SinumerikChannel, number: int) -> SinumerikChannel:
    found: SinumerikChannel = group_of(channel).channel(number)
    return found


def _is_given(channel: SinumerikChannel, axis: str, number: int) -> bool:
    """Whether nobody keeps an axis from a channel."""
    owner = group_of(channel).owner[axis]
    if owner in (axis_exchange.NOBODY, number):
        return True
    owning = _channel(channel, owner)
    return action_axes.is_neutral(owning, axis_exchange.column_of(owning, axis))


def _give(channel: SinumerikChannel, axis: str, number: int) -> None:
    """A channel has an axis, where it stands: neutral, or its program's."""
    group, asking = group_of(channel), _channel(channel, number)
    place = axis_exchange.standing(channel, axis)
    for each in group.channels:
        if each.number != number:
            action_axes.forget(each, axis)
    group.owner[axis] = number
    column, clocked = axis_exchange.column_of(asking, axis), asking.actual.clocked
    if clocked is not None:
        group.moved_by[axis] = number
        action_axes.expect(asking, (column,))
        clocked.stand_at(column, place)
    action_axes.arrived(asking, column)
