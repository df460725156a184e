"""A run that is too long to hold: bent and given its law window by window, while it comes.

A window lies between two seams, which the path alone chooses: so many stretches and so many seconds of the feed
behind the one before, on the longest stretch there (`bends/seeking.py`). Its law begins in the motion in which the
window before leaves it, leads to rest some time beyond its end, and is kept up to its end. What is cut where, and how
far ahead is looked, depends on the path, never on the chunks in which it comes: so do the results, to the last bit.

Where no law is found from that motion, the one before goes on, for it leads to rest within the limits: for a while, at
last up to the rest.
"""

from __future__ import annotations

from array import array

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.third_order.compiled import kernels
from polycnc.motion.third_order.laws.quickest import Room as RoomOfLaws
from polycnc.motion.third_order.parts import Room, Seam, bend_between, cut_out, known_from, part_of
from polycnc.motion.third_order.windows import Windows

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.laws.courses import Axes
    from polycnc.motion.third_order.windows import Window


#: Columns of stretches that have a number at every end, at every end for each axis, and for each stretch.
ENDS, PLACES = ("way",), ("place",)
VECTORS, SINGLE = (
    ("leave", "arrive"),
    ("form", "tolerance", "turn_tolerance", "cap2", "step2", "spread2", "left2", "ease", "row"),
)

#: Stretches that are taken at once: what lies behind them need not be moved when those before are forgotten.
AT_ONCE = 2048


class Sizes(NamedTuple):
    """How a run is cut.

    Attributes:
        stretches: Of a window at least.
        seconds: Of a window at least, as the feed counts them.
        most: Stretches of a window, whatever its seconds.
        range: Stretches on one of which its end lies.
        around: Stretches before and behind those that are looked at for it; three times as many are fewer than
            those of a window.
    """

    stretches: int = 1000
    seconds: float = 2.0
    most: int = 8000
    range: int = 64
    around: int = 192


class Passing(NamedTuple):
    """A steady motion in which a run begins or ends: at a seam where the path is bent with even knots all around.

    Attributes:
        way: Where, by the ways of the stretches.
        apart: Distance of the knots around, mm.
        speed: mm/s; it does not change there. Of the highest one around 0.999 at most, for limits are met, not reached.
    """

    way: float
    apart: float
    speed: float


class Rooms:
    """Memory in which runs are bent and get their laws, one run after another: new one costs as much as both."""

    def __init__(self) -> None:
        self.bends, self.laws = Room(), RoomOfLaws()


