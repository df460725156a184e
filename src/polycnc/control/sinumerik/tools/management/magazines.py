"""Magazines and their places: $TC_MAP, $TC_MPP and their like, GETFREELOC, MVTOOL, POSM, TCI, CHKDM, $A_TOOLMN.

A place holds the tool whose number `$TC_MPP6` tells. A change of tool does not take it out: in this model a place is
the home of its tool. The buffer is magazine 9998; its first place is the spindle (job planning 1.12.1, example).
Source: job planning 16.1; Function Manual Tool Management.
"""

from __future__ import annotations

from polycnc.control.sinumerik.auxiliary import load_tool
from polycnc.control.sinumerik.variables.stored import Stored
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row

#: `$TC_MPP`: kind of a place (1 in a magazine, 2 spindle …), its state (bit 0 disabled), its tool.
KIND, FITS, STATE, TOOL = "$TC_MPP1", "$TC_MPP2", "$TC_MPP4", "$TC_MPP6"
#: The buffer, and in it the spindle.
BUFFER, SPINDLE = 9998, (9998, 1)
#: Where a magazine stands (`$TC_MAP8`): the place that is at the change position.
AT_CHANGE = "$TC_MAP8"
#: `$TC_TP7` is the type of place that a tool needs, 0 for any; `$TC_MPTH[n,m]` are types that fit in rising order.
NEEDS, HIERARCHY = "$TC_TP7", "$TC_MPTH"
IN_MAGAZINE, DISABLED = 1, 1
#: Results of GETFREELOC, MVTOOL: done; no such tool or place; place occupied or empty.
DONE, NOTHING, TAKEN = 0, -1, -2
_TEXTS = frozenset(("$TC_MAP2", "$TC_MAMP1"))
#: Data of tools and edges that Siemens keeps for itself.
_REAL = ("$TC_TPCS", "$TC_DPCS")


def values_of(channel: SinumerikChannel, name: str) -> dict[tuple[int, ...], float]:
    """A datum of all places that have it."""
    return {indices: value for (of, indices), value in Stored.of(channel).values.items() if of == name}


def _value(channel: SinumerikChannel, name: str, magazine: int, place: int) -> int:
    return int(Stored.of(channel).values.get((name, (magazine, place)), 0.0))


def tools_held(channel: SinumerikChannel) -> set[int]:
    """T numbers of the tools that are in magazines."""
    return {int(number) for number in values_of(channel, TOOL).values()}


def place_of(channel: SinumerikChannel, tool: int) -> tuple[int, int]:
    """Magazine and place of a tool; zeros for one that is in none."""
    for indices, number in sorted(values_of(channel, TOOL).items()):
        if int(number) == tool:
            return indices[0], indices[1]
    return 0, 0


def _exists(channel: SinumerikChannel, magazine: int, place: int) -> bool:
    return (KIND, (magazine, place)) in Stored.of(channel).values


def free_place(channel: SinumerikChannel, args: Arguments) -> int:
    """GETFREELOC(VAR magazine, VAR place, t, magazine, place): the next free place of a magazine from a place on.

    0 found, -1 no such tool or magazine, -2 none is free that fits the tool. Magazine 0 is any, place 0 the first.
    """
    tool, magazine, start = args[2:5]
    arguments.give_back(args[0], 0)
    arguments.give_back(args[1], 0)
    if tool not in channel.memory.tools.tools or not any(
        magazine in (0, place[0]) for place in values_of(channel, KIND)
    ):
        return NOTHING
    found = _next_free(channel, tool, magazine, start)
    if found is None:
        return TAKEN
    arguments.give_back(args[0], found[0])
    arguments.give_back(args[1], found[1])
    return DONE


def _next_free(channel: SinumerikChannel, tool: int, magazine: int, start: int) -> tuple[int, int] | None:
    """The next free place that fits a tool, from a place on and then from the first one; None for none."""
    places = sorted((m, n) for m, n in values_of(channel, KIND) if magazine in (0, m))
    for found in (*(p for p in places if p[1] >= start), *(p for p in places if p[1] < start)):
        usable = (
            _value(channel, KIND, *found) == IN_MAGAZINE and not _value(channel, STATE, *found) & DISABLED
        )
        if usable and not _value(channel, TOOL, *found) and _fits(channel, tool, found):
            return found
    return None


def _fits(channel: SinumerikChannel, tool: int, place: tuple[int, int]) -> bool:
    """Whether a tool goes into a place: of its type, or of one behind it in a hierarchy of types."""
    needed = int(channel.memory.tools.tools[tool].values.get(NEEDS, 0.0))
    offered = _value(channel, FITS, *place)
    if needed in (0, offered):
        return True
    ranks: dict[int, dict[int, int]] = {}
    for (hierarchy, rank), type_ in values_of(channel, HIERARCHY).items():
        ranks.setdefault(hierarchy, {})[int(type_)] = rank
    return any(needed in of and of[needed] < of.get(offered, -1) for of in ranks.values())


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


