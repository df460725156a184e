"""Tool environments, and which length acts on which axis: TOOLENV, DELTOOLENV, GETTENV, LENTOAX.

An environment notes what holds for the lengths of the tool: T, D, DL and the rules by which lengths become offsets.
Source: job planning 16.1 (what the functions do); Function Manual W1 (arguments and results).
"""

from __future__ import annotations

from math import copysign

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.tools.lengths import Rules, axes_of
from polycnc.control.sinumerik.tools.management.systems import NAMES, SYSTEMS, WORK, seen_from
from polycnc.control.sinumerik.tools.selection import rules_of
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Row

#: Results: done, lengths lie between the axes, no such environment or no edge, a name that is none.
DONE, BETWEEN, NOTHING, NO_NAME = 0, 1, -1, -4
LONGEST_NAME = 31
#: Geometry axes of abscissa, ordinate and applicate by the plane.
ORDER = {"G17": (0, 1, 2), "G18": (2, 0, 1), "G19": (1, 2, 0)}
#: What counts as no part of a direction; digits in which two parts are equal.
_NONE, _DIGITS = 1e-9, 9


class Environment(NamedTuple):
    """What was noted: numbers of tool, edge and additive offset, and how the lengths are evaluated."""

    tool: int
    edge: int
    additive: int
    rules: Rules


@dataclass(slots=True)
class Environments(State, lifetime=Lifetime.POWER):
    """What TOOLENV has noted, by name."""

    named: dict[str, Environment] = field(default_factory=dict)


def note(channel: SinumerikChannel, args: Arguments) -> int:
    """TOOLENV(name): note what holds for the tool now; a name that is there is noted anew. 0, or -4 for no name."""
    name, tools = str(args[0]), channel.memory.tools
    if not 0 < len(name) <= LONGEST_NAME:
        return NO_NAME
    rules = tools.rules or rules_of(channel)
    Environments.of(channel).named[name] = Environment(tools.active, tools.edge_number, tools.additive, rules)
    return DONE


def forget(channel: SinumerikChannel, args: Arguments) -> int:
    """DELTOOLENV([name]): forget one environment, or all. 0, or -1 where there is none of this name."""
    named = Environments.of(channel).named
    if not args or args[0] is None:
        named.clear()
        return DONE
    return DONE if named.pop(str(args[0]), None) is not None else NOTHING


def numbers_of(channel: SinumerikChannel, args: Arguments) -> int:
    """GETTENV(name, VAR field): T, D and DL of an environment go into a field of three INT. 0; -1 for no such name."""
    found = Environments.of(channel).named.get(str(args[0]))
    field_of("GETTENV", args[1], (3,))
    if found is None:
        return NOTHING
    args[1].items[:3] = [found.tool, found.edge, found.additive]
    return DONE


def assignment(channel: SinumerikChannel, args: Arguments) -> int:
    """LENTOAX(VAR lengths, VAR matrix[, system]): which length acts on abscissa, ordinate and applicate.

    `lengths` gets the number of the length that lies along each axis, negative where it counts against it, 0 for none.
    The matrix makes offsets along these axes of lengths 1 to 3. The system is the work where none is told, else the
    name or letter of one (`systems`). 0; 1 where lengths lie between the axes, and `lengths` has those that act most;
    -1 without an edge.

    Raises:
        AlarmError: 14020 for another system, and what `seen_from` finds.
    """
    lengths, matrix = args[:2]
    told = str(args[2]).strip().upper() if len(args) > 2 and args[2] is not None else WORK
    system = NAMES.get(told, told)
    if system not in SYSTEMS:
        raise AlarmError("14020", text="LENTOAX")
    field_of("LENTOAX", lengths, (3,))
    field_of("LENTOAX", matrix, (3, 3))
    tools, plane = channel.memory.tools, channel.mode["plane"]
    edge = tools.edge
    if edge is None:
        return NOTHING
    rules = tools.rules or rules_of(channel)
    turned = seen_from(channel, system, "LENTOAX") @ Frame((tools.carrier or IDENTITY).m)
    columns = []
    for axis in axes_of(edge, rules, plane):
        sign = -1.0 if rules.mirrors_lengths and rules.mirrored[axis] else 1.0
        columns.append(turned.direct(*(sign if k == axis else 0.0 for k in range(3))))
    rows = [[column[axis] for column in columns] for axis in ORDER[plane]]
    matrix.items[:9] = [value for row in rows for value in row]
    lengths.items[:3] = [_length_of(row) for row in rows]
    lies_between = any(_NONE < abs(value) < 1.0 - _NONE for row in rows for value in row)
    return BETWEEN if lies_between else DONE


def _length_of(row: list[float]) -> int:
    """The number of the length that acts most on an axis; 0 for none."""
    most = max(row, key=lambda value: round(abs(value), _DIGITS))  # the first of equal ones
    return 0 if abs(most) <= _NONE else int(copysign(row.index(most) + 1, most))


def field_of(name: str, array: Any, dims: tuple[int, ...]) -> None:
    """Alarm 12360 for a field of another size."""
    if tuple(getattr(array, "dims", ())) != dims:
        raise AlarmError("12360", text=name)


def _count(channel: SinumerikChannel, _indices: Indices) -> int:
    """`$P_TOOLENVN`: how many environments there are."""
    return len(Environments.of(channel).named)


ENVIRONMENT_VARIABLES: dict[str, Row] = {"$P_TOOLENVN": (Type.INT, _count, None)}
FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], int]] = {
    "TOOLENV": note,
    "DELTOOLENV": forget,
    "GETTENV": numbers_of,
    "LENTOAX": assignment,
}