class RunPlanner:
    """Plans one run from rest to rest, or from and to a steady motion, in windows.

    Args:
        axes: Limits of the axes; those of the speed are the tops of the stretches.
        take: Gets every window, in order.
        start: The motion in which the run begins; from rest without. Then its stretches begin so far before that the
            path is known there (`parts.known_from`).
        sizes: Of the windows.
        rooms: Those of the runs before; its own without.
    """

    def __init__(
        self,
        axes: Axes,
        take: Callable[[Window], object],
        *,
        start: Passing | None = None,
        sizes: Sizes | None = None,
        rooms: Rooms | None = None,
    ) -> None:
        self._sizes = sizes or Sizes()
        self._path: Stretches | None = None
        self._head = None if start is None else Seam(start.way, start.apart)
        rooms = rooms or Rooms()
        self._room = rooms.bends
        self._windows = Windows(axes, take, rooms.laws, 0.0 if start is None else start.speed)
        # Stretches of the buffer: the first of this window, the first not counted, the last looked at for rests.
        self._since = self._counted = self._searched = 0
        self._passed = array("d", (0.0,))
        self._located = start is None

    @property
    def detours(self) -> int:
        """Windows whose law could not begin in the motion before."""
        return self._windows.detours

    def take(self, chunk: Stretches, *, closed: bool = False) -> None:
        """Stretches that follow those taken: their ways go on, and the first place is the last one of those.

        Their arrays are the planner's from then on. Where the run is `closed` with them it is finished next.
        """
        count = len(chunk.form)
        for first in range(0, count, AT_ONCE):
            part = chunk if count <= AT_ONCE else part_of(chunk, first, min(first + AT_ONCE, count))
            if self._path is None:  # where a path begins is known but for the first stretches
                self._path = part
            else:
                _extend(self._path, part)
            if not (closed and first + AT_ONCE >= count):
                self._go_on(None, ended=False)

    def finish(self, end: Passing | None = None) -> None:
        """The run has come to its end: to rest, or to a steady motion, behind which stretches lie as before a start."""
        if self._path is not None:
            self._go_on(end, ended=True)
        self._path = None

    def _go_on(self, end: Passing | None, *, ended: bool) -> None:
        """Bend what is settled."""
        path = self._path
        assert path is not None
        if not self._located:
            self._locate(path)
        while path.form:
            count = len(path.form)
            rest = kernels().next_rest(path, self._searched)
            self._searched = min(rest, count) - 1
            tail = self._next_seam(path, min(rest, count))
            if tail is not None:
                self._windows.add(bend_between(path, self._head, tail, self._room))
                self._pass(path, tail)
            elif rest < count:
                self._rest(path, rest)
            else:
                break
        if ended and path.form:
            tail = None if end is None else Seam(end.way, end.apart)
            self._windows.add(
                bend_between(path, self._head, tail, self._room), 0.0 if end is None else end.speed
            )

    def _locate(self, path: Stretches) -> None:
        """Find the stretch of the seam at which the run begins, where it has come."""
        assert self._head is not None
        while self._since < len(path.form) and path.way[self._since + 1] <= self._head.way:
            self._since += 1
        self._counted = self._searched = self._since
        self._located = self._since < len(path.form)

    def _next_seam(self, path: Stretches, end: int) -> Seam | None:
        """The seam at which the window ends, if it is settled by the stretches before `end`."""
        sizes = self._sizes
        if not self._located or end - self._since < min(sizes.stretches, sizes.most) + sizes.range:
            return None
        self._counted = kernels().far_enough(
            path, self._since, self._counted, sizes.stretches, sizes.seconds, sizes.most, self._passed
        )
        low = self._counted - sizes.around
        high = self._counted + sizes.range + sizes.around
        if high + sizes.around > end:  # and room for a seam at which the run may end
            return None
        around = cut_out(path, low, high, path.way[low])
        found, room = array("d", (0.0, 0.0)), self._room
        room.for_stretches(high - low, len(path.rotary))
        if not kernels().find_seam(
            around,
            sizes.around,
            sizes.around + sizes.range,
            room.smooth,
            room.turning,
            room.spline,
            found,
        ):
            msg = f"rows {around.row[0]} to {around.row[-1]} cannot be bent within their tolerance"
            raise ValueError(msg)
        return Seam(path.way[low] + found[0], found[1])

    def _pass(self, path: Stretches, seam: Seam) -> None:
        """Go on behind a seam."""
        first = known_from(path, seam)
        self._head, self._passed[0] = seam, 0.0
        self._drop(path, first)
        self._since = 0
        while path.way[self._since + 1] <= seam.way:
            self._since += 1
        self._counted = self._since

    def _rest(self, path: Stretches, rest: int) -> None:
        """Bring the window to an end at a rest within the run."""
        leg = cut_out(path, 0, rest, 0.0)
        part = bend_between(leg, self._head, None, self._room)
        if path.row[rest] == path.row[rest - 1]:  # its row goes on
            part.rows.pop()
            part.row_way.pop()
        self._windows.add(part, 0.0)
        self._head, self._passed[0] = None, 0.0
        self._drop(path, rest)
        self._since = self._counted = self._searched = 0

    def _drop(self, path: Stretches, first: int) -> None:
        """Forget the stretches before one."""
        for name in ENDS + SINGLE:
            del getattr(path, name)[:first]
        for name in PLACES + VECTORS:
            del getattr(path, name)[: first * len(path.rotary)]
        self._searched = max(self._searched - first, 0)


def _extend(path: Stretches, part: Stretches) -> None:
    """Let a path go on with stretches that follow it."""
    n = len(path.rotary)
    path.way.extend(part.way[1:])
    path.place.extend(part.place[n:])
    for name in VECTORS + SINGLE:
        getattr(path, name).extend(getattr(part, name))
