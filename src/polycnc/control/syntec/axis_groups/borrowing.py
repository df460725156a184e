"""Roaming axes: G52.2 borrows axes for an axis group, G52.1 gives them back (manual 2.80).

An axis roams where Pr742 is 1 and Pr701 on names more than one group for it. No group has it until it borrows it.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.channel.waits import Wait, Why
from polycnc.control.syntec.axis_groups.names import CODES, axis_of_code
from polycnc.control.syntec.coordinates.turns import TurnState
from polycnc.control.word_address.block.rules import Rule
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words

HOLDERS = "roaming_axes"
ROAMING = 1
WAITS, ALARMS, GOES_ON = 0, 1, 2
RESULTS = range(27, 401)
LONGEST_WAIT_S = 9999.999


@dataclass(slots=True)
class BorrowingState(State, lifetime=Lifetime.POWER):
    """How often the running G52.2 has waited."""

    tries: int = 0


def roams(channel: SyntecChannel, axis: int) -> bool:
    """Whether an axis belongs to whoever borrows it."""
    if _none_roam(channel):
        return False
    mask = channel.memory.parameters.axis_groups[axis]
    return mask & (mask - 1) != 0 and bool(mask >> (channel.number - 1) & 1)


def _none_roam(channel: SyntecChannel) -> bool:
    return channel.memory.parameters.shared_axes != ROAMING


def release(channel: SyntecChannel, words: Words) -> None:
    """G52.1 P Q R: give axes back."""
    holders = _holders(channel)
    axes = _axes(channel, words)
    channel.flush()
    channel.synchronise()
    if any(holders.get(_name(channel, axis)) != channel.number for axis in axes):
        raise words.fail("axis_borrowing", "G52.1")
    for axis in axes:
        del holders[_name(channel, axis)]


def borrow(channel: SyntecChannel, words: Words) -> None:
    """G52.2 P Q R [I] [J] [K]: borrow all of the axes or none; I says what happens where one is not free."""
    state = BorrowingState.of(channel)
    holders = _holders(channel)
    axes = _axes(channel, words)
    reaction, result, patient = _answers(words)
    channel.flush()
    channel.synchronise()
    names = [_name(channel, axis) for axis in axes]
    if any(holders.get(name) == channel.number for name in names):
        raise words.fail("axis_borrowing", "G52.2")
    free = not any(name in holders for name in names)
    if free:
        for axis, name in zip(axes, names, strict=True):
            holders[name] = channel.number
            _take_position(channel, axis)
    elif reaction == WAITS:
        _try_again(channel, lambda: not any(name in holders for name in names))
        return
    elif patient and state.tries < len(channel.machine.channels):
        # What the others can still do they do now; then they hold the axes for longer than K.
        state.tries += 1
        _try_again(channel, lambda: True)
        return
    state.tries = 0
    if reaction != WAITS and result is not None:
        channel.memory.set_variable(result, int(free))
    if not free and reaction == ALARMS:
        raise words.fail("axes_not_borrowed", "G52.2")


def _guarded(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A motion that is refused while the group does not have its roaming axes."""
    roaming = [word for word in plan.axis_words if roams(builder.channel, word.axis)]
    if step is None or not roaming:
        return step

    def move(channel: SyntecChannel, values: list[float]) -> None:
        holders = _holders(channel)
        for word in roaming:
            if holders.get(_name(channel, word.axis)) != channel.number:
                raise builder.control.fail("axis_not_held", address=word.address)
        step(channel, values)

    return move


def _holders(channel: SyntecChannel) -> dict[str, int]:
    """Which group holds a roaming axis, by the machine's name of the axis."""
    assert channel.group is not None  # a session always runs a group
    holders: dict[str, int] = channel.group.shared.setdefault(HOLDERS, {})
    return holders


def _name(channel: SyntecChannel, axis: int) -> str:
    return str(channel.axis_data[axis].name)


def _axes(channel: SyntecChannel, words: Words) -> list[int]:
    """The axes that P, Q and R name; each must roam, and none may take part in a transformation."""
    codes = [words.typed(letter) for letter in "PQR" if letter in words]
    if any(code is not None and code != int(code) for code in codes):
        raise words.fail("axis_borrowing_type", "P")
    bound = channel.coordinates.transformation is not None or not TurnState.of(channel).plane.is_identity
    axes = [axis_of_code(channel, code) for code in codes if code is not None and code in CODES]
    if not axes or len(axes) != len(codes) or bound or any(a < 0 or not roams(channel, a) for a in axes):
        raise words.fail("axis_borrowing", "P")
    return axes


def _answers(words: Words) -> tuple[int, int | None, bool]:
    """I, J, and whether K lets the block wait."""
    reaction, result, wait = words.typed("I"), words.typed("J"), words.typed("K")
    for value in (reaction, result):
        if value is not None and value != int(value):
            raise words.fail("axis_borrowing_type", "I")
    seconds = wait
    if wait is not None and words.form("K") == "" and not words.plan.rules.calculator:
        seconds = wait / 1000.0
    if (
        (reaction is not None and reaction not in (WAITS, ALARMS, GOES_ON))
        or (result is not None and int(result) not in RESULTS)
        or (seconds is not None and not 0.001 <= seconds <= LONGEST_WAIT_S)
    ):
        raise words.fail("axis_borrowing", "G52.2")
    return int(reaction or WAITS), None if result is None else int(result), seconds is not None


def _try_again(channel: SyntecChannel, until: Callable[[], bool]) -> None:
    """Run the block once more after others have had their turn."""
    channel.level.index = channel.level.current
    channel.wait = Wait(Why.CHANNEL, until=until)


def _take_position(channel: SyntecChannel, axis: int) -> None:
    """The axis stands where the group that moved it last has left it."""
    group, name = channel.group, _name(channel, axis)
    assert group is not None
    mover = group.moved_by.get(name, channel.number)
    if mover != channel.number:
        other = group.channel(mover)
        places = {data.name: i for i, data in enumerate(other.axis_data)}
        machine = channel.coordinates.machine
        machine[axis] = other.coordinates.machine[places[name]]
        channel.coordinates.arrive_machine(machine)
    group.moved_by[name] = channel.number


#: A group moves a roaming axis only while it has it.
RULE = Rule("roaming axes", rests=_none_roam, in_cycles=False, wrap=_guarded)
