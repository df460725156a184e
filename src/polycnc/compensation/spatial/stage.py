"""The stage of radius compensation in space: the tip moves by the radius across path and tool.

With the tool along v and the path along t the tool stands to the left by v × t. At a corner both blocks see the
same tool v, so their offset lines, looked at along v, meet at `r (n1 + n2) / (1 + n1 · n2)` from the corner. An arc
whose plane is square on the tool has a parallel arc (`arcs`), any other one becomes chords. Where the control
turns the tool at a corner (`Rules.turns`), it does that before the arc about it or along with it.
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from math import acos, ceil, degrees, sqrt

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, PlacedEvent, Rank, Stage
from polycnc.compensation.spatial.arcs import Rest, between, crossing, is_across, meeting, turns_left
from polycnc.compensation.spatial.chords import CHORD_ERROR_MM, bends, doubled, strays
from polycnc.compensation.spatial.rules import TURNS_ALONG, TURNS_BEFORE, TURNS_NOT
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import parts_for_chord_error
from polycnc.geometry.vectors import cross, dot, minus, times
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.compensation.spatial.chords import Directions
    from polycnc.compensation.spatial.rules import Corners, Rules
    from polycnc.geometry.frames import Vector

PARALLEL = 1e-6
NOWHERE: Vector = (0.0, 0.0, 0.0)


@dataclass(slots=True)
class _Held:
    """A block whose end waits for the next one: its move, the normal at its end, the tool there, its direction.

    What it has of the stage holds for the corner at its end: how corners are passed, the depth, what a floor adds, and
    the side.
    """

    move: Move
    normal: Vector
    tool: Vector
    tangent: Vector
    starts: bool
    corners: Corners
    rules: Rules
    depth: float
    deeper: float
    side: int


class SpatialStage(Stage):
    """Offsets straight moves of the tip.

    Args:
        geometry: Columns of X, Y, Z.
        posture: How the tool stands on the work.
        radius: Offset, mm; negative changes sides.
        side: 1 left, -1 right.
        corners: What happens at outer corners.
        rules: How the control does it.
        join: Makes one motion of the chords of a move.

    Attributes:
        posture: How the tool stands on the work, from the next move on.
        depth: How far down the tool its tip lies from the programmed point, from the next block on, mm.
        leaves: The next move leads back to the programmed path.
    """

    rank = Rank.SPATIAL_COMPENSATION

    def __init__(
        self,
        geometry: tuple[int, int, int],
        posture: Directions,
        radius: float,
        side: int,
        corners: Corners,
        rules: Rules,
        join: Callable[[list[Move]], object] = len,
    ) -> None:
        self.side = side
        self._unite = join
        self.corners = corners
        self.rules = rules
        self.depth = 0.0
        self._depth = 0.0
        self._geometry = geometry
        self.posture = posture
        self.radius = self._next_radius = radius
        self._starts = rules.square_start
        self._held: _Held | None = None
        self._shift: Vector = NOWHERE
        self._at: list[float] | None = None
        self._idle = 0
        self._queue: list[Move | PlacedEvent] = []
        self.leaves = False
        self._left = False

    @property
    def active(self) -> bool:
        """Whether the move that leads back to the programmed path is still to come."""
        return not self._left

    @property
    def holds_vector(self) -> bool:
        """Whether the tool stands beside the path, or a block waits that leads it there."""
        return self._held is not None or self._at is not None

    def beside(self, position: list[float]) -> list[float]:
        """Where the tip stands when the program stands at a position; see `Stage`."""
        return self._shifted(position, self._shift)

    def programmed(self, position: list[float]) -> list[float]:
        """Where the program stands when the tip stands at a position; see `Stage`."""
        x, y, z = self._shift
        return self._shifted(position, (-x, -y, -z))

    def move(self, move: Move) -> None:
        """Take the next move."""
        if self.leaves:
            self._lead_back(move)
            return
        if self._left:
            self.after.move(move)
            return
        tool = self.posture.tool_at(move.end)
        if not move.is_arc:
            start, end = self._point(move.start), self._point(move.end)
            way = _unit((end[0] - start[0], end[1] - start[1], end[2] - start[2]))
            self._take(move, tool, way, way, self.corners)
        elif is_across(move, tool) and _near(tool, self.posture.tool_at(move.start)):
            path = MovePath(move, self._geometry)
            self._take(move, tool, path.direction(0.0), path.direction(1.0), self.corners)
        elif self.rules.slanted:
            raise AlarmError(self.rules.slanted, line=move.line)
        else:
            self._in_chords(move)

    def _in_chords(self, move: Move) -> None:
        """An arc that has no parallel arc, in chords; between them the parallels meet."""
        path = MovePath(move, self._geometry, in_chords=True)
        error = CHORD_ERROR_MM * path.radius / (path.radius + abs(self.radius))
        count = parts_for_chord_error(path.radius, path.sweep, error)
        count = doubled(count, partial(strays, path, self.posture))
        chords = [
            replace(move, kind=Kind.SPLINE, start=start, end=end, center=None, turns=0.0, turning=None)
            for start, end in pairwise(path.at(k / count) for k in range(count + 1))
        ]
        self._unite(chords)
        for k, chord in enumerate(chords, 1):
            departing, arriving = (path.direction(part / len(chords)) for part in (k - 1, k))
            self._take(chord, self.posture.tool_at(chord.end), departing, arriving, self.corners)

    def _take(
        self, move: Move, tool: Vector, departing: Vector | None, arriving: Vector | None, corners: Corners
    ) -> None:
        """End the block in front at its corner with this one, which waits for its own."""
        normal = None if arriving is None else self._normal(tool, arriving)
        if departing is None or arriving is None or normal is None:
            self._later(move)
            return
        self._idle = 0
        deeper = self._deeper(normal, tool, arriving)
        self._join(departing, move, deeper)
        self.radius = self._next_radius
        self._hold(move, normal, tool, arriving, corners, deeper)

    def _hold(
        self, move: Move, normal: Vector, tool: Vector, tangent: Vector, corners: Corners, deeper: float = 0.0
    ) -> None:
        """Let a block wait for the next one."""
        self._held = _Held(
            move, normal, tool, tangent, self._starts, corners, self.rules, self.depth, deeper, self.side
        )
        self._starts = False

    def shift_at(self, place: Move) -> None:
        """A block without motion starts up: the tool goes beside the next one there (FANUC type C)."""
        self._hold(place, NOWHERE, self.posture.tool_at(place.end), NOWHERE, self.corners)

    def return_at(self, place: Move) -> None:
        """A block without motion ends the compensation: the tool goes back to the path there (FANUC type C)."""
        self._release()
        self._emit(place, NOWHERE)

    def _deeper(self, normal: Vector, tool: Vector, tangent: Vector) -> float:  # noqa: ARG002 - for floors
        """How far down the tool a floor beside the wall calls for at the end of the move that comes, mm."""
        return 0.0

    def _later(self, item: Move | PlacedEvent) -> None:
        """Pass something on behind the block that waits, or at once where none does."""
        self._queue.append(item)
        if self._held is None:
            self._run_queue()

    def _run_queue(self) -> None:
        queue, self._queue = self._queue, []
        for item in queue:
            if isinstance(item, Move):
                self._emit(item, self._shift)
            else:
                self.after.event(item)

    def _join(self, tangent: Vector, following: Move, deeper: float) -> None:
        """End the block that waits at its corner with the following one, which has this direction."""
        held, self._held = self._held, None
        if held is None:
            return
        self._depth = held.depth + (deeper if held.starts else held.deeper)
        turned = self._tool_behind(held)
        first, second = held.normal, self._normal(turned, tangent)
        if second is None:
            raise AlarmError(held.rules.no_corner, line=held.move.line)
        changed = held.side != self.side
        if changed and held.starts:
            second = times(second, -1.0)
        outer = self._is_outer(held, second, turned, tangent)
        if held.starts and not (held.rules.corner_ends and outer):
            self._emit(held.move, self._beside(second, turned))
            self._run_queue()
            return
        if changed:
            self._emit_turning(held.move, held.tangent, self._crossing(held, following, second, tangent))
            self._run_queue()
            return
        cosine = min(1.0, dot(first, second))
        if outer and held.corners.is_round(180.0 - degrees(acos(max(-1.0, cosine)))):
            if held.corners.cut_off:
                self._cut_off(held, second, tangent)
                return
            self._emit_turning(held.move, held.tangent, self._beside(first, held.tool))
            self._round(held, second, turned)
            return
        if cosine < -1.0 + PARALLEL:
            raise AlarmError(held.rules.no_corner, line=held.move.line)
        factor = 1.0 / (1.0 + cosine)
        x, y, z = (factor * (a + b) for a, b in zip(first, second, strict=True))
        shift = self._beside((x, y, z), held.tool)
        if (held.move.is_arc or following.is_arc) and cosine < 1.0 - PARALLEL * PARALLEL:
            shift = self._meeting(held, following)
        self._emit_turning(held.move, held.tangent, shift)
        self._run_queue()

    def _meeting(self, held: _Held, following: Move) -> Vector:
        """The vector from a corner to where the parallels meet of which one at least is an arc."""
        distance = self.side * self.radius
        found = meeting(held.move, following, held.tool, (distance, distance), self._geometry)
        if found is None:
            raise AlarmError(held.rules.no_corner, line=held.move.line)
        x, y, z = (a - self._depth * b for a, b in zip(found, held.tool, strict=True))
        return (x, y, z)

    def _crossing(self, held: _Held, following: Move, second: Vector, tangent: Vector) -> Vector:
        """At a change of side: to where the parallels meet within reach of a block, else square on the next one.

        FANUC 0i-TF Plus 5.4.3, looked at along the tool.
        """
        one, two = times(held.normal, self.radius), times(second, self._next_radius)
        if held.move.is_arc or following.is_arc:
            distances = (held.side * self.radius, self.side * self._next_radius)
            found = meeting(held.move, following, held.tool, distances, self._geometry)
        else:
            found = crossing(one, two)
        if found is not None:
            back = self._part_of(held.move, held.tool, held.tangent, times(found, -1.0))
            ahead = self._part_of(following, held.tool, tangent, found)
            found = found if 0.0 <= back <= 1.0 or 0.0 <= ahead <= 1.0 else None
        x, y, z = (u - self._depth * v for u, v in zip(found or two, held.tool, strict=True))
        return (x, y, z)

    def _part_of(self, move: Move, tool: Vector, tangent: Vector, way: Vector) -> float:
        """How much of a move a way across the tool is as long as, counted along a direction."""
        flat = minus(tangent, times(tool, dot(tangent, tool)))
        length = MovePath(move, self._geometry).length if move.is_arc else self._length(move)
        return dot(way, flat) / max(length * dot(flat, flat), PARALLEL)

    def _length(self, move: Move) -> float:
        way = minus(self._point(move.end), self._point(move.start))
        return sqrt(dot(way, way))

    def _tool_behind(self, held: _Held) -> Vector:
        """The tool as the moves that wait behind a block leave it."""
        if held.rules.turns == TURNS_NOT:
            return held.tool
        turned = [move for move in self._queue if isinstance(move, Move)]
        return self.posture.tool_at(turned[-1].end) if turned else held.tool

    def _is_outer(self, held: _Held, second: Vector, turned: Vector, tangent: Vector) -> bool:
        outer = dot(second, held.tangent) * self.radius
        unturned = self._normal(held.tool, tangent)
        if held.rules.changes and unturned is not None and turned != held.tool:
            before = dot(unturned, held.tangent) * self.radius
            if min(outer, before) < -PARALLEL and max(outer, before) > PARALLEL:
                raise AlarmError(held.rules.changes, line=held.move.line)
        if held.rules.rounds_ends and dot(held.normal, second) < PARALLEL - 1.0 and held.side == self.side:
            return True
        return outer > PARALLEL

    def _round(self, held: _Held, second: Vector, turned: Vector) -> None:
        """About an outer corner, with what waits there in front, behind or along."""
        if turned == held.tool and held.rules.turns != TURNS_BEFORE:
            self._around(held.move, second, turned)
            self._run_queue()
            return
        if held.rules.turns == TURNS_ALONG:
            self._turn_along(held, second)
            return
        queue, self._queue = self._queue, []
        for item in queue:
            if not isinstance(item, Move):
                self.after.event(item)
                continue
            tool = self.posture.tool_at(item.end)
            normal = self._normal(tool, held.tangent)
            shift = self._shift if normal is None else self._beside(normal, tool)
            self._emit_turning(item, held.tangent, shift)
            held.move = item
        self._around(held.move, second, turned)

    def _cut_off(self, held: _Held, second: Vector, tangent: Vector) -> None:
        """Past a sharp outer corner by the radius, and back to the other parallel in a line."""
        sign = 1.0 if self.radius > 0.0 else -1.0
        ways = ((held.normal, held.tangent, sign), (second, tangent, -sign))
        beyond, before = (self._on_parallel(normal, way, held.tool, part) for normal, way, part in ways)
        self._emit_turning(held.move, held.tangent, beyond)
        self._emit(replace(held.move, turning=None), before)
        self._run_queue()

    def _on_parallel(self, normal: Vector, tangent: Vector, tool: Vector, part: float) -> Vector:
        """From a corner to a place beside it, by a part of the radius farther along the path, seen along the tool."""
        way = _unit(minus(tangent, times(tool, dot(tangent, tool)))) or tangent
        x, y, z = (a + part * b for a, b in zip(normal, way, strict=True))
        return self._beside((x, y, z), tool)

    def _around(self, move: Move, normal: Vector, tool: Vector) -> None:
        """An arc about the corner where a move ends, across the tool."""
        shift = self._beside(normal, tool)
        end = self._shifted(move.end, shift)
        if self._at is None or _near(self._shift, shift):
            return
        self._shift = shift
        clockwise = self.side * self.radius > 0.0
        kind = Kind.CW if clockwise else Kind.CCW
        x, y, z = (a - self._depth * b for a, b in zip(self._point(move.end), tool, strict=True))
        arc = replace(move, kind=kind, start=self._at, end=end, center=(x, y, z), normal=tool)
        self._at = end
        self.after.move(arc)

    def _turn_along(self, held: _Held, second: Vector) -> None:
        """The arc in chords, each with the part of the turns that lies on it, by their angles (ORIC)."""
        queue, self._queue = self._queue, []
        ways = [self._angle_of(item) if isinstance(item, Move) else 0.0 for item in queue]
        total, sweep, done = sum(ways), acos(max(-1.0, min(1.0, dot(held.normal, second)))), 0.0
        for item, way in zip(queue, ways, strict=True):
            if not isinstance(item, Move):
                self.after.event(item)
                continue
            share = way / total
            radius = max(abs(self.radius), PARALLEL)
            count = parts_for_chord_error(radius, sweep * share, CHORD_ERROR_MM)
            places = [
                [a + k / count * (b - a) for a, b in zip(item.start, item.end, strict=True)]
                for k in range(count + 1)
            ]
            chords = [
                replace(item, kind=Kind.SPLINE, start=start, end=end) for start, end in pairwise(places)
            ]
            self._unite(chords)
            for k, chord in enumerate(chords, 1):
                normal = between(held.normal, second, sweep, done + share * k / count)
                self._emit(chord, self._beside(normal, self.posture.tool_at(chord.end)))
            done += share

    def _angle_of(self, move: Move) -> float:
        """How far a move turns the tool, radians; never quite nothing."""
        a, b = self.posture.tool_at(move.start), self.posture.tool_at(move.end)
        return max(acos(max(-1.0, min(1.0, dot(a, b)))), PARALLEL)

    def _beside(self, normal: Vector, tool: Vector) -> Vector:
        """From the programmed point to the tip: by the radius along a normal, and the depth down the tool."""
        x, y, z = (self.radius * a - self._depth * b for a, b in zip(normal, tool, strict=True))
        return (x, y, z)

    def _emit(self, move: Move, shift: Vector) -> None:
        end = self._shifted(move.end, shift)
        self._shift = shift
        moved = replace(move, start=self._at or move.start, end=end)
        if move.center is not None:
            moved.center = self._centre(move, move.center)
        self._at = end
        self.after.move(moved)

    def _emit_turning(self, move: Move, tangent: Vector, shift: Vector) -> None:
        """Pass a block on; where the tool turns along a straight one, in chords that keep as far beside it.

        `tangent` is the direction of the path, of a block that only turns the tool that of the one before.
        """
        if self.rules.reverses and self._at is not None and not move.is_arc:
            self._check_sense(move, shift)
        before, path = self._shift, MovePath(move, self._geometry, in_chords=True)
        tools = self.posture.tool_at(move.start), self.posture.tool_at(move.end)
        first, last = (self._normal(tool, tangent) for tool in tools)
        straight = self._at is None or move.is_arc or not self.rules.follows_turns
        if first is None or last is None or straight:
            self._emit(move, shift)
            return
        rests = [
            Rest.of(minus(at, self._beside(normal, tool)), tangent, tool)
            for at, normal, tool in ((before, first, tools[0]), (shift, last, tools[1]))
        ]

        def beside(part: float) -> Vector:
            tool = self.posture.tool_at(path.at(part))
            normal = self._normal(tool, tangent) or last
            # What corners ask for at both ends fades along the block.
            rest = rests[0].fading(rests[1], part).at(tangent, tool)
            x, y, z = (a + b for a, b in zip(self._beside(normal, tool), rest, strict=True))
            return (x, y, z)

        count = self._chords(path, tangent, *rests)
        if move.turning is not None:  # near a pole the tool turns along a bent way
            count = doubled(count, lambda n: bends(beside, n) or strays(path, self.posture, n))
        if count == 1:
            self._emit(move, shift)
            return
        pieces = [path.between(k / count, (k + 1) / count) for k in range(count)]
        self._unite(pieces)
        for k, piece in enumerate(pieces, 1):
            if k < count:
                piece.kind = Kind.SPLINE
            self._emit(piece, beside(k / count))

    def _check_sense(self, move: Move, shift: Vector) -> None:
        """Refuse a block that leads against its programmed direction."""
        start, end = self._at or move.start, self._shifted(move.end, shift)
        led = minus(self._point(end), self._point(start))
        if dot(led, minus(self._point(move.end), self._point(move.start))) < 0.0:
            raise AlarmError(self.rules.reverses, line=move.line)

    def _chords(self, path: MovePath, tangent: Vector, first: Rest, last: Rest) -> int:
        """In how many chords the tip goes round where the tool, and what is square on it, turn along a move."""
        turning = path.move.turning
        parts = (0.0, 1.0) if turning is None else (0.0, *turning.shares)
        tools = [self.posture.tool_at(path.at(part)) for part in parts]
        normals = [self._normal(tool, tangent) or tool for tool in tools]
        counts = (
            parts_for_chord_error(max(abs(reach), PARALLEL), _turned(directions), CHORD_ERROR_MM / 2.0)
            for reach, directions in (
                (self.radius, normals),
                (max(abs(self._depth), abs(first.tool), abs(last.tool)), tools),
            )
        )
        # What fades while the tool turns bends the way by a quarter of both changes.
        bend = abs(last.tool - first.tool) * _turned(tools) / 4.0
        return max(*counts, ceil(sqrt(bend / (CHORD_ERROR_MM / 2.0))))

    def _centre(self, move: Move, center: Vector) -> Vector:
        """The centre of the parallel arc, as far down the tool as its ends."""
        tool = self.posture.tool_at(move.end)
        away = minus(self._point(move.start), center)
        left = self.side * self.radius * (1.0 if turns_left(move, tool) else -1.0)
        flat = minus(away, times(tool, dot(away, tool)))
        if self.rules.no_room and sqrt(dot(flat, flat)) - left < PARALLEL:
            raise AlarmError(self.rules.no_room, line=move.line)
        return minus(center, times(tool, self._depth))

    def _normal(self, tool: Vector, tangent: Vector) -> Vector | None:
        left = _unit(cross(tool, tangent))
        return None if left is None else times(left, float(self.side))

    def _point(self, position: list[float]) -> Vector:
        x, y, z = self._geometry
        return position[x], position[y], position[z]

    def _shifted(self, position: list[float], shift: Vector) -> list[float]:
        moved = list(position)
        for axis, value in zip(self._geometry, shift, strict=True):
            moved[axis] += value
        return moved

    def _release(self) -> None:
        """End the block that waits square on itself."""
        held, self._held = self._held, None
        if held is not None:
            self._depth = held.depth + held.deeper
            emit = self._emit if held.starts else partial(self._emit_turning, tangent=held.tangent)
            emit(held.move, shift=self._beside(held.normal, held.tool))
            self._starts = self._starts or (held.starts and held.normal == NOWHERE)
        self._run_queue()

    def lead_back(self) -> None:
        """The next move ends on the programmed path."""
        self.leaves = True

    def _lead_back(self, move: Move) -> None:
        """End the block that waits, at an outer corner with this move as if it were compensated; it leads back."""
        held, start, end = self._held, self._point(move.start), self._point(move.end)
        way = _unit(minus(end, start))
        second = None if held is None or way is None else self._normal(held.tool, way)
        if held is None or way is None or second is None:
            self._release()
        elif self._is_outer(held, second, held.tool, way):
            self._join(way, move, 0.0)
        else:
            self._release()
        self._emit(move, NOWHERE)
        self.leaves, self._left = False, True

    def change(self, side: int, radius: float) -> None:
        """The other side, or another radius, from the next block on; between the two is no corner, or a crossing."""
        if self.rules.crosses and side * radius * self.side * self.radius < 0.0:
            self.side, self._next_radius = side, radius
            return
        self._release()
        self.side, self.radius, self._next_radius = side, radius, radius

    def change_radius(self, radius: float) -> None:
        """Another radius: it holds at the end of the next block and grows along it (FANUC 0i-TF Plus 5.4.3)."""
        self._next_radius = radius

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it comes behind the block that waits."""
        self._later(event)

    def block(self) -> None:
        """Count blocks that cannot be computed; a computable one has set the count to zero."""
        self._idle += 1
        if self.rules.idle and self._at is not None and self._idle > self.rules.most_idle:
            raise AlarmError(self.rules.idle)
        self.after.block()

    def flush(self) -> None:
        """Pass on what waits."""
        self._release()
        self.after.flush()


def _unit(v: Vector) -> Vector | None:
    size = sqrt(dot(v, v))
    return None if size < PARALLEL else (v[0] / size, v[1] / size, v[2] / size)


def _turned(directions: Sequence[Vector]) -> float:
    """How far a direction turns, radians."""
    return sum(acos(max(-1.0, min(1.0, dot(a, b)))) for a, b in pairwise(directions))


def _near(a: Vector, b: Vector) -> bool:
    return all(abs(x - y) < PARALLEL for x, y in zip(a, b, strict=True))
