"""What a row asks for: the length that its feed counts, and the speed."""

from __future__ import annotations

from math import inf, pi, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import (
    BLEND,
    BLOCKS,
    CURVE,
    CUTS_PER_PIECE,
    DELTA,
    DRIVE_REDUCTION,
    DRIVE_SPEED,
    EARLY,
    EXIT2,
    FACTOR,
    FEED,
    FORM,
    FREE,
    HOLD2,
    HOLD_PULL,
    INVERSE_TIME,
    JOINT_PULL,
    KIND,
    LAG_FROM,
    LAG_S,
    MARGIN,
    NUMBER,
    PATH_PULL,
    PAUSE,
    PER_REVOLUTION,
    PIECES,
    PLACES,
    POSITION,
    RAMP,
    RAMP_S,
    RAPID,
    RAPID_SPEED,
    REF,
    REST,
    ROTARY,
    ROW,
    ROW_SLOT,
    RPM,
    RPM_LIMIT,
    RUN_BLEND,
    RUN_RAMP,
    SLOT,
    SPARE_PIECES,
    STANDING_SPINDLE,
    STATE_BLOCKS,
    SURFACE_MM_S,
    TAP,
    THREAD,
    TOP_FEED,
    TOP_RAPID,
    VECTORS,
    WITHOUT_FEED,
    piece_width,
)


def axes_of(state: Floats) -> int:
    """Number of axes that a state has room for."""
    return (len(state) - STATE_BLOCKS) // BLOCKS


def is_rapid(state: Floats) -> bool:
    """Whether the row at hand runs at rapid traverse."""
    return state[KIND] == RAPID or state[KIND] == REF


def norm(state: Floats, block: int, n: int, limits: Floats, weight: float) -> float:
    """Length of a vector of all axes; a degree of a rotary axis counts `weight` millimetres."""
    total = 0.0
    for i in range(n):
        value = state[block + i]
        if limits[ROTARY * n + i] != 0.0:
            value *= weight
        total += value * value
    return sqrt(total)


def revolutions_s(contexts: Floats, record: int, radius_mm: float) -> float:
    """Spindle speed at a turning radius, revolutions a second."""
    surface = contexts[record + SURFACE_MM_S]
    if surface == 0.0:
        return contexts[record + RPM] / 60.0
    limit = contexts[record + RPM_LIMIT] / 60.0
    around = 2.0 * pi * abs(radius_mm)
    return limit if around * limit <= surface else surface / around


def lead_of(curves: Floats, state: Floats) -> float:
    """Lead of a thread or tap in mm, 0 for other moves."""
    if (state[KIND] == THREAD or state[KIND] == TAP) and state[CURVE] >= 0.0:
        return curves[int(state[CURVE])]
    return 0.0


def mean_lead(curves: Floats, state: Floats, lead: float, way: float) -> float:
    """What a revolution covers on average over a straight thread whose lead grows with every revolution.

    With `g` the growth, `lead² + 2·g·way` is the square of the last lead, and first and last lead have the mean.
    """
    at = int(state[CURVE])
    is_straight = curves[at + 5] == 0.0 and curves[at + 6] == 0.0 and curves[at + 7] == 0.0
    if state[KIND] != THREAD or not is_straight:
        return lead
    return 0.5 * (lead + sqrt(max(lead * lead + 2.0 * curves[at + 2] * way, 0.0)))


def faster(curves: Floats, state: Floats) -> float:
    """How much faster than its lead asks the row at hand runs: a tap on its way out; 1 for other moves."""
    if state[KIND] != TAP or state[CURVE] < 0.0:
        return 1.0
    factor: float = curves[int(state[CURVE]) + FACTOR]
    return factor if factor > 0.0 else 1.0


def asked_speed(
    curves: Floats, contexts: Floats, record: int, state: Floats, length: float, radius_mm: float
) -> float:
    """Path speed that the program asks for by its feed mode, mm/s; 0 for none.

    That of a rapid is infinite, unless rapids have a speed of their own.
    """
    if is_rapid(state):
        speed = contexts[record + RAPID_SPEED]
        return speed if speed > 0.0 else inf
    lead = lead_of(curves, state)
    if lead > 0.0:
        # The lead counts along the axis with the longest way; the others follow it.
        n, longest = axes_of(state), 0.0
        for i in range(STATE_BLOCKS + DELTA * n, STATE_BLOCKS + DELTA * n + n):
            longest = max(longest, abs(state[i]))
        if longest > 0.0:
            lead = mean_lead(curves, state, lead, longest) * faster(curves, state)
            return lead * revolutions_s(contexts, record, radius_mm) * length / longest
    speed = state[FEED]
    if contexts[record + PER_REVOLUTION] != 0.0:
        speed *= revolutions_s(contexts, record, radius_mm)
    elif contexts[record + INVERSE_TIME] != 0.0:
        speed *= length
    if speed > 0.0:
        return speed
    return 0.0  # none, zero, or NaN


