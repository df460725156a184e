"""Several channels: INIT, START, WAITM, WAITMC, WAITE, SETM, CLEARM (job planning 1.13)."""

from __future__ import annotations

from polycnc.channel.group import ChannelGroup
from polycnc.control.sinumerik.block.arguments import Arguments
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.statements.calls import named_program
from polycnc.messages import AlarmError
from polycnc.program.names import WORKPIECE, stored_directory

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.program import Program

#: Third argument of INIT: without, with, and with an awaited acknowledgement.
ACKNOWLEDGEMENTS = ("N", "S", "A")
MARKS = range(100)


def group_of(channel: SinumerikChannel) -> ChannelGroup:
    """The channels of the control."""
    return channel.group or ChannelGroup(channel)


def _number(channel: SinumerikChannel, value: Any, name: str) -> int:
    """The number of a channel; alarm 14020 where the machine has none of that number."""
    number = arguments.whole(value)
    if not group_of(channel).has(number):
        raise AlarmError("14020", text=f"{name}({number})")
    return number


def _mark(value: Any, name: str) -> int:
    mark = arguments.whole(value)
    if mark not in MARKS:
        raise AlarmError("14020", text=f"{name}({mark})")
    return mark


def _catch_up(channel: SinumerikChannel) -> None:
    """What channels tell each other they tell when their axes are there, not when the block is prepared."""
    channel.flush()
    channel.synchronise()


def select(channel: SinumerikChannel, args: Arguments) -> None:
    """INIT(n, path, mode): select a program in a channel; it is looked up as a call would."""
    if len(args) not in (2, 3) or not isinstance(args[1], str):
        raise AlarmError("14020", text="INIT")
    number = _number(channel, args[0], "INIT")
    if number == channel.number or (len(args) == 3 and str(args[2]).upper() not in ACKNOWLEDGEMENTS):
        raise AlarmError("14020", text="INIT")
    if group_of(channel).is_running(number):
        raise AlarmError("14020", text=f"INIT({number})")
    group_of(channel).select(number, _selected(channel, args[1]))


def _selected(channel: SinumerikChannel, path: str) -> Program:
    """The program of a name or path, or that of a workpiece directory (2.1); alarm 14011 without one."""
    if not stored_directory(path).endswith(WORKPIECE):
        return named_program(channel, path)
    program = channel.store.main_of_workpiece(path)
    if program is None:
        raise AlarmError("14011", text=path)
    return program


def start(channel: SinumerikChannel, args: Arguments) -> None:
    """START(n, …): start the selected programs; the calling channel runs already."""
    _catch_up(channel)
    group = group_of(channel)
    for value in args:
        number = _number(channel, value, "START")
        if number != channel.number and not group.start(number):
            raise AlarmError("14020", text=f"START({number})")
    group.let_run(channel)


def meet(name: str) -> Callable[[SinumerikChannel, Arguments], None]:
    """WAITM(m, n, …), WAITMC: set a mark and wait for it in other channels."""

    def run(channel: SinumerikChannel, args: Arguments) -> None:
        if not args:
            raise AlarmError("14020", text=name)
        _catch_up(channel)
        others = [_number(channel, value, name) for value in args[1:]]
        group_of(channel).meet(channel, _mark(args[0], name), others)

    return run


def wait_for_ends(channel: SinumerikChannel, args: Arguments) -> None:
    """WAITE(n, …): wait for the program end of other channels."""
    _catch_up(channel)
    others = [_number(channel, value, "WAITE") for value in args]
    group_of(channel).wait_for_ends(channel, [number for number in others if number != channel.number])


def set_marks(channel: SinumerikChannel, args: Arguments) -> None:
    """SETM(m, …): set marks without waiting."""
    _catch_up(channel)
    for value in args:
        group_of(channel).set_mark(channel.number, _mark(value, "SETM"))


def clear_marks(channel: SinumerikChannel, args: Arguments) -> None:
    """CLEARM(m, …): delete marks; CLEARM() all of them."""
    _catch_up(channel)
    marks = group_of(channel).marks(channel.number)
    if not args:
        marks.clear()
    marks.difference_update(_mark(value, "CLEARM") for value in args)


def names(channel: SinumerikChannel) -> dict[str, str]:
    """Names of channels ($MC_CHAN_NAME) with their numbers, as texts that stand for them in programs."""
    data = MachineData.of(channel)
    count = len(channel.machine.channels)
    if count == 1 and not data.is_set("$MC_CHAN_NAME", 0):
        return {}
    found = {}
    for place in range(count):
        given = data.is_set("$MC_CHAN_NAME", place)
        name = str(data.read("$MC_CHAN_NAME", place)) if given else f"CHAN{place + 1}"
        found[name.upper()] = str(place + 1)
    return found


PROCEDURES = {
    "INIT": select,
    "START": start,
    "WAITM": meet("WAITM"),
    "WAITMC": meet("WAITMC"),
    "WAITE": wait_for_ends,
    "SETM": set_marks,
    "CLEARM": clear_marks,
}
