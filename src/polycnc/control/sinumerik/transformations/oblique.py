"""G07 and G05: plunging along an oblique axis (6.8.4).

G07 goes to where G05 begins: the infeed stays, the other axis goes where it must stand at the programmed point. G05
then moves the oblique axis alone, and the tool meets that point along it.
"""

from __future__ import annotations

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.inclined import InclinedAxis

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel

#: How far a place that G05 names may lie beside its way, mm.
SAME_MM = 0.001


def plunge(draft: Draft) -> Step:
    """G05, G07: one of the two axes of TRAANG moves.

    Raises:
        AlarmError: 14146 without an oblique axis, PC0001 for a place of G05 that does not lie on its way.
    """
    starts = draft.codes["block_motion"] == "G7"
    named = frozenset(term.column for term in draft.axis_terms())
    goal = moves.goal_of(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        axis, transformation = _axis(channel), channel.coordinates.transformation
        assert transformation is not None
        if goal is None:
            return
        point, here = goal(channel, values), channel.coordinates.machine
        target = transformation.to_machine(point)
        still = axis.inclined if starts else axis.other
        if not starts:
            # The oblique axis goes as far as the infeed asks for, wherever the other one stands.
            target[axis.other] = here[axis.other]
        target[still] = here[still]
        end = transformation.to_work(target)
        if not starts and any(abs(end[column] - point[column]) > SAME_MM for column in named):
            raise not_supported("G05: X Z")
        moves.line(channel, Kind.FEED, end, moves.checked_feed(channel.feed))

    return run


def _axis(channel: SinumerikChannel) -> InclinedAxis:
    """The oblique axis of the transformation that acts."""
    build = seat.Transformations.of(channel).build
    inner = build.inner if build is not None else None
    last = inner.links[-1] if isinstance(inner, Chain) else inner
    if not isinstance(last, InclinedAxis):
        raise AlarmError("14146")
    return last