def lagging_pull(contexts: Floats, record: int, speed: float) -> float:
    """Acceleration from rest that is as far behind at a speed as acceleration after interpolation (FANUC 1626, 1627).

    An acceleration u is behind by `v²/2u`; one over a time constant by `v·LAG_S`, of which an exponential one that
    begins at LAG_FROM has the part above it.
    """
    above = speed - contexts[record + LAG_FROM]
    if contexts[record + LAG_S] == 0.0 or not above > 0.0 or speed == inf:
        return inf
    return speed * speed / (2.0 * contexts[record + LAG_S] * above)


def drive_factor(
    contexts: Floats,
    record: int,
    n: int,
    limits: Floats,
    state: Floats,
    ways: Floats,
    first: int,
    speed: float,
) -> float:
    """DRIVE: the part of the acceleration that is left where an axis passes DRIVE_SPEED of its velocity.

    `ways` from `first` on is q', `speed` the highest speed along the path.
    """
    part, block = contexts[record + DRIVE_SPEED], (TOP_RAPID if is_rapid(state) else TOP_FEED) * n
    if part < 1.0:
        for i in range(n):
            if speed * abs(ways[first + i]) > part * limits[block + i]:
                return 1.0 - contexts[record + DRIVE_REDUCTION]
    return 1.0


def bounded(asked: float, state: Floats) -> float:
    """The speed asked for, or no bound where none is; such rows are counted."""
    if not asked > 0.0:
        waits = state[FEED] > 0.0 or state[KIND] == THREAD or state[KIND] == TAP
        state[STANDING_SPINDLE if waits else WITHOUT_FEED] += 1.0
    return bound(asked, state)


def bound(asked: float, state: Floats) -> float:
    """The speed asked for, or no bound where none is.

    Where the feed is FREE, because overrides will act on it, it bounds threads and rapids alone; where it is 2, a dry
    run will act on threads too.
    """
    is_free = state[FREE] > (1.0 if state[KIND] == THREAD else 0.0) and not is_rapid(state)
    return inf if is_free or not asked > 0.0 else asked


def follows_radius(contexts: Floats, record: int) -> bool:
    """Whether the feed changes with the turning radius: per revolution, under constant surface speed."""
    return contexts[record + SURFACE_MM_S] != 0.0 and contexts[record + PER_REVOLUTION] != 0.0


def has_room(pieces: Floats, contexts: Floats, record: int, state: Floats, parts: int, n: int) -> bool:
    """Whether so many more pieces, and what they may be cut into, fit in the buffer."""
    if contexts[record + RAMP_S] > 0.0:
        parts = CUTS_PER_PIECE * parts + SPARE_PIECES
    return (int(state[PIECES]) + parts) * piece_width(n) <= len(pieces)


def next_piece(pieces: Floats, state: Floats, form: int, cap2: float, n: int) -> int:
    """Take the next record of `pieces` for the row at hand; where it begins."""
    at = int(state[PIECES]) * piece_width(n)
    state[PIECES] += 1.0
    state[EXIT2] = cap2
    pieces[at + FORM], pieces[at + ROW], pieces[at + SLOT] = form, state[NUMBER], state[ROW_SLOT]
    pieces[at + HOLD2], pieces[at + HOLD_PULL], pieces[at + PAUSE], pieces[at + MARGIN] = inf, inf, 0.0, 1.0
    pieces[at + PATH_PULL] = inf
    pieces[at + RAMP], pieces[at + BLEND], pieces[at + EARLY] = state[RUN_RAMP], state[RUN_BLEND], 0.0
    return at


def open_joint(pieces: Floats, at: int, state: Floats, entry2: float) -> None:
    """Give the first piece of a row what `join` has found."""
    pieces[at + HOLD2], pieces[at + HOLD_PULL], pieces[at + PAUSE] = entry2, state[JOINT_PULL], state[REST]


def place(pieces: Floats, at: int, n: int, state: Floats, first: float, last: float) -> None:
    """Give a piece its ends: parts, 0 to 1, of the straight way of the row at hand."""
    position, delta, here = STATE_BLOCKS + POSITION * n, STATE_BLOCKS + DELTA * n, at + VECTORS + PLACES * n
    for i in range(n):
        pieces[here + i] = state[position + i] + first * state[delta + i]
        pieces[here + n + i] = state[position + i] + last * state[delta + i]
