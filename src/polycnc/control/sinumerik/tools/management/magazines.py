"""Magazines and their places: $TC_MAP, $TC_MPP, GETFREELOC, MVTOOL, CHKDM, $A_TOOLMN, $A_TOOLMLN.

A place holds the tool whose number `$TC_MPP6` tells. A change of tool does not take it out: in this model a place is
the home of its tool. Source: job planning 16.1; Function Manual Tool Management.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row

#: `$TC_MPP`: kind of a place (1 in a magazine, 2 spindle …), its state (bit 0 disabled), its tool.
KIND, STATE, TOOL = "$TC_MPP1", "$TC_MPP4", "$TC_MPP6"
IN_MAGAZINE, DISABLED = 1, 1
#: Results of GETFREELOC, MVTOOL: done; no such tool or place; place occupied or empty.
DONE, NOTHING, TAKEN = 0, -1, -2
_TEXTS = frozenset(("$TC_MAP2",))


def _values(channel: SinumerikChannel, name: str) -> dict[tuple[int, ...], float]:
    """A datum of all places that have it."""
    return {indices: value for (of, indices), value in Stored.of(channel).values.items() if of == name}


def _value(channel: SinumerikChannel, name: str, magazine: int, place: int) -> int:
    return int(Stored.of(channel).values.get((name, (magazine, place)), 0.0))


def place_of(channel: SinumerikChannel, tool: int) -> tuple[int, int]:
    """Magazine and place of a tool; zeros for one that is in none."""
    for indices, number in sorted(_values(channel, TOOL).items()):
        if int(number) == tool:
            return indices[0], indices[1]
    return 0, 0


def _exists(channel: SinumerikChannel, magazine: int, place: int) -> bool:
    return (KIND, (magazine, place)) in Stored.of(channel).values


def free_place(channel: SinumerikChannel, args: Arguments) -> int:
    """GETFREELOC(VAR magazine, VAR place, t, magazine, place): the next free place of a magazine from a place on.

    0 found, -1 no such tool or magazine, -2 none is free. Magazine 0 is any, place 0 the first.
    """
    tool, magazine, start = args[2:5]
    places = sorted(place for place in _values(channel, KIND) if magazine in (0, place[0]))
    arguments.give_back(args[0], 0)
    arguments.give_back(args[1], 0)
    if tool not in channel.memory.tools.tools or not places:
        return NOTHING
    for found in (*(p for p in places if p[1] >= start), *(p for p in places if p[1] < start)):
        usable = (
            _value(channel, KIND, *found) == IN_MAGAZINE and not _value(channel, STATE, *found) & DISABLED
        )
        if usable and not _value(channel, TOOL, *found):
            arguments.give_back(args[0], found[0])
            arguments.give_back(args[1], found[1])
            return DONE
    return TAKEN


def move(channel: SinumerikChannel, args: Arguments) -> None:
    """MVTOOL(VAR state, magazine, place, to magazine, to place): a tool goes to another place; state 0, -1 or -2."""
    if len(args) < 5 or None in args[:5]:
        raise AlarmError("14020", text="MVTOOL")
    source, goal = (tuple(map(arguments.whole, args[i : i + 2])) for i in (1, 3))
    values = Stored.of(channel).values
    if not _exists(channel, *source) or not _exists(channel, *goal):
        arguments.give_back(args[0], NOTHING)
    elif not _value(channel, TOOL, *source) or _value(channel, TOOL, *goal):
        arguments.give_back(args[0], TAKEN)
    else:
        values[TOOL, goal], values[TOOL, source] = values[TOOL, source], 0.0
        arguments.give_back(args[0], DONE)


def has_unique_edges(channel: SinumerikChannel, args: Arguments) -> int:
    """CHKDM(magazine[, place]): 1 if no D number is in two tools of a magazine, else 0."""
    seen: set[int] = set()
    for (magazine, _), number in _values(channel, TOOL).items():
        tool = channel.memory.tools.tools.get(int(number))
        if tool is None or (args and args[0] not in (None, 0, magazine)):
            continue
        if seen.intersection(tool.edges):
            return 0
        seen.update(tool.edges)
    return 1


def _datum(name: str, count: int) -> Row:
    """A datum of a magazine or a place, which is kept."""
    type_ = Type.STRING if name in _TEXTS else Type.INT

    def read(channel: SinumerikChannel, indices: Indices) -> float | str:
        if len(indices) != count:
            raise AlarmError("12400", text=name)
        found: float | str = Stored.of(channel).values.get((name, indices), "" if name in _TEXTS else 0)
        return found

    def write(channel: SinumerikChannel, indices: Indices, value: float | str) -> None:
        if len(indices) != count:
            raise AlarmError("12400", text=name)
        Stored.of(channel).values[name, tuple(indices)] = value

    return type_, read, write


def _of_tool(which: int) -> Callable[[SinumerikChannel, Indices], int]:
    return lambda channel, indices: place_of(channel, arguments.whole(indices[0] if indices else None))[which]


MAGAZINE_VARIABLES: dict[str, Row] = {
    **{f"$TC_MAP{n}": _datum(f"$TC_MAP{n}", 1) for n in range(1, 11)},
    **{f"$TC_MPP{n}": _datum(f"$TC_MPP{n}", 2) for n in range(1, 8)},
    "$A_TOOLMN": (Type.INT, _of_tool(0), None),
    "$A_TOOLMLN": (Type.INT, _of_tool(1), None),
}
FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], int]] = {
    "GETFREELOC": free_place,
    "CHKDM": has_unique_edges,
}
PROCEDURES: dict[str, Procedure] = {"MVTOOL": move}
