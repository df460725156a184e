"""Chamfers and roundings between two moves: `,C` and `,R` of FANUC, CHR, CHF and RND of SINUMERIK.

The first of the two moves waits until the second one is known; then both are cut short and the new row
stands between them, with the line of the first. A rounding's centre lies where the parallels of both moves
at the rounding's radius meet, on the side to which the path turns; so lines and arcs need no cases of their
own.
"""

from __future__ import annotations

from enum import Enum
from math import degrees, hypot, isnan, nan, radians

from polycnc.channel.moves import origins
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import END_OF_BLOCK, EndOfBlock, Item, Move, PlacedEvent, Rank, Stage
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import SAME_POINT_MM
from polycnc.messages import AlarmError
from polycnc.toolpath.context import SHORTENED
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.moves.knots import Motions
    from polycnc.compensation.plane import Plane
    from polycnc.geometry.arcs import Point

#: Directions that differ by less (radians) have no corner between them.
_STRAIGHT_ON = 1e-6


class Shape(Enum):
    """What is put into a corner, and what its size means."""

    #: Straight; size = way from the corner along both moves (`,C`, CHR).
    CHAMFER = "chamfer"
    #: Straight; size = length of the chamfer itself (CHF).
    CHAMFER_LENGTH = "chamfer length"
    #: Tangent arc; size = radius (`,R`, RND, RNDM).
    ROUNDING = "rounding"


class CornerViolation(Enum):
    """What can be wrong with a corner; where the control gives no code, the corner is left as it is."""

    NO_NEXT_MOVE = "no move in the plane follows, or the block has none itself"
    #: Counts as `NO_NEXT_MOVE` where the control has no code of its own for it.
    RAPID = "one of the two moves is a rapid"
    #: Nothing is wrong where the control has no code for it: the corner is left as it is.
    TOO_MANY_BLOCKS = "too many blocks without a way in the plane stand between the two moves"
    TOO_SHORT = "a move is shorter than the chamfer or rounding needs"


@dataclass(frozen=True, slots=True)
class CornerPolicy:
    """The behaviour of one control.

    Attributes:
        dwell_between: A dwell may stand between the two moves.
        idle_blocks: Blocks without plane motion that may stand between the two moves; none where the next block must
            be the next move (FANUC 0i-TF Plus 4.7).
        shrinks: A size that does not fit is reduced to the largest that does (SINUMERIK).
        least_turn_deg: Between directions that differ by less there is no corner.
        waits_at_shape: The blocks between the two moves come in front of the shape, the tool standing where it begins;
            else behind it. What the block of the second move does first is behind it always.
        start_up_between: Radius compensation may start up between the two moves.
        at_rapids: Rapids have corners as other moves have, and a shape may be one.
        belongs_to_next: Feed, or rapid, of a shape are those of the second move; else of the first.
        threads_follow: The second move may be a thread; else it is refused as a rapid is.
    """

    dwell_between: bool = False
    idle_blocks: int = 0
    shrinks: bool = False
    least_turn_deg: float = degrees(1e-6)
    waits_at_shape: bool = False
    start_up_between: bool = False
    at_rapids: bool = False
    belongs_to_next: bool = False
    threads_follow: bool = True


@dataclass(frozen=True, slots=True)
class _Request:
    shape: Shape
    size: float
    feed: float = nan
    modal: bool = False


@dataclass(slots=True)
class _Held:
    """A move that waits for the next one, and what came after it, in order: items, and changes of later stages."""

    move: Move
    request: _Request
    blocks: int = 0
    dwells: bool = False
    after: list[Item] = field(default_factory=list)
    changes: list[Callable[[], None]] = field(default_factory=list)

    @property
    def between(self) -> int:
        """How many items belong to ended blocks: those behind them are of the block of the next move."""
        ends = [i for i, item in enumerate(self.after, 1) if isinstance(item, EndOfBlock)]
        return ends[-1] if ends else 0


