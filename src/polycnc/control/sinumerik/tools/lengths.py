"""Tool lengths along X, Y, Z: by plane and type, mirrored, and with wear by sign and coordinate system.

Setting data, the functions TOWSTD … and the frame count as they were when the edge was selected: another value acts
with the next T or D (job planning 7.3). The plane acts at once, but for wear that lies in a system of its own: that
keeps the axes which it had at the selection (Function Manual W1).

Source: job planning 7.3 (SD42900 to SD42960, TOWSTD …); Function Manual W1 (bits of SD42935, which sign acts where;
`$TC_DPV`, values of SD42950).
"""

from __future__ import annotations

from polycnc.control.sinumerik.tools.edges import (
    COARSE,
    DIRECTION,
    DIRECTION_PARTS,
    DP_BASE_LENGTH,
    DP_LENGTH,
    DP_TIP,
    DP_WEAR_LENGTH,
    FINE,
)
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, Vector
from polycnc.machine.kinematics import unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.tools.edges import Edge

#: Geometry axis (0 X, 1 Y, 2 Z) of lengths L1, L2, L3 (job planning 7.3, SD42940); a minus sign is a value of
#: its own.
TURNING_LENGTHS = {
    17: (1, 0, 2),
    18: (0, 2, 1),
    19: (2, 1, 0),
    -17: (0, 1, 2),
    -18: (2, 0, 1),
    -19: (1, 2, 0),
}
OTHER_LENGTHS = {17: (2, 1, 0), 18: (1, 0, 2), 19: (0, 2, 1), -17: (2, 0, 1), -18: (1, 2, 0), -19: (0, 1, 2)}
#: Edge positions for which SD42920 turns the sign of wear round, of length 1 and of length 2.
TURNED_BY_TIP = (frozenset({3, 4, 8}), frozenset({2, 3, 7}))
#: The system in which wear is a part of the tool's length.
WITH_TOOL = "TOWSTD"
#: Systems in which wear goes with an orientable carrier, and those that a frame turns.
WITH_CARRIER, OF_WORK = "TOWTCS", "TOWWCS"
#: The system of the machine's axes, and all in which wear stays as it is while a transformation turns the tool.
OF_MACHINE = "TOWMCS"
AGAINST_TOOL = frozenset((OF_MACHINE, "TOWBCS", OF_WORK))
#: SD42950: lengths of every tool lie as those of a milling or of a turning tool; another value leaves it to the type.
AS_MILLING, AS_TURNING = 1, 2


class Rules(NamedTuple):
    """What says how the parameters of an edge become lengths along the axes.

    Attributes:
        plane: Plane in which the edge was selected.
        constant: SD42940, 0 where lengths follow the plane.
        length_type: SD42950.
        mirrors_lengths: SD42900.
        mirrors_wear: SD42910.
        sign_by_tip: SD42920.
        inverts_wear: SD42930.
        apart: SD42935: parts of the wear that lie in `system`; bit 0 wear, bit 1 fine, bit 2 coarse additive offset.
        temperature: SD42960 along X, Y, Z, mm.
        system: Function of group 56.
        mirrored: Axes that the frame mirrors.
        work: From the work to the basic coordinate system, without scale.
        against: G44 of ISO code: the lengths count against the tool.
    """

    plane: str = "G17"
    constant: int = 0
    length_type: int = 0
    mirrors_lengths: bool = False
    mirrors_wear: bool = False
    sign_by_tip: bool = False
    inverts_wear: bool = False
    apart: int = 0
    temperature: Vector = (0.0, 0.0, 0.0)
    system: str = WITH_TOOL
    mirrored: tuple[bool, bool, bool] = (False, False, False)
    work: Frame = IDENTITY
    against: bool = False


class Lengths(NamedTuple):
    """Lengths along X, Y, Z, mm: what a carrier turns with the tool, and wear that stays as it is."""

    turning: Vector
    fixed: Vector


def axes_of(edge: Edge, rules: Rules, plane: str) -> tuple[int, int, int]:
    """Geometry axes (0 X, 1 Y, 2 Z) of lengths 1, 2 and 3."""
    turning = counts_as_turning(edge, rules)
    table = TURNING_LENGTHS if turning else OTHER_LENGTHS
    return table.get(rules.constant or int(plane[1:]), table[18 if turning else 17])


