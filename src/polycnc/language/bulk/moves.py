"""What plain blocks do: targets, straight moves and arcs, on the numbers of a scan. Kernels; see `layout`.

Every sum and product stands here in the order in which the interpreter forms it (`channel.coordinates`,
`control.word_address.path`, `geometry.frames`, `geometry.arcs`), so that both give the same bits. Checks that could
end in an alarm are a trifle stricter than there: what they refuse, the interpreter judges.
"""

from __future__ import annotations

from math import copysign, floor, nan, sqrt
from typing import NamedTuple

from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32, Words32
from polycnc.language.bulk.layout import (
    ABSOLUTE,
    ARC_MOTION,
    AXES,
    CAME_FROM,
    CCW,
    CURVES,
    CUT,
    DIRECT,
    FACTOR_WIDTH,
    FEED,
    FEED_WORD,
    FIRST_CENTER,
    FIRST_CURVE,
    FIRST_TARGET,
    GEOMETRY,
    HIGH,
    INCREMENTS,
    LAST_CENTER,
    LIMITED,
    LINE,
    LINE_WITHOUT_WAY,
    LOW,
    LOWEST_NOTE,
    MACHINE,
    MIRRORS,
    MOTION,
    NAMES_FEED,
    NEEDS_FEED,
    NEW_PENDING,
    NEW_POSITION,
    NEW_PROGRAMMED,
    NO_MOTION,
    NOTE_LINE,
    NOTE_ROW,
    NOTE_RULE,
    NOTE_WIDTH,
    NOTE_WORD,
    NOTES,
    OFFSETS,
    OWES,
    PENDING,
    PLANE,
    POSITION,
    POSITIVE_FEED,
    PROGRAMMED,
    PROGRAMMING_FRAME,
    RADIUS,
    RADIUS_TOLERANCES,
    RAPID_MOTION,
    RATIO,
    ROWS,
    RULE_WIDTH,
    SECOND_CENTER,
    SHIFT,
    SHIFTED,
    SKIPS_TINY,
    TARGET_WIDTH,
    TARGETS,
    TIMES,
    TOLERANCE,
    VALUES,
    VECTORS,
    ZERO_FRAME,
)
from polycnc.toolpath.kinds import Kind
from polycnc.toolpath.table import CURVE_WIDTH, NO_CURVE

RAPID, STRAIGHT = int(Kind.RAPID), int(Kind.FEED)
CIRCLE_CW, CIRCLE_CCW = int(Kind.CW), int(Kind.CCW)
SCREW_CW, SCREW_CCW = int(Kind.HELIX_CW), int(Kind.HELIX_CCW)
#: Ways shorter than this (mm, degrees) count as none; ways about as long are in doubt.
TINY, TINY_LOW, TINY_HIGH = 1e-9, 0.9e-9, 1.1e-9
#: Chords and radii below this (mm) are for the interpreter.
SHORTEST_CHORD = 1e-8
#: Slack of the arc tolerance: less than the interpreter's own.
SLACK = 5e-10


class Columns(NamedTuple):
    """Columns of the toolpath that a scan writes; `end` flat, `curves` flat with `CURVE_WIDTH` numbers a row.

    Notes beside them: `notes` flat with `NOTE_WIDTH` numbers each, `said` with its value and the position each.
    """

    kind: Bytes
    line: Words32
    feed: Floats
    end: Floats
    curve: Ints32
    curves: Floats
    notes: Ints
    said: Floats


def act(ints: Ints, floats: Floats, rules: Ints32, factors: Floats, number: int, columns: Columns) -> bool:
    """Do what a rule says with the values read; false, and nothing done, where the interpreter must."""
    rule, factor = number * RULE_WIDTH, number * FACTOR_WIDTH
    feed = floats[FEED]
    if rules[rule + FEED_WORD] >= 0:
        feed = word(floats, rules, factors, rule, factor, FEED_WORD)
        if rules[rule + POSITIVE_FEED] and not feed > 0.0:
            return False
    motion = rules[rule + MOTION]
    if motion != NO_MOTION:
        if rules[rule + NEEDS_FEED] and not feed > 0.0:
            return False
        find_target(ints, floats, rules, factors, rule, factor)
        if motion == ARC_MOTION:
            done = arc(ints, floats, rules, factors, rule, factor, feed, columns)
        else:
            row_feed = nan if motion == RAPID_MOTION and not rules[rule + NAMES_FEED] else feed
            kind = RAPID if motion == RAPID_MOTION else STRAIGHT
            done = straight(ints, floats, kind, row_feed, rules[rule + SKIPS_TINY] != 0, columns)
        if not done:
            return False
    floats[FEED] = feed
    return True


