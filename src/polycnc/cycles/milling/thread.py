"""Thread milling on a helix (SINUMERIK CYCLE90)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.cycles.count import parts
from polycnc.cycles.milling.stroke import Place, arc, rapid
from polycnc.deferred.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.milling.stroke import MillStroke


@dataclass(frozen=True, slots=True)
class MilledThread:
    """A thread and how it is milled; mm.

    Attributes:
        place: Its axis.
        path_radius: Of the tool's centre on the thread.
        lead: Pitch.
        reference, depth: Levels of its beginning and end.
        ccw: Sense of rotation.
        inside: An internal thread.
        clearance: Distance from an external thread at which the tool goes down.
        feed: On the path.
        retract: Level of the end.
    """

    place: Place
    path_radius: float
    lead: float
    reference: float
    depth: float
    ccw: bool
    inside: bool
    clearance: float
    feed: float
    retract: float


def mill(thread: MilledThread) -> Iterator[MillStroke]:
    """Onto the thread on a half turn, full turns to the depth, off it on a half turn; the pitch holds throughout."""
    down = -1.0 if thread.depth < thread.reference else 1.0
    turns = max(1, parts(abs(thread.depth - thread.reference), thread.lead, 1e-6))
    level = thread.depth - down * turns * thread.lead
    radius, half = thread.path_radius, down * thread.lead / 2.0
    far = 0.0 if thread.inside else radius + 2.0 * thread.clearance
    begin, contact = thread.place(far, 0.0), thread.place(radius, 0.0)
    middle = thread.place((far + radius) / 2.0, 0.0)
    # From outside the half circle curves against the turns, else it would cut into the core.
    onto = thread.ccw if thread.inside else not thread.ccw
    yield rapid(begin)
    yield rapid(w=level - half)
    yield arc(thread.feed, contact, middle, onto, level)
    for k in range(1, turns + 1):
        yield arc(thread.feed, contact, thread.place(0.0, 0.0), thread.ccw, level + down * k * thread.lead)
    yield arc(thread.feed, begin, middle, onto, thread.depth + half)
    yield rapid(w=thread.retract)
