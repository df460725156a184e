"""What plain blocks do: targets, straight moves and arcs, on the numbers of a scan. Kernels; see `layout`.

Every sum and product stands here in the order in which the interpreter forms it (`channel.coordinates`,
`control.word_address.path`, `geometry.frames`, `geometry.arcs`), so that both give the same bits. Checks that could
end in an alarm are a trifle stricter than there: what they refuse, the interpreter judges.
"""

from __future__ import annotations

from math import copysign, floor, nan, sqrt

from polycnc.kernels.layout import Floats, Ints32
from polycnc.language.bulk.conversions import HALF, Reading
from polycnc.language.bulk.layout import (
    TARGET_WIDTH,
    Columns,
    Factor,
    Motion,
    NoteRecord,
    Rule,
    State,
    Strokes,
)  # fmt: skip
from polycnc.toolpath.kinds import CURVE_WIDTH, NO_CURVE, Kind
from polycnc.transformation.orientation.records import StandRecord
from polycnc.transformation.orientation.standing import stand

RAPID, STRAIGHT, DWELL = int(Kind.RAPID), int(Kind.FEED), int(Kind.DWELL)
CIRCLE_CW, CIRCLE_CCW = int(Kind.CW), int(Kind.CCW)
SCREW_CW, SCREW_CCW = int(Kind.HELIX_CW), int(Kind.HELIX_CCW)
#: Ways shorter than this (mm, degrees) count as none; ways about as long are in doubt.
TINY, TINY_LOW, TINY_HIGH = 1e-9, 0.9e-9, 1.1e-9
#: Chords and radii below this (mm) are for the interpreter.
SHORTEST_CHORD = 1e-8
#: Slack of the arc tolerance: less than the interpreter's own.
SLACK = 5e-10


def act(state: State, rules: Ints32, factors: Floats, number: int, columns: Columns) -> bool:
    """Do what a rule says with the values read; false, and nothing done, where the interpreter must."""
    rule, factor = number * Rule.SIZE, number * Factor.SIZE
    feed = state.scan.feed
    if rules[rule + Rule.FEED_WORD] >= 0:
        feed = word(state, rules, factors, rule, factor, Rule.FEED_WORD)
        if rules[rule + Rule.POSITIVE_FEED] and not feed > 0.0:
            return False
    motion = rules[rule + Rule.MOTION]
    if motion != Motion.NONE:
        if rules[rule + Rule.NEEDS_FEED] and not feed > 0.0:
            return False
        find_target(state, rules, factors, rule, factor)
        turns, rows = rules[rule + Rule.HAS_DIRECTION] != 0, state.scan.rows
        if turns and not stood(state, rules, rule):
            return False
        drills = rules[rule + Rule.DRILLS]
        if drills and not may_drill(state, drills - 1, feed):
            return False
        if motion == Motion.ARC:
            done = arc(state, rules, factors, rule, factor, feed, columns)
        else:
            row_feed = nan if motion == Motion.RAPID and not rules[rule + Rule.NAMES_FEED] else feed
            kind = RAPID if motion == Motion.RAPID else STRAIGHT
            done = straight(state, kind, row_feed, rules[rule + Rule.SKIPS_TINY] != 0, columns)
        if not done:
            return False
        if turns:
            note_turn(state, state.scan.rows > rows)
        if drills:
            drill(state, columns)
    state.scan.feed = feed
    return True


def may_drill(state: State, axis: int, feed: float) -> bool:
    """Whether the strokes of a hole along an axis can be made at the target; else the interpreter must."""
    strokes, scan = state.strokes, state.scan
    count = int(strokes[Strokes.COUNT])
    if count < 0 or axis != int(strokes[Strokes.AXIS]) or scan.root != strokes[Strokes.ROOT]:
        return False
    if feed != strokes[Strokes.FEED] or state.position[axis] != strokes[Strokes.LEVEL]:
        return False
    if scan.curves + strokes[Strokes.DWELLS] > scan.most_curves:
        return False
    if scan.rows + count >= scan.most_rows or scan.blocks + strokes[Strokes.BLOCKS] >= scan.most_blocks:
        return False
    level, is_free = state.new_position[axis], True
    for i in range(2):
        state.new_position[axis] = strokes[Strokes.RANGE + i]
        is_free = is_free and within_limits(state)
    state.new_position[axis] = level
    return is_free


def drill(state: State, columns: Columns) -> None:
    """Make the strokes of a hole."""
    strokes = state.strokes
    axis = int(strokes[Strokes.AXIS])
    for i in range(int(strokes[Strokes.COUNT])):
        stroke = Strokes.FIRST + 3 * i
        state.new_position[axis] = strokes[stroke + 2]
        if int(strokes[stroke]) == DWELL:
            put_dwell(state, strokes[stroke + 1], columns)
        else:
            put_row(state, int(strokes[stroke]), strokes[stroke + 1], NO_CURVE, columns)
    state.position[axis] = state.programmed[axis] = strokes[Strokes.END]
    state.pending[axis] = 0.0
    state.scan.blocks += int(strokes[Strokes.BLOCKS])


