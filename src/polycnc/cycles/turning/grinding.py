"""Grinding cycles of the lathe: traverse and oscillation grinding (FANUC 0i-TF Plus II.4.6).

Strokes are increments along two axes: `infeed` towards the work, `along` over it.
"""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


class GrindStroke(NamedTuple):
    """One step: a move by increments (mm) at one of the two feeds, or a dwell."""

    infeed: float = 0.0
    along: float = 0.0
    at_infeed_rate: bool = False
    dwell_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Grinding:
    """What a grinding cycle is told.

    Attributes:
        first: Infeed before the way forth; `second` before the way back.
        length: Way over the work.
        dwell_s: Time after an infeed (traverse) or before a stroke (oscillation).
        repeats: How often.
    """

    first: float
    second: float
    length: float
    dwell_s: float = 0.0
    repeats: int = 1


def traverse(cycle: Grinding) -> Iterator[GrindStroke]:
    """G71, G72: infeed, dwell, forth, infeed, dwell, back. Without infeed only the strokes (spark-out)."""
    for _ in range(cycle.repeats):
        for infeed, along in ((cycle.first, cycle.length), (cycle.second, -cycle.length)):
            if infeed:
                yield GrindStroke(infeed=infeed, at_infeed_rate=True)
            yield GrindStroke(dwell_s=cycle.dwell_s)
            yield GrindStroke(along=along)


def oscillate(cycle: Grinding) -> Iterator[GrindStroke]:
    """G73, G74: dwell, infeed and stroke together, dwell, the same back."""
    for _ in range(cycle.repeats):
        for infeed, along in ((cycle.first, cycle.length), (cycle.second, -cycle.length)):
            yield GrindStroke(dwell_s=cycle.dwell_s)
            yield GrindStroke(infeed=infeed, along=along)