def counts_as_turning(edge: Edge, rules: Rules) -> bool:
    """Whether lengths lie as those of a turning tool."""
    return rules.length_type == AS_TURNING or (edge.is_turning and rules.length_type != AS_MILLING)


def direction_of(edge: Edge, rules: Rules, plane: str) -> Vector | None:
    """Direction along the tool, away from its tip, that `$TC_DPV…` give it; None where the plane says it (W1).

    `$TC_DPV` names one by its number: 1 to 3 along lengths 1 to 3 of a mill, along 3 to 1 of a turning tool, 4 to 6
    against them. The others are parts of it along the lengths, and lie where these lie.
    """
    parts = [edge.directions.get(name, 0.0) for name in DIRECTION_PARTS]
    number = int(edge.directions.get(DIRECTION, 0.0))
    if 1 <= number <= 6:
        place = (number - 1) % 3
        place = 2 - place if counts_as_turning(edge, rules) else place
        parts = [0.0, 0.0, 0.0]
        parts[place] = 1.0 if number <= 3 else -1.0
    if not any(parts):
        return None
    found = [0.0, 0.0, 0.0]
    for axis, part in zip(axes_of(edge, rules, plane), parts, strict=True):
        found[axis] = -part if rules.mirrored[axis] and rules.mirrors_lengths else part
    return unit((found[0], found[1], found[2]))


def along_axes(edge: Edge, rules: Rules, plane: str, location: int, added: Sequence[float]) -> Lengths:
    """The lengths of an edge along X, Y, Z.

    Args:
        edge: The edge.
        rules: How it is evaluated.
        plane: Plane that holds now.
        location: DL, 0 for none.
        added: What TOFFL adds to lengths 1, 2 and 3, mm.
    """
    turning, apart = list(rules.temperature), [0.0, 0.0, 0.0]
    kept = axes_of(edge, rules, rules.plane)
    for i, axis in enumerate(axes_of(edge, rules, plane)):
        mirrored = rules.mirrored[axis]
        measured = edge.values[DP_LENGTH + i] + edge.values[DP_BASE_LENGTH + i]
        measured = -measured if rules.against else measured
        turning[axis] += (-measured if mirrored and rules.mirrors_lengths else measured) + added[i]
        sign = -1.0 if mirrored and rules.mirrors_wear else 1.0
        sign = -sign if rules.inverts_wear != rules.against else sign
        if rules.sign_by_tip and edge.is_turning and i < 2 and edge.values[DP_TIP] in TURNED_BY_TIP[i]:
            turning_sign = -sign
        else:
            turning_sign = sign
        for bit, wear in enumerate(_wear(edge, i, location)):
            if rules.system == WITH_TOOL or not rules.apart >> bit & 1:
                turning[axis] += turning_sign * wear
            else:
                apart[kept[i]] += _sign_apart(rules, kept[i]) * wear
    return _sorted(rules, turning, apart)


def _wear(edge: Edge, i: int, location: int) -> tuple[float, float, float]:
    """Wear of a length: its own, fine and coarse additive offsets."""
    fine, coarse = (edge.added(kind, location, DP_LENGTH + i) for kind in (FINE, COARSE))
    return edge.values[DP_WEAR_LENGTH + i], fine, coarse


def _sign_apart(rules: Rules, axis: int) -> float:
    """Sign of wear in a system of its own: edge positions do not count, a mirror not where the frame leads it."""
    mirrored = rules.mirrored[axis] and rules.mirrors_wear and rules.system != OF_WORK
    return -1.0 if mirrored != (rules.inverts_wear != rules.against) else 1.0


def _sorted(rules: Rules, turning: list[float], apart: list[float]) -> Lengths:
    """Wear that lies in a system of its own comes to the lengths that turn, or to those that do not."""
    x, y, z = turning
    a, b, c = apart
    if rules.system == WITH_CARRIER:
        return Lengths((x + a, y + b, z + c), (0.0, 0.0, 0.0))
    return Lengths((x, y, z), rules.work.direct(a, b, c) if rules.system == OF_WORK else (a, b, c))
