"""Cutter radius compensation G40 to G42: one look-ahead engine for all controls.

How it works, and why it is right:

1. A block of the contour is an *edge* with a signed offset (left positive). Its parallel is known at once; where it
   ends depends only on the edge that follows. So every plane move becomes a `Step` that waits in the *window* until
   the next plane move tells its end: a `Corner`, the list of vectors from the programmed corner that the tool passes
   (`ends`). The first vector ends the move, the last one starts the next move, and the way between them is extra rows
   (`rows`).
2. Everything else (moves of other axes, events, block ends) is hung on the step in front and passed on after it, with
   the tool where that step left it. So order is kept by construction.
3. Closing a corner changes nothing before it. That is why a step may be passed on as soon as its corner is known and
   nothing that could still object to it is to come: when N blocks have been read (see `policy`). A step that must
   go before its corner is known ends square on itself: look-ahead too short and `flush` are the same case.
4. A move is gouged away when the vectors at its two ends have changed places. That is seen when its second corner is
   closed, while the move in front still waits in the window: the alarm comes before the tool gets there
   (`interference`).

Start-up, cancel, G38, G39 and forced vectors are other ways to make one corner (`vectors`), not other states of the
engine: it knows only which edge starts, which continues and which cancels.

Nose radius compensation is the same with a `tip`: the displayed point is the nose centre moved by radius times tip, so
while a vector stands, this shift stands with it (FANUC 0i-TF Plus 5.2).
"""

from __future__ import annotations

from itertools import pairwise
from math import hypot, nan

from polycnc.channel.moves.path import END_OF_BLOCK, Item, Move, PlacedEvent, Rank, Stage
from polycnc.compensation import vectors
from polycnc.compensation.ends import blind_end, end_before, square_ends, starts_blind
from polycnc.compensation.interference import InterferenceCheck, Objections
from polycnc.compensation.policy import BENDS, Approach, Violation
from polycnc.compensation.rows import RowWriter
from polycnc.compensation.step import NO_VECTOR, Role, Step
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.offset import Corner
from polycnc.geometry.tolerances import NO_WAY, ROUNDED_MM, SAME_POINT_MM
from polycnc.toolpath.context import PROGRAMMED
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.moves.knots import Motions
    from polycnc.channel.moves.path import Run
    from polycnc.compensation.plane import Plane
    from polycnc.compensation.policy import Policy
    from polycnc.geometry.arcs import Point


