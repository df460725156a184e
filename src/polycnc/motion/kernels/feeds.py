"""What a row asks for: the length that its feed counts, and the speed."""

from __future__ import annotations

from math import inf, pi, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import (
    BEND_PIECES,
    CHORD_PARTS,
    CUTS_PER_PIECE,
    FACTOR,
    GROWTH,
    LEAD_PIECES,
    PLACES,
    RAPID,
    REF,
    SPARE_PIECES,
    SPLINE,
    TAP,
    THREAD,
    ContextRecord,
    Limits,
    PieceRecord,
    State,
    piece_width,
)
from polycnc.transformation.orientation.linkage import STANDS_MM

#: A smaller feed counts as this one, mm/s: squares of speeds and all times stay numbers.
SLOWEST = 1e-9


#: Of the tolerance of a corner, what ends that are led beside the programmed ones leave at least.
LEAST_LEFT = 0.2


def left_tolerance(contexts: Floats, record: int, off: float) -> float:
    """What of the contour tolerance rows leave that are so far beside the programmed ones, mm.

    Where rounding keeps a distance from the corner, it is no part of a tolerance.
    """
    tolerance: float = contexts[record + ContextRecord.TOLERANCE]
    if off == 0.0 or contexts[record + ContextRecord.ROUNDING] < inf:
        return tolerance
    return max(tolerance - off, LEAST_LEFT * tolerance)


def left_swing(contexts: Floats, record: int, off: float, swung: float) -> float:
    """Likewise of what rotary axes may leave their way by at a corner that is rounded within the tolerance, degrees."""
    swing: float = contexts[record + ContextRecord.SWING]
    if swing == 0.0:
        return left_tolerance(contexts, record, off)
    return max(1.0 - swung, LEAST_LEFT) * swing


def left_angle(angle: float, state: State) -> float:
    """Likewise of the angle that rotary axes may leave their way by at the corner before the row at hand, degrees."""
    return angle * max(1.0 - max(state.run.swung, state.row.swung), LEAST_LEFT)


def axes_of(state: State) -> int:
    """Number of axes that a state has room for."""
    return len(state.position)


def is_rapid(state: State) -> bool:
    """Whether the row at hand runs at rapid traverse."""
    return state.row.kind == RAPID or state.row.kind == REF


def norm(vector: Floats, n: int, limits: Limits, weight: float) -> float:
    """Length of a vector of all axes; a degree of a rotary axis counts `weight` millimetres."""
    total = 0.0
    for i in range(n):
        value = vector[i]
        if limits.rotary[i] != 0.0:
            value *= weight
        total += value * value
    return sqrt(total)


def revolutions_s(contexts: Floats, record: int, radius_mm: float) -> float:
    """Spindle speed at a turning radius, revolutions a second."""
    surface = contexts[record + ContextRecord.SURFACE_MM_S]
    if surface == 0.0:
        return contexts[record + ContextRecord.RPM] / 60.0
    limit = contexts[record + ContextRecord.RPM_LIMIT] / 60.0
    around = 2.0 * pi * abs(radius_mm)
    return limit if around * limit <= surface else surface / around


def lead_of(curves: Floats, state: State) -> float:
    """Lead of a thread or tap in mm, 0 for other moves."""
    if (state.row.kind == THREAD or state.row.kind == TAP) and state.row.curve >= 0.0:
        return curves[state.row.curve]
    return 0.0


def is_straight_thread(curves: Floats, state: State) -> bool:
    """Whether the row at hand is a thread that is no arc."""
    at = state.row.curve
    if state.row.kind != THREAD or at < 0:
        return False
    return curves[at + 5] == 0.0 and curves[at + 6] == 0.0 and curves[at + 7] == 0.0


def growth_of(curves: Floats, state: State) -> float:
    """What the lead of the row at hand grows by each revolution, mm; 0 for all but straight threads."""
    return curves[state.row.curve + GROWTH] if is_straight_thread(curves, state) else 0.0


def turns_s(contexts: Floats, record: int, state: State, radius_mm: float) -> float:
    """Revolutions a second of the spindle that the row at hand follows, a thread at the operator's override."""
    turns = revolutions_s(contexts, record, radius_mm)
    return turns * state.run.override if state.row.kind == THREAD else turns


def faster(curves: Floats, state: State) -> float:
    """How much faster than its lead asks the row at hand runs: a tap on its way out; 1 for other moves."""
    if state.row.kind != TAP or state.row.curve < 0.0:
        return 1.0
    factor: float = curves[state.row.curve + FACTOR]
    return factor if factor > 0.0 else 1.0


