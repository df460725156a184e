"""GETTCOR: the length of a tool and what it is made of, along the axes of a coordinate system.

Source: job planning 16.1 (what the function does); arguments and results are those of the Function Manual W1 as known.
"""

from __future__ import annotations

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tables import data_factor
from polycnc.control.sinumerik.tools.edges import (
    COARSE,
    DP_BASE_LENGTH,
    DP_CORNER_RADIUS,
    DP_LENGTH,
    DP_SIDE_ANGLE,
    DP_TIP,
    DP_TYPE,
    FINE,
    WEAR_PARAMETERS,
    Edge,
)
from polycnc.control.sinumerik.tools.lengths import AGAINST_TOOL, OF_MACHINE, Rules, along_axes
from polycnc.control.sinumerik.tools.management.environments import ORDER, Environments, field_of
from polycnc.control.sinumerik.tools.management.systems import BASIC, MACHINE, SYSTEMS, has_offsets, seen_from
from polycnc.control.sinumerik.tools.selection import rules_of
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector

#: Results.
DONE, NO_ENVIRONMENT, WRONG_COMPONENTS, NO_TOOL, NO_EDGE, NO_ADDITIVE, WRONG_SYSTEM = (
    0,
    -2,
    -3,
    -4,
    -5,
    -6,
    -9,
)
#: Parts of a length: base, set-up, geometry, sum offsets, toolholder, wear, kinematics of a transformation.
BASE, SETUP, GEOMETRY, SUM, HOLDER, WEAR, KINEMATIC = "CEGSTWK"
PARTS = frozenset((BASE, SETUP, GEOMETRY, SUM, HOLDER, WEAR, KINEMATIC))
#: Places in the result: type, edge position, three lengths, then radius and $TC_DP7 to 11.
FIELD, LENGTHS = 11, range(2, 9)
#: Additive offsets of an edge.
LAST_ADDITIVE = 6
_GEOMETRY_PARAMETERS = range(DP_LENGTH, DP_SIDE_ANGLE + 1)
_BASE_PARAMETERS = range(DP_BASE_LENGTH, DP_BASE_LENGTH + 3)


class Asked(NamedTuple):
    """Whose lengths: the edge (None for no offsets), its additive offset, the rules; whether it is the active one."""

    edge: Edge | None
    additive: int
    rules: Rules
    is_active: bool


def length_of(channel: SinumerikChannel, args: Arguments) -> int:
    """GETTCOR(VAR field[, parts:system[, environment[, T[, D[, DL]]]]]): a field of 11 REAL gets the length.

    The field: type, edge position, lengths along abscissa, ordinate and applicate, radius, $TC_DP7 to 11. Parts are
    letters (`PARTS`), none of them or `-` for all; the system is that of the machine where none is told. 0, or -2 to -6
    and -9 for environment, parts, T, D, DL, system that are none; then the field stays.

    Raises:
        AlarmError: PC0001 for the part of a transformation whose head has offsets, and what `seen_from` finds.
    """
    field_of("GETTCOR", args[0], (FIELD,))
    given = [*args[1:], *[None] * 5][:5]
    parts, system = [*str(given[0] or "").upper().split(":", 1), MACHINE][:2]
    parts = parts.strip().replace("-", "")
    if set(parts) - PARTS or len(set(parts)) < len(parts):
        return WRONG_COMPONENTS
    if system not in SYSTEMS:
        return WRONG_SYSTEM
    if (KINEMATIC in parts or not parts) and has_offsets(channel):
        raise not_supported("GETTCOR: K")
    asked = asked_of(channel, given[1:])
    if isinstance(asked, int):
        return asked
    unit = data_factor(channel.mode)
    values = _values(channel, asked, frozenset(parts), system)
    args[0].items[:FIELD] = [value / unit if i in LENGTHS else value for i, value in enumerate(values)]
    return DONE


