"""What a row asks for: the length that its feed counts, and the speed."""

from __future__ import annotations

from math import inf, pi, sqrt

from polycnc.motion.kernels.columns import (
    CURVE_WIDTH,
    EXIT2,
    Floats,
    INVERSE_TIME,
    Limits,
    PER_REVOLUTION,
    PIECES,
    Pieces,
    RAPID,
    REF,
    RPM,
    RPM_LIMIT,
    Rows,
    SURFACE_MM_S,
    State,
    TAP,
    THREAD,
    WITHOUT_FEED,
)


def norm(vector: Floats, limits: Limits, weight: float) -> float:
    """Length of a vector of all axes; a degree of a rotary axis counts `weight` millimetres."""
    total = 0.0
    for i in range(len(vector)):
        value = vector[i] * weight if limits.rotary[i] != 0 else vector[i]
        total += value * value
    return sqrt(total)


def revolutions_s(contexts: Floats, base: int, radius_mm: float) -> float:
    """Spindle speed at a turning radius, revolutions a second."""
    surface = contexts[base + SURFACE_MM_S]
    if surface == 0.0:
        return contexts[base + RPM] / 60.0
    limit = contexts[base + RPM_LIMIT] / 60.0
    around = 2.0 * pi * abs(radius_mm)
    return limit if around * limit <= surface else surface / around


def programmed_speed(
    rows: Rows, row: int, contexts: Floats, base: int, length: float, radius_mm: float, state: State
) -> float:
    """Path speed that the program asks for, by the feed mode that holds (mm/s); infinite for a rapid."""
    kind = rows.kind[row]
    if kind == RAPID or kind == REF:
        return inf
    if (kind == THREAD or kind == TAP) and rows.curve[row] >= 0:
        lead = rows.curves[rows.curve[row] * CURVE_WIDTH]
        if lead > 0.0:
            # The lead counts along the axis with the longest way; the others follow it.
            longest = 0.0
            for value in state.delta:
                longest = max(longest, abs(value))
            if longest > 0.0:
                return lead * revolutions_s(contexts, base, radius_mm) * length / longest
    speed = rows.feed[row]
    if contexts[base + PER_REVOLUTION] != 0.0:
        speed *= revolutions_s(contexts, base, radius_mm)
    elif contexts[base + INVERSE_TIME] != 0.0:
        speed *= length
    return speed if speed > 0.0 else -1.0


def capped_speed(programmed: float, state: State) -> float:
    """A programmed speed, or no bound where there is none; such rows are counted."""
    if programmed < 0.0:
        state.count[WITHOUT_FEED] += 1
        return inf
    return programmed


def add_piece(
    pieces: Pieces, state: State, length: float, cap2: float, entry2: float, pull: float, form: int, row: int, slot: int
) -> int:
    """Append a piece; its number."""
    p = state.count[PIECES]
    pieces.length[p] = length
    pieces.cap2[p] = cap2
    pieces.entry2[p] = entry2
    pieces.pull[p] = pull
    pieces.form[p] = form
    pieces.row[p] = row
    pieces.slot[p] = slot
    state.count[PIECES] = p + 1
    state.now[EXIT2] = cap2
    return p