class CutterCompensation(Stage):
    """The stage of the path that moves the tool off the contour by its radius.

    Args:
        plane: The plane of compensation; it must not change while compensation is active.
        policy: The control's behaviour; may be replaced between blocks.
        violations: The control's alarm code for each violation that it checks; one without a code is let
            pass.
        motions: Makes one motion of rows of a block; without it they stand by themselves.

    Attributes:
        suspended: Contour blocks keep the vector that stands square at the end of the last compensated one
            (CUTCONON); the first one behind them begins square on itself, with a line to there.
    """

    rank = Rank.COMPENSATION
    takes_runs = True

    def __init__(
        self,
        plane: Plane,
        policy: Policy,
        violations: Mapping[Violation, str],
        motions: Motions | None = None,
    ) -> None:
        self.plane = plane
        self.policy = policy
        self._rows, self._motions = RowWriter(plane, self, motions), motions
        self._violations = Objections(violations)
        self._role = Role.PLAIN
        self._side = 1
        self._radius = 0.0
        self._tip = NO_VECTOR
        self._window: list[Step] = []
        self._interference = InterferenceCheck(
            self._window, self._rows, self._violations, self._release_before
        )
        self._read = 0
        self._wall: Point | None = None
        self._place: Move | None = None
        self._forced: Point | None = None
        self._holds = False
        self._starts_square = self._is_engaged = False
        self._is_bare = False
        self.suspended = False

    # ---- what a control commands ---------------------------------------------------------------------------

    @property
    def active(self) -> bool:
        """Whether moves are compensated, or a vector is still to be removed."""
        return self._role is not Role.PLAIN

    @property
    def holds_vector(self) -> bool:
        """Whether the tool stands beside the contour, or a move waits that leads it there."""
        return bool(self._window) or self._rows.vector != NO_VECTOR

    @property
    def is_starting(self) -> bool:
        """Whether the next move leads to the contour."""
        return self._role is Role.START

    @property
    def on_contour(self) -> bool:
        """Whether the next move belongs to the contour; what leads there and away does not."""
        return self._role is Role.CONTOUR and not self.suspended

    @property
    def side(self) -> int:
        """The side that was commanded last: 1 left of the direction of travel, -1 right."""
        return self._side

    def engage(self, side: int, radius: float, tip: Point = NO_VECTOR, place: Move | None = None) -> None:
        """G41 or G42, at the start, for a change of side or again.

        Args:
            side: 1 left of the direction of travel (G41), -1 right (G42).
            radius: Tool radius, mm; a negative one changes the sides.
            tip: Nose centre to programmed tip in units of the radius, in the plane; zero for milling tools.
            place: A move without way that stands for the block, where the control may shift the tool in a
                block without motion (start-up type C, `forced_vector`).
        """
        if self._role is Role.CONTOUR:
            same = side * radius * self._side * self._radius > 0.0
            self._starts_square = self._starts_square or (same and self.policy.recommand_is_square)
        else:
            self._role = Role.START
        self._side, self._radius, self._tip, self._wall = side, radius, tip, None
        self._place, self._is_engaged = place, True

    def cancel(self, wall: Point | None = None, place: Move | None = None) -> None:
        """G40. With motion in the block or without: the next plane motion leads back to the programmed path.

        Args:
            wall: Direction of the workpiece after the last point (`G40 I J K`), in the plane.
            place: As for `engage`.
        """
        if self._role is Role.START and not self._window and self._rows.vector == NO_VECTOR:
            self._forget()
        elif self._role is not Role.PLAIN:
            self._role = Role.CANCEL
            self._wall = wall
            self._place = place

    def change_radius(self, radius: float, tip: Point | None = None) -> None:
        """Another radius within compensation: it holds at the end of the next block and grows along it.

        FANUC 0i-TF Plus 5.2.4 and 5.3, SYNTEC 2.27.5: a block's end vector is that of the block's own radius. Beside
        another side (`change_side`), and by the policy where its sign changes, it holds from the start of that block.
        """
        self._radius = radius
        if tip is not None:
            self._tip = tip

    def change_side(self, side: int) -> None:
        """The other side within compensation."""
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

    def beside(self, position: list[float]) -> list[float]:
        """Where the tool stands when the program stands at a position; see `Stage`."""
        plane = self.plane
        return plane.at(position, arcs.plus(plane.point(position), self._rows.displacement))

    def programmed(self, position: list[float]) -> list[float]:
        """Where the program stands when the tool stands at a position beside it; see `Stage`."""
        plane = self.plane
        return plane.at(position, arcs.minus(plane.point(position), self._rows.displacement))

    def drop_vector(self) -> None:
        """The block in front ends on the programmed point; compensation goes on from there (G50, G52)."""
        if self._window and self._window[-1].corner is None:
            last = self._window[-1]
            last.corner, last.shift = Corner([NO_VECTOR]), NO_VECTOR
        self._release_all()
        self._rows.drop_vector()

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
        """Take the next move; see `Stage`."""
        if self._role is Role.PLAIN or not self.plane.moves(move):
            self._in_order(move)
            if self._place is not None:
                self._place = self._place.between(move.end, move.end)
            return
        edge = self.plane.edge(move)
        if edge is None:
            self._refuse_radius(move)
            edge = offset.line(self.plane.point(move.start), self.plane.point(move.end))
        self._place = None
        self._take(move, edge)

    def run(self, run: Run) -> int:
        """Take many moves at once, where all that wait and all that follow are ordinary lines (`runs`)."""
        window = self._window
        waits = self._place is not None or self._forced is not None or self._holds
        timed = self._motions is not None and self._motions.is_timed(run.context)
        if (
            waits
            or timed
            or self.suspended
            or self._starts_square
            or self._role is not Role.CONTOUR
            or not window
        ):
            return 0
        from polycnc.compensation.runs.window import Window, fits  # for long programs only

        same = window[-1].distance == self._side * self._radius and window[-1].policy == self.policy
        if not (same and window[-1].shift == self._shift() and fits(window, run, self._read)):
            return 0
        whole = Window(self.plane, window, run, self._rows.displacement)
        read = self.after.run(whole.run.part(whole.lead()))
        if read:
            window[:] = whole.steps(read, self._read + read)
            self._read += read
            self._rows.vector = whole.vector(read - 1)
            self._rows.displacement = arcs.plus(self._rows.vector, self._shift())
        return read

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it keeps its place between the moves."""
        self._in_order(event)

    def block(self) -> None:
        """A block has been read: look-ahead counts blocks, with or without motion."""
        place, self._place = self._place, None
        shifts = self.policy.shifts_without_motion and self._role is not Role.CONTOUR
        if place is not None and (shifts or self._forced is not None):
            point = self.plane.point(place.end)
            place.feed = nan if place.kind is Kind.RAPID else place.feed
            self._take(place, offset.Edge(point, point, NO_VECTOR, NO_VECTOR))
        self._is_bare = self._role is Role.CANCEL and self.policy.bare_cancel_is_square
        self._in_order(END_OF_BLOCK)
        self._read += 1
        while self._window and self._read - self._window[0].read >= self._window[0].waits_for:
            self._release()

    def flush(self) -> None:
        """Pass on everything: no more moves will come, so the last one ends square on itself."""
        self._release_all()
        self.after.flush()

    # ---- the window ----------------------------------------------------------------------------------------

    def _in_order(self, item: Item) -> None:
        if self._window:
            self._window[-1].after.append(item)
        else:
            self._pass_item(item)

    def _pass_item(self, item: Item | Step) -> None:
        if isinstance(item, Step):
            self._rows.pass_over(item)
        elif isinstance(item, Move):
            self._rows.pass_on(item)
        else:
            self.pass_on(item)

    def _take(self, move: Move, edge: offset.Edge) -> None:
        """Put a plane move into the window; it closes the corner in front of it."""
        distance, shift = self._side * self._radius, self._shift()
        step = Step(move, edge, edge, self._role, distance, shift, self.policy, self._read, self._rows.vector)
        step.side = self._side
        step.suspended = self.suspended and self._role is Role.CONTOUR
        step.forced, step.holds = self._forced, self._holds or step.suspended
        step.starts_square, step.is_engaged = self._starts_square, self._is_engaged
        step.is_bare = self._is_bare
        self._forced, self._holds, self._starts_square, self._is_engaged = None, False, False, False
        step.edge = self._checked(step)
        if step.role is Role.CONTOUR and not self._window and step.policy.approaches_behind_stops:
            self._rows.approach(step)
        if self._window:
            self._follow(self._window[-1], step)
        self._window.append(step)
        if self._role is Role.START:
            self._role = Role.CONTOUR
        elif self._role is Role.CANCEL:
            step.corner, step.shift = Corner([NO_VECTOR]), NO_VECTOR
            self._release_all()
            self._forget()

    def _follow(self, before: Step, step: Step) -> None:
        """A step comes behind the last one of the window."""
        seam = arcs.minus(before.contour.end, step.contour.start)
        if hypot(*seam) > SAME_POINT_MM:
            # The zero has been moved between them: their corner is found as if it had not, and no check looks past it.
            self._close(before, replace(step, contour=step.contour.moved(seam), edge=step.edge.moved(seam)))
            self._release_all()
            step.first = self._rows.vector
            return
        if step.policy.leaves_out_arcs and before.is_chord and not step.is_chord:
            self._leave_out_arcs(step)
        self._close(self._window[-1], step)
        if step.suspended or self._window[-1].suspended:
            self._release_all()  # no way round leads past such a stretch

    def _shift(self) -> Point:
        """What stands beside every vector (nose centre to tip), mm."""
        reach = abs(self._side * self._radius)
        return reach * self._tip[0], reach * self._tip[1]

    def _checked(self, step: Step) -> offset.Edge:
        """The edge to be offset, once it is sure that it may be."""
        edge = step.edge
        if edge.center is None or step.suspended:
            return edge
        if step.role is not Role.CONTOUR:
            start = step.role is Role.START
            self._violations.object(Violation.ARC_START if start else Violation.ARC_CANCEL, step.move)
            return edge
        radii = (arcs.radius_of(edge.center, edge.start), arcs.radius_of(edge.center, edge.end))
        # A radius lies between two rounded points; a rounded end beside them may make the other one differ.
        rounding = 2.0 * ROUNDED_MM + min(abs(radii[0] - radii[1]), ROUNDED_MM)
        if offset.offset_radius(min(radii), step.distance, edge.ccw) < -rounding:
            chord = arcs.radius_of(edge.start, edge.end)
            if step.policy.avoids and chord > NO_WAY:  # nothing could stand for a full circle
                step.altered = step.is_chord = True
                return offset.line(edge.start, edge.end)
            self._refuse_radius(step.move)
        return edge

    def _refuse_radius(self, move: Move) -> None:
        """The alarm for an arc that is about to be read: the tool stops at the start of the block in front (5.4.3)."""
        if Violation.INNER_RADIUS_TOO_SMALL in self._violations and self._window:
            self._release_before(self._window[-1])
        self._violations.object(Violation.INNER_RADIUS_TOO_SMALL, move)

    def _close(self, step: Step, following: Step) -> None:
        """Decide the end of a step by the one that follows, and check what this makes of it."""
        if step.corner is None:
            corner = end_before(step, following, self._wall)
            if corner is None:
                corner = self._no_intersection(step, following)
            if step.corner_arc is None:
                corner = vectors.without_small_moves(corner, following.edge, step.policy.least_move_mm)
            step.corner = corner
            self._bend(step, following)
            if step.role is Role.CONTOUR and step.forced is None and not step.holds:
                self._interference.check(step)
        self._window[-1].lead_to(following)

    def _bend(self, step: Step, following: Step) -> None:
        """A start-up or cancel block that meets the contour on a polynomial takes its direction from it."""
        starts = step.role is Role.START and following.role is Role.CONTOUR
        leaves = step.role is Role.CONTOUR and following.role is Role.CANCEL
        lead, met = (step, following) if starts else (following, step)
        rule, programmed = lead.policy.approach, lead.move.origin == PROGRAMMED  # a smooth approach is none
        straight = programmed and lead.edge.center is None and met.edge.length > NO_WAY
        if (starts or leaves) and rule in BENDS and straight:
            column = self.plane.columns[self.plane.w]
            lead.contact = met.contact_at(column, at_start=starts, curved=rule is Approach.CURVED)

    def _leave_out_arcs(self, following: Step) -> None:
        """Inner arcs too small for the tool go where the blocks in front of them and behind them meet."""
        count = next(
            (n for n, step in enumerate(reversed(self._window)) if not step.is_chord), len(self._window)
        )
        if count == len(self._window) or following.role is not Role.CONTOUR:
            return
        before, arcs_ = self._window[-count - 1], self._window[-count:]
        same = all(step.distance == before.distance and not step.is_commanded for step in (*arcs_, following))
        if not same or before.role is not Role.CONTOUR or before.is_commanded:
            return
        around = [step.contour for step in (before, *arcs_, following)]
        if any(offset.is_outer(one, two, before.distance) for one, two in pairwise(around)):
            return  # a peak between them: past it only a way round leads
        point = offset.meet(before.edge, following.edge, before.distance, following.distance)
        if point is None or offset.is_outer(before.edge, following.edge, before.distance):
            return
        self._interference.leave_out(before, arcs_, following, point)

    def _no_intersection(self, step: Step, following: Step) -> Corner:
        """FANUC 0i-TF Plus 5.4.3: the tool stops at the end of the block in front."""
        if Violation.NO_INTERSECTION in self._violations:
            while len(self._window) > 1:
                self._release()
        self._violations.object(Violation.NO_INTERSECTION, step.move)
        return square_ends(step, following)

    def _release(self) -> None:
        """Pass on the first step of the window; without a following one it ends square on itself."""
        self._interference.keep_clear()
        step = self._window.pop(0)
        if step.corner is None:
            step.corner = self._blind_end(step)
        self._interference.admit(step)
        self._rows.emit(step, step.corner)
        for item in step.after:
            self._pass_item(item)

    def _blind_end(self, step: Step) -> Corner:
        if not starts_blind(step):
            return blind_end(step)
        step.shift = NO_VECTOR
        if self._role is Role.CONTOUR:
            self._role = Role.START
        return Corner([NO_VECTOR])

    def _release_before(self, step: Step) -> None:
        while self._window[0] is not step:
            self._release()

    def _release_all(self) -> None:
        while self._window:
            self._release()

    def _forget(self) -> None:
        self._role = Role.PLAIN
        self._rows.drop_vector()
        self._interference.forget()
        self._wall = self._place = None
        self._forced, self._holds = None, False
        self._starts_square = self._is_engaged = self._is_bare = False
