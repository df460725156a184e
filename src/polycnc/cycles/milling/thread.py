"""Thread milling on a helix (SINUMERIK CYCLE90, CYCLE70)."""

from __future__ import annotations

from polycnc.cycles.count import parts
from polycnc.cycles.milling.stroke import Place, arc, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

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


@dataclass(frozen=True, slots=True)
class ToothedThread:
    """A thread that is milled in passes, by a cutter with one tooth or more in a row; mm.

    Attributes:
        place: Its axis, and where its turns begin.
        path_radii: Of the tool's centre, pass by pass.
        lead: Pitch.
        teeth: Of the cutter along its axis, a pitch apart; the lowest one lies at its tip.
        reference, depth: Levels of its beginning and end.
        rises: The cutter works from the depth outwards.
        ccw: Sense of rotation.
        beside: For an external thread the distance from its axis at which the cutter goes down; 0 for an internal one.
        feed: On the path.
        safe, retract: Levels of the safety plane and the end.
    """

    place: Place
    path_radii: Sequence[float]
    lead: float
    teeth: int
    reference: float
    depth: float
    rises: bool
    ccw: bool
    beside: float
    feed: float
    safe: float
    retract: float


def mill_with_teeth(thread: ToothedThread) -> Iterator[MillStroke]:
    """Each pass: onto the thread on a half turn, once round for each row of teeth, off it on a half turn.

    With one tooth the turns follow each other to the end of the thread. With more, the cutter leaves the thread after a
    turn and goes on by all its teeth.
    """
    yield rapid(thread.place(thread.beside, 0.0))
    yield rapid(w=thread.safe)
    for radius in thread.path_radii:
        for begin, turns in _bites(thread):
            yield from _bite(thread, radius, begin, turns)
    yield rapid(w=thread.retract)


def _bites(thread: ToothedThread) -> list[tuple[float, int]]:
    """The level at which each series of turns begins, in its order, and how many turns it has."""
    up = 1.0 if thread.depth < thread.reference else -1.0
    length = abs(thread.depth - thread.reference)
    if thread.teeth <= 1:
        turns = max(1, parts(length, thread.lead, 1e-6))
        return [(thread.depth if thread.rises else thread.depth + up * turns * thread.lead, turns)]
    row = thread.teeth * thread.lead
    count = max(1, parts(length, row, 1e-6))
    if thread.rises:
        return [(thread.depth + up * k * row, 1) for k in range(count)]
    return [(thread.depth + up * (k * row + thread.lead), 1) for k in reversed(range(count))]


def _bite(thread: ToothedThread, radius: float, begin: float, turns: int) -> Iterator[MillStroke]:
    """Turns from a level on, with half turns onto the thread and off it that keep the pitch."""
    up = 1.0 if thread.depth < thread.reference else -1.0
    step = (up if thread.rises else -up) * thread.lead
    far, contact = thread.place(thread.beside, 0.0), thread.place(radius, 0.0)
    half = thread.place((thread.beside + radius) / 2.0, 0.0)
    # From outside the half circle curves against the turns, else it would cut into the core.
    onto = thread.ccw is not bool(thread.beside)
    yield rapid(w=begin - 0.5 * step)
    yield arc(thread.feed, contact, half, onto, begin)
    for k in range(1, turns + 1):
        yield arc(thread.feed, contact, thread.place(0.0, 0.0), thread.ccw, begin + k * step)
    yield arc(thread.feed, far, half, onto, begin + (turns + 0.5) * step)