def asked_speed(
    curves: Floats, contexts: Floats, record: int, state: State, length: float, radius_mm: float
) -> float:
    """Path speed that the program asks for by its feed mode, mm/s; 0 for none, `SLOWEST` where it asks for less.

    That of a rapid is infinite, unless rapids have a speed of their own; of a thread whose lead changes it is the
    highest one.
    """
    if is_rapid(state):
        speed = contexts[record + ContextRecord.RAPID_SPEED]
        return speed if speed > 0.0 else inf
    lead = lead_of(curves, state)
    if lead > 0.0:
        # The lead counts along the axis with the longest way; the others follow it.
        n, longest = axes_of(state), 0.0
        for i in range(n):
            longest = max(longest, abs(state.delta[i]))
        if longest > 0.0:
            last2 = lead * lead + 2.0 * growth_of(curves, state) * longest
            lead = max(lead, sqrt(max(last2, 0.0))) * faster(curves, state)
            return lead * turns_s(contexts, record, state, radius_mm) * length / longest
    speed = state.row.feed
    if contexts[record + ContextRecord.PER_REVOLUTION] != 0.0:
        speed *= revolutions_s(contexts, record, radius_mm)
    elif contexts[record + ContextRecord.INVERSE_TIME] != 0.0:
        speed *= length
    if speed > 0.0:
        return max(speed, SLOWEST)
    return 0.0  # none, zero, or NaN


def counted_length(
    contexts: Floats, record: int, n: int, limits: Limits, state: State
) -> tuple[float, float]:
    """Length that the feed of the row at hand counts, and the weight of degrees in it; 1 where nothing else moves."""
    weight: float = contexts[record + ContextRecord.ROTARY_WEIGHT]
    length = norm(state.delta, n, limits, weight)
    if weight == 0.0 and length < STANDS_MM:
        return norm(state.delta, n, limits, 1.0), 1.0
    return length, weight


def straight_speed(
    curves: Floats,
    contexts: Floats,
    record: int,
    state: State,
    length: float,
    radius_mm: float,
    weight: float,
) -> float:
    """As `asked_speed`; a cut that moves nothing but rotary axes has a speed in degrees, if it names no time.

    That is one of its own, or its feed, of which so many millimetres are a degree.
    """
    asked = asked_speed(curves, contexts, record, state, length, radius_mm)
    turns = weight != contexts[record + ContextRecord.ROTARY_WEIGHT] and not is_rapid(state)
    if not turns or contexts[record + ContextRecord.INVERSE_TIME] != 0.0:
        return asked
    own: float = contexts[record + ContextRecord.TURN_SPEED]
    return own * state.run.override if own > 0.0 else asked / contexts[record + ContextRecord.TURN_WEIGHT]


def lagging_pull(contexts: Floats, record: int, speed: float) -> float:
    """Acceleration from rest that is as far behind at a speed as acceleration after interpolation (FANUC 1626, 1627).

    An acceleration u is behind by `v²/2u`; one over a time constant by `v·LAG_S`, of which an exponential one that
    begins at LAG_FROM has the part above it.
    """
    above = speed - contexts[record + ContextRecord.LAG_FROM]
    if contexts[record + ContextRecord.LAG_S] == 0.0 or not above > 0.0 or speed == inf:
        return inf
    return speed * speed / (2.0 * contexts[record + ContextRecord.LAG_S] * above)


def drive_factor(
    contexts: Floats,
    record: int,
    n: int,
    limits: Limits,
    state: State,
    ways: Floats,
    first: int,
    speed: float,
) -> float:
    """DRIVE: the part of the acceleration that is left where an axis passes DRIVE_SPEED of its velocity.

    `ways` from `first` on is q', `speed` the highest speed along the path.
    """
    part = contexts[record + ContextRecord.DRIVE_SPEED]
    tops = limits.top_rapid if is_rapid(state) else limits.top_feed
    if part < 1.0:
        for i in range(n):
            if speed * abs(ways[first + i]) > part * tops[i]:
                return 1.0 - contexts[record + ContextRecord.DRIVE_REDUCTION]
    return 1.0


def bounded(asked: float, state: State) -> float:
    """The speed asked for, or no bound where none is; such rows are counted."""
    if not asked > 0.0:
        waits = state.row.feed > 0.0 or state.row.kind == THREAD or state.row.kind == TAP
        if waits:
            state.run.standing_spindle += 1
        else:
            state.run.without_feed += 1
    return bound(asked, state)


