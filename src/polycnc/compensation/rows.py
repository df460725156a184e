"""The rows that compensation passes on: moves with their vectors, and the ways round corners."""

from __future__ import annotations

from math import ceil, copysign, hypot, inf, sqrt

from polycnc.channel.moves import origins
from polycnc.compensation.step import NO_VECTOR, Role
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.offset import Joint
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from polycnc.channel.moves.knots import Motions
    from polycnc.channel.moves.path import Move, Stage
    from polycnc.compensation.plane import Plane
    from polycnc.compensation.step import Contact, Step
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector
    from polycnc.geometry.offset import Corner

#: Chords of a lead that meets the contour on a polynomial keep within this of it.
CHORD_TOLERANCE_MM = 0.001


class RowWriter:
    """Passes rows on for a stage, and knows where the tool stands beside the programmed point.

    Args:
        plane: The plane of compensation.
        stage: The stage whose next one gets the rows.
        motions: Makes one motion of rows of a block; without it they stand by themselves.

    Attributes:
        vector: The vector at the end of the last compensated move.
        displacement: How far the tool stands beside the programmed point: the vector, and the tip's shift with it.
    """

    def __init__(self, plane: Plane, stage: Stage, motions: Motions | None = None) -> None:
        self.plane = plane
        self._stage = stage
        self._motions = motions
        self.vector = NO_VECTOR
        self.displacement = NO_VECTOR

    def drop_vector(self) -> None:
        """From here on the tool is taken to stand on the programmed point."""
        self.vector = self.displacement = NO_VECTOR

    def pass_over(self, step: Step) -> None:
        """A step is left out: the tool stays in the plane, and stands beside the end of this step from now on."""
        move, edge, plane = step.move, step.edge, self.plane
        here = arcs.plus(plane.point(move.start), self.displacement)
        if plane.moves_elsewhere(move):
            self._stage.after.move(_straight(move, plane.at(move.start, here), plane.at(move.end, here)))
        self.displacement = arcs.plus(self.displacement, arcs.minus(edge.start, edge.end))

    def pass_on(self, move: Move) -> None:
        """Pass on a move that is not compensated itself, from where the vector holds the tool."""
        if self.displacement == NO_VECTOR:
            self._stage.after.move(move)
            return
        plane = self.plane
        start, end = (
            plane.at(p, arcs.plus(plane.point(p), self.displacement)) for p in (move.start, move.end)
        )
        self._stage.after.move(
            replace(move, start=start, end=end, center=plane.moved_center(move, self.displacement))
        )

    def approach(self, step: Step) -> None:
        """A straight block from where the tool stands to square on the start of a step, as far off as it stands now.

        At outer corners alone: at inner ones it would lead into the contour. Nothing for a step that keeps its vector,
        or leads nowhere.
        """
        distance = copysign(hypot(*self.vector), step.distance)
        if not distance or step.holds or step.edge.length <= NO_WAY:
            return
        vector, plane, move = offset.square(step.edge.departing, distance), self.plane, step.move
        if distance * (self.vector[0] * vector[1] - self.vector[1] * vector[0]) > NO_WAY:
            return
        way = arcs.minus(vector, self.vector)
        if hypot(*way) > NO_WAY:
            here = arcs.plus(plane.point(move.start), self.displacement)
            ends = plane.at(move.start, here), plane.at(move.start, arcs.plus(here, way))
            row = _straight(move, *ends)
            self._stage.after.move(replace(row, origin=origins.APPROACH_BEHIND_STOP))
        self.vector, self.displacement = vector, arcs.plus(self.displacement, way)
        step.first = vector

    def emit(self, step: Step, corner: Corner) -> None:
        """Pass on a compensated move and the rows that lead round the corner at its end."""
        move, edge, plane = step.move, step.edge, self.plane
        start = arcs.plus(plane.point(move.start), self.displacement)
        target = arcs.plus(edge.end, arcs.plus(corner.vectors[0], step.shift))
        way = hypot(target[0] - start[0], target[1] - start[1])
        if edge.is_full_circle and way <= 2.0 * step.policy.least_move_mm:
            # Rounding must not shrink a full circle to nothing.
            target, way = start, inf
        row = move.between(plane.at(move.start, start), plane.at(move.end, target))
        if move.center is not None:
            if edge.center is None or step.straight or way <= NO_WAY:
                row = replace(row, kind=Kind.FEED, center=None, turns=0.0)
            else:
                along = arcs.plus(step.shift, step.first) if step.suspended else step.shift
                row = replace(row, center=plane.moved_center(move, along))
        if step.contact is not None and way > NO_WAY:
            self._bend(row, step.contact, leaves=step.role is Role.CANCEL)
        made = [row] if step.contact is None or way <= NO_WAY else []
        if row.center is None and way <= NO_WAY and not plane.moves_elsewhere(move):
            made.clear()
        if len(corner.vectors) > 1:
            template = (step.corner_arc[0] if step.corner_arc else move).between(row.end, row.end)
            for vector in corner.vectors[1:]:
                template = self._join(template, step, corner.joint, vector, made)
        if self._motions is not None and made[:1] == [row] and not step.corner_arc:
            self._motions.share_time(made)
        for each in made:
            self._stage.after.move(each)
        self.vector = corner.vectors[-1]
        self.displacement = arcs.plus(self.vector, step.shift)

    def _bend(self, row: Move, contact: Contact, *, leaves: bool) -> None:
        """The row as chords of the polynomial that meets the contour where the row ends or, as it `leaves`, begins."""
        plane, u, v = self.plane, row.start, row.end
        in_order = (plane.u, plane.v, plane.w)
        (a, b, c), (d, e, f) = (
            [p[i] if (i := plane.columns[axis]) >= 0 else 0.0 for axis in in_order] for p in (u, v)
        )
        free, touching = ((d, e, f), (a, b, c)) if leaves else ((a, b, c), (d, e, f))
        points = [(0.0, touching), *course(free, touching, contact)]
        if not leaves:
            points = [(1.0 - share, point) for share, point in reversed(points)]
        kind = Kind.RAPID if row.kind is Kind.RAPID else Kind.SPLINE
        chords, before = [], row.start
        for share, point in points[1:-1]:
            place = [first + (last - first) * share for first, last in zip(u, v, strict=True)]
            for axis, value in zip(in_order, point, strict=True):
                if plane.columns[axis] >= 0:
                    place[plane.columns[axis]] = value
            chords.append(replace(row, kind=kind, start=before, end=place))
            before = place
        chords.append(replace(row, kind=kind, start=before))
        if self._motions is not None:
            self._motions.join(chords)
        for chord in chords:
            self._stage.after.move(chord)

    def _join(self, template: Move, step: Step, joint: Joint, vector: Point, made: list[Move]) -> Move:
        """Add one row from the place of the last one to the next vector."""
        plane = self.plane
        target = arcs.plus(step.edge.end, arcs.plus(vector, step.shift))
        end = plane.at(template.end, target)
        center, kind = None, Kind.RAPID if template.kind is Kind.RAPID else Kind.FEED
        if joint is Joint.ARC:
            kind = Kind.CCW if step.distance < 0.0 else Kind.CW
            center = plane.lift(arcs.plus(step.edge.end, step.shift), end)
        elif joint is Joint.SPLINE:
            kind = Kind.SPLINE
        origin = origins.ROUND_CORNER if center is not None or kind is Kind.SPLINE else origins.JOINED
        row = replace(
            template, origin=origin, kind=kind, start=template.end, end=end, center=center,
            normal=plane.normal, turns=0.0, parameters=(), turning=None,
        )  # fmt: skip
        u, v = plane.point(template.end)
        if hypot(target[0] - u, target[1] - v) > NO_WAY:
            made.append(row)
        return replace(row, kind=template.kind)


