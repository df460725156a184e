"""Plain blocks of SINUMERIK: what their steps do, told as data for the scanner.

A block is plain if it compiles to one call of the control with numbers only, and every step of its plan says what it
does (`language.bulk.declare`): the motion functions and dimensions of its head, F, and a straight line or an arc.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block.positions import AxisTerm, Dimension
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import (
    Conversion,
    Scaling,
    SetFeed,
    Straight,
    Target,
    Word,
)

if TYPE_CHECKING:
    from collections.abc import Sequence


def targets(terms: Sequence[AxisTerm]) -> tuple[Target, ...] | None:
    """Axis words as data; None for the ways of rotary axes and coded positions."""
    if any(term.coded or term.way not in (Dimension.ABSOLUTE, Dimension.INCREMENTAL) for term in terms):
        return None
    return tuple(
        Target(
            term.position,
            Conversion(Scaling.TIMES, 1.0, term.factor),
            term.column,
            term.way is Dimension.INCREMENTAL,
        )
        for term in terms
    )


def straight(terms: Sequence[AxisTerm], *, rapid: bool = False) -> Straight | None:
    """A straight line as data; None where its axis words cannot be told."""
    told = targets(terms)
    if told is None:
        return None
    absolute = not any(target.incremental for target in told)
    return Straight(rapid, told, absolute=absolute, skips_tiny=True)


def feed(position: int, factor: float) -> SetFeed:
    """F as data: zero and less are no feed, or an alarm."""
    return SetFeed(length(position, factor), positive=True)


def length(position: int, factor: float) -> Word:
    """A word with a factor as data."""
    return Word(position, Conversion(Scaling.TIMES, 1.0, factor))