def put_dwell(state: State, seconds: float, columns: Columns) -> None:
    """Write a dwell as a row."""
    curve = state.scan.curves * CURVE_WIDTH
    columns.curves[curve] = seconds
    for i in range(1, CURVE_WIDTH):
        columns.curves[curve + i] = 0.0
    put_row(state, DWELL, nan, state.scan.first_curve + state.scan.curves, columns)
    state.scan.curves += 1
    state.scan.dwells += 1


def stood(state: State, rules: Ints32, rule: int) -> bool:
    """Stand the tool at the target along the direction that the block names; false where the interpreter must."""
    at = rule + Rule.DIRECTION
    x = state.values[rules[at]] if rules[at] >= 0 else 0.0
    y = state.values[rules[at + 1]] if rules[at + 1] >= 0 else 0.0
    z = state.values[rules[at + 2]] if rules[at + 2] >= 0 else 0.0
    if not stand(state.tool, state.position, x, y, z, state.new_position):
        return False
    for k in range(2):
        column = int(state.tool[StandRecord.OUTER + k])
        state.new_programmed[column], state.new_pending[column] = state.new_position[column], 0.0
    return True


def note_turn(state: State, moves: bool) -> None:
    """Remember from where to where a block has turned the tool."""
    state.scan.turned += 1
    for i in range(state.scan.axes):
        state.turned_to[i] = state.position[i]
        state.turned_from[i] = state.came_from[i] if moves else state.position[i]


def note(state: State, rules: Ints32, factors: Floats, number: int, columns: Columns) -> bool:
    """Note down that a block begins here that does more than move; it counts when the block is done."""
    place, axes = state.scan.notes * NoteRecord.SIZE, state.scan.axes
    said = state.scan.notes * (axes + 1)
    slot = rules[number * Rule.SIZE + Rule.NOTE_WORD]
    value = state.values[slot] if slot >= 0 else 0.0
    if slot >= 0 and value < factors[number * Factor.SIZE + Factor.LOWEST_NOTE]:
        return False
    columns.notes[place + NoteRecord.ROW] = state.scan.rows
    columns.notes[place + NoteRecord.LINE] = state.scan.block_line
    columns.notes[place + NoteRecord.RULE] = number
    columns.said[said] = value
    for i in range(axes):
        columns.said[said + 1 + i] = state.position[i]
    return True


def converted(value: float, way: int, scale: float, unit: float) -> float:
    """A typed number in internal units (`control.word_address.numbers`)."""
    if way == Reading.TIMES:
        return value * unit
    if way == Reading.INCREMENTS:
        return value / scale * unit
    if way == Reading.CUT:
        return copysign(float(floor(abs(value) * scale + 1e-6)), value) / scale * unit
    if way == Reading.RATIO:
        return value * unit / scale
    if way == Reading.ROUNDED:
        if value >= 0.0:
            return float(floor(value * scale + HALF)) / scale * unit
        return float(-floor(HALF - value * scale)) / scale * unit
    return value


def word(state: State, rules: Ints32, factors: Floats, rule: int, factor: int, which: int) -> float:
    """The value of a word in internal units."""
    value = state.values[rules[rule + which]]
    return converted(value, rules[rule + which + 1], factors[factor + which], factors[factor + which + 1])


def find_target(state: State, rules: Ints32, factors: Floats, rule: int, factor: int) -> None:
    """The programmed end point, the display's, and what incremental words are owed behind the block."""
    axes = state.scan.axes
    direct = rules[rule + Rule.ABSOLUTE] != 0 and state.scan.direct != 0 and state.scan.owes == 0
    base = state.position if direct else state.programmed
    new, pending, owed = state.new_programmed, state.new_pending, state.pending
    for i in range(axes):
        new[i] = base[i]
        pending[i] = owed[i]
    for i in range(rules[rule + Rule.TARGETS]):
        which = Rule.FIRST_TARGET + TARGET_WIDTH * i
        value = word(state, rules, factors, rule, factor, which)
        axis = rules[rule + which + 2]
        if rules[rule + which + 3]:
            new[axis] += value + pending[axis]
        else:
            new[axis] = value
        if state.scan.owes:
            pending[axis] = 0.0
    position = state.new_position
    image(state, state.scan.has_programming, state.programming, new, position)
    if state.scan.shifted:
        for i in range(axes):
            position[i] += state.shift[i]