def _straight(move: Move, start: list[float], end: list[float]) -> Move:
    """A straight row between two positions, otherwise as a move."""
    kind = Kind.RAPID if move.kind is Kind.RAPID else Kind.FEED
    return replace(move, kind=kind, start=start, end=end, center=None, turns=0.0, parameters=(), turning=None)


def course(free: Vector, touching: Vector, at: Contact) -> list[tuple[float, Vector]]:
    """Points of a lead from the contour to its free point (KONTT, KONTC), with their shares `s`, but for the first.

    With `s` from 0 at the contour to 1 at the free point they lie on `c + L·t·s + L²/2·k·s² + r·sⁿ`: `t` is the tangent
    of the tool's path, `k` its curvature vector (KONTT leaves the term out, and n is 2 for 3), `L` the distance of both
    ends, and `r` what is left to the free point, where nothing is asked of the direction.

    Args:
        free: Where nothing is asked of the curve, in the plane's order, mm.
        touching: Where it meets the path beside the contour, mm.
        at: How it meets that.
    """
    way = [b - a for a, b in zip(touching, free, strict=True)]
    size = hypot(*way)
    first = [size * each for each in at.outwards]
    second = [0.5 * size * size * each for each in at.curvature or (0.0, 0.0, 0.0)]
    rest = [a - b - c for a, b, c in zip(way, first, second, strict=True)]
    highest = 2 if at.curvature is None else 3
    # The second derivative is linear, so it is greatest at an end.
    greatest = max(
        hypot(*(2.0 * b + (2.0 if highest == 2 else 6.0 * s) * c for b, c in zip(second, rest, strict=True)))
        for s in (0.0, 1.0)
    )
    count = max(ceil(sqrt(greatest / (8.0 * CHORD_TOLERANCE_MM))), 1)

    def place(s: float) -> Vector:
        x, y, z = (
            a + b * s + c * s * s + d * s**highest
            for a, b, c, d in zip(touching, first, second, rest, strict=True)
        )
        return x, y, z

    return [(k / count, place(k / count)) for k in range(1, count)] + [(1.0, free)]