def asked_of(channel: SinumerikChannel, given: list[object]) -> Asked | int:
    """The edge that environment, T, D and DL tell; a result where they tell none."""
    tools = channel.memory.tools
    number, edge_number, additive = tools.active, tools.edge_number, tools.additive
    rules, is_active = tools.rules or rules_of(channel), True
    if given[0]:
        environment = Environments.of(channel).named.get(str(given[0]))
        if environment is None:
            return NO_ENVIRONMENT
        number, edge_number, additive, rules = environment
        is_active = (number, edge_number) == (tools.active, tools.edge_number)
    wanted = [None if each is None else int(str(each)) for each in given[1:]]
    if wanted[0] is not None:
        number, is_active = wanted[0], wanted[0] == number and is_active
    tool = tools.tools.get(number)
    if tool is None and number:
        return NO_TOOL
    if wanted[1] is not None:
        is_active = is_active and wanted[1] == edge_number
        edge_number = wanted[1]
    edge = tool.edges.get(edge_number) if tool is not None else None
    if edge is None and edge_number:
        return NO_EDGE
    if wanted[2] is not None:
        additive = wanted[2]
    return Asked(edge, additive, rules, is_active) if 0 <= additive <= LAST_ADDITIVE else NO_ADDITIVE


def _values(channel: SinumerikChannel, asked: Asked, parts: frozenset[str], system: str) -> list[float]:
    if asked.edge is None:
        return [0.0] * FIELD
    edge = made_of(asked.edge, parts)
    length = length_along(channel, edge, asked, parts, system)
    order = ORDER[channel.mode["plane"]]
    return [
        asked.edge.values[DP_TYPE],
        asked.edge.values[DP_TIP],
        *(length[axis] for axis in order),
        edge.radius(asked.additive, inverts=asked.rules.inverts_wear),
        *(edge.total(n, asked.additive) for n in range(DP_CORNER_RADIUS, DP_SIDE_ANGLE + 1)),
    ]


def made_of(edge: Edge, parts: frozenset[str]) -> Edge:
    """The edge with some of its parts only, all where none is told."""
    if not parts:
        return edge
    kept = {GEOMETRY: _GEOMETRY_PARAMETERS, WEAR: WEAR_PARAMETERS, BASE: _BASE_PARAMETERS}
    numbers = {n for part, parameters in kept.items() if part in parts for n in parameters} | {
        DP_TYPE,
        DP_TIP,
    }
    values = [value if n in numbers else 0.0 for n, value in enumerate(edge.values)]
    sums = {kind for kind, part in ((FINE, SUM), (COARSE, SETUP)) if part in parts}
    additive = {key: value for key, value in edge.additive.items() if key[0] in sums}
    return replace(edge, values=values, additive=additive)


def length_along(
    channel: SinumerikChannel, edge: Edge, asked: Asked, parts: frozenset[str], system: str
) -> Vector:
    """The length along X, Y, Z of a system; that of the tool is as it is drawn, whatever a toolholder does to it."""
    tools, whole = channel.memory.tools, not parts
    rules = asked.rules if whole else asked.rules._replace(temperature=(0.0, 0.0, 0.0))
    added = tools.added_lengths if whole and asked.is_active else (0.0, 0.0, 0.0)
    found = along_axes(edge, rules, channel.mode["plane"], asked.additive, added)
    carrier = tools.carrier or IDENTITY
    holder = carrier.t if whole or HOLDER in parts else (0.0, 0.0, 0.0)
    turned = carrier.direct(*found.turning)
    is_apart = rules.system in AGAINST_TOOL
    with_tool = (0.0, 0.0, 0.0) if is_apart else found.fixed
    x, y, z = (sum(values) for values in zip(turned, with_tool, holder, strict=True))
    seen = seen_from(channel, system, "GETTCOR")
    length = seen.direct(x, y, z)
    if is_apart and any(found.fixed):
        own = seen_from(channel, MACHINE if rules.system == OF_MACHINE else BASIC, "GETTCOR")
        x, y, z = (a + b for a, b in zip(length, (seen @ own.inverse()).direct(*found.fixed), strict=True))
        return (x, y, z)
    return length


FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], int]] = {"GETTCOR": length_of}
