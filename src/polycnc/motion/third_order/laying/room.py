"""Room for the stretches of a run, row by row, until a planner of the run takes them over."""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import TYPE_CHECKING, cast
from polycnc.motion.kernels.columns import new_state
from polycnc.motion.third_order.bends.stretches import Stretches
from polycnc.motion.third_order.laws.courses import Axes
from polycnc.motion.third_order.laying.rows import RunLaid
from polycnc.motion.third_order.parts import numbers, part_of, whole

if TYPE_CHECKING:
    from polycnc.motion.kernels.columns import Limits

#: Stretches, and changes of the slot, that there is room for at first.
ROOM, CHANGES = 1024, 64
#: The least time in which an axis builds its acceleration up along a run, s. Where the jerk allows less (by a time
#: constant alone the acceleration builds up within 1 ms) x bends at once from node to node, which few steps of Newton's
#: method do not find; from rest to rest this costs no more than that time.
BUILD_S = 0.006


class RunRoom:
    """The stretches of a run that nobody has taken yet.

    Args:
        n: Number of axes.

    Attributes:
        lead: What the kernels carry from row to row.
        laid: How far the run is laid.
        path: The stretches, with room for more.
        slots: From which row on times count in another slot, and in which.
    """

    def __init__(self, n: int) -> None:
        self.lead, self.laid = new_state(n), RunLaid()
        self.path, self.slots = _room(ROOM, n), whole(2 * CHANGES)

    @property
    def is_open(self) -> bool:
        """Whether a run is laid, and not over."""
        return self.laid.stretches > 0

    def tell(self, limits: Limits) -> None:
        """Say what the axes can do, before a run begins."""
        self.path.rotary[:] = array("d", limits.rotary)
        self.path.top[:] = tops_of(limits)

    def grow(self) -> bool:
        """Let the room grow; false where stretches must be taken out of it."""
        if 2 * self.laid.slots + 2 <= len(self.slots) and self.laid.stretches > 1:
            return False
        self.widen()
        return True

    def widen(self) -> None:
        """Make room, whatever is in it."""
        if 2 * self.laid.slots + 2 > len(self.slots):
            self.slots.frombytes(bytes(8 * len(self.slots)))
        else:
            self.path = _grown(self.path)

    def cut_off(self, left: int) -> Stretches:
        """Take the stretches out but so many of the last ones."""
        path, count = self.path, self.laid.stretches
        end = count - left
        taken = part_of(path, 0, end)
        if left > 0:
            kept = part_of(path, end, count)
            for column, values in zip(_columns(path)[:-2], _columns(kept)[:-2], strict=True):
                column[: len(values)] = values
        self.laid.stretches = left
        return taken

    def clear(self) -> None:
        """The run is over."""
        self.laid.stretches = self.laid.rows = self.laid.slots = 0


def axes_of(limits: Limits) -> Axes:
    """What the axes can do in a run; none builds its acceleration up within less than `BUILD_S`."""
    jerks = (min(jerk, pull / BUILD_S) for pull, jerk in zip(limits.acceleration, limits.jerk, strict=True))
    return Axes(tops_of(limits), array("d", limits.acceleration), array("d", jerks))


def _columns(path: Stretches) -> list[array[float]]:
    """The columns, of which the last two have a number for each axis alone."""
    return cast("list[array[float]]", list(path))


def tops_of(limits: Limits) -> array[float]:
    """Highest speeds of the axes in a run, of which rapids may be a part."""
    if limits.path.rapid_stops:
        return array("d", limits.top_feed)
    return array("d", map(max, limits.top_feed, limits.top_rapid))


def _room(count: int, n: int) -> Stretches:
    """Room for so many stretches of n axes."""
    return Stretches(
        way=numbers(count + 1),
        place=numbers((count + 1) * n),
        leave=numbers(count * n),
        arrive=numbers(count * n),
        form=whole(count),
        tolerance=numbers(count),
        turn_tolerance=numbers(count),
        cap2=numbers(count),
        step2=numbers(count),
        spread2=numbers(count),
        left2=numbers(count),
        ease=numbers(count),
        row=whole(count),
        rotary=numbers(n),
        top=numbers(n),
    )


def _grown(path: Stretches) -> Stretches:
    """The same stretches with twice the room."""
    room = _room(2 * len(path.form), len(path.rotary))
    for new, old in zip(_columns(room), _columns(path), strict=True):
        new[: len(old)] = old
    return room