def note(ints: Ints, floats: Floats, rules: Ints32, factors: Floats, number: int, columns: Columns) -> bool:
    """Note down that a block begins here that does more than move; it counts when the block is done."""
    place, axes = ints[NOTES] * NOTE_WIDTH, ints[AXES]
    said = ints[NOTES] * (axes + 1)
    slot = rules[number * RULE_WIDTH + NOTE_WORD]
    value = floats[VALUES + slot] if slot >= 0 else 0.0
    if slot >= 0 and value < factors[number * FACTOR_WIDTH + LOWEST_NOTE]:
        return False
    columns.notes[place + NOTE_ROW] = ints[ROWS]
    columns.notes[place + NOTE_LINE] = ints[LINE]
    columns.notes[place + NOTE_RULE] = number
    columns.said[said] = value
    for i in range(axes):
        columns.said[said + 1 + i] = floats[VECTORS + POSITION * axes + i]
    return True


def converted(value: float, way: int, scale: float, unit: float) -> float:
    """A typed number in internal units (`control.word_address.numbers`)."""
    if way == TIMES:
        return value * unit
    if way == INCREMENTS:
        return value / scale * unit
    if way == CUT:
        return copysign(float(floor(abs(value) * scale + 1e-6)), value) / scale * unit
    if way == RATIO:
        return value * unit / scale
    return value


def word(floats: Floats, rules: Ints32, factors: Floats, rule: int, factor: int, which: int) -> float:
    """The value of a word in internal units."""
    value = floats[VALUES + rules[rule + which]]
    return converted(value, rules[rule + which + 1], factors[factor + which], factors[factor + which + 1])


def find_target(ints: Ints, floats: Floats, rules: Ints32, factors: Floats, rule: int, factor: int) -> None:
    """The programmed end point, the display's, and what incremental words are owed behind the block."""
    axes = ints[AXES]
    direct = rules[rule + ABSOLUTE] != 0 and ints[DIRECT] != 0 and ints[OWES] == 0
    base = VECTORS + (POSITION if direct else PROGRAMMED) * axes
    new, pending, owed = (
        VECTORS + NEW_PROGRAMMED * axes,
        VECTORS + NEW_PENDING * axes,
        VECTORS + PENDING * axes,
    )
    for i in range(axes):
        floats[new + i] = floats[base + i]
        floats[pending + i] = floats[owed + i]
    for i in range(rules[rule + TARGETS]):
        which = FIRST_TARGET + TARGET_WIDTH * i
        value = word(floats, rules, factors, rule, factor, which)
        axis = rules[rule + which + 2]
        if rules[rule + which + 3]:
            floats[new + axis] += value + floats[pending + axis]
        else:
            floats[new + axis] = value
        if ints[OWES]:
            floats[pending + axis] = 0.0
    position = VECTORS + NEW_POSITION * axes
    image(ints, floats, ints[PROGRAMMING_FRAME], new, position)
    if ints[SHIFTED]:
        for i in range(axes):
            floats[position + i] += floats[VECTORS + SHIFT * axes + i]


def image(ints: Ints, floats: Floats, frame: int, source: int, target: int) -> None:
    """The image of a vector under a frame of the geometry axes; a frame of -1 changes nothing."""
    for i in range(ints[AXES]):
        floats[target + i] = floats[source + i]
    if frame < 0:
        return
    x = floats[source + ints[GEOMETRY]] if ints[GEOMETRY] >= 0 else 0.0
    y = floats[source + ints[GEOMETRY + 1]] if ints[GEOMETRY + 1] >= 0 else 0.0
    z = floats[source + ints[GEOMETRY + 2]] if ints[GEOMETRY + 2] >= 0 else 0.0
    for row in range(3):
        if ints[GEOMETRY + row] >= 0:
            floats[target + ints[GEOMETRY + row]] = mapped(floats, frame, row, x, y, z)


