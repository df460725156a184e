"""G07 and G05: plunging along an oblique axis (6.8.4).

G07 goes to where G05 begins: the infeed stays, the other axis goes where it must stand at the programmed point. G05
then moves the oblique axis alone, and the tool meets that point along it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.transformations import seat
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.inclined import InclinedAxis

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel


def plunge(draft: Draft) -> Step:
    """G05, G07: one of the two axes of TRAANG moves; 14146 without an oblique axis."""
    starts = draft.codes["block_motion"] == "G7"
    goal = moves.goal_of(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        axis, transformation = _axis(channel), channel.coordinates.transformation
        assert transformation is not None
        if goal is None:
            return
        target, here = transformation.to_machine(goal(channel, values)), channel.coordinates.machine
        still = axis.inclined if starts else axis.other
        if not starts:
            # The oblique axis goes as far as the infeed asks for, wherever the other one stands.
            target[axis.other] = here[axis.other]
        target[still] = here[still]
        end = transformation.to_work(target)
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