def turn_to(channel: SinumerikChannel, args: Arguments) -> None:
    """POSM(place, magazine[, place, internal magazine]): a place goes to the change position, or to another place.

    `$TC_MAP8` tells the place at the change position; `$TC_MDP1[magazine, place]` how many places a place of the
    buffer lies away from it (`$TC_MDP2` one of the loading magazine 9999). 14020 for no such place.
    """
    if not 2 <= len(args) <= 4 or None in args[:2]:
        raise AlarmError("14020", text="POSM")
    place, magazine = map(arguments.whole, args[:2])
    if not _exists(channel, magazine, place):
        raise AlarmError("14020", text="POSM")
    away = 0
    if len(args) == 4 and None not in args[2:]:
        at, internal = map(arguments.whole, args[2:])
        datum = _DISTANCES.get(internal)
        if datum is None or (datum, (magazine, at)) not in Stored.of(channel).values:
            raise AlarmError("14020", text="POSM")
        away = _value(channel, datum, magazine, at)
    count = sum(1 for of, _ in values_of(channel, KIND) if of == magazine)
    Stored.of(channel).values[AT_CHANGE, (magazine,)] = (place - 1 - away) % count + 1


def out_of_buffer(channel: SinumerikChannel, args: Arguments) -> None:
    """TCI(place[, holder]): the tool at a place of the buffer goes into the magazine, to the next free place that fits.

    From the spindle it goes home, and none is in the spindle then. 14020 for no tool there, or no place for it.
    """
    if not 1 <= len(args) <= 2 or args[0] is None:
        raise AlarmError("14020", text="TCI")
    place = arguments.whole(args[0])
    values, source = Stored.of(channel).values, (BUFFER, place)
    tool = channel.memory.tools.active if source == SPINDLE else _value(channel, TOOL, *source)
    if tool not in channel.memory.tools.tools:
        raise AlarmError("14020", text="TCI")
    if (source == SPINDLE and place_of(channel, tool) == (0, 0)) or source != SPINDLE:
        found = _next_free(channel, tool, 0, 0)
        if found is None:
            raise AlarmError("14020", text="TCI")
        values[TOOL, found] = tool
    if source == SPINDLE:
        channel.memory.tools.selected = 0
        load_tool(channel)
    else:
        values[TOOL, source] = 0


def has_unique_edges(channel: SinumerikChannel, args: Arguments) -> int:
    """CHKDM(magazine[, place]): 1 if no D number is in two tools of a magazine, else 0."""
    seen: set[int] = set()
    for (magazine, _), number in values_of(channel, TOOL).items():
        tool = channel.memory.tools.tools.get(int(number))
        if tool is None or (args and args[0] not in (None, 0, magazine)):
            continue
        if seen.intersection(tool.edges):
            return 0
        seen.update(tool.edges)
    return 1


def _datum(name: str, count: int) -> Row:
    """A datum of a magazine or a place, which is kept."""
    type_ = Type.STRING if name in _TEXTS else Type.REAL if name.startswith(_REAL) else Type.INT

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


def _in_spindle(row: Row) -> Row:
    """`$TC_MPP6`: the tool of a place; of the spindle the one in it, which only a change of tool makes another."""
    type_, stored, write = row
    assert write is not None

    def read(channel: SinumerikChannel, indices: Indices) -> float | str:
        found: float | str = channel.memory.tools.active if indices == SPINDLE else stored(channel, indices)
        return found

    def put(channel: SinumerikChannel, indices: Indices, value: float | str) -> None:
        if indices == SPINDLE and value != channel.memory.tools.active:
            raise AlarmError("17210", text=TOOL)
        write(channel, indices, value)

    return type_, read, put


def _of_tool(which: int) -> Callable[[SinumerikChannel, Indices], int]:
    return lambda channel, indices: place_of(channel, arguments.whole(indices[0] if indices else None))[which]


#: Data by how many numbers stand in their brackets: of all magazines, of one, of places and what lies between two.
_DATA = {
    0: [f"$TC_MAMP{n}" for n in (1, 2, 3)],
    1: [f"$TC_MAP{n}" for n in range(1, 11)],
    2: [*(f"$TC_MPP{n}" for n in range(1, 8)), "$TC_MDP1", "$TC_MDP2", "$TC_MLSR", HIERARCHY],
}
_OF_BUILDER = {1: ("MAPC", "MAPCS", "TPCS"), 2: ("MPPC", "MPPCS", "DPCS", "MOPC", "MOPCS")}
#: Where the distances of a magazine from places of an internal one stand.
_DISTANCES = {BUFFER: "$TC_MDP1", 9999: "$TC_MDP2"}
_ROWS = {name: _datum(name, count) for count, names in _DATA.items() for name in names}
MAGAZINE_VARIABLES: dict[str, Row] = {
    **_ROWS,
    TOOL: _in_spindle(_ROWS[TOOL]),
    **{
        f"$TC_{kind}{n}": _datum(f"$TC_{kind}{n}", count)
        for count, kinds in _OF_BUILDER.items()
        for kind in kinds
        for n in range(1, 11)
    },
    "$A_MYMN": (Type.INT, _of_tool(0), None),
    "$A_MYMLN": (Type.INT, _of_tool(1), None),
    "$A_TOOLMN": (Type.INT, _of_tool(0), None),
    "$A_TOOLMLN": (Type.INT, _of_tool(1), None),
}
FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], int]] = {
    "GETFREELOC": free_place,
    "CHKDM": has_unique_edges,
}
PROCEDURES: dict[str, Procedure] = {"MVTOOL": move, "POSM": turn_to, "TCI": out_of_buffer}