def mapped(floats: Floats, frame: int, row: int, x: float, y: float, z: float) -> float:
    """One coordinate of the image of a point."""
    m = frame + 3 * row
    value: float = floats[m] * x + floats[m + 1] * y + floats[m + 2] * z + floats[frame + 9 + row]
    return value


def within_limits(ints: Ints, floats: Floats) -> bool:
    """Whether the target lies within the travel of every axis."""
    if not ints[LIMITED]:
        return True
    axes = ints[AXES]
    machine = VECTORS + MACHINE * axes
    image(ints, floats, ints[ZERO_FRAME], VECTORS + NEW_POSITION * axes, machine)
    for i in range(axes):
        value = floats[machine + i] + floats[VECTORS + OFFSETS * axes + i]
        if value < floats[VECTORS + LOW * axes + i] or value > floats[VECTORS + HIGH * axes + i]:
            return False
    return True


def arrive(ints: Ints, floats: Floats, moves: bool) -> None:
    """The block is done: positions are the new ones."""
    axes = ints[AXES]
    for i in range(VECTORS, VECTORS + axes):
        if moves:
            floats[i + CAME_FROM * axes] = floats[i + POSITION * axes]
        floats[i + POSITION * axes] = floats[i + NEW_POSITION * axes]
        floats[i + PROGRAMMED * axes] = floats[i + NEW_PROGRAMMED * axes]
        floats[i + PENDING * axes] = floats[i + NEW_PENDING * axes]


def put_row(ints: Ints, floats: Floats, kind: int, feed: float, curve: int, columns: Columns) -> None:
    """Write the move to the target as a row."""
    row, axes = ints[ROWS], ints[AXES]
    columns.kind[row] = kind
    columns.line[row] = ints[LINE]
    columns.feed[row] = feed
    columns.curve[row] = curve
    for i in range(axes):
        columns.end[row * axes + i] = floats[VECTORS + NEW_POSITION * axes + i]
    ints[ROWS] = row + 1


def straight(ints: Ints, floats: Floats, kind: int, feed: float, skips_tiny: bool, columns: Columns) -> bool:
    """A straight move to the target; no way, no row, and the position stays where `skips_tiny` says so."""
    axes = ints[AXES]
    moves = False
    for i in range(axes):
        new = floats[VECTORS + NEW_POSITION * axes + i]
        old = floats[VECTORS + POSITION * axes + i]
        if TINY_LOW < abs(new - old) < TINY_HIGH:
            return False
        moves = moves or abs(new - old) > TINY
    if moves:
        if not within_limits(ints, floats):
            return False
        put_row(ints, floats, kind, feed, NO_CURVE, columns)
    elif skips_tiny:
        for i in range(axes):
            floats[VECTORS + PENDING * axes + i] = floats[VECTORS + NEW_PENDING * axes + i]
        return True
    arrive(ints, floats, moves)
    return True


def arc(
    ints: Ints,
    floats: Floats,
    rules: Ints32,
    factors: Floats,
    rule: int,
    factor: int,
    feed: float,
    columns: Columns,
) -> bool:
    """An arc or helix to the target, about a centre or with a radius."""
    axes = ints[AXES]
    first, second = ints[GEOMETRY + rules[rule + PLANE]], ints[GEOMETRY + rules[rule + PLANE + 1]]
    old, new = VECTORS + PROGRAMMED * axes, VECTORS + NEW_PROGRAMMED * axes
    begin_u, begin_v = floats[old + first], floats[old + second]
    end_u, end_v = floats[new + first], floats[new + second]
    ccw = rules[rule + CCW] != 0
    if rules[rule + RADIUS] >= 0:
        radius = word(floats, rules, factors, rule, factor, RADIUS)
        tolerance = floats[TOLERANCE] * factors[factor + RADIUS_TOLERANCES]
        if rules[rule + LINE_WITHOUT_WAY] and begin_u == end_u and begin_v == end_v and radius != 0.0:
            return straight(ints, floats, STRAIGHT, feed, False, columns)
        found, center_u, center_v = center_by_radius(begin_u, begin_v, end_u, end_v, radius, ccw, tolerance)
    else:
        center_u = begin_u + center_word(floats, rules, factors, rule, factor, FIRST_CENTER)
        center_v = begin_v + center_word(floats, rules, factors, rule, factor, SECOND_CENTER)
        start = sqrt((begin_u - center_u) ** 2 + (begin_v - center_v) ** 2)
        stop = sqrt((end_u - center_u) ** 2 + (end_v - center_v) ** 2)
        found = start > SHORTEST_CHORD and abs(stop - start) <= floats[TOLERANCE] + SLACK
    if not found or barely_rises(ints, floats, rules, rule) or not within_limits(ints, floats):
        return False
    for i in range(3):
        floats[LAST_CENTER + i] = 0.0
    floats[LAST_CENTER + rules[rule + PLANE]] = center_u - begin_u
    floats[LAST_CENTER + rules[rule + PLANE + 1]] = center_v - begin_v
    kind = put_curve(ints, floats, rules, rule, center_u, center_v, columns)
    put_row(ints, floats, kind, feed, ints[FIRST_CURVE] + ints[CURVES], columns)
    ints[CURVES] += 1
    arrive(ints, floats, True)
    return True


