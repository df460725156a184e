"""Cutter radius compensation G40 to G42: one look-ahead engine for all controls.

How it works, and why it is right:

1. A block of the contour is an *edge* with a signed offset (left positive). Its parallel is known at once;
where it
   ends depends only on the edge that follows. So every plane move becomes a `_Step` that waits in the
   *window* until the next plane move tells its end: a `Corner`, the list of vectors from the programmed
   corner that the tool passes. The first vector ends the move, the last one starts the next move, and the
   way between them is extra rows.
2. Everything else (moves of other axes, events, block ends) is hung on the step in front and passed on
after it,
   with the tool where that step left it. So order is kept by construction.
3. Closing a corner changes nothing before it. That is why a step may be passed on as soon as its corner is
known and
   nothing that could still object to it is to come: when N blocks have been read (see `policies`). A step
   that must go before its corner is known ends square on itself: look-ahead too short and `flush` are the
   same case.
4. A move is gouged away when the vectors at its two ends have changed places. That is seen when its second
corner is
   closed, while the move in front still waits in the window: the alarm comes before the tool gets there.

Start-up, cancel, G38, G39 and forced vectors are other ways to make one corner (`vectors`), not other
states of the engine: it knows only which edge starts, which continues and which cancels.

Nose radius compensation is the same with a `tip`: the displayed point is the nose centre moved by radius
times tip, so while a vector stands, this shift stands with it (FANUC 0i-TF Plus 5.2).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import Enum
from math import hypot, inf
from typing import TYPE_CHECKING

from polycnc.compensation import vectors
from polycnc.compensation.avoidance import crosses, way_round
from polycnc.compensation.policies import Violation
from polycnc.geometry import arcs, offset
from polycnc.geometry.offset import Corner, Joint
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.path import Move, PathStage
    from polycnc.compensation.plane import Plane
    from polycnc.compensation.policies import Policy
    from polycnc.geometry.arcs import Point
    from polycnc.toolpath import Event

_NO_VECTOR: Point = (0.0, 0.0)


class _Role(Enum):
    """What the next plane move is."""

    PLAIN = "not compensated"
    START = "start-up"
    CONTOUR = "contour"
    CANCEL = "cancel"


@dataclass(slots=True)
class _Step:
    """A plane move in the window.

    Attributes:
        move: As programmed.
        edge: Its edge.
        role: Start-up, contour or cancel.
        distance: Signed offset of the contour, left positive.
        shift: Added to every vector (nose centre to tip).
        policy: The control's behaviour when the block was read.
        read: Number of the block.
        first: Vector at its start.
        corner: Vectors at its end, once known.
        forced: Direction on which the vector at its end stands square (I, J, K in the block).
        holds: It keeps the vector of its start (G38).
        starts_square: The block in front ends square on itself.
        straight: Its vectors were left out, so it is a straight move.
        avoided: Its end was moved to avoid an interference.
        behind_avoidance: Its start was.
        corner_arc: The block of G39 after it, and the direction on which the arc ends square.
        after: What came after it, in order.
    """

    move: Move
    edge: offset.Edge
    role: _Role
    distance: float
    shift: Point
    policy: Policy
    read: int
    first: Point = _NO_VECTOR
    corner: Corner | None = None
    forced: Point | None = None
    holds: bool = False
    starts_square: bool = False
    straight: bool = False
    avoided: bool = False
    behind_avoidance: bool = False
    corner_arc: tuple[Move, Point | None] | None = None
    after: list[Callable[[], None]] = field(default_factory=list)


class CutterCompensation:
    """The stage of the path that moves the tool off the contour by its radius.

    Args:
        plane: The plane of compensation; it must not change while compensation is active.
        policy: The control's behaviour; may be replaced between blocks.
        violations: The control's alarm code for each violation that it checks; one without a code is let
            pass.
        after: The next stage.
    """

    def __init__(
        self, plane: Plane, policy: Policy, violations: Mapping[Violation, str], after: PathStage
    ) -> None:
        self.plane = plane
        self.policy = policy
        self.after = after
        self._violations = violations
        self._role = _Role.PLAIN
        self._side = 1
        self._radius = 0.0
        self._tip = _NO_VECTOR
        self._window: list[_Step] = []
        self._read = 0
        self._vector = _NO_VECTOR
        self._delta = _NO_VECTOR
        self._wall: Point | None = None
        self._place: Move | None = None
        self._forced: Point | None = None
        self._holds = False
        self._starts_square = False

    # ---- what a control commands ---------------------------------------------------------------------------

    @property
    def active(self) -> bool:
        """Whether moves are compensated, or a vector is still to be removed."""
        return self._role is not _Role.PLAIN

    def engage(self, side: int, radius: float, tip: Point = _NO_VECTOR, place: Move | None = None) -> None:
        """G41 or G42, at the start, for a change of side or again.

        Args:
            side: 1 left of the direction of travel (G41), -1 right (G42).
            radius: Tool radius, mm; a negative one changes the sides.
            tip: Nose centre to programmed tip in units of the radius, in the plane; zero for milling tools.
            place: A move without way that stands for the block, where the control may shift the tool in a
                block without motion (start-up type C, `forced_vector`).
        """
        if self._role is _Role.CONTOUR:
            same = side * radius * self._side * self._radius > 0.0
            self._starts_square = self._starts_square or (same and self.policy.recommand_is_square)
        else:
            self._role = _Role.START
        self._side, self._radius, self._tip, self._wall = side, radius, tip, None
        self._place = place

    def cancel(self, wall: Point | None = None, place: Move | None = None) -> None:
        """G40. With motion in the block or without: the next plane motion leads back to the programmed path.

        Args:
            wall: Direction of the workpiece after the last point (`G40 I J K`), in the plane.
            place: As for `engage`.
        """
        if self._role is _Role.START and not self._window and self._vector == _NO_VECTOR:
            self._forget()
        elif self._role is not _Role.PLAIN:
            self._role = _Role.CANCEL
            self._wall = wall
            self._place = place

    def change_radius(self, radius: float, tip: Point | None = None) -> None:
        """Another radius within compensation: it holds at the end of the next block and grows along it.

        FANUC 0i-TF Plus 5.2.4 and 5.3, SYNTEC 2.27.5: a block's end vector is that of the block's own radius.
        """
        self._radius = radius
        if tip is not None:
            self._tip = tip

    def change_side(self, side: int) -> None:
        """The other side within compensation, with the radius as it is."""
        self._side = side

    def forced_vector(self, direction: Point) -> None:
        """The vector at the end of this block is square on a direction (I, J, K in G00 or G01)."""
        self._forced = direction

    def hold_vector(self) -> None:
        """G38: the block in front ends square on itself, and this block keeps that vector."""
        self._holds = True

    def end_square(self) -> None:
        """The block in front ends square on itself: nothing is read behind this block before it is executed."""
        self._release_all()

    def drop_vector(self) -> None:
        """The block in front ends on the programmed point; compensation goes on from there (G50, G52)."""
        if self._window and self._window[-1].corner is None:
            last = self._window[-1]
            last.corner, last.shift = Corner([_NO_VECTOR]), _NO_VECTOR
        self._release_all()
        self._vector = self._delta = _NO_VECTOR

    def corner_arc(self, place: Move, direction: Point | None = None) -> None:
        """G39: an arc about the corner, from square on the block in front to square on the next one.

        Args:
            place: A move without way that stands for the block: kind, feed and line of the arc.
            direction: Direction on which the arc ends square, instead of the next block (`G39 I J K`).
        """
        if self._window and self._window[-1].corner is None:
            self._window[-1].corner_arc = (place, direction)

    def discard(self) -> None:
        """Forget everything that is held back (alarm, reset)."""
        self._window.clear()
        self._forget()

    # ---- the stage -----------------------------------------------------------------------------------------

    def move(self, move: Move) -> None:
        """Take the next move; see `PathStage`."""
        if self._role is _Role.PLAIN or not self.plane.moves(move):
            self._in_order(lambda: self._pass(move))
            return
        edge = self.plane.edge(move)
        if edge is None:
            self._violate(Violation.INNER_RADIUS_TOO_SMALL, move)
            edge = offset.line(self.plane.point(move.start), self.plane.point(move.end))
        self._place = None
        self._take(move, edge)

    def event(self, event: Event, program: int, line: int, context: int) -> None:
        """Take an event; it keeps its place between the moves."""
        self._in_order(lambda: self.after.event(event, program, line, context))

    def block(self) -> None:
        """A block has been read: look-ahead counts blocks, with or without motion."""
        place, self._place = self._place, None
        if place is not None and (self.policy.shifts_without_motion or self._forced is not None):
            point = self.plane.point(place.end)
            self._take(place, offset.Edge(point, point, _NO_VECTOR, _NO_VECTOR))
        self._in_order(self.after.block)
        self._read += 1
        while self._window and self._read - self._window[0].read >= self._window[0].policy.read_blocks:
            self._release()

    def flush(self) -> None:
        """Pass on everything: no more moves will come, so the last one ends square on itself."""
        self._release_all()
        self.after.flush()

    # ---- the window ----------------------------------------------------------------------------------------

    def _in_order(self, deed: Callable[[], None]) -> None:
        if self._window:
            self._window[-1].after.append(deed)
        else:
            deed()

    def _take(self, move: Move, edge: offset.Edge) -> None:
        """Put a plane move into the window; it closes the corner in front of it."""
        distance = self._side * self._radius
        shift = (abs(distance) * self._tip[0], abs(distance) * self._tip[1])
        step = _Step(move, edge, self._role, distance, shift, self.policy, self._read, self._vector)
        step.forced, step.holds, step.starts_square = self._forced, self._holds, self._starts_square
        self._forced, self._holds, self._starts_square = None, False, False
        step.edge = self._checked(step)
        if self._window:
            self._close(self._window[-1], step)
        self._window.append(step)
        if self._role is _Role.START:
            self._role = _Role.CONTOUR
        elif self._role is _Role.CANCEL:
            step.corner, step.shift = Corner([_NO_VECTOR]), _NO_VECTOR
            self._release_all()
            self._forget()

    def _checked(self, step: _Step) -> offset.Edge:
        """The edge to be offset, once it is sure that it may be."""
        edge = step.edge
        if edge.center is None:
            return edge
        if step.role is not _Role.CONTOUR:
            start = step.role is _Role.START
            self._violate(Violation.ARC_START if start else Violation.ARC_CANCEL, step.move)
            return edge
        radius = min(arcs.radius_of(edge.center, edge.start), arcs.radius_of(edge.center, edge.end))
        if offset.offset_radius(radius, step.distance, edge.ccw) < -offset.SMOOTH_MM:
            if step.policy.avoids:
                return offset.line(edge.start, edge.end)
            self._violate(Violation.INNER_RADIUS_TOO_SMALL, step.move)
        return edge

    def _close(self, step: _Step, following: _Step) -> None:
        """Decide the end of a step by the one that follows, and check what this makes of it."""
        if step.corner is None:
            corner = self._corner(step, following)
            if corner is None:
                corner = self._no_intersection(step, following)
            if step.corner_arc is None:
                corner = vectors.without_small_moves(corner, following.edge, step.policy.least_move_mm)
            step.corner = corner
            if step.role is _Role.CONTOUR and step.forced is None and not step.holds:
                self._check(step, following)
        following.first = self._end_of(self._window[-1], following)

    @staticmethod
    def _end_of(step: _Step, following: _Step) -> Point:
        """The last vector of a step, seen from the start of the following one."""
        u, v = step.corner.vectors[-1] if step.corner else _NO_VECTOR
        end, start = step.edge.end, following.edge.start
        return (u + end[0] - start[0], v + end[1] - start[1])

    def _corner(self, step: _Step, following: _Step) -> Corner | None:
        edge, distance, policy = step.edge, step.distance, step.policy
        if step.forced is not None:
            return vectors.square(offset.ray(edge.end, step.forced).arriving, distance)
        if step.holds:
            return Corner([step.first])
        if step.corner_arc is not None:
            direction = step.corner_arc[1]
            end = following.edge.departing if direction is None else offset.ray(edge.end, direction).arriving
            return Corner([offset.square(edge.arriving, distance), offset.square(end, distance)], Joint.ARC)
        if following.role is not _Role.CONTOUR:
            return vectors.leave(edge, following.edge, distance, policy, self._wall)
        if step.role is _Role.START:
            return vectors.approach(edge, following.edge, distance, policy)
        if following.holds or following.starts_square:
            return vectors.square(edge.arriving, distance)
        if following.distance * distance < 0.0:
            return vectors.change_of_side(edge, following.edge, distance, following.distance)
        return offset.corner(edge, following.edge, distance, policy.outer)

    def _no_intersection(self, step: _Step, following: _Step) -> Corner:
        """FANUC 0i-TF Plus 5.4.3: the tool stops at the end of the block in front."""
        if Violation.NO_INTERSECTION in self._violations:
            while len(self._window) > 1:
                self._release()
        self._violate(Violation.NO_INTERSECTION, step.move)
        return Corner(
            [offset.square(d, step.distance) for d in (step.edge.arriving, following.edge.departing)]
        )

    def _release(self) -> None:
        """Pass on the first step of the window; without a following one it ends square on itself."""
        self._keep_clear()
        step = self._window.pop(0)
        if step.corner is None:
            step.corner = self._blind_end(step)
        self._emit(step, step.corner)
        for deed in step.after:
            deed()

    def _blind_end(self, step: _Step) -> Corner:
        no_length = step.edge.length <= 0.0
        if step.forced is not None:
            return vectors.square(offset.ray(step.edge.end, step.forced).arriving, step.distance)
        if step.role is _Role.START and (no_length or not step.policy.blind_start_is_square):
            step.shift = _NO_VECTOR
            if self._role is _Role.CONTOUR:
                self._role = _Role.START
            return Corner([_NO_VECTOR])
        if step.holds:
            return Corner([step.first])
        corner = vectors.square(step.edge.arriving, step.distance)
        if step.corner_arc is not None and step.corner_arc[1] is not None:
            end = offset.ray(step.edge.end, step.corner_arc[1]).arriving
            return Corner([*corner.vectors, offset.square(end, step.distance)], Joint.ARC)
        return corner

    def _release_all(self) -> None:
        while self._window:
            self._release()

    def _forget(self) -> None:
        self._role = _Role.PLAIN
        self._vector = self._delta = _NO_VECTOR
        self._wall = self._place = None
        self._forced, self._holds, self._starts_square = None, False, False

    # ---- interference --------------------------------------------------------------------------------------

    def _violate(self, violation: Violation, move: Move) -> None:
        """Raise the control's alarm at the line of a move, unless the control does not check this."""
        code = self._violations.get(violation)
        if code is not None:
            raise AlarmError(code, line=move.line, program=move.program)

    def _check(self, step: _Step, following: _Step) -> None:
        """Look for vectors that have changed places with those just found (FANUC 0i-TF Plus 5.4.6)."""
        policy, is_line = step.policy, step.edge.center is None
        if step.corner is None:
            return
        self._check_behind_avoidance(step)
        if len(self._window) < 2:
            return
        ends = step.corner.vectors
        for earlier in self._window[:-2] if policy.checks_direction and not policy.looks_far else ():
            if earlier.corner is None or earlier.forced is not None:
                continue
            if crosses(earlier.edge, earlier.corner.vectors[-1], step.edge, ends[0]):
                self._violate(Violation.INTERFERENCE, step.move)
        previous = self._window[-2]
        if previous.corner is None or previous.forced is not None:
            return
        if not (policy.checks_direction if is_line else policy.checks_arcs):
            return
        starts = previous.corner.vectors
        # Of several vectors those that cross are left out in pairs, the inmost first; the last must not cross.
        while offset.reverses(step.edge, starts[-1], ends[0]):
            is_last = len(starts) == 1 and len(ends) == 1
            if policy.looks_far and is_last:
                # Decided when the block in front is passed on.
                return
            if is_last or (policy.avoids and not policy.looks_far):
                self._avoid(previous, step, following)
                return
            if len(starts) > 1:
                starts.pop()
            if len(ends) > 1:
                ends.pop(0)
            step.first, step.straight = starts[-1], True

    def _keep_clear(self) -> None:
        """Before a block is passed on: compare its end with those of the blocks read, the farthest first (5.4.6)."""
        first = self._window[0]
        if not first.policy.looks_far or first.corner is None or first.forced is not None:
            return
        numbers: list[int] = []
        for number in range(len(self._window) - 2, 0, -1):
            step = self._window[number]
            if step.corner is None or step.forced is not None or step.role is not _Role.CONTOUR:
                continue
            vector, other = first.corner.vectors[-1], step.corner.vectors[0]
            if number > 1:
                found = step.policy.checks_direction and crosses(first.edge, vector, step.edge, other)
            else:
                is_line = step.edge.center is None
                checked = step.policy.checks_direction if is_line else step.policy.checks_arcs
                found = checked and offset.reverses(step.edge, vector, other)
            if found:
                numbers.append(number)
        # A way round that would cut gives way to one past fewer blocks.
        if numbers and not any(self._lead_round(number) for number in numbers):
            self._lead_round(numbers[0], dares=True)

    def _lead_round(self, number: int, *, dares: bool = False) -> bool:
        """Replace the blocks between the first one of the window and the one behind `number` (5.4.6.3).

        False where there is no way, or a dangerous one; with `dares` these are alarms, as far as the control has them.
        """
        first, last, following = self._window[0], self._window[number], self._window[number + 1]
        if number == 1 and _meets_joint(first, last):
            return True
        way, between = None, self._window[1 : number + 1]
        if first.role is following.role is _Role.CONTOUR:
            edges = [step.edge for step in between]
            way = way_round(first.edge, first.first, edges, following.edge, last.distance)
        if not dares and (way is None or way.is_dangerous):
            return False
        if way is None:
            self._violate(Violation.NO_AVOIDANCE, last.move)
            return True
        if way.is_dangerous and not first.policy.dares:
            self._violate(Violation.AVOIDANCE_DANGEROUS, last.move)
        first.corner = Corner([way.leaving])
        del self._window[1 : number + 1]
        for step in between[:-1] if way.arriving is not None else between:
            first.after.extend(step.after)
        behind = first
        if way.arriving is not None:
            move = replace(
                last.move, kind=Kind.FEED, start=first.move.end, center=None, turns=0.0, parameters=()
            )
            edge = offset.line(first.edge.end, last.edge.end)
            behind = replace(last, move=move, edge=edge, first=way.leaving, corner=Corner([way.arriving]))
            self._window.insert(1, behind)
        following.first, following.behind_avoidance = self._end_of(behind, following), True
        self._check_behind_avoidance(following)
        return True

    def _check_behind_avoidance(self, step: _Step) -> None:
        """The block behind an avoidance must not run backwards itself."""
        if not step.behind_avoidance or step.corner is None or step.policy.dares:
            return
        if offset.reverses(step.edge, step.first, step.corner.vectors[0]):
            self._violate(Violation.AVOIDANCE_INTERFERES, step.move)

    def _avoid(self, previous: _Step, step: _Step, following: _Step) -> None:
        """Leave a move out: the one in front runs on to the one that follows (FANUC 0i-TF Plus 5.4.6.3)."""
        if not step.policy.avoids:
            self._violate(Violation.INTERFERENCE, step.move)
            return
        dares = step.policy.dares
        if previous.avoided and not dares:
            self._violate(Violation.AVOIDANCE_INTERFERES, step.move)
        if _meets_joint(previous, step):
            return
        before, beyond = previous.edge, following.edge
        point = None
        if previous.role is following.role is _Role.CONTOUR:
            point = offset.meet(before, beyond, step.distance, step.distance)
        if point is None:
            self._violate(Violation.NO_AVOIDANCE, step.move)
            return
        vector = (point[0] - before.end[0], point[1] - before.end[1])
        leads_back = offset.reverses(before, previous.first, vector)
        if not dares and (leads_back or offset.is_outer(before, beyond, step.distance)):
            self._violate(Violation.AVOIDANCE_DANGEROUS, step.move)
        previous.corner, previous.avoided = Corner([vector]), True
        previous.after.extend(step.after)
        self._window.remove(step)

    # ---- writing -------------------------------------------------------------------------------------------

    def _pass(self, move: Move) -> None:
        """Pass on a move that is not compensated itself, from where the vector holds the tool."""
        if self._delta == _NO_VECTOR:
            self.after.move(move)
            return
        plane = self.plane
        start, end = (plane.at(p, _add(plane.point(p), self._delta)) for p in (move.start, move.end))
        self.after.move(replace(move, start=start, end=end, center=plane.moved_center(move, self._delta)))

    def _emit(self, step: _Step, corner: Corner) -> None:
        """Pass on a compensated move and the rows that lead round the corner at its end."""
        move, edge, plane = step.move, step.edge, self.plane
        start = _add(plane.point(move.start), self._delta)
        target = _add(edge.end, _add(corner.vectors[0], step.shift))
        way = hypot(target[0] - start[0], target[1] - start[1])
        if edge.is_full_circle and way <= 2.0 * step.policy.least_move_mm:
            # Rounding must not shrink a full circle to nothing.
            target, way = start, inf
        row = replace(move, start=plane.at(move.start, start), end=plane.at(move.end, target))
        if move.center is not None:
            if edge.center is None or step.straight or way <= arcs.SAME_POINT_MM:
                row = replace(row, kind=Kind.FEED, center=None, turns=0.0)
            else:
                row = replace(row, center=plane.moved_center(move, step.shift))
        if row.center is not None or way > arcs.SAME_POINT_MM or plane.moves_elsewhere(move):
            self.after.move(row)
        template = replace(step.corner_arc[0] if step.corner_arc else move, start=row.end, end=row.end)
        for vector in corner.vectors[1:]:
            template = self._join(template, step, corner.joint, vector)
        self._vector = corner.vectors[-1]
        self._delta = _add(self._vector, step.shift)

    def _join(self, template: Move, step: _Step, joint: Joint, vector: Point) -> Move:
        """One row from the place of the last one to the next vector."""
        plane = self.plane
        target = _add(step.edge.end, _add(vector, step.shift))
        end = plane.at(template.end, target)
        center, kind = None, Kind.RAPID if template.kind is Kind.RAPID else Kind.FEED
        if joint is Joint.ARC:
            kind = Kind.CCW if step.distance < 0.0 else Kind.CW
            center = plane.lift(_add(step.edge.end, step.shift), end)
        elif joint is Joint.SPLINE:
            kind = Kind.SPLINE
        row = replace(
            template, kind=kind, start=template.end, end=end, center=center,
            normal=plane.normal, turns=0.0, parameters=(),
        )  # fmt: skip
        u, v = plane.point(template.end)
        if hypot(target[0] - u, target[1] - v) > arcs.SAME_POINT_MM:
            self.after.move(row)
        return replace(row, kind=template.kind)


def _add(a: Point, b: Point) -> Point:
    return (a[0] + b[0], a[1] + b[1])


def _subtract(a: Point, b: Point) -> Point:
    return (a[0] - b[0], a[1] - b[1])


def _meets_joint(previous: _Step, step: _Step) -> bool:
    """Let the move in front run on to the arc about the corner behind a step too short for the tool."""
    if step.corner is None or step.corner.joint is not Joint.ARC:
        return False
    about, distance = step.edge.end, step.distance
    first, last = (_add(about, vector) for vector in (step.corner.vectors[0], step.corner.vectors[-1]))
    joint = offset.arc(first, last, about, distance < 0.0)
    point = offset.meet(previous.edge, joint, distance, 0.0)
    if point is None or not arcs.contains_direction(first, last, about, joint.ccw, point):
        return False
    previous.corner = Corner([_subtract(point, previous.edge.end)])
    step.first = _subtract(point, step.edge.start)
    step.corner.vectors[0] = _subtract(point, about)
    return True