class CornerStage(Stage):
    """The stage of the path that inserts chamfers and roundings.

    Args:
        plane: Working plane.
        policy: The control's behaviour.
        violations: The control's alarm codes.
        motions: Makes a shape part of the time of its block; without it the shape takes its own.
    """

    rank = Rank.CORNERS

    def __init__(
        self,
        plane: Plane,
        policy: CornerPolicy,
        violations: Mapping[CornerViolation, str],
        motions: Motions | None = None,
    ) -> None:
        self.plane, self._motions = plane, motions
        self.policy = policy
        self._violations = violations
        self._modal: _Request | None = None
        self._wanted: _Request | None = None
        #: Feed of a rounding of this block by RNDM; NaN where the block names none.
        self._own_feed = nan
        self._held: _Held | None = None
        #: Where the tool stands at a shape, while what came between the two moves is passed on.
        self._beside_shape: Point | None = None

    @property
    def active(self) -> bool:
        """Whether moves are held back or changed."""
        return self._modal is not None or self._wanted is not None or self._held is not None

    @property
    def rounds(self) -> bool:
        """Whether this block has asked for a rounding behind its move, which comes yet."""
        return self._wanted is not None and self._wanted.shape is Shape.ROUNDING

    def settle(self) -> bool:
        """Radius compensation begins, ends or changes: a corner that waits for its second move cannot span that.

        One of RNDM stays as it is. False where the program asked for the shape: then the control objects.
        """
        held = self._held
        if held is None:
            return True
        if held.request.modal:
            self._let_go(held)
        return held.request.modal

    def change(self, change: Callable[[], None]) -> None:
        """Change a later stage behind the shape that waits for its second move; at once where none waits.

        So radius compensation may begin, end or change between the two moves: the first one and the shape are of the
        contour in front.
        """
        if self._held is None:
            change()
        else:
            self._held.changes.append(change)

    @property
    def changes_later(self) -> bool:
        """Whether a change waits."""
        return self._held is not None and bool(self._held.changes)

    def insert(self, shape: Shape, size: float, feed: float = nan) -> None:
        """Put a shape after the move of this block; call it before the move.

        Args:
            shape: Chamfer or rounding.
            size: As the shape says, mm, positive.
            feed: Feed of the inserted row; NaN for that of the move in front (FRC).
        """
        self._wanted = _Request(shape, size, feed)

    def round_all(self, radius: float, feed: float = nan) -> None:
        """Round every corner between cutting moves from this block on (RNDM); radius 0 ends it."""
        self._modal = _Request(Shape.ROUNDING, radius, feed, modal=True) if radius > 0.0 else None

    def feed_all(self, feed: float) -> None:
        """Another feed of all roundings from this block on; NaN for that of the move in front (FRCM)."""
        if self._modal is not None:
            self._modal = replace(self._modal, feed=feed)

    def feed_once(self, feed: float) -> None:
        """Another feed of a rounding by RNDM behind this block alone; call it before the move (FRC)."""
        self._own_feed = feed

    def move(self, move: Move) -> None:
        """Take the next move; see `Stage`."""
        if not self.plane.moves(move):
            if move.kind is Kind.DWELL:
                self.dwell()
            self._in_order(move)
            return
        held, wanted, self._wanted = self._held, self._wanted, None
        if held is not None:
            # The zero may have been moved between the two: the corner is that of the machine.
            seam = arcs.minus(self.plane.point(held.move.end), self.plane.point(move.start))
            if hypot(*seam) > SAME_POINT_MM:
                near = self._join(held, self.plane.moved(move, seam))
                move = self.plane.moved(near, (-seam[0], -seam[1]))
            else:
                move = self._join(held, move)
        is_left = move.kind is Kind.RAPID and not self.policy.at_rapids
        request = wanted or (None if is_left else self._rounding())
        if request is None:
            self._pass(move)
        else:
            self._held = _Held(move, request)

    def dwell(self) -> None:
        """This block is a dwell, of no time perhaps: one between the two moves does not count."""
        held = self._held
        if held is not None and self.policy.dwell_between and not held.dwells:
            held.dwells = True
            held.blocks -= 1

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it keeps its place between the moves."""
        self._in_order(event)

    def block(self) -> None:
        """A block has been read: too many without plane motion, and there is no corner."""
        self._in_order(END_OF_BLOCK)
        self._own_feed = nan
        if self._wanted is not None:
            self._wanted = None
            self._violate(CornerViolation.NO_NEXT_MOVE, 0)
        if self._held is not None:
            self._held.blocks += 1
            if self._held.blocks > self.policy.idle_blocks + 1:
                if not self._held.request.modal:
                    self._violate(CornerViolation.TOO_MANY_BLOCKS, self._held.move.line)
                self._give_up()

    def flush(self) -> None:
        """Pass on what is held back: no more moves will come."""
        self._give_up()
        self.after.flush()

    def discard(self) -> None:
        """Forget everything that is held back (alarm, reset)."""
        self._held = self._wanted = self._modal = None
        self._own_feed = nan

    # ---- inside --------------------------------------------------------------------------------------------

    def _rounding(self) -> _Request | None:
        modal, feed, self._own_feed = self._modal, self._own_feed, nan
        return modal if modal is None or isnan(feed) else replace(modal, feed=feed)

    def _in_order(self, item: Item) -> None:
        if self._held is not None:
            self._held.after.append(item)
        else:
            self._pass_item(item)

    def _pass_item(self, item: Item) -> None:
        self.pass_on(self._displaced(item) if isinstance(item, Move) else item)

    def _give_up(self) -> None:
        held = self._held
        if held is None:
            return
        if not held.request.modal:
            self._violate(CornerViolation.NO_NEXT_MOVE, held.move.line)
        self._let_go(held)

    def _let_go(self, held: _Held, inserted: Move | None = None) -> None:
        """Pass on the move, the shape, and what came between: in front of the shape or behind it."""
        self._held = None
        self._pass(held.move)
        before = held.between if self.policy.waits_at_shape else 0
        if inserted is not None:
            self._pass_beside(inserted.start, held.after[:before])
            self._pass(inserted)
        for change in held.changes:
            change()
        end, behind = (held.move.end, held.after) if inserted is None else (inserted.end, held.after[before:])
        self._pass_beside(end, behind)

    def _pass_beside(self, end: list[float], items: list[Item]) -> None:
        self._beside_shape = self.plane.point(end)
        for item in items:
            self._pass_item(item)
        self._beside_shape = None

    def _displaced(self, move: Move) -> Move:
        """A dwell, or a move square to the plane, between the two moves of a corner happens at an end of the shape."""
        point = self._beside_shape
        if point is None:
            return move
        return replace(move, start=self.plane.at(move.start, point), end=self.plane.at(move.end, point))

    def _pass(self, move: Move) -> None:
        if move.center is not None or move.start != move.end:
            self.after.move(move)

    def _violate(self, violation: CornerViolation, line: int) -> None:
        code = self._violations.get(violation)
        if code is None and violation is CornerViolation.RAPID:
            code = self._violations.get(CornerViolation.NO_NEXT_MOVE)
        if code is not None:
            raise AlarmError(code, line=line)

    def _join(self, held: _Held, move: Move) -> Move:
        """Cut both moves, pass on the first and the inserted row; gives the second as cut."""
        a, b = self.plane.edge(held.move), self.plane.edge(move)
        request = held.request
        is_thread = move.kind is Kind.THREAD and not self.policy.threads_follow
        is_rapid = Kind.RAPID in (held.move.kind, move.kind) and not self.policy.at_rapids
        if is_thread or is_rapid:
            if not request.modal:
                self._violate(CornerViolation.RAPID, held.move.line)
        elif a is not None and b is not None and abs(offset.turn(a, b)) > radians(self.policy.least_turn_deg):
            size = request.size
            cuts = _cuts(request.shape, a, b, size)
            if cuts is None and self.policy.shrinks:
                size = _largest(request.shape, a, b, size)
                cuts = _cuts(request.shape, a, b, size)
            if cuts is not None:
                return self._cut(held, move, cuts, offset.turn(a, b) > 0.0)
            if not self.policy.shrinks:
                self._violate(CornerViolation.TOO_SHORT, held.move.line)
        self._let_go(held)
        return move

    def _cut(self, held: _Held, move: Move, cuts: offset.Cuts, ccw: bool) -> Move:
        plane, first = self.plane, held.move
        ways = MovePath(first, plane.columns), MovePath(move, plane.columns)
        own_end = plane.at(_between(ways[0], cuts.part_a), cuts.leaving)
        leaving, entering = own_end, plane.at(_between(ways[1], cuts.part_b), cuts.entering)
        turned = ways[0].turned(0.0, cuts.part_a), ways[1].turned(cuts.part_b, 1.0)
        moved = any(isinstance(item, Move) and item.start != item.end for item in held.after)
        if moved:  # other axes have gone their own way between: the shape lies in the plane
            own_end = plane.at(first.end, cuts.leaving)
            level = move.start if self.policy.waits_at_shape else first.end
            leaving, entering = plane.at(level, cuts.leaving), plane.at(level, cuts.entering)
            turned = first.turning, move.turning
        like = move if self.policy.belongs_to_next else first
        is_rapid = like.kind is Kind.RAPID
        inserted = replace(
            first, kind=Kind.RAPID if is_rapid else Kind.FEED, start=leaving, end=entering, center=None, turns=0.0,
            parameters=(), turning=None, origin=origins.CORNER_LINE,
            feed=like.feed if is_rapid or isnan(held.request.feed) else held.request.feed,
        )  # fmt: skip
        if cuts.center is not None:
            inserted.kind = plane.arc_kind(ccw, leaving, entering)
            inserted.center, inserted.normal = plane.lift(cuts.center, leaving), plane.normal
            inserted.origin = origins.CORNER_ARC
        held.move = _rest(_cut_short(first, end=own_end, turning=turned[0]), cuts.part_a > 0.0)
        start = plane.at(move.start, cuts.entering) if moved else entering
        second = _rest(_cut_short(move, start=start, turning=turned[1]), cuts.part_b < 1.0)
        if self._motions is not None and isnan(held.request.feed) and not is_rapid:
            self._motions.share_time([second if self.policy.belongs_to_next else held.move, inserted])
        self._let_go(held, inserted)
        return second


def _cuts(shape: Shape, a: offset.Edge, b: offset.Edge, size: float) -> offset.Cuts | None:
    """The cuts for a shape between two edges; None where it does not fit."""
    if shape is Shape.ROUNDING:
        return offset.rounded(a, b, size)
    return offset.chamfered(a, b, size if shape is Shape.CHAMFER else offset.leg_of_chamfer(a, b, size))


def _largest(shape: Shape, a: offset.Edge, b: offset.Edge, size: float) -> float:
    """The largest size up to `size` that fits, by bisection down to a nanometre; smaller ones fit as well."""
    low, high = 0.0, size
    while high - low > 1e-9 * max(size, 1.0):
        middle = 0.5 * (low + high)
        if _cuts(shape, a, b, middle) is None:
            high = middle
        else:
            low = middle
    return low


def _cut_short(move: Move, **changes: Any) -> Move:
    """A move that the shape beside it leaves less of."""
    return replace(move, origin=move.origin or SHORTENED, **changes)


def _rest(move: Move, is_left: bool) -> Move:
    """What a cut leaves of a move; of an arc that is used up not a full circle, but nothing."""
    return move if is_left else replace(move, center=None)


def _between(way: MovePath, part: float) -> list[float]:
    """Positions of the axes after a part of a move, the point of the plane apart."""
    move = way.move
    if move.turning is not None:
        return way.at(part)
    return [s + part * (e - s) for s, e in zip(move.start, move.end, strict=True)]
