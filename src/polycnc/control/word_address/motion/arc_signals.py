"""Where a signal comes on an arc, and the part of the arc in front of it (M96 of FANUC and SYNTEC).

An arc is known when its row is made, so the row is looked at: that also fits G68, mirrors of the work and R in place
of centre words. Spirals and arcs of several turns are not known here.
"""

from __future__ import annotations

from math import acos, asin, pi, tau

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.vectors import axis_vector
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector

#: How far start and end of an arc may differ in radius and still be one circle, mm.
SAME_RADIUS = 0.05


class MadeArc(NamedTuple):
    """An arc whose row stands in the toolpath; work positions, mm and degrees.

    Attributes:
        kind: Its sense, and whether it climbs.
        feed: As its row has it.
        start: Where it begins, and `end` where it ends: all axes.
        center: Its centre, and `normal` the direction across its plane.
        plane: Columns of the axes of its plane.
        middle: The centre in these axes.
        sweep: Its angle, radians; below 0 clockwise.
    """

    kind: Kind
    feed: float
    start: list[float]
    end: list[float]
    center: Vector
    normal: Vector
    plane: tuple[int, int]
    middle: Point
    sweep: float

    def position(self, share: float) -> list[float]:
        """Where all axes are after a share of the arc."""
        u, v = self.plane
        found = [a + (b - a) * share for a, b in zip(self.start, self.end, strict=True)]
        begin = (self.start[u], self.start[v])
        angle = arcs.angle_at(self.middle, begin) + self.sweep * share
        found[u], found[v] = arcs.point_at(self.middle, arcs.radius_of(self.middle, begin), angle)
        return found

    def shares(self, axis: int, value: float) -> Iterator[float]:
        """Where on the arc an axis has a value: shares, in no order."""
        if axis not in self.plane:
            way = self.end[axis] - self.start[axis]
            share = (value - self.start[axis]) / way if abs(way) > NO_WAY else 0.0
            if abs(self.start[axis] + way * share - value) <= NO_WAY and -NO_WAY <= share <= 1.0 + NO_WAY:
                yield share
            return
        u, v = self.plane
        begin = (self.start[u], self.start[v])
        radius, first = arcs.radius_of(self.middle, begin), arcs.angle_at(self.middle, begin)
        place = self.plane.index(axis)
        ratio = (value - self.middle[place]) / radius
        if abs(ratio) > 1.0 + NO_WAY:
            return
        ratio = min(max(ratio, -1.0), 1.0)
        angles = (acos(ratio), -acos(ratio)) if place == 0 else (asin(ratio), pi - asin(ratio))
        for angle in angles:
            turned = (angle - first if self.sweep > 0.0 else first - angle) % tau
            if tau - turned <= NO_WAY:
                turned = 0.0
            if turned <= abs(self.sweep) + NO_WAY:
                yield min(turned / abs(self.sweep), 1.0)

    def share_at(self, channel: WordAddressChannel, at: Mapping[str, float]) -> float | None:
        """The share of the arc after which a signal comes: where all axes that it names are where it says.

        Where they never are so together, each has to have been there, as on a straight way.
        """
        values = {
            axis: channel.control.from_display(channel, axis, value)
            for name, value in at.items()
            if (axis := channel.axis_index.get(name)) is not None
        }
        found = [sorted(self.shares(axis, value)) for axis, value in values.items()]
        if not found or not all(found):
            return None
        for share in sorted(share for each in found for share in each):
            place = self.position(share)
            if all(abs(place[axis] - value) <= SAME_RADIUS / 100.0 for axis, value in values.items()):
                return share
        return max(each[0] for each in found)

    def make(self, channel: WordAddressChannel, share: float) -> None:
        """The arc up to a share of it."""
        channel.curve(self.kind, self.position(share), self.feed, center=self.center, normal=self.normal)


def made_arc(channel: WordAddressChannel, start: list[float], mark: int) -> MadeArc | None:
    """The arc that is all that a block has made since a mark; None where it is something else."""
    chunk = channel.toolpath.chunk
    if len(chunk) != mark + 1 or chunk.kind[-1] not in ARC_KINDS or channel.path.changes_ends:
        return None
    row, geometry = channel.toolpath.row_of(chunk, mark), channel.coordinates.geometry
    u, v, w = PLANES[channel.mode["plane"]]
    cx, cy, cz, nx, ny, nz, turns = row.curve[:7]
    center, normal, plane = (cx, cy, cz), (nx, ny, nz), (geometry[u], geometry[v])
    middle, end = (center[u], center[v]), list(row.end)
    first, last = ((place[plane[0]], place[plane[1]]) for place in (start, end))
    if turns or normal != axis_vector(w) or abs(arcs.radius_mismatch(first, last, middle)) > SAME_RADIUS:
        return None
    sweep = arcs.sweep_angle(first, last, middle, row.kind in CCW_KINDS)
    return MadeArc(row.kind, row.feed, start, end, center, normal, plane, middle, sweep)