def image(state: State, moves: int, frame: Floats, source: Floats, target: Floats) -> None:
    """The image of a vector under a frame of the geometry axes; `moves`: the frame changes anything."""
    for i in range(state.scan.axes):
        target[i] = source[i]
    if not moves:
        return
    x = source[state.geometry[0]] if state.geometry[0] >= 0 else 0.0
    y = source[state.geometry[1]] if state.geometry[1] >= 0 else 0.0
    z = source[state.geometry[2]] if state.geometry[2] >= 0 else 0.0
    for row in range(3):
        if state.geometry[row] >= 0:
            target[state.geometry[row]] = mapped(frame, row, x, y, z)


def mapped(frame: Floats, row: int, x: float, y: float, z: float) -> float:
    """One coordinate of the image of a point."""
    m = 3 * row
    value: float = frame[m] * x + frame[m + 1] * y + frame[m + 2] * z + frame[9 + row]
    return value


def within_limits(state: State) -> bool:
    """Whether the target lies within the travel of every axis."""
    if not state.scan.limited:
        return True
    axes = state.scan.axes
    machine = state.machine
    image(state, state.scan.has_zero, state.zero, state.new_position, machine)
    for i in range(axes):
        value = machine[i] + state.offsets[i]
        if value < state.low[i] or value > state.high[i]:
            return False
    return True


def circle_within_limits(state: State, rules: Ints32, rule: int, center_u: float, center_v: float) -> bool:
    """Whether the whole circle of an arc lies within the travel, at the height of its start and of its end."""
    if not state.scan.limited:
        return True
    u, v, w = rules[rule + Rule.PLANE], rules[rule + Rule.PLANE + 1], rules[rule + Rule.PLANE + 2]
    first, second, third = state.geometry[u], state.geometry[v], state.geometry[w]
    du, dv = state.programmed[first] - center_u, state.programmed[second] - center_v
    radius = sqrt(du * du + dv * dv)
    if state.scan.has_programming:
        radius *= reach_of(state.programming, u)
    for at_end in range(2):
        height = 0.0
        if third >= 0:
            height = state.new_programmed[third] if at_end else state.programmed[third]
        x = center_u if u == 0 else (center_v if v == 0 else height)
        y = center_u if u == 1 else (center_v if v == 1 else height)
        z = center_u if u == 2 else (center_v if v == 2 else height)
        if not ball_within_limits(state, x, y, z, radius):
            return False
    return True


def reach_of(frame: Floats, column: int) -> float:
    """How long a frame makes a unit of an axis."""
    a, b, c = frame[column], frame[3 + column], frame[6 + column]
    return sqrt(a * a + b * b + c * c)


def ball_within_limits(state: State, x: float, y: float, z: float, radius: float) -> bool:
    """Whether all points of the display about a programmed point lie within the travel."""
    if state.scan.has_programming:
        frame = state.programming
        x, y, z = mapped(frame, 0, x, y, z), mapped(frame, 1, x, y, z), mapped(frame, 2, x, y, z)
    if state.scan.shifted:
        x += state.shift[state.geometry[0]] if state.geometry[0] >= 0 else 0.0
        y += state.shift[state.geometry[1]] if state.geometry[1] >= 0 else 0.0
        z += state.shift[state.geometry[2]] if state.geometry[2] >= 0 else 0.0
    for i in range(3):
        axis = state.geometry[i]
        if axis >= 0:
            value, reach = (x if i == 0 else (y if i == 1 else z)), radius
            if state.scan.has_zero:
                frame = state.zero
                value = mapped(frame, i, x, y, z)
                a, b, c = frame[3 * i], frame[3 * i + 1], frame[3 * i + 2]
                reach = radius * sqrt(a * a + b * b + c * c)
            value += state.offsets[axis]
            if value - reach < state.low[axis] or value + reach > state.high[axis]:
                return False
    return True


def arrive(state: State, moves: bool) -> None:
    """The block is done: positions are the new ones."""
    axes = state.scan.axes
    for i in range(axes):
        if moves:
            state.came_from[i] = state.position[i]
        state.position[i] = state.new_position[i]
        state.programmed[i] = state.new_programmed[i]
        state.pending[i] = state.new_pending[i]


def put_row(state: State, kind: int, feed: float, curve: int, columns: Columns) -> None:
    """Write the move to the target as a row."""
    row, axes = state.scan.rows, state.scan.axes
    columns.kind[row] = kind
    columns.line[row] = state.scan.block_line
    columns.program[row] = state.scan.program
    columns.feed[row] = feed
    columns.curve[row] = curve
    for i in range(axes):
        columns.end[row * axes + i] = state.new_position[i]
    state.scan.rows = row + 1