def bound(asked: float, state: State) -> float:
    """The speed asked for, or no bound where none is.

    Where the feed is FREE, because overrides will act on it, it bounds threads and rapids alone; where it is 2, a dry
    run will act on threads too.
    """
    is_free = state.run.free > (1.0 if state.row.kind == THREAD else 0.0) and not is_rapid(state)
    return inf if is_free or not asked > 0.0 else asked


def block_top(length: float, limits: Limits, state: State) -> float:
    """Highest speed of the row at hand, a cut, at which the control keeps up; threads and taps follow their spindle."""
    is_bound = state.row.kind == THREAD or state.row.kind == TAP or is_rapid(state)
    return inf if limits.path.block_s == 0.0 or is_bound else length / limits.path.block_s


def follows_radius(contexts: Floats, record: int, state: State) -> bool:
    """Whether the speed of the row at hand changes with the turning radius.

    Under constant surface speed that of a feed per revolution does, and that of a thread, whatever F counts.
    """
    per_revolution = contexts[record + ContextRecord.PER_REVOLUTION] != 0.0 or state.row.kind == THREAD
    return contexts[record + ContextRecord.SURFACE_MM_S] != 0.0 and per_revolution


def radius_on_line(contexts: Floats, record: int, limits: Limits, state: State, share: float) -> float:
    """Turning radius (work X) at a share of the straight row at hand; that at its end where no speed follows it."""
    facing = limits.geometry[0]
    if facing < 0 or not follows_radius(contexts, record, state):
        return state.row.facing
    return state.row.facing - state.delta[facing] * (1.0 - share)


def has_room(pieces: Floats, contexts: Floats, record: int, state: State, parts: int, n: int) -> bool:
    """Whether so many more pieces, and what they may be cut into, fit in the buffer."""
    if contexts[record + ContextRecord.RAMP_S] > 0.0:
        parts = CUTS_PER_PIECE * parts + SPARE_PIECES
    else:
        parts += BEND_PIECES
        if state.row.kind == THREAD:
            parts += LEAD_PIECES
        if state.row.kind == SPLINE or state.run.smooth != 0.0:
            parts += 2 * CHORD_PARTS  # those of the chord before, and of the one at hand
    return (state.run.pieces + parts) * piece_width(n) <= len(pieces)


def next_piece(pieces: Floats, state: State, form: int, cap2: float, n: int) -> int:
    """Take the next record of `pieces` for the row at hand; where it begins."""
    at = state.run.pieces * piece_width(n)
    state.run.pieces += 1
    state.run.exit2 = cap2
    pieces[at + PieceRecord.FORM], pieces[at + PieceRecord.ROW], pieces[at + PieceRecord.SLOT] = (
        form,
        state.row.number,
        state.row.slot,
    )
    (
        pieces[at + PieceRecord.HOLD2],
        pieces[at + PieceRecord.HOLD_PULL],
        pieces[at + PieceRecord.PAUSE],
        pieces[at + PieceRecord.MARGIN],
    ) = inf, inf, 0.0, 1.0
    pieces[at + PieceRecord.PATH_PULL], pieces[at + PieceRecord.ZONE] = inf, 0.0
    pieces[at + PieceRecord.ALONE], pieces[at + PieceRecord.RISE] = 0.0, 0.0
    pieces[at + PieceRecord.ASKED] = 0.0
    pieces[at + PieceRecord.RAMP], pieces[at + PieceRecord.BLEND], pieces[at + PieceRecord.EARLY] = (
        state.joint.ramp,
        state.joint.blend,
        0.0,
    )
    return at


def open_joint(pieces: Floats, at: int, state: State, entry2: float) -> None:
    """Give the first piece of a row what `join` has found."""
    pieces[at + PieceRecord.HOLD2], pieces[at + PieceRecord.HOLD_PULL], pieces[at + PieceRecord.PAUSE] = (
        entry2,
        state.joint.pull,
        state.joint.rest,
    )


def place(pieces: Floats, at: int, n: int, state: State, first: float, last: float) -> None:
    """Give a piece its ends: parts, 0 to 1, of the straight way of the row at hand."""
    position, delta, here = state.position, state.delta, at + PieceRecord.VECTORS + PLACES * n
    for i in range(n):
        pieces[here + i] = position[i] + first * delta[i]
        pieces[here + n + i] = position[i] + last * delta[i]