def barely_rises(ints: Ints, floats: Floats, rules: Ints32, rule: int) -> bool:
    """Whether an arc goes so little along the third axis that controls differ on whether it is a helix."""
    axes, third = ints[AXES], ints[GEOMETRY + rules[rule + PLANE + 2]]
    if third < 0:
        return False
    way: float = floats[VECTORS + NEW_PROGRAMMED * axes + third] - floats[VECTORS + PROGRAMMED * axes + third]
    return 0.0 < abs(way) < TINY_HIGH


def center_word(floats: Floats, rules: Ints32, factors: Floats, rule: int, factor: int, which: int) -> float:
    """The way from the start to the centre along one axis; 0 without a word."""
    return word(floats, rules, factors, rule, factor, which) if rules[rule + which] >= 0 else 0.0


def center_by_radius(
    begin_u: float, begin_v: float, end_u: float, end_v: float, radius: float, ccw: bool, tolerance: float
) -> tuple[bool, float, float]:
    """Whether there is a centre, and the centre (`geometry.arcs.center_from_radius`)."""
    du, dv = end_u - begin_u, end_v - begin_v
    chord = sqrt(du * du + dv * dv)
    if radius == 0.0 or chord < SHORTEST_CHORD or chord > 2.0 * abs(radius) + 0.999 * tolerance:
        return False, 0.0, 0.0
    height = sqrt(max(radius * radius - 0.25 * chord * chord, 0.0))
    if (radius > 0.0) != ccw:
        height = -height
    center_u = 0.5 * (begin_u + end_u) - height * dv / chord
    return True, center_u, 0.5 * (begin_v + end_v) + height * du / chord


def put_curve(
    ints: Ints, floats: Floats, rules: Ints32, rule: int, center_u: float, center_v: float, columns: Columns
) -> int:
    """Write the curve parameters of an arc; gives its kind."""
    axes = ints[AXES]
    old, new = VECTORS + PROGRAMMED * axes, VECTORS + NEW_PROGRAMMED * axes
    u, v, w = rules[rule + PLANE], rules[rule + PLANE + 1], rules[rule + PLANE + 2]
    third = ints[GEOMETRY + w]
    curve = ints[CURVES] * CURVE_WIDTH
    for i in range(3):
        axis = ints[GEOMETRY + i]
        columns.curves[curve + i] = floats[old + axis] if axis >= 0 else 0.0
        columns.curves[curve + 3 + i] = 1.0 if i == w else 0.0
    columns.curves[curve + u], columns.curves[curve + v] = center_u, center_v
    columns.curves[curve + 6] = columns.curves[curve + 7] = 0.0
    frame = ints[PROGRAMMING_FRAME]
    if frame >= 0:
        x, y, z = columns.curves[curve], columns.curves[curve + 1], columns.curves[curve + 2]
        for i in range(3):
            columns.curves[curve + i] = mapped(floats, frame, i, x, y, z)
    ccw = (rules[rule + CCW] != 0) != (ints[MIRRORS] != 0)
    if third >= 0 and floats[new + third] != floats[old + third]:
        return SCREW_CCW if ccw else SCREW_CW
    return CIRCLE_CCW if ccw else CIRCLE_CW