def straight(state: State, kind: int, feed: float, skips_tiny: bool, columns: Columns) -> bool:
    """A straight move to the target; no way, no row, and the position stays where `skips_tiny` says so."""
    axes = state.scan.axes
    moves = False
    for i in range(axes):
        new = state.new_position[i]
        old = state.position[i]
        if TINY_LOW < abs(new - old) < TINY_HIGH:
            return False
        moves = moves or abs(new - old) > TINY
    if moves:
        if not within_limits(state):
            return False
        put_row(state, kind, feed, NO_CURVE, columns)
    elif skips_tiny:
        for i in range(axes):
            state.pending[i] = state.new_pending[i]
        return True
    arrive(state, moves)
    return True


def arc(
    state: State,
    rules: Ints32,
    factors: Floats,
    rule: int,
    factor: int,
    feed: float,
    columns: Columns,
) -> bool:
    """An arc or helix to the target, about a centre or with a radius."""
    first, second = state.geometry[rules[rule + Rule.PLANE]], state.geometry[rules[rule + Rule.PLANE + 1]]
    old, new = state.programmed, state.new_programmed
    begin_u, begin_v = old[first], old[second]
    end_u, end_v = new[first], new[second]
    ccw = rules[rule + Rule.CCW] != 0
    if rules[rule + Rule.RADIUS] >= 0:
        radius = word(state, rules, factors, rule, factor, Rule.RADIUS)
        tolerance = state.scan.tolerance * factors[factor + Factor.RADIUS_TOLERANCES]
        if rules[rule + Rule.LINE_WITHOUT_WAY] and begin_u == end_u and begin_v == end_v and radius != 0.0:
            return straight(state, STRAIGHT, feed, False, columns)
        found, center_u, center_v = center_by_radius(begin_u, begin_v, end_u, end_v, radius, ccw, tolerance)
    else:
        center_u = begin_u + center_word(state, rules, factors, rule, factor, Rule.FIRST_CENTER)
        center_v = begin_v + center_word(state, rules, factors, rule, factor, Rule.SECOND_CENTER)
        du, dv = begin_u - center_u, begin_v - center_v
        start = sqrt(du * du + dv * dv)  # a product, for a power may differ by its last bit
        du, dv = end_u - center_u, end_v - center_v
        stop = sqrt(du * du + dv * dv)
        found = start > SHORTEST_CHORD and abs(stop - start) <= state.scan.tolerance + SLACK
    if not found or barely_rises(state, rules, rule) or not within_limits(state):
        return False
    if not circle_within_limits(state, rules, rule, center_u, center_v):
        return False
    for i in range(3):
        state.last_center[i] = 0.0
    state.last_center[rules[rule + Rule.PLANE]] = center_u - begin_u
    state.last_center[rules[rule + Rule.PLANE + 1]] = center_v - begin_v
    kind = put_curve(state, rules, rule, center_u, center_v, columns)
    put_row(state, kind, feed, state.scan.first_curve + state.scan.curves, columns)
    state.scan.curves += 1
    arrive(state, True)
    return True


def barely_rises(state: State, rules: Ints32, rule: int) -> bool:
    """Whether an arc goes so little along the third axis that controls differ on whether it is a helix."""
    third = state.geometry[rules[rule + Rule.PLANE + 2]]
    if third < 0:
        return False
    way: float = state.new_programmed[third] - state.programmed[third]
    return 0.0 < abs(way) < TINY_HIGH


def center_word(state: State, rules: Ints32, factors: Floats, rule: int, factor: int, which: int) -> float:
    """The way from the start to the centre along one axis; 0 without a word."""
    return word(state, rules, factors, rule, factor, which) if rules[rule + which] >= 0 else 0.0


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
    state: State, rules: Ints32, rule: int, center_u: float, center_v: float, columns: Columns
) -> int:
    """Write the curve parameters of an arc; gives its kind."""
    old, new = state.programmed, state.new_programmed
    u, v, w = rules[rule + Rule.PLANE], rules[rule + Rule.PLANE + 1], rules[rule + Rule.PLANE + 2]
    third = state.geometry[w]
    curve = state.scan.curves * CURVE_WIDTH
    for i in range(3):
        axis = state.geometry[i]
        columns.curves[curve + i] = old[axis] if axis >= 0 else 0.0
        columns.curves[curve + 3 + i] = 1.0 if i == w else 0.0
    columns.curves[curve + u], columns.curves[curve + v] = center_u, center_v
    columns.curves[curve + 6] = columns.curves[curve + 7] = 0.0
    frame = state.programming
    if state.scan.has_programming:
        x, y, z = columns.curves[curve], columns.curves[curve + 1], columns.curves[curve + 2]
        for i in range(3):
            columns.curves[curve + i] = mapped(frame, i, x, y, z)
    ccw = (rules[rule + Rule.CCW] != 0) != (state.scan.mirrors != 0)
    if third >= 0 and new[third] != old[third]:
        return SCREW_CCW if ccw else SCREW_CW
    return CIRCLE_CCW if ccw else CIRCLE_CW
